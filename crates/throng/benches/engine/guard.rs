//! The guard in a packed crowd, everybody pushed at random. An item is an agent.

use crate::scenes::Dice;
use divan::Bencher;
use divan::counter::ItemsCount;
use glam::{DVec2, Vec2};
use throng::guard::{Bodies, Contacts, Guard, Pose};
use throng::perceive::Grid;
use throng::space::Walls;

/// Bodies of 0.2 m in rows like bricks, a gap of 2 % between them, and where each would go in a sub-step of 1/120 s.
fn packed(count: usize) -> (Vec<Vec2>, Vec<Pose>) {
    let mut dice = Dice(5);
    let side = (count as f64).sqrt() as usize;
    let place = |k: usize| {
        let (x, y) = (k % side, k / side);
        DVec2::new(x as f64 + 0.5 * (y % 2) as f64, y as f64 * 0.75_f64.sqrt()) * (0.4 * 1.02)
    };
    let positions: Vec<Vec2> = (0..count).map(|k| place(k).as_vec2()).collect();
    let mut push = || (DVec2::from_angle(dice.between(0.0, 6.3)) * dice.between(0.0, 1.3 / 120.0)).as_vec2();
    let targets = positions.iter().map(|&at| Pose { position: at + push(), heading: 0.0 }).collect();
    (positions, targets)
}

#[divan::bench(args = [1_000, 10_000])]
fn collect_contacts(bencher: Bencher, count: usize) {
    let (positions, _) = packed(count);
    let (radii, reach, numbers) = (vec![0.2; count], vec![0.015; count], (0..count as u32).collect::<Vec<_>>());
    let (mut grid, mut contacts, walls) = (Grid::default(), Contacts::default(), Walls::default());
    grid.rebuild(&positions, &numbers, 1.0);
    let (headings, cores, guarded) = (vec![0.0; count], vec![Vec2::ZERO; count], vec![true; count]);
    let bodies = Bodies {
        positions: &positions,
        headings: &headings,
        cores: &cores,
        radii: &radii,
        reach: &reach,
        guarded: &guarded,
    };
    bencher
        .counter(ItemsCount::new(count))
        .bench_local(|| contacts.collect(&bodies, &numbers, &grid, &walls, |_, _| true));
}

#[divan::bench(args = [1_000, 10_000])]
fn certify(bencher: Bencher, count: usize) {
    let (positions, targets) = packed(count);
    let (radii, reach, numbers) = (vec![0.2; count], vec![0.015; count], (0..count as u32).collect::<Vec<_>>());
    let (mut grid, mut contacts, walls) = (Grid::default(), Contacts::default(), Walls::default());
    grid.rebuild(&positions, &numbers, 1.0);
    let (headings, cores, guarded) = (vec![0.0; count], vec![Vec2::ZERO; count], vec![true; count]);
    let bodies = Bodies {
        positions: &positions,
        headings: &headings,
        cores: &cores,
        radii: &radii,
        reach: &reach,
        guarded: &guarded,
    };
    contacts.collect(&bodies, &numbers, &grid, &walls, |_, _| true);
    let mut guard = Guard::default();
    bencher
        .counter(ItemsCount::new(count))
        .with_inputs(|| targets.clone())
        .bench_local_refs(|targets| guard.certify(&bodies, &contacts, &walls, targets));
}
