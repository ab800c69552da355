//! Bad starts: bodies that overlap at the start are reported, separate smoothly, and go on.

use crate::world::common::{Draw, journey_to, run_for, walker, with_settings};
use crate::world::oracle::Snapshot;
use glam::DVec2;
use std::collections::BTreeMap;
use throng::{Agent, Obstacle, SubSteps, World};

/// Overlapping pairs and their separation (distance over sum of radii), by brute force.
fn brute(world: &World) -> Vec<(u32, u32, f64)> {
    let agents = world.relative_columns();
    let mut all = Vec::new();
    for a in 0..agents.len() {
        for b in 0..agents.len() {
            let radii = f64::from(agents.radius[a]) + f64::from(agents.radius[b]);
            let d = agents.position[a].as_dvec2().distance(agents.position[b].as_dvec2());
            if agents.number[a] < agents.number[b] && d < radii * (1.0 - 1e-4) {
                all.push((agents.number[a], agents.number[b], d / radii));
            }
        }
    }
    all.sort_by_key(|&(a, b, _)| (a, b));
    all
}

/// A heap of agents within `spread` metres, a fifth of them at exactly the place of another.
fn heap(case: u64, count: usize, spread: f64, step: f64, sub_steps: SubSteps) -> World {
    let mut draw = Draw::new(case + 500);
    let origin = draw.point(DVec2::splat(-9e3), DVec2::splat(9e3));
    let mut world = with_settings(step, sub_steps, origin);
    let mut last = origin;
    for k in 0..count {
        if k % 5 != 4 {
            last = origin + draw.point(DVec2::splat(-spread), DVec2::splat(spread));
        }
        let journey = journey_to(&mut world, origin + DVec2::from_angle(draw.between(0.0, 6.3)) * 7.0);
        let radius = draw.between(0.12, 0.35) as f32;
        let stays = draw.index(3) == 0;
        let journey = if stays { throng::JourneyId::STAY } else { journey };
        world.add_agent(Agent { position: last.extend(0.0), radius, journey, ..Agent::default() }).unwrap();
    }
    world
}

#[test]
fn overlaps_are_reported_as_brute_force_finds_them() {
    for case in 0..10 {
        let world = heap(case, 40, 1.0 + case as f64, 0.05, SubSteps::Auto);
        let found = brute(&world);
        assert!(!found.is_empty());
        assert_eq!(world.overlapping(), found, "case {case}");
    }
}

/// Overlapping pairs never come closer, no new pairs overlap, no agent exceeds its speed, and in the end no two agents
/// overlap.
#[test]
fn a_heap_parts_smoothly_and_for_good() {
    for (case, step) in [1.0 / 60.0, 0.05, 0.1, 0.5, 1.0].into_iter().enumerate() {
        let mut world = heap(case as u64, 16, 0.8, step, SubSteps::Auto);
        let mut before: BTreeMap<(u32, u32), f64> = brute(&world).into_iter().map(|(a, b, d)| ((a, b), d)).collect();
        assert!(before.len() > 8);
        let mut last = Snapshot::of(&world);
        run_for(&mut world, 15.0, |world| {
            let now = brute(world);
            for &(a, b, d) in &now {
                let was = before.get(&(a, b)).unwrap_or_else(|| panic!("{a} and {b} did not overlap before"));
                assert!(d >= was - 1e-4, "at {:.2} s {a} and {b} come closer: {was} to {d}", world.time());
            }
            before = now.into_iter().map(|(a, b, d)| ((a, b), d)).collect();
            let then = Snapshot::of(world);
            for (row, (from, to)) in last.positions.iter().zip(&then.positions).enumerate() {
                let speed = from.distance(*to) / world.settings().step;
                assert!(speed <= f64::from(world.relative_columns().max_speed[row]) + 0.02, "a shove of {speed} m/s");
            }
            last = then;
        });
        assert_eq!(world.overlapping(), [], "case {case}");
        assert_eq!(brute(&world), []);
    }
}

/// Any number of agents that start at one place leave it at walking speed: the guard does not hold them there.
#[test]
fn a_pile_dissolves() {
    for (case, step) in [1.0 / 30.0, 0.1, 0.4].into_iter().enumerate() {
        let mut world = heap(case as u64, 400, 0.3, step, SubSteps::Auto);
        let mut last = Snapshot::of(&world);
        assert!(brute(&world).len() > 60_000);
        run_for(&mut world, 12.0, |world| {
            let then = Snapshot::of(world);
            for (row, (from, to)) in last.positions.iter().zip(&then.positions).enumerate() {
                let speed = from.distance(*to) / world.settings().step;
                assert!(speed <= f64::from(world.relative_columns().max_speed[row]) + 0.02, "a shove of {speed} m/s");
            }
            last = then;
        });
        assert_eq!(brute(&world), [], "case {case}");
    }
}

#[test]
fn two_in_one_place_with_one_goal_both_arrive() {
    for (case, angle) in [0.0, 1.0, 2.5, 4.4].into_iter().enumerate() {
        let origin = DVec2::new(-777.0, 3100.0 * case as f64);
        let mut world = with_settings(0.04, SubSteps::Auto, origin);
        let agent = walker(&mut world, origin, origin + DVec2::from_angle(angle) * 8.0);
        world.add_agent(agent.clone()).unwrap();
        world.add_agent(agent).unwrap();
        assert_eq!(world.overlapping(), [(0, 1, 0.0)]);
        run_for(&mut world, 2.0, |_| {});
        assert_eq!(world.overlapping(), [], "they part within two seconds");
        run_for(&mut world, 18.0, |_| {});
        assert!(world.finished());
        assert_eq!(brute(&world), []);
    }
}

/// Two standing agents separate too, and then rest.
#[test]
fn two_resting_agents_in_one_place_part_and_rest_again() {
    let mut world = with_settings(0.05, SubSteps::Auto, DVec2::ZERO);
    for _ in 0..2 {
        world.add_agent(Agent::default()).unwrap();
    }
    run_for(&mut world, 10.0, |_| {});
    assert_eq!(brute(&world), []);
    let still = |world: &World| world.relative_columns().velocity.iter().all(|v| v.length() < 1e-3);
    assert!(still(&world), "{:?}", world.relative_columns().velocity);
    let apart = world.relative_columns().position[0].distance(world.relative_columns().position[1]);
    assert!(apart < 0.5, "no farther than it takes: {apart}");
}

#[test]
fn a_heap_in_a_corner_parts_without_entering_the_walls() {
    let mut world = with_settings(0.05, SubSteps::Auto, DVec2::new(4000.0, -4000.0));
    let origin = world.settings().origin;
    let corner = [(6.0, 0.5), (0.0, 0.0), (0.7, 6.0)].map(|p| origin + DVec2::from(p));
    world.add_obstacle(Obstacle::Wall { points: corner.to_vec() }).unwrap();
    let mut draw = Draw::new(6);
    for _ in 0..10 {
        let position = origin + draw.point(DVec2::splat(0.4), DVec2::splat(0.9));
        world.add_agent(Agent { position: position.extend(0.0), radius: 0.2, ..Agent::default() }).unwrap();
    }
    let walls = crate::world::oracle::obstacles(&world);
    run_for(&mut world, 20.0, |world| {
        let positions = Snapshot::of(world).positions;
        let least =
            positions.iter().map(|&p| crate::world::oracle::distance_to(&walls[0], p)).fold(f64::INFINITY, f64::min);
        assert!(least >= 0.2 * (1.0 - 1e-4), "at {:.2} s: {least} m from the wall", world.time());
    });
    assert_eq!(brute(&world), []);
}
