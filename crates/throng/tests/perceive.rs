//! The grid's answers are those of brute force and of an independent k-d tree, on every kind of set.

use glam::Vec2;
use kiddo::{ImmutableKdTree, SquaredEuclidean};
use proptest::prelude::*;
use std::num::NonZero;
use throng::perceive::{Grid, Near};

/// The contract, in the plainest way: all within range, by distance, then number.
fn brute_force(points: &[Vec2], numbers: &[u32], from: Vec2, range: f32) -> Vec<(f32, u32)> {
    let mut all: Vec<(f32, u32)> = points
        .iter()
        .zip(numbers)
        .map(|(&p, &number)| ((p - from).x * (p - from).x + (p - from).y * (p - from).y, number))
        .filter(|&(d, _)| d <= range * range)
        .collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    all
}

fn check(points: &[Vec2], cell: f32, k: usize, range: f32, queries: impl Iterator<Item = Vec2>) {
    // numbers that have nothing to do with the order of rows
    let numbers: Vec<u32> = (0..points.len() as u32).map(|i| i.wrapping_mul(2_654_435_761)).collect();
    let mut grid = Grid::default();
    grid.rebuild(points, &numbers, cell);
    let mut found = Vec::new();
    for from in queries {
        let expected = brute_force(points, &numbers, from, range);
        grid.nearest(from, k, range, |_| true, &mut found);
        let nearest: Vec<(f32, u32)> = found.iter().map(|near| (near.distance_squared, near.number)).collect();
        assert_eq!(nearest, expected[..k.min(expected.len())], "{k} nearest to {from}");
        for near in &found {
            assert_eq!(numbers[near.row as usize], near.number);
        }
        let mut within: Vec<(f32, u32)> = Vec::new();
        grid.within(from, range, |near: Near| within.push((near.distance_squared, near.number)));
        within.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        assert_eq!(within, expected, "within {range} of {from}");
    }
}

fn point(range: f32) -> impl Strategy<Value = Vec2> {
    (-range..range, -range..range).prop_map(|(x, y)| Vec2::new(x, y))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn random_sets(
        points in prop::collection::vec(point(30.0), 1..400),
        queries in prop::collection::vec(point(50.0), 1..20),
        cell in 0.1f32..20.0, k in 1usize..20, range in 0.1f32..40.0,
    ) {
        check(&points, cell, k, range, queries.into_iter());
    }

    #[test]
    fn clustered_and_coincident_sets(
        centers in prop::collection::vec(point(1000.0), 1..5),
        // multiples of a quarter: many ties and many points in one place
        offsets in prop::collection::vec((0i8..8, 0i8..8), 1..400),
        cell in 0.1f32..20.0, k in 1usize..20,
    ) {
        let points: Vec<Vec2> = offsets
            .iter()
            .enumerate()
            .map(|(i, &(x, y))| centers[i % centers.len()] + Vec2::new(f32::from(x), f32::from(y)) * 0.25)
            .collect();
        check(&points, cell, k, 1.5, points.iter().copied().step_by(7));
    }
}

#[test]
fn a_hundred_thousand_in_one_spot_and_a_few_far_away() {
    let mut points = vec![Vec2::new(0.5, 0.5); 50_000];
    let spot = |i: usize| Vec2::new((i * 7919 % 10_007) as f32, (i * 104_729 % 10_009) as f32) * 1e-6;
    points.extend((0..50_000).map(spot));
    points.extend([Vec2::new(9_000.0, -9_000.0), Vec2::new(-9_000.0, 9_000.0)]);
    let numbers: Vec<u32> = (0..points.len() as u32).rev().collect();
    let mut grid = Grid::default();
    grid.rebuild(&points, &numbers, 1.0);
    let mut found = Vec::new();
    for (row, &point) in points.iter().enumerate() {
        grid.nearest(point, 10, 5.0, |near| near.row as usize != row, &mut found);
        assert_eq!(found.len(), if row < 100_000 { 10 } else { 0 });
    }
    // a few of them against brute force: of the coincident ones the lowest numbers win
    for from in [points[0], points[60_000], points[99_999]] {
        grid.nearest(from, 10, 5.0, |_| true, &mut found);
        let nearest: Vec<(f32, u32)> = found.iter().map(|near| (near.distance_squared, near.number)).collect();
        assert_eq!(nearest, brute_force(&points, &numbers, from, 5.0)[..10]);
    }
}

#[test]
fn distances_are_those_of_a_kd_tree() {
    let points: Vec<Vec2> = (0..5_000)
        .map(|i| {
            let t = i as f32 * 2.399_963;
            Vec2::new(t.cos(), t.sin()) * (i as f32).sqrt() * 0.3
        })
        .collect();
    let numbers: Vec<u32> = (0..5_000).collect();
    let mut grid = Grid::default();
    grid.rebuild(&points, &numbers, 1.0);
    let entries: Vec<[f32; 2]> = points.iter().map(|p| [p.x, p.y]).collect();
    let tree = ImmutableKdTree::new_from_slice(&entries).unwrap();
    let mut found = Vec::new();
    for from in points.iter().step_by(13).map(|&p| p + Vec2::new(0.013, -0.007)) {
        grid.nearest(from, 12, 100.0, |_| true, &mut found);
        let expected =
            tree.query(&[from.x, from.y]).nearest_n::<SquaredEuclidean<f32>>(NonZero::new(12).unwrap()).execute();
        assert_eq!(found.len(), expected.len());
        for (near, expected) in found.iter().zip(expected) {
            assert!((near.distance_squared - expected.distance).abs() <= 1e-5 * expected.distance.max(1e-3));
        }
    }
}

#[test]
fn an_empty_grid_answers() {
    let mut grid = Grid::default();
    grid.rebuild(&[], &[], 1.0);
    let mut found = vec![Near::default()];
    grid.nearest(Vec2::ZERO, 3, 1.0, |_| true, &mut found);
    assert!(found.is_empty());
    grid.within(Vec2::ZERO, 1.0, |_| panic!("nobody is there"));
}
