//! ORCA: the half-planes of ten neighbours, and the best velocity in them. An item is an agent.

use crate::scenes::{Dice, points};
use divan::Bencher;
use divan::counter::ItemsCount;
use glam::{DVec2, Vec2};
use throng::avoid::{AvoidanceInput, AvoidanceNeighbour, LocalModel, Orca, Outline, Workspace};
use throng::perceive::Grid;

/// All agents of a crowd, each with its ten nearest neighbours; random velocities and preferred velocities, up to
/// walking speed.
#[divan::bench(args = [0.5, 2.0])]
fn ten_neighbours(bencher: Bencher, density: f64) {
    let (points, numbers) = points(1_000, density);
    let (mut grid, mut found, mut rng) = (Grid::default(), Vec::new(), Dice(3));
    grid.rebuild(&points, &numbers, 1.0);
    let mut velocities =
        || -> Vec<Vec2> { points.iter().map(|_| rng.point(DVec2::splat(-0.9), DVec2::splat(0.9)).as_vec2()).collect() };
    let (velocities, chosen_velocities) = (velocities(), velocities());
    let mut seen = Vec::new();
    for (row, &from) in points.iter().enumerate() {
        grid.nearest(from, 10, 20.0, |near| near.row as usize != row, &mut found);
        let neighbour = |row: usize| AvoidanceNeighbour {
            offset: points[row] - from,
            above: 0.0,
            vertical_velocity: 0.0,
            velocity: velocities[row],
            preferred: velocities[row],
            radii: 0.412,
            share: 0.5,
            room: 0.5,
            aside: Vec2::X,
            outline: Outline::POINT,
        };
        seen.push(found.iter().map(|near| neighbour(near.row as usize)).collect::<Vec<_>>());
    }
    let (orca, mut workspace) = (Orca::default(), Workspace::default());
    bencher.counter(ItemsCount::new(points.len())).bench_local(|| {
        let mut sum = Vec2::ZERO;
        for (row, neighbours) in seen.iter().enumerate() {
            let view = AvoidanceInput {
                velocity: velocities[row],
                preferred: chosen_velocities[row],
                neighbours,
                ..AvoidanceInput::default()
            };
            sum += orca.velocity(&view, &mut workspace);
        }
        sum
    });
}
