//! Whole steps of the world, with all stages. An item is an agent moved by one sub-step.

use crate::scenes;
use divan::Bencher;
use divan::counter::ItemsCount;
use throng::World;

fn steps(bencher: Bencher, mut world: World) {
    let before = world.summary().agent_steps;
    world.step();
    let items = world.summary().agent_steps - before;
    bencher.counter(ItemsCount::new(items)).bench_local(|| world.step());
}

#[divan::bench(args = [(1_000, 0.5), (1_000, 2.0), (10_000, 0.5), (10_000, 2.0)], sample_count = 60, sample_size = 1)]
fn open(bencher: Bencher, (count, density): (usize, f64)) {
    steps(bencher, scenes::open(count, density));
}

#[divan::bench(sample_count = 60, sample_size = 1)]
fn ring_of_1000(bencher: Bencher) {
    steps(bencher, scenes::ring(1_000));
}

#[divan::bench(sample_count = 60, sample_size = 1)]
fn corridor_of_400(bencher: Bencher) {
    steps(bencher, scenes::corridor());
}
