//! A step of a world that has run for a while allocates nothing.

use glam::DVec2;
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;
use throng::perceive::Instructions;
use throng::{Agent, Goal, Group, GroupId, Journey, JourneyId, Settings, Stop, SubSteps, World};

#[global_allocator]
static MEMORY: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

const COUNT: u32 = 3000;

/// 0.25 people per m2 in the open, added in no spatial order, each bound for a place far away in one of many directions.
fn crossing(group: Group) -> World {
    let settings = Settings { step: 0.1, sub_steps: SubSteps::Fixed(1), ..Settings::default() };
    let mut world = World::new(settings).unwrap();
    let group: GroupId = world.add_group(group).unwrap();
    let journeys: Vec<JourneyId> = (0..64)
        .map(|k| {
            let at = DVec2::from_angle(f64::from(k) / 64.0 * std::f64::consts::TAU) * 10_000.0;
            let goal = world.add_goal(Goal::Point { at, tolerance: 0.5 }).unwrap();
            world.add_journey(Journey { stops: vec![Stop { goal, wait: 0.0 }], repeat: false }).unwrap()
        })
        .collect();
    let side = f64::from(COUNT).sqrt().ceil();
    for number in 0..COUNT {
        // a prime steps through places, directions and speeds in no order
        let mixed = number * 7919;
        let place = DVec2::new(f64::from(mixed % COUNT) % side, (f64::from(mixed % COUNT) / side).floor());
        let preferred_speed = 1.3 + 0.2 * (mixed % 101) as f32 / 101.0;
        let body = Agent { radius: 0.25, preferred_speed, max_speed: 2.0, ..Agent::default() };
        let journey = journeys[mixed as usize % journeys.len()];
        world.add_agent(Agent { position: (place - 0.5 * side) * 2.0, group, journey, ..body }).unwrap();
    }
    world
}

/// Allocations of so many steps.
fn allocations(world: &mut World, steps: u32) -> usize {
    let region = Region::new(MEMORY);
    for _ in 0..steps {
        world.step();
    }
    let change = region.change();
    change.allocations + change.reallocations
}

/// Agreeing on standoffs and planning ways allocate, and so does a list that is longer than it ever was: a crowd that
/// has walked for a while makes no longer ones.
#[test]
fn a_step_allocates_nothing() {
    let manners = Group { resolve: false, ..Group::default() };
    let bare = Group { keep_right: 0.0, detour: false, queue: false, ..manners.clone() };
    let groups = [("bare", Group { guard: false, ..bare.clone() }), ("guarded", bare), ("with manners", manners)];
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    for (name, group) in groups {
        for instructions in [Instructions::Best, Instructions::Plain, Instructions::Avx2] {
            one_thread.install(|| {
                let mut world = crossing(group.clone());
                world.use_instructions(instructions);
                assert!(allocations(&mut world, 400) > 0, "they are counted");
                assert_eq!(allocations(&mut world, 40), 0, "{name}, {instructions:?}");
                world.sort_rows();
                assert_eq!(allocations(&mut world, 5), 0, "{name}, {instructions:?}, rows sorted");
            });
        }
    }
}
