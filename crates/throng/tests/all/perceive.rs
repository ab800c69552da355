//! The grid's answers equal those of brute force and of an independent k-d tree, on every kind of set.

use glam::Vec2;
use kiddo::{ImmutableKdTree, SquaredEuclidean};
use proptest::prelude::*;
use std::num::NonZero;
use throng::perceive::{Grid, Near};

/// The definition: all points within range, by distance, then number.
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

/// An independent k-d tree (kiddo), for distances: at equal distances its choice is arbitrary.
struct Tree(ImmutableKdTree<f32, 2>);

impl Tree {
    fn new(points: &[Vec2]) -> Self {
        let entries: Vec<[f32; 2]> = points.iter().map(|p| [p.x, p.y]).collect();
        Self(ImmutableKdTree::new_from_slice(&entries).unwrap())
    }

    /// Panics if these are not the `k` nearest to `from`, or all points within `range`.
    fn check(&self, found: &[Near], from: Vec2, k: usize, range: f32) {
        let most = NonZero::new(k).unwrap();
        let nearest = self.0.query(&[from.x, from.y]).nearest_n::<SquaredEuclidean<f32>>(most).execute();
        // whether a point exactly at the range is within depends on rounding
        let limit = range * range;
        let sure = nearest.iter().take_while(|near| near.distance < limit * (1.0 - 1e-5)).count();
        let possible = nearest.iter().take_while(|near| near.distance <= limit * (1.0 + 1e-5)).count();
        assert!((sure..=possible).contains(&found.len()), "{} of {sure} to {possible} near {from}", found.len());
        for (near, expected) in found.iter().zip(nearest) {
            let (near, expected) = (near.distance_squared, expected.distance);
            assert!((near - expected).abs() <= 1e-5 * expected.max(1e-6), "{near} instead of {expected} from {from}");
        }
    }
}

fn check(points: &[Vec2], cell: f32, k: usize, range: f32, queries: impl Iterator<Item = Vec2>) {
    // numbers independent of the order of rows
    let numbers: Vec<u32> = (0..points.len() as u32).map(|i| i.wrapping_mul(2_654_435_761)).collect();
    let mut grid = Grid::default();
    grid.rebuild(points, &numbers, cell);
    let tree = Tree::new(points);
    let mut found = Vec::new();
    for from in queries {
        let expected = brute_force(points, &numbers, from, range);
        grid.nearest(from, k, range, |_| true, &mut found);
        let nearest: Vec<(f32, u32)> = found.iter().map(|near| (near.distance_squared, near.number)).collect();
        assert_eq!(nearest, expected[..k.min(expected.len())], "{k} nearest to {from}");
        for near in &found {
            assert_eq!(numbers[near.row as usize], near.number);
        }
        tree.check(&found, from, k, range);
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
        // multiples of a quarter: many ties and many points at one place
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

    /// Seven powers of ten: most points in a spot, some far and farther away.
    #[test]
    fn very_uneven_sets(
        spokes in prop::collection::vec((-3.0f32..4.0, 0.0f32..std::f32::consts::TAU), 1..400),
        spot in 0usize..300, center in point(5000.0),
        cell in 0.1f32..20.0, k in 1usize..20, range in -2.0f32..4.0,
    ) {
        let spoke = |(i, &(power, angle)): (usize, &(f32, f32))| {
            let length = if i < spot { 1e-3 * (i % 7) as f32 } else { libm::powf(10.0, power) };
            center + Vec2::from_angle(angle) * length
        };
        let points: Vec<Vec2> = spokes.iter().enumerate().map(spoke).collect();
        let beside = points.iter().map(|&p| p + Vec2::splat(0.7)).step_by(17);
        let queries = points.iter().copied().step_by(11).chain(beside);
        check(&points, cell, k, libm::powf(10.0, range), queries);
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
    // a few of them, compared with brute force: of coincident points the lowest numbers count
    for from in [points[0], points[60_000], points[99_999]] {
        grid.nearest(from, 10, 5.0, |_| true, &mut found);
        let nearest: Vec<(f32, u32)> = found.iter().map(|near| (near.distance_squared, near.number)).collect();
        assert_eq!(nearest, brute_force(&points, &numbers, from, 5.0)[..10]);
    }
}

/// Points that differ only in their numbers.
#[test]
fn a_hundred_thousand_in_exactly_one_place() {
    let spot = Vec2::new(-812.25, 3.5);
    let points = vec![spot; 100_000];
    let numbers: Vec<u32> = (0..100_000u32).map(|i| i.wrapping_mul(2_654_435_761)).collect();
    let mut sorted = numbers.clone();
    sorted.sort_unstable();
    let mut grid = Grid::default();
    grid.rebuild(&points, &numbers, 1.0);
    let mut found = Vec::new();
    for (row, own) in numbers.iter().enumerate() {
        let accept = |near: &mut Near| near.row as usize != row;
        grid.nearest(spot, 10, 5.0, accept, &mut found);
        let expected = sorted.iter().copied().filter(|number| number != own).take(10);
        assert!(found.iter().map(|near| near.number).eq(expected), "row {row}: {found:?}");
    }
    for from in [spot + Vec2::new(3.0, 4.0), spot - Vec2::new(3.0, 4.0)] {
        grid.nearest(from, 3, 5.0, |_| true, &mut found);
        assert!(found.iter().map(|near| near.number).eq(sorted[..3].iter().copied()), "at the very range: {found:?}");
        let mut within = 0;
        grid.within(from, 5.0, |_| within += 1);
        assert_eq!(within, 100_000);
    }
}

/// Half of them within a centimetre, compared with a k-d tree.
#[test]
fn a_hundred_thousand_close_together_are_as_a_kd_tree_has_them() {
    let spread = |i: u32| Vec2::new((i * 7919 % 10_007) as f32, (i * 104_729 % 10_009) as f32);
    let points: Vec<Vec2> = (0..100_000).map(|i| spread(i % 30_000) * if i % 2 == 0 { 1e-6 } else { 1e-3 }).collect();
    let numbers: Vec<u32> = (0..100_000).rev().collect();
    let mut grid = Grid::default();
    grid.rebuild(&points, &numbers, 0.5);
    let tree = Tree::new(&points);
    let mut found = Vec::new();
    for &from in points.iter().step_by(101) {
        grid.nearest(from, 10, 0.3, |_| true, &mut found);
        tree.check(&found, from, 10, 0.3);
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
    let tree = Tree::new(&points);
    let mut found = Vec::new();
    for from in points.iter().step_by(13).map(|&p| p + Vec2::new(0.013, -0.007)) {
        grid.nearest(from, 12, 100.0, |_| true, &mut found);
        tree.check(&found, from, 12, 100.0);
    }
}

#[test]
fn an_empty_grid_answers() {
    let mut grid = Grid::default();
    grid.rebuild(&[], &[], 1.0);
    let mut found = vec![Near::default()];
    grid.nearest(Vec2::ZERO, 3, 1.0, |_| true, &mut found);
    assert!(found.is_empty());
    grid.within(Vec2::ZERO, 1.0, |_| panic!("the grid is empty"));
}
