//! The walkable ground: clearance from the walls of the input, gaps, doors, errors.

use crate::navigation::oracle::{Dice, Scene, clearance};
use glam::DVec2;
use throng::navigate::{NavError, NavMesh, PathSearch, Ring, Unreachable};
use throng::{Obstacle, Walkable};

fn ring(corners: &[(f64, f64)]) -> Vec<DVec2> {
    corners.iter().map(|&corner| DVec2::from(corner)).collect()
}

fn room(width: f64, height: f64) -> Walkable {
    Walkable { outer: ring(&[(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)]), holes: vec![] }
}

const NOWHERE: (DVec2, DVec2) = (DVec2::ZERO, DVec2::ZERO);

/// Checks that a mesh of this ground keeps the radius from its walls, and that points outside of the mesh have hardly
/// more clearance than the radius.
fn check_clearance(name: &str, (walkable, obstacles): (&[Walkable], &[Obstacle]), radius: f64, points: &[DVec2]) {
    let mesh = NavMesh::build(walkable, obstacles, radius, NOWHERE).unwrap();
    for &vertex in mesh.vertices().iter().step_by(1 + mesh.vertices().len() / 2000) {
        let least = clearance(walkable, obstacles, vertex);
        assert!(least >= radius - 1e-6, "{name}: vertex {vertex} has only {least}");
    }
    let mut covered = 0;
    for &at in points {
        let least = clearance(walkable, obstacles, at);
        match mesh.locate(at) {
            Some(_) => assert!(least >= radius - 1e-6, "{name}: {at} has only {least}"),
            None => assert!(least <= radius + 0.0041, "{name}: {at} has {least} but is no ground"),
        }
        covered += usize::from(mesh.locate(at).is_some());
    }
    assert!(covered > points.len() / 20, "{name}: only {covered} of {} points are ground", points.len());
}

#[test]
fn the_mesh_keeps_the_radius_from_walls_and_loses_hardly_more() {
    for seed in 0..30 {
        let scene = Scene::random(seed);
        let radius = 0.1 + 0.05 * (seed % 6) as f64;
        let mut rng = Dice(seed);
        let points: Vec<DVec2> = (0..500).map(|_| scene.point(&mut rng)).collect();
        check_clearance(&format!("seed {seed}"), (&scene.walkable, &scene.obstacles), radius, &points);
    }
}

#[test]
fn so_does_that_of_many_obstacles_that_overlap() {
    let mut rng = Dice(1);
    let side = 30.0;
    let obstacles: Vec<Obstacle> = (0..1500)
        .map(|index| {
            let at = rng.point(DVec2::ZERO, DVec2::splat(side));
            let size = DVec2::new(rng.between(0.1, 1.5), rng.between(0.1, 0.5));
            match index % 3 {
                0 => Obstacle::Circle { center: at, radius: 0.5 * size.x },
                1 => Obstacle::rectangle(at, size, rng.between(0.0, 3.0)),
                _ => Obstacle::Wall { points: vec![at, at + size, at + DVec2::X * size.x] },
            }
        })
        .collect();
    let points: Vec<DVec2> = (0..1500).map(|_| rng.point(DVec2::ZERO, DVec2::splat(side))).collect();
    check_clearance("obstacles", (&[room(side, side)], &obstacles), 0.1, &points);
}

#[test]
fn so_does_that_of_ground_with_many_corners() {
    let corner = |index: u32| {
        let angle = f64::from(index) * std::f64::consts::TAU / 6000.0;
        // bays of half a metre, and teeth of a centimetre
        let out = 10.0 + 0.25 * (40.0 * angle).sin() + 0.01 * f64::from(index % 2);
        DVec2::from_angle(angle) * out
    };
    let ground = Walkable { outer: (0..6000).map(corner).collect(), holes: vec![] };
    let mut rng = Dice(2);
    let points: Vec<DVec2> =
        (0..1000).map(|_| DVec2::from_angle(rng.between(0.0, 6.3)) * rng.between(9.0, 10.5)).collect();
    check_clearance("corners", (&[ground], &[]), 0.2, &points);
}

#[test]
fn gaps_a_centimetre_wider_than_the_body_are_open_and_narrower_ones_closed() {
    for (step, radius) in [0.1, 0.2, 0.25, 0.3, 0.5].into_iter().enumerate() {
        for (gap, open) in [(2.0 * radius + 0.01, true), (2.0 * radius - 0.01, false)] {
            for far in [0.0, -1800.0] {
                let turned = DVec2::from_angle(0.3 * step as f64);
                let place = |x: f64, y: f64| DVec2::splat(far) + turned.rotate(DVec2::new(x, y));
                let hall = Walkable {
                    outer: vec![place(-5.0, -4.0), place(5.0, -4.0), place(5.0, 4.0), place(-5.0, 4.0)],
                    holes: vec![],
                };
                let walls = |x: f64| Obstacle::Wall { points: vec![place(0.0, x), place(0.0, 5.0 * x.signum())] };
                let posts = |x: f64| Obstacle::Circle { center: place(0.0, x + 3.0 * x.signum()), radius: 3.0 };
                let blocks = |x: f64| Obstacle::Polygon {
                    corners: vec![
                        place(-0.5, x),
                        place(0.5, x),
                        place(0.5, 5.0 * x.signum()),
                        place(-0.5, 5.0 * x.signum()),
                    ],
                };
                for pair in [
                    [walls(gap / 2.0), walls(-gap / 2.0)],
                    [posts(gap / 2.0), posts(-gap / 2.0)],
                    [blocks(gap / 2.0), blocks(-gap / 2.0)],
                    [walls(gap / 2.0), posts(-gap / 2.0)],
                ] {
                    let mesh = NavMesh::build(std::slice::from_ref(&hall), &pair, radius, NOWHERE).unwrap();
                    let path = mesh.path(&mut PathSearch::new(), place(-4.0, 0.0), place(4.0, 0.0));
                    assert_eq!(path.is_ok(), open, "radius {radius}, gap {gap}, {pair:?}");
                }
            }
        }
    }
}

#[test]
fn a_door_in_the_outline_lets_a_body_through() {
    let outer = ring(&[
        (0.0, 0.0),
        (5.0, 0.0),
        (5.0, 2.0),
        (5.2, 2.0),
        (5.2, 0.0),
        (10.0, 0.0),
        (10.0, 5.0),
        (5.2, 5.0),
        (5.2, 2.6),
        (5.0, 2.6),
        (5.0, 5.0),
        (0.0, 5.0),
    ]);
    let rooms = [Walkable { outer, holes: vec![] }];
    let mesh = NavMesh::build(&rooms, &[], 0.2, NOWHERE).unwrap();
    assert_eq!(mesh.island_count(), 1);
    let path = mesh.path(&mut PathSearch::new(), DVec2::new(1.0, 1.0), DVec2::new(9.0, 1.0)).unwrap();
    assert!(path.length > 8.0 && path.length < 9.0);
    assert_eq!(NavMesh::build(&rooms, &[], 0.31, NOWHERE).unwrap().island_count(), 2);
}

#[test]
fn walkable_areas_unite_and_touching_ones_have_no_wall_between() {
    let east = Walkable { outer: ring(&[(4.0, 0.0), (4.0, 4.0), (9.0, 4.0), (9.0, 0.0)]), holes: vec![] };
    let west = Walkable {
        outer: ring(&[(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)]),
        holes: vec![ring(&[(1.0, 1.0), (2.0, 1.0), (2.0, 2.0), (1.0, 2.0)])],
    };
    let mesh = NavMesh::build(&[west, east], &[], 0.5, NOWHERE).unwrap();
    assert!(mesh.visible(DVec2::new(3.0, 3.0), DVec2::new(8.0, 3.0)));
    // 8 x 3 less a 2 x 2 square round the hole with rounded corners.
    let arcs = 3.0 + std::f64::consts::FRAC_PI_4;
    assert!((mesh.area_size() - (24.0 - arcs)).abs() < 0.02, "{}", mesh.area_size());
}

#[test]
fn without_walkable_ground_there_is_a_way_round_everything() {
    let house = Obstacle::rectangle(DVec2::new(5.0, 5.0), DVec2::splat(4.0), 0.0);
    let mesh = NavMesh::build(&[], &[house], 0.3, (DVec2::ZERO, DVec2::new(6.0, 6.0))).unwrap();
    let path = mesh.path(&mut PathSearch::new(), DVec2::new(1.0, 5.0), DVec2::new(8.0, 5.5)).unwrap();
    assert!(path.corners.len() > 2);
    assert!(matches!(NavMesh::build(&[], &[], 0.3, (DVec2::ZERO, DVec2::ZERO)), Err(NavError::NoRoom { .. })));
}

#[test]
fn errors_say_which_ring_and_where() {
    let bow = Walkable { outer: ring(&[(0.0, 0.0), (4.0, 4.0), (4.0, 0.0), (0.0, 4.0)]), holes: vec![] };
    let error = NavMesh::build(&[room(9.0, 9.0), bow], &[], 0.2, NOWHERE).unwrap_err();
    match &error {
        NavError::SelfCrossing { ring: Ring::Outer { area: 1 }, first: 0, second: 2, at } => {
            assert!(at.distance(DVec2::splat(2.0)) < 1e-6)
        }
        other => panic!("{other:?}"),
    }
    assert_eq!(
        error.to_string(),
        "walkable area 1 crosses itself at (2.000, 2.000): the edges after its points 0 and 2"
    );
    let bow = Obstacle::Polygon { corners: ring(&[(0.0, 0.0), (4.0, 4.0), (4.0, 0.0), (0.0, 4.0)]) };
    assert!(matches!(
        NavMesh::build(&[room(9.0, 9.0)], &[bow], 0.2, NOWHERE),
        Err(NavError::SelfCrossing { ring: Ring::Obstacle { index: 0 }, .. })
    ));
    let two = Walkable { outer: ring(&[(0.0, 0.0), (1.0, 0.0), (1.0, 0.0)]), holes: vec![] };
    assert!(matches!(NavMesh::build(&[two], &[], 0.2, NOWHERE), Err(NavError::TooFewCorners { found: 2, .. })));
    let bad = Obstacle::Wall { points: vec![DVec2::ZERO, DVec2::new(f64::NAN, 0.0)] };
    assert!(matches!(
        NavMesh::build(&[room(9.0, 9.0)], &[bad], 0.2, NOWHERE),
        Err(NavError::NotFinite { ring: Ring::Obstacle { index: 0 }, point: 1 })
    ));
    assert!(matches!(NavMesh::build(&[room(9.0, 9.0)], &[], 0.0, NOWHERE), Err(NavError::Limit { .. })));
    assert!(matches!(NavMesh::build(&[room(1.0, 9.0)], &[], 0.6, NOWHERE), Err(NavError::NoRoom { .. })));
    assert!(matches!(NavMesh::build(&[room(3e6, 9.0)], &[], 0.6, NOWHERE), Err(NavError::TooWide { .. })));
}

#[test]
fn rings_that_touch_themselves_or_fold_back_are_no_error() {
    let pinched = Walkable {
        outer: ring(&[(0.0, 0.0), (4.0, 0.0), (2.0, 2.0), (4.0, 4.0), (0.0, 4.0), (2.0, 2.0)]),
        holes: vec![],
    };
    assert_eq!(NavMesh::build(&[pinched], &[], 0.2, NOWHERE).unwrap().island_count(), 2);
    let flat = Obstacle::Polygon { corners: ring(&[(2.0, 2.0), (4.0, 2.0), (3.0, 2.0)]) };
    let mesh = NavMesh::build(&[room(6.0, 4.0)], &[flat], 0.2, NOWHERE).unwrap();
    assert!(mesh.locate(DVec2::new(3.0, 2.1)).is_none() && mesh.locate(DVec2::new(3.0, 2.25)).is_some());
}

#[test]
fn unreachable_says_why() {
    let wall = Obstacle::Wall { points: ring(&[(5.0, -1.0), (5.0, 7.0)]) };
    let block = Obstacle::rectangle(DVec2::new(8.0, 3.0), DVec2::splat(2.0), 0.0);
    let mesh = NavMesh::build(&[room(10.0, 6.0)], &[wall, block], 0.25, NOWHERE).unwrap();
    let mut search = PathSearch::new();
    let mut path = |from: (f64, f64), to: (f64, f64)| mesh.path(&mut search, from.into(), to.into());
    assert!(matches!(
        path((1.0, 1.0), (9.5, 1.0)),
        Err(Unreachable::NoWay { from: 0, to: 1 } | Unreachable::NoWay { from: 1, to: 0 })
    ));
    assert!(matches!(path((6.0, 1.0), (8.0, 3.0)), Err(Unreachable::GoalInWall { distance, .. }) if distance > 1.0));
    assert!(matches!(path((-7.0, 1.0), (1.0, 3.0)), Err(Unreachable::StartInWall { .. })));
    assert!(matches!(path((f64::NAN, 1.0), (1.0, 3.0)), Err(Unreachable::NotFinite)));
    // A goal at a wall is reached as far as the body allows.
    let end = path((1.0, 1.0), (4.9, 3.0)).unwrap().corners[0];
    assert!((end.x - 4.75).abs() < 1e-5 && (end.y - 3.0).abs() < 1e-9);
}
