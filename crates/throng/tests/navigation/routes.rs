//! Agents that follow routes get there, also when they are pushed.

use crate::oracle::{Dice, Scene};
use glam::DVec2;
use throng::navigate::{Heading, NavMesh, Route, Search};

/// Walks at 1.3 m/s with pushes; returns how often it planned, and how far it went.
fn walk(mesh: &NavMesh, from: DVec2, to: DVec2, push: f64, dice: &mut Dice) -> Option<(u32, f64)> {
    let mut search = Search::new();
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
            step += DVec2::from_angle(dice.between(0.0, std::f64::consts::TAU)) * push;
        }
        // Walls push back what a guard would not let in.
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
        let mut dice = Dice(seed + 5000);
        for _ in 0..5 {
            let (from, to) = (scene.free_point(&mesh, &mut dice), scene.free_point(&mesh, &mut dice));
            let Ok(path) = mesh.path(&mut Search::new(), from, to) else { continue };
            let (plans, length) = walk(&mesh, from, to, 0.0, &mut dice).expect("it arrives");
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
        let mut dice = Dice(seed + 6000);
        for _ in 0..5 {
            let (from, to) = (scene.free_point(&mesh, &mut dice), scene.free_point(&mesh, &mut dice));
            if mesh.path(&mut Search::new(), from, to).is_err() {
                continue;
            }
            let (plans, _) = walk(&mesh, from, to, 0.1, &mut dice).expect("it arrives");
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
    let mut dice = Dice(1);
    let mut lost = 0;
    for _ in 0..200 {
        let points: Vec<_> = (0..3).map(|_| scene.free_point(&mesh, &mut dice)).collect();
        let Ok(path) = mesh.path(&mut Search::new(), points[0], points[1]) else { continue };
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
    let mut dice = Dice(9);
    let (from, to) = (scene.free_point(&mesh, &mut dice), scene.free_point(&mesh, &mut dice));
    let mut route = Route::new(&mesh.path(&mut Search::new(), from, to).unwrap());
    route.advance(&mesh, from);
    let saved = postcard::to_allocvec(&route).unwrap();
    assert_eq!(postcard::from_bytes::<Route>(&saved).unwrap(), route);
}
