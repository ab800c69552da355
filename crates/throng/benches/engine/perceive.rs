//! The grid: building it, and the ten nearest neighbours of all points. An item is a point.

use crate::scenes::points;
use divan::Bencher;
use divan::counter::ItemsCount;
use glam::Vec2;
use throng::perceive::Grid;

#[divan::bench(args = [1_000, 10_000, 100_000])]
fn rebuild(bencher: Bencher, count: usize) {
    let (points, numbers) = points(count, 2.0);
    let mut grid = Grid::default();
    bencher.counter(ItemsCount::new(count)).bench_local(|| grid.rebuild(&points, &numbers, 1.0));
}

#[divan::bench]
fn rebuild_100_000_in_one_spot(bencher: Bencher) {
    let points: Vec<Vec2> = points(100_000, 2.0).0.iter().map(|&p| p * 1e-6).collect();
    let numbers: Vec<u32> = (0..100_000).collect();
    let mut grid = Grid::default();
    bencher.counter(ItemsCount::new(points.len())).bench_local(|| grid.rebuild(&points, &numbers, 1.0));
}

fn nearest_of_all(bencher: Bencher, points: &[Vec2], numbers: &[u32]) {
    let (mut grid, mut found) = (Grid::default(), Vec::new());
    grid.rebuild(points, numbers, 1.0);
    bencher.counter(ItemsCount::new(points.len())).bench_local(|| {
        let mut sum = 0;
        for (row, &from) in points.iter().enumerate() {
            grid.nearest(from, 10, 5.0, |near| near.row as usize != row, &mut found);
            sum += found.len();
        }
        sum
    });
}

#[divan::bench(args = [(1_000, 0.5), (1_000, 2.0), (10_000, 0.5), (10_000, 2.0)])]
fn nearest_10(bencher: Bencher, (count, density): (usize, f64)) {
    let (points, numbers) = points(count, density);
    nearest_of_all(bencher, &points, &numbers);
}

#[divan::bench]
fn nearest_10_in_one_spot(bencher: Bencher) {
    let (points, numbers) = points(10_000, 2.0);
    let points: Vec<Vec2> = points.iter().map(|&p| p * 1e-6).collect();
    nearest_of_all(bencher, &points, &numbers);
}
