//! The guard in a packed crowd with random pushes. An item is an agent.

use crate::scenes::Dice;
use divan::Bencher;
use divan::counter::ItemsCount;
use glam::{DVec2, Vec2};
use std::iter::repeat_n;
use throng::agent::Column;
use throng::guard::{BodyPose, Contacts, Guard, GuardedBodies, Solids};
use throng::perceive::Grid;
use throng::space::Walls;

/// Bodies of 0.2 m in rows like bricks with gaps of 2 %, their targets in a sub-step of 1/120 s, and the other columns
/// of the guard.
struct Packed {
    positions: Vec<Vec2>,
    targets: Vec<BodyPose>,
    numbers: Vec<u32>,
    headings: Vec<f32>,
    altitudes: Column<f32>,
    cores: Column<Vec2>,
    radii: Column<f32>,
    reach: Column<f32>,
    guarded: Column<bool>,
    solids: Solids,
    grid: Grid,
}

impl Packed {
    fn new(count: usize) -> Self {
        let mut rng = Dice(5);
        let side = (count as f64).sqrt() as usize;
        let place = |k: usize| {
            let (x, y) = (k % side, k / side);
            DVec2::new(x as f64 + 0.5 * (y % 2) as f64, y as f64 * 0.75_f64.sqrt()) * (0.4 * 1.02)
        };
        let positions: Vec<Vec2> = (0..count).map(|k| place(k).as_vec2()).collect();
        let mut push = || (DVec2::from_angle(rng.between(0.0, 6.3)) * rng.between(0.0, 1.3 / 120.0)).as_vec2();
        let targets =
            positions.iter().map(|&at| BodyPose { position: at + push(), altitude: 0.0, heading: 0.0 }).collect();
        let numbers: Vec<u32> = (0..count as u32).collect();
        let mut grid = Grid::default();
        grid.rebuild(&positions, &numbers, 1.0);
        Self {
            positions,
            targets,
            numbers,
            headings: vec![0.0; count],
            altitudes: repeat_n(0.0, count).collect(),
            cores: repeat_n(Vec2::ZERO, count).collect(),
            radii: repeat_n(0.2, count).collect(),
            reach: repeat_n(0.015, count).collect(),
            guarded: repeat_n(true, count).collect(),
            solids: Solids::default(),
            grid,
        }
    }

    fn bodies(&self) -> GuardedBodies<'_> {
        GuardedBodies {
            positions: &self.positions,
            altitudes: &self.altitudes,
            headings: &self.headings,
            cores: &self.cores,
            radii: &self.radii,
            reach: &self.reach,
            guarded: &self.guarded,
            solids: &self.solids,
            resting: &[],
        }
    }

    fn collect(&self, contacts: &mut Contacts) {
        contacts.collect(&self.bodies(), &self.numbers, &self.grid, &Walls::default(), |_, _| true, |_| None);
    }
}

#[divan::bench(args = [1_000, 10_000])]
fn collect_contacts(bencher: Bencher, count: usize) {
    let (packed, mut contacts) = (Packed::new(count), Contacts::default());
    bencher.counter(ItemsCount::new(count)).bench_local(|| packed.collect(&mut contacts));
}

#[divan::bench(args = [1_000, 10_000])]
fn certify(bencher: Bencher, count: usize) {
    let (packed, mut contacts, mut guard) = (Packed::new(count), Contacts::default(), Guard::default());
    packed.collect(&mut contacts);
    let (bodies, walls) = (packed.bodies(), Walls::default());
    let mut targets = Vec::new();
    bencher
        .counter(ItemsCount::new(count))
        .bench_local(|| guard.certify(&bodies, &contacts, &walls, |row| packed.targets[row], &mut targets));
}
