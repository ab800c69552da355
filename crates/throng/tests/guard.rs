//! The guard keeps its promise whatever it is asked to do: random crowds, sizes, speeds and walls, checked by an
//! independent search over the time of the step.

use glam::{DVec2, Vec2};
use proptest::prelude::*;
use throng::Obstacle;
use throng::guard::{Bodies, Contacts, Guard, nearest_approach};
use throng::perceive::Grid;
use throng::space::{NearWalls, Walls};

#[derive(Clone, Debug)]
struct Crowd {
    positions: Vec<Vec2>,
    radii: Vec<f32>,
    reach: Vec<f32>,
    targets: Vec<Vec2>,
}

/// Moves the crowd under guard, and gives where it went.
fn guarded(crowd: &Crowd, walls: &Walls) -> Vec<Vec2> {
    let numbers: Vec<u32> = (0..crowd.positions.len() as u32).collect();
    let mut grid = Grid::default();
    grid.rebuild(&crowd.positions, &numbers, 1.0);
    let bodies = Bodies { positions: &crowd.positions, radii: &crowd.radii, reach: &crowd.reach };
    let mut contacts = Contacts::default();
    contacts.collect(&bodies, &numbers, &grid, walls, |_, _| true);
    let mut targets = crowd.targets.clone();
    Guard::default().certify(&bodies, &contacts, walls, &mut targets);
    targets
}

/// The promise, by sampling the step's time.
fn check(crowd: &Crowd, walls: &Walls, targets: &[Vec2]) {
    let at = |row: usize, t: f64| crowd.positions[row].as_dvec2().lerp(targets[row].as_dvec2(), t);
    let times = || (0..=64).map(|i| f64::from(i) / 64.0);
    for (a, target) in targets.iter().enumerate() {
        let moved = crowd.positions[a].distance(*target);
        assert!(moved <= crowd.reach[a] * 1.001, "{moved} farther than {}", crowd.reach[a]);
        for b in 0..a {
            let radii = f64::from(crowd.radii[a]) + f64::from(crowd.radii[b]);
            let start = at(a, 0.0).distance(at(b, 0.0));
            let least = times().map(|t| at(a, t).distance(at(b, t))).fold(f64::INFINITY, f64::min);
            assert!(least >= radii.min(start) - 1.1e-6 * radii, "{a} and {b}: {least} of {radii}, from {start}");
        }
        let distance = |t: f64| walls.distance(at(a, t), 100.0, &mut NearWalls::default());
        let radius = f64::from(crowd.radii[a]);
        let start = distance(0.0);
        let least = times().map(distance).fold(f64::INFINITY, f64::min);
        assert!(least >= radius.min(start) - 1.1e-6 * radius, "{a} and a wall: {least} of {radius}, from {start}");
    }
}

fn crowd(spread: f32) -> impl Strategy<Value = Crowd> {
    let body = (-spread..spread, -spread..spread, 0.05f32..0.8, 0.0f32..3.0, 0.0f32..std::f32::consts::TAU);
    prop::collection::vec(body, 2..40).prop_map(|bodies| {
        let mut crowd = Crowd { positions: vec![], radii: vec![], reach: vec![], targets: vec![] };
        for (x, y, radius, length, angle) in bodies {
            crowd.positions.push(Vec2::new(x, y));
            crowd.radii.push(radius);
            crowd.reach.push(2.0);
            crowd.targets.push(Vec2::new(x, y) + Vec2::new(angle.cos(), angle.sin()) * length);
        }
        crowd
    })
}

/// Takes out whoever overlaps somebody before them, or a wall.
fn parted(crowd: Crowd, walls: &Walls) -> Crowd {
    let mut kept: Vec<usize> = Vec::new();
    for row in 0..crowd.positions.len() {
        let p = crowd.positions[row].as_dvec2();
        let radius = |row: usize| f64::from(crowd.radii[row]);
        let free = kept.iter().all(|&k| crowd.positions[k].as_dvec2().distance(p) >= radius(k) + radius(row));
        if free && walls.distance(p, 100.0, &mut NearWalls::default()) >= radius(row) {
            kept.push(row);
        }
    }
    Crowd {
        positions: kept.iter().map(|&row| crowd.positions[row]).collect(),
        radii: kept.iter().map(|&row| crowd.radii[row]).collect(),
        reach: kept.iter().map(|&row| crowd.reach[row]).collect(),
        targets: kept.iter().map(|&row| crowd.targets[row]).collect(),
    }
}

fn room() -> Walls {
    let wall = |points: &[(f64, f64)]| Obstacle::Wall { points: points.iter().map(|&p| DVec2::from(p)).collect() };
    let obstacles = [
        wall(&[(-4.0, -4.0), (4.0, -4.0), (4.0, 4.0), (-4.0, 4.0), (-4.0, -4.0)]),
        wall(&[(0.0, -4.0), (0.0, -0.7)]),
        Obstacle::Circle { center: DVec2::new(2.0, 1.5), radius: 0.7 },
        Obstacle::rectangle(DVec2::new(-2.0, 1.0), DVec2::new(1.5, 0.5), 0.6),
    ];
    Walls::new(&[], &obstacles, DVec2::ZERO)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn nobody_overlaps_in_the_open(crowd in crowd(4.0)) {
        let crowd = parted(crowd, &Walls::default());
        check(&crowd, &Walls::default(), &guarded(&crowd, &Walls::default()));
    }

    #[test]
    fn nobody_overlaps_in_a_room(crowd in crowd(4.0)) {
        let walls = room();
        let crowd = parted(crowd, &walls);
        check(&crowd, &walls, &guarded(&crowd, &walls));
    }

    /// Bad starts do not get worse.
    #[test]
    fn overlapping_bodies_come_no_closer(crowd in crowd(2.0)) {
        check(&crowd, &Walls::default(), &guarded(&crowd, &Walls::default()));
    }

    #[test]
    fn free_motion_is_left_alone(offset in 5.0f32..9.0, v in -1.0f32..1.0) {
        let crowd = Crowd {
            positions: vec![Vec2::ZERO, Vec2::new(offset, 0.0)],
            radii: vec![0.5, 0.5],
            reach: vec![1.5, 1.5],
            targets: vec![Vec2::new(0.3, v), Vec2::new(offset - 0.4, -v)],
        };
        prop_assert_eq!(guarded(&crowd, &Walls::default()), crowd.targets.clone());
    }
}

#[test]
fn a_wish_that_is_no_number_means_standing() {
    let crowd = Crowd {
        positions: vec![Vec2::ZERO, Vec2::X],
        radii: vec![0.3, 0.3],
        reach: vec![1.0, 1.0],
        targets: vec![Vec2::new(f32::NAN, 0.0), Vec2::new(0.2, f32::INFINITY)],
    };
    assert_eq!(guarded(&crowd, &Walls::default()), crowd.positions);
}

#[test]
fn a_bullet_does_not_pass_through_a_thin_wall() {
    let wall = Obstacle::Wall { points: vec![DVec2::new(1.0, -5.0), DVec2::new(1.0, 5.0)] };
    let walls = Walls::new(&[], &[wall], DVec2::ZERO);
    let crowd =
        Crowd { positions: vec![Vec2::ZERO], radii: vec![0.1], reach: vec![50.0], targets: vec![Vec2::new(40.0, 3.0)] };
    let targets = guarded(&crowd, &walls);
    check(&crowd, &walls, &targets);
    assert!(targets[0].x <= 0.9 && targets[0].x > 0.5, "{}", targets[0]);
}

#[test]
fn nearest_approach_is_the_least_over_time() {
    for i in 0..500 {
        let t = f64::from(i);
        let offset = DVec2::new((t * 0.7).sin() * 3.0, (t * 1.3).cos() * 3.0);
        let motion = DVec2::new((t * 2.1).cos(), (t * 0.9).sin()) * (t * 0.01);
        let sampled =
            (0..=10_000).map(|k| (offset + motion * (f64::from(k) / 10_000.0)).length()).fold(f64::INFINITY, f64::min);
        let exact = nearest_approach(offset, motion);
        assert!(exact <= sampled + 1e-12 && exact >= sampled - 1e-3, "{exact} {sampled}");
    }
}
