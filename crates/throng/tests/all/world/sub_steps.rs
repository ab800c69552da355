//! The division of steps: by a fixed number, or by a rule that depends only on the state.

use crate::world::common::{Draw, run_for, with_settings};
use crate::world::scenes::{Kind, populate};
use glam::DVec2;
use throng::{Agent, Stage, SubSteps, World};

/// Number of sub-steps of the next step.
fn parts_of_next(world: &mut World) -> u64 {
    let before = world.summary().sub_steps;
    world.step();
    world.summary().sub_steps - before
}

/// Two agents at this distance, the smaller of radius 0.2, the faster of 2 m/s at most.
fn pair(step: f64, apart: f64) -> World {
    let mut world = with_settings(step, SubSteps::Auto, DVec2::new(-44.0, 5000.0));
    let position = world.settings().origin;
    world.add_agent(Agent { position: position.extend(0.0), radius: 0.2, max_speed: 2.0, ..Agent::default() }).unwrap();
    let position = position + DVec2::new(0.0, apart);
    world.add_agent(Agent { position: position.extend(0.0), radius: 0.3, ..Agent::default() }).unwrap();
    world
}

#[test]
fn a_fixed_number_is_kept_to() {
    for parts in [1, 2, 7] {
        let mut world = with_settings(0.1, SubSteps::Fixed(parts), DVec2::ZERO);
        populate(&mut world, &mut Draw::new(1), (DVec2::splat(-3.0), DVec2::splat(3.0)), 20, &Kind::default());
        let there = world.relative_columns().len() as u64;
        run_for(&mut world, 2.0, |_| {});
        let summary = world.summary();
        assert_eq!((summary.steps, summary.sub_steps), (20, 20 * u64::from(parts)));
        assert_eq!(summary.agent_steps, 20 * u64::from(parts) * there);
    }
}

/// The rule: no agent moves farther in a sub-step than a quarter of the smallest radius, an eighth if two agents are
/// within a body's width of each other; no more sub-steps than that takes.
#[test]
fn the_rule_is_what_its_page_says() {
    for step in [0.01, 0.02, 1.0 / 30.0, 0.1, 0.37, 1.0] {
        for (apart, part) in [(9.0, 0.25), (0.55, 0.125), (1.0, 0.125)] {
            let parts = parts_of_next(&mut pair(step, apart)) as f64;
            let farthest = |parts: f64| 2.0 * step / parts;
            assert!(farthest(parts) <= part * 0.2 * 1.01, "{parts} at {step} s, {apart} m");
            let enough = parts == 1.0 || farthest(parts - 1.0) > part * 0.2;
            assert!(enough, "{parts} at {step} s, {apart} m: one less would do");
        }
    }
}

#[test]
fn one_agent_alone_is_no_crowd_and_no_agents_need_no_division() {
    let mut world = with_settings(0.1, SubSteps::Auto, DVec2::ZERO);
    assert_eq!(parts_of_next(&mut world), 1);
    world.add_agent(Agent { radius: 0.2, max_speed: 2.0, ..Agent::default() }).unwrap();
    assert_eq!(parts_of_next(&mut world), 4);
    let mut world = with_settings(10.0, SubSteps::Auto, DVec2::ZERO);
    world.add_agent(Agent { preferred_speed: 0.0, max_speed: 0.0, ..Agent::default() }).unwrap();
    assert_eq!(parts_of_next(&mut world), 1);
}

/// A world that reached a state by loading divides steps as the world that ran to it.
#[test]
fn only_the_state_decides() {
    let crowd = |seed| {
        let mut world = with_settings(0.2, SubSteps::Auto, DVec2::ZERO);
        populate(&mut world, &mut Draw::new(seed), (DVec2::splat(-4.0), DVec2::splat(4.0)), 12, &Kind::default());
        world
    };
    let mut walked = crowd(5);
    let mut loaded = crowd(6);
    for _ in 0..40 {
        loaded.step();
        loaded.load(&walked.save()).unwrap();
        assert_eq!(parts_of_next(&mut loaded), parts_of_next(&mut walked));
    }
}

#[test]
fn when_the_pair_has_parted_the_steps_get_longer() {
    let mut world = pair(0.1, 0.6);
    let first = world.id(0);
    let crowded = parts_of_next(&mut world);
    world.remove_agent(first);
    let position = world.settings().origin - DVec2::new(8.0, 0.0);
    world.add_agent(Agent { position: position.extend(0.0), radius: 0.2, max_speed: 2.0, ..Agent::default() }).unwrap();
    let free = parts_of_next(&mut world);
    assert_eq!((crowded, free), (8, 4));
}

#[test]
fn every_stage_of_every_sub_step_is_reported_and_changes_nothing() {
    let mut told = pair(0.3, 1.0);
    let mut plain = told.clone();
    let parts = parts_of_next(&mut plain);
    let mut stages = Vec::new();
    told.step_in_stages(|stage| stages.push(stage));
    assert!(parts > 1);
    assert_eq!(stages, Stage::ALL.repeat(parts as usize));
    assert_eq!(told.state_hash(), plain.state_hash());
}
