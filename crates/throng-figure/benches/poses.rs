//! The time of a pose, of a plan of steps, and of a live step.

use glam::DVec2;
use throng_figure::{Build, Level, Live, Mesh, Person, Sample, Skeleton, Walk};

fn main() {
    divan::main();
}

/// A minute at 25 samples a second.
fn samples() -> Vec<Sample> {
    (0..1500)
        .map(|moment| {
            let time = f64::from(moment) / 25.0;
            Sample { time, position: DVec2::new(1.3 * time, (0.5 * time).sin()), heading: 0.4 * (0.5 * time).cos() }
        })
        .collect()
}

#[divan::bench(sample_size = 1000)]
fn pose(bencher: divan::Bencher) {
    let walk = Walk::recorded(&Person::new(1, 2), &samples()).expect("valid samples");
    let mut time = 0.0;
    bencher.bench_local(|| {
        time = (time + 0.04) % 60.0;
        walk.pose(divan::black_box(time))
    });
}

#[divan::bench]
fn plan_a_minute(bencher: divan::Bencher) {
    let samples = samples();
    bencher.bench(|| Walk::recorded(&Person::new(1, 2), divan::black_box(&samples)));
}

#[divan::bench(sample_size = 1000)]
fn live_step_of_40_ms(bencher: divan::Bencher) {
    let at = |time: f64| Sample { time, position: DVec2::new(1.3 * time, 0.0), heading: 0.0 };
    let mut live = Live::new(Person::new(1, 2), at(0.0)).expect("a valid sample");
    let mut moment = 0;
    bencher.bench_local(|| {
        moment += 1;
        live.step(at(f64::from(moment) * 0.04))
    });
}

#[divan::bench(sample_size = 1000)]
fn joints_in_the_world(bencher: divan::Bencher) {
    let person = Person::new(1, 2);
    let (skeleton, walk) = (Skeleton::new(&person), Walk::recorded(&person, &samples()).expect("valid samples"));
    let pose = walk.pose(10.0);
    bencher.bench_local(|| skeleton.world(divan::black_box(&pose)));
}

#[divan::bench]
fn mesh(bencher: divan::Bencher) {
    bencher.bench(|| Mesh::new(Build::Man, Level::Fine));
}
