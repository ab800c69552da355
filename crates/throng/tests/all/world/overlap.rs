//! No two agents overlap: with any model, any limits, any time step, at the ends of steps and between them.

use crate::world::common::{Draw, with_settings};
use crate::world::oracle::{Snapshot, assert_free, obstacles, rounding_speed};
use crate::world::scenes::{Kind, clutter, populate};
use glam::{DVec2, Vec2};
use std::sync::Arc;
use throng::avoid::{AvoidanceInput, LocalModel, Workspace};
use throng::{Group, SubSteps, World};

/// A model that aims at collisions, or returns invalid velocities.
#[derive(Debug)]
struct Reckless;

impl LocalModel for Reckless {
    fn velocity(&self, view: &AvoidanceInput<'_>, _: &mut Workspace) -> Vec2 {
        match view.neighbours.first() {
            Some(near) if near.offset.x > 0.6 => Vec2::new(f32::NAN, 1.0),
            Some(near) => near.offset.normalize_or(near.aside) * 1e3,
            None => view.preferred * 100.0,
        }
    }

    fn wall_range(&self, radius: f32, _: f32) -> f32 {
        radius
    }
}

/// Steps, and checks: no overlap at any of `moments` times between steps, and no agent faster than its limit.
fn check(world: &mut World, steps: usize, moments: u32) {
    let obstacles = obstacles(world);
    let mut before = Snapshot::of(world);
    assert_eq!(before.overlaps(&obstacles), [""; 0], "the start must be free");
    for _ in 0..steps {
        world.step();
        let after = Snapshot::of(world);
        for moment in 1..=moments {
            let found = before.between(&after, f64::from(moment) / f64::from(moments)).overlaps(&obstacles);
            assert!(found.is_empty(), "at {:.3} s ({moment} of {moments}): {found:#?}", world.time());
        }
        let agents = world.relative_columns();
        for (row, (from, to)) in before.positions.iter().zip(&after.positions).enumerate() {
            let seconds = world.settings().step;
            let speed = from.distance(*to) / seconds;
            // rounding, once a sub-step: there are fewer than 2000 of them
            let most = f64::from(agents.max_speed[row]) * (1.0 + 1e-5);
            let most = most + 2000.0 * rounding_speed(agents.position[row], seconds);
            assert!(speed <= most, "agent {row} makes {speed} m/s of {most}");
        }
        before = after;
    }
}

/// A separate world for every case: clutter, crowd and all settings follow from the number.
fn scene(case: u64, sub_steps: SubSteps, things: usize) -> World {
    let mut draw = Draw::new(case + 1000);
    let step = [1.0 / 60.0, 0.04, 0.1, 0.3, 1.0][case as usize % 5];
    let origin = draw.point(DVec2::splat(-9000.0), DVec2::splat(9000.0)).round();
    let mut world = with_settings(step, sub_steps, origin);
    let keep_right = draw.one_of(&[0.0, 0.08, -0.3]);
    let group = world.add_group(Group { keep_right, ..Group::default() }).unwrap();
    let center = origin + draw.point(DVec2::splat(-3.0), DVec2::splat(3.0));
    let half = draw.between(3.0, 6.0);
    for obstacle in if things > 0 { clutter(&mut draw, center, half, things) } else { vec![] } {
        world.add_obstacle(obstacle).unwrap();
    }
    let area = (center - DVec2::splat(half), center + DVec2::splat(half));
    populate(&mut world, &mut draw, area, 45, &Kind { group, ..Kind::default() });
    assert!(world.relative_columns().len() > 5, "case {case}: {}", world.relative_columns().len());
    world
}

fn steps(world: &World, seconds: f64, most: usize) -> usize {
    ((seconds / world.settings().step) as usize).clamp(4, most)
}

#[test]
fn no_two_agents_overlap_in_random_rooms() {
    for case in 0..20 {
        let mut world = scene(case, SubSteps::Auto, 1 + case as usize % 5);
        let count = steps(&world, 8.0, 150);
        check(&mut world, count, 1);
    }
}

#[test]
fn no_two_agents_overlap_in_the_open() {
    for case in 20..30 {
        let mut world = scene(case, SubSteps::Auto, 0);
        let count = steps(&world, 8.0, 150);
        check(&mut world, count, 1);
    }
}

/// With one sub-step the motion of a step is a straight line without overlaps at any time.
#[test]
fn no_two_agents_overlap_between_steps() {
    for case in 30..50 {
        let mut world = scene(case, SubSteps::Fixed(1), case as usize % 4);
        let count = steps(&world, 20.0, 100);
        check(&mut world, count, 12);
    }
}

#[test]
fn no_two_agents_overlap_whatever_the_model_returns() {
    for case in 50..60 {
        let mut draw = Draw::new(case);
        let step = draw.one_of(&[1.0 / 60.0, 0.1, 1.0]);
        let mut world = with_settings(step, SubSteps::Fixed(1), DVec2::ZERO);
        for obstacle in clutter(&mut draw, DVec2::ZERO, 5.0, 3) {
            world.add_obstacle(obstacle).unwrap();
        }
        let reckless = Group { name: "reckless".into(), model: Arc::new(Reckless), ..Group::default() };
        let group = world.add_group(reckless).unwrap();
        let area = (DVec2::splat(-5.0), DVec2::splat(5.0));
        populate(&mut world, &mut draw, area, 30, &Kind { group, ..Kind::default() });
        check(&mut world, 60, 12);
        assert!(world.relative_columns().position.iter().all(|p| p.is_finite()));
    }
}

/// Errors by rounding and slack do not accumulate: a crush under pressure for thousands of steps keeps the guarantee.
#[test]
fn a_crush_that_lasts_does_not_creep() {
    let mut world = with_settings(1.0 / 60.0, SubSteps::Fixed(1), DVec2::new(1e4, -1e4));
    let origin = world.settings().origin;
    let reckless = Group { name: "reckless".into(), model: Arc::new(Reckless), ..Group::default() };
    let group = world.add_group(reckless).unwrap();
    let mut draw = Draw::new(3);
    // all agents push their nearest neighbour, near a wall
    let wall = [(-9.0, -1.4), (9.0, -1.2)].map(|p| origin + DVec2::from(p));
    world.add_obstacle(throng::Obstacle::Wall { points: wall.to_vec() }).unwrap();
    let area = (origin - DVec2::new(1.5, 1.0), origin + DVec2::splat(1.5));
    populate(&mut world, &mut draw, area, 25, &Kind { group, ..Kind::default() });
    for step in 0..6000 {
        world.step();
        if step % 100 == 99 {
            assert_free(&world);
        }
    }
}
