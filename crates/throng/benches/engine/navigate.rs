//! Meshes and paths on floors of many rooms. An item is a room of a mesh, or a path.

use crate::scenes::{Dice, floor, on_floor};
use divan::Bencher;
use divan::counter::ItemsCount;
use glam::DVec2;
use throng::navigate::{NavMesh, PathSearch};

fn mesh(side: u32) -> NavMesh {
    let (ground, obstacles) = floor(side);
    NavMesh::build(&ground, &obstacles, 0.2, (DVec2::ZERO, DVec2::ZERO)).expect("a valid floor")
}

#[divan::bench(args = [3, 10, 30], sample_count = 20, sample_size = 1)]
fn build_rooms_squared(bencher: Bencher, side: u32) {
    let (ground, obstacles) = floor(side);
    bencher
        .counter(ItemsCount::new(side * side))
        .bench_local(|| NavMesh::build(&ground, &obstacles, 0.2, (DVec2::ZERO, DVec2::ZERO)));
}

/// Between random places of the floor.
#[divan::bench(args = [3, 10, 30], sample_count = 10, sample_size = 1)]
fn paths_through_rooms_squared(bencher: Bencher, side: u32) {
    let (mesh, mut search, mut rng) = (mesh(side), PathSearch::new(), Dice(11));
    let mut ends = Vec::new();
    while ends.len() < 100 {
        let (from, to) = (on_floor(side, &mut rng), on_floor(side, &mut rng));
        if mesh.path(&mut search, from, to).is_ok() {
            ends.push((from, to));
        }
    }
    bencher
        .counter(ItemsCount::new(ends.len()))
        .bench_local(|| ends.iter().filter_map(|&(from, to)| mesh.path(&mut search, from, to).ok()).count());
}

/// From random places of the floor to one place.
#[divan::bench(args = [3, 10, 30], sample_count = 10, sample_size = 1)]
fn paths_to_one_place_in_rooms_squared(bencher: Bencher, side: u32) {
    let (mesh, mut rng) = (mesh(side), Dice(11));
    let from: Vec<DVec2> = (0..500).map(|_| on_floor(side, &mut rng)).collect();
    let to = on_floor(side, &mut rng);
    bencher.counter(ItemsCount::new(from.len())).bench_local(|| mesh.paths(&from, to));
}

/// Whether two places some metres apart see each other.
#[divan::bench(args = [3, 30])]
fn sights_in_rooms_squared(bencher: Bencher, side: u32) {
    let (mesh, mut rng) = (mesh(side), Dice(12));
    let mut place = || loop {
        let at = on_floor(side, &mut rng);
        if mesh.locate(at).is_some() {
            return at;
        }
    };
    let ends: Vec<(DVec2, DVec2)> =
        (0..1_000).map(|_| (place(), place())).map(|(a, b)| (a, a + (b - a).clamp_length_max(4.0))).collect();
    bencher
        .counter(ItemsCount::new(ends.len()))
        .bench_local(|| ends.iter().filter(|&&(a, b)| mesh.visible(a, b)).count());
}
