//! Whole steps of the world, everything in it. An item is an agent moved by one sub-step.

use crate::scenes;
use divan::Bencher;
use divan::counter::ItemsCount;
use std::sync::Arc;
use throng::World;
use throng::avoid::{Avo, ClearPath, Hrvo, LocalModel, Orca, Orca3d, Rvo, RvoLab, Search, Unavoiding, Vo};

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

const MODELS: [&str; 10] =
    ["none", "orca", "orca_3d", "avo", "hrvo", "clearpath", "vo", "rvo", "rvo, 250 drawn", "rvo_lab"];

/// The reference work with every model.
#[divan::bench(args = MODELS, sample_count = 10, sample_size = 1)]
fn crossing_of_10000(bencher: Bencher, name: &str) {
    let model: Arc<dyn LocalModel> = match name {
        "orca" => Arc::new(Orca::default()),
        "orca_3d" => Arc::new(Orca3d::default()),
        "avo" => Arc::new(Avo::default()),
        "hrvo" => Arc::new(Hrvo::default()),
        "clearpath" => Arc::new(ClearPath::default()),
        "vo" => Arc::new(Vo::default()),
        "rvo" => Arc::new(Rvo::default()),
        "rvo, 250 drawn" => Arc::new(Rvo { search: Search::Random { candidates: 250 }, ..Rvo::default() }),
        "rvo_lab" => Arc::new(RvoLab),
        _ => Arc::new(Unavoiding),
    };
    steps(bencher, scenes::crossing(10_000, model));
}
