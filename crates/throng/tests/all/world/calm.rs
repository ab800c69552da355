//! No jitter: arrived crowds rest, headings turn smoothly, and passing agents leave resting agents at rest.

use crate::world::common::{Draw, journey_to, run, run_for, walker, world};
use crate::world::oracle::{Snapshot, assert_free};
use crate::world::scenes::free_spot;
use glam::DVec2;
use throng::{Agent, World};

/// Angle between two headings, degrees.
fn turn(a: f32, b: f32) -> f64 {
    let away = f64::from(a) - f64::from(b);
    away.sin().atan2(away.cos()).abs().to_degrees()
}

/// Checks that a world rests for five seconds: mean speed below 1 mm/s, no heading turned by more than a degree.
fn assert_rests(world: &mut World, label: &str) {
    let headings = world.relative_columns().heading.clone();
    let before = Snapshot::of(world).positions;
    let (mut speeds, mut samples) = (0.0, 0.0);
    run_for(world, 5.0, |world| {
        let agents = world.relative_columns();
        speeds += agents.velocity.iter().map(|v| f64::from(v.length())).sum::<f64>() / agents.len() as f64;
        samples += 1.0;
        for (row, (&now, &then)) in agents.heading.iter().zip(&headings).enumerate() {
            assert!(turn(now, then) <= 1.0, "{label}: row {row} turned from {then} to {now} by {:.2} s", world.time());
        }
    });
    let mean = speeds / samples;
    assert!(mean < 1e-3, "{label}: a mean speed of {mean} m/s at rest");
    let moved = before.iter().zip(&Snapshot::of(world).positions).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
    assert!(moved < 0.05, "{label}: an agent crept {moved} m");
}

/// A random crowd of `count` agents with one goal.
fn gathering(count: usize, seed: u64, radii: &[f32]) -> World {
    let mut draw = Draw::new(seed);
    let mut world = world(0.04, DVec2::new(-2600.0, 5100.0));
    let origin = world.settings().origin;
    let journey = journey_to(&mut world, origin + draw.point(DVec2::splat(-2.0), DVec2::splat(2.0)));
    let half = DVec2::splat(1.2 * (count as f64).sqrt());
    let mut taken = Vec::new();
    for _ in 0..count {
        let radius = draw.one_of(radii);
        let spot = free_spot(&mut draw, &[], &taken, (origin - half, origin + half), f64::from(radius)).unwrap();
        taken.push((spot, f64::from(radius)));
        let preferred_speed = draw.between(0.8, 1.6) as f32;
        world
            .add_agent(Agent { position: spot.extend(0.0), journey, radius, preferred_speed, ..Agent::default() })
            .unwrap();
    }
    world
}

#[test]
fn a_crowd_that_gathers_at_one_point_comes_to_rest() {
    for (count, seed, radii) in [(60, 1, &[0.2f32][..]), (100, 2, &[0.15, 0.2, 0.3]), (200, 3, &[0.2])] {
        let mut world = gathering(count, seed, radii);
        run(&mut world, 60.0, |_| {});
        assert!(world.finished(), "{count}: {:?}", world.summary());
        run_for(&mut world, 20.0, |_| {});
        assert_free(&world);
        assert_rests(&mut world, &format!("{count} at one point"));
    }
}

/// A file of twenty agents walks to one place: no heading oscillates.
#[test]
fn a_queue_walks_without_wagging() {
    let mut world = world(0.04, DVec2::new(7000.0, 10.0));
    let origin = world.settings().origin;
    let along = DVec2::from_angle(2.6);
    let journey = journey_to(&mut world, origin + along * 25.0);
    for k in 0..20 {
        let position = origin - along * (0.5 * f64::from(k));
        let preferred_speed = 1.2 + 0.05 * (k % 4) as f32;
        world
            .add_agent(Agent { position: position.extend(0.0), journey, preferred_speed, ..Agent::default() })
            .unwrap();
    }
    run_for(&mut world, 3.0, assert_free);
    let mut turned = [0.0; 20];
    let mut last = world.relative_columns().heading.clone();
    run_for(&mut world, 12.0, |world| {
        assert_free(world);
        for (row, heading) in world.relative_columns().heading.iter().enumerate() {
            turned[row] += turn(*heading, last[row]);
            last[row] = *heading;
        }
    });
    let worst = turned.iter().fold(0.0f64, |a, &b| a.max(b)) / 12.0;
    let mean = turned.iter().sum::<f64>() / 20.0 / 12.0;
    assert!(worst < 25.0 && mean < 10.0, "degrees a second: worst {worst:.1}, mean {mean:.1}");
}

#[test]
fn passers_by_leave_a_resting_crowd_at_rest() {
    let mut world = gathering(40, 9, &[0.2, 0.25]);
    let origin = world.settings().origin;
    run(&mut world, 60.0, |_| {});
    assert!(world.finished());
    for k in 0..8 {
        let from = origin + DVec2::new(-9.0 - f64::from(k), 1.2 - 0.3 * f64::from(k));
        let agent = walker(&mut world, from, origin + DVec2::new(12.0 + f64::from(k), 1.0));
        world.add_agent(agent).unwrap();
    }
    run(&mut world, 120.0, assert_free);
    assert!(world.finished(), "the passing agents arrive: {:?}", world.summary());
    run_for(&mut world, 20.0, |_| {});
    assert_rests(&mut world, "after the passers-by");
}

#[test]
fn a_scattered_crowd_with_nowhere_to_go_never_moves() {
    let mut draw = Draw::new(70);
    let mut world = world(0.05, DVec2::new(-50.0, 50.0));
    let mut taken = Vec::new();
    for _ in 0..80 {
        let area = (DVec2::new(-54.0, 46.0), DVec2::new(-46.0, 54.0));
        let Some(spot) = free_spot(&mut draw, &[], &taken, area, 0.2) else { continue };
        taken.push((spot, 0.2));
        world.add_agent(Agent::at(spot)).unwrap();
    }
    run_for(&mut world, 5.0, |_| {});
    for _ in 0..100 {
        world.step();
    }
    assert_rests(&mut world, "nowhere to go");
    for ((start, _), now) in taken.iter().zip(Snapshot::of(&world).positions) {
        assert!(start.distance(now) < 0.05, "from {start} to {now}");
    }
}
