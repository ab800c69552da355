//! Agents that follow routes arrive, even when they are pushed.

use crate::navigation::oracle::{Dice, Scene};
use glam::DVec2;
use throng::navigate::{Heading, NavMesh, PathSearch, Route};
use throng::{Obstacle, Walkable};

/// Walks at 1.3 m/s with pushes; returns the number of plans and the length of the walk.
fn walk(mesh: &NavMesh, from: DVec2, to: DVec2, push: f64, rng: &mut Dice) -> Option<(u32, f64)> {
    let mut search = PathSearch::new();
    let mut route = Route::new(&mesh.path(&mut search, from, to).ok()?);
    let (mut at, mut plans, mut length) = (from, 1, 0.0);
    for _ in 0..4000 {
        let aim = match route.advance(mesh, at) {
            Heading::Lost => {
                route = Route::new(&mesh.path(&mut search, at, to).ok()?);
                plans += 1;
                continue;
            }
            Heading::End(end) if end.distance(at) < 0.05 => return Some((plans, length)),
            Heading::End(aim) | Heading::Corner(aim) => aim,
        };
        let mut step = (aim - at).clamp_length_max(1.3 / 20.0);
        if push > 0.0 {
            step += DVec2::from_angle(rng.between(0.0, std::f64::consts::TAU)) * push;
        }
        // Walls push the agent back to the mesh.
        let next = mesh.nearest(at + step);
        length += next.distance(at);
        at = next;
    }
    None
}

#[test]
fn followers_arrive_along_the_shortest_path_without_planning_again() {
    for seed in 0..30 {
        let scene = Scene::random(seed);
        let mesh = scene.mesh(0.2);
        let mut rng = Dice(seed + 5000);
        for _ in 0..5 {
            let (from, to) = (scene.free_point(&mesh, &mut rng), scene.free_point(&mesh, &mut rng));
            let Ok(path) = mesh.path(&mut PathSearch::new(), from, to) else { continue };
            let (plans, length) = walk(&mesh, from, to, 0.0, &mut rng).expect("it arrives");
            assert_eq!(plans, 1, "seed {seed} {from} -> {to}");
            assert!(length < path.length * 1.005 + 0.01, "seed {seed}: {length} {}", path.length);
        }
    }
}

#[test]
fn pushed_followers_arrive_and_seldom_plan_again() {
    let (mut walks, mut all) = (0, 0);
    for seed in 0..30 {
        let scene = Scene::random(seed);
        let mesh = scene.mesh(0.2);
        let mut rng = Dice(seed + 6000);
        for _ in 0..5 {
            let (from, to) = (scene.free_point(&mesh, &mut rng), scene.free_point(&mesh, &mut rng));
            if mesh.path(&mut PathSearch::new(), from, to).is_err() {
                continue;
            }
            let (plans, _) = walk(&mesh, from, to, 0.1, &mut rng).expect("it arrives");
            walks += 1;
            all += plans;
        }
    }
    assert!(all < 2 * walks, "{all} plans for {walks} walks");
}

#[test]
fn a_follower_carried_off_says_that_it_is_lost() {
    let scene = Scene::random(1);
    let mesh = scene.mesh(0.2);
    let mut rng = Dice(1);
    let mut lost = 0;
    for _ in 0..200 {
        let points: Vec<_> = (0..3).map(|_| scene.free_point(&mesh, &mut rng)).collect();
        let Ok(path) = mesh.path(&mut PathSearch::new(), points[0], points[1]) else { continue };
        let mut route = Route::new(&path);
        route.advance(&mesh, points[0]);
        match route.advance(&mesh, points[2]) {
            Heading::Lost => {
                lost += 1;
                assert_eq!(route.advance(&mesh, points[0]), Heading::Lost);
            }
            Heading::Corner(aim) | Heading::End(aim) => assert!(mesh.visible(points[2], aim)),
        }
    }
    assert!(lost > 10);
}

#[test]
fn a_route_survives_saving() {
    let scene = Scene::random(4);
    let mesh = scene.mesh(0.2);
    let mut rng = Dice(9);
    let (from, to) = (scene.free_point(&mesh, &mut rng), scene.free_point(&mesh, &mut rng));
    let mut route = Route::new(&mesh.path(&mut PathSearch::new(), from, to).unwrap());
    route.advance(&mesh, from);
    let saved = postcard::to_allocvec(&route).unwrap();
    assert_eq!(postcard::from_bytes::<Route>(&saved).unwrap(), route);
}

/// A disturbance of a walker: a current, or a rotated direction.
#[derive(Clone, Copy, Debug)]
enum Drift {
    /// A current, as a part of the walking speed.
    Current(DVec2),
    /// Walks at this angle to its preferred direction, as agents that keep right do, radians.
    Turned(f64),
}

/// Walks with a drift and plans again when lost. Returns the length of the walk, or `None` if the walker does not
/// arrive within three times the expected time.
fn drift(mesh: &NavMesh, from: DVec2, to: DVec2, drift: Drift) -> Option<f64> {
    const STEP: f64 = 1.3 / 25.0;
    let mut search = PathSearch::new();
    let path = mesh.path(&mut search, from, to).ok()?;
    let mut route = Route::new(&path);
    let (mut at, mut length) = (from, 0.0);
    for _ in 0..(3.0 * path.length / STEP) as usize + 50 {
        let aim = match route.advance(mesh, at) {
            Heading::Lost => {
                route = Route::new(&mesh.path(&mut search, at, to).ok()?);
                continue;
            }
            Heading::End(end) if end.distance(at) < 0.15 => return Some(length),
            Heading::End(aim) | Heading::Corner(aim) => aim,
        };
        // the walker does not slow down for corners
        let step = (aim - at).normalize_or_zero() * STEP;
        let step = match drift {
            Drift::Current(current) => step + current * STEP,
            Drift::Turned(angle) => DVec2::from_angle(angle).rotate(step),
        };
        let next = mesh.nearest(at + step);
        length += next.distance(at);
        at = next;
    }
    None
}

/// Round the end of a wall and on past a pillar that stands close to the line: for a walker that drifts to the pillar's
/// side, the pillar hides the next corner, and only the corner that it has passed is in view.
#[test]
fn a_walker_that_drifts_behind_a_pillar_goes_on_and_not_back() {
    for turned in 0..8 {
        let angle = 0.1 + 0.8 * f64::from(turned);
        let place = |x: f64, y: f64| DVec2::new(310.0, -4200.0) + DVec2::from_angle(angle).rotate(DVec2::new(x, y));
        for side in [1.0, -1.0] {
            for (off, ahead) in [(0.45, 3.0), (0.6, 4.0), (0.8, 5.0)] {
                let outer = [(-4.0, -9.0), (12.0, -9.0), (12.0, 9.0), (-4.0, 9.0)].map(|(x, y)| place(x, y)).to_vec();
                let wall = Obstacle::Wall { points: vec![place(0.0, 0.2 * side), place(0.0, 9.0 * side)] };
                let pillar = Obstacle::rectangle(place(ahead, -(off + 0.1) * side), DVec2::new(0.3, 0.6), angle);
                let ground = [Walkable { outer, holes: vec![] }];
                let mesh = NavMesh::build(&ground, &[wall, pillar], 0.2, (DVec2::ZERO, DVec2::ZERO)).unwrap();
                let (from, to) = (place(-0.5, 4.0 * side), place(9.0, 0.0));
                let shortest = mesh.path(&mut PathSearch::new(), from, to).unwrap().length;
                let across = DVec2::from_angle(angle).perp() * -side;
                let drifts = [0.1, 0.2, 0.3, 0.4].map(|part| Drift::Current(across * part)).into_iter();
                for kind in drifts.chain([0.1, 0.2, 0.3].map(|turn| Drift::Turned(-side * turn))) {
                    let walked = drift(&mesh, from, to, kind);
                    let label = || format!("{kind:?}, side {side}, pillar {off} {ahead}, turned {angle}");
                    let walked = walked.unwrap_or_else(|| panic!("never arrives: {}", label()));
                    assert!(walked < 1.3 * shortest, "{walked} of {shortest} m: {}", label());
                }
            }
        }
    }
}

#[test]
fn in_random_rooms_drifting_walkers_arrive_without_detours() {
    for seed in 0..40 {
        let scene = Scene::random(seed);
        let mesh = scene.mesh(0.2);
        let mut rng = Dice(seed + 7000);
        for walk in 0..6 {
            let (from, to) = (scene.free_point(&mesh, &mut rng), scene.free_point(&mesh, &mut rng));
            let Ok(path) = mesh.path(&mut PathSearch::new(), from, to) else { continue };
            let kind = if walk % 2 == 0 {
                Drift::Current(DVec2::from_angle(rng.between(0.0, std::f64::consts::TAU)) * rng.between(0.05, 0.4))
            } else {
                Drift::Turned(rng.between(-0.35, 0.35))
            };
            let walked = drift(&mesh, from, to, kind);
            let walked = walked.unwrap_or_else(|| panic!("never arrives: seed {seed}, {from} -> {to}, {kind:?}"));
            // on a short path the drift is a large part
            assert!(
                walked < 1.3 * path.length + 0.5,
                "seed {seed}, {from} -> {to}: {walked} of {} m, {kind:?}",
                path.length
            );
        }
    }
}
