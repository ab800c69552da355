//! How much memory an agent takes: its state, and what a step keeps for it.
#![allow(clippy::print_stdout)]

use glam::DVec2;
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;
use throng::{Agent, Goal, Journey, JourneyId, Settings, Stop, SubSteps, World};

#[global_allocator]
static MEMORY: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

const COUNT: u32 = 20_000;

/// The reference work that crowd simulators are compared on: 0.25 people per m2 in the open, each bound for a place far
/// away in one of many directions.
fn crossing() -> World {
    let settings = Settings { step: 0.1, sub_steps: SubSteps::Fixed(1), ..Settings::default() };
    let mut world = World::new(settings).unwrap();
    let journeys: Vec<JourneyId> = (0..64)
        .map(|k| {
            let at = DVec2::from_angle(f64::from(k) / 64.0 * std::f64::consts::TAU) * 10_000.0;
            let goal = world.add_goal(Goal::Point { at, tolerance: 0.5 }).unwrap();
            world.add_journey(Journey { stops: vec![Stop { goal, wait: 0.0 }], repeat: false }).unwrap()
        })
        .collect();
    world.reserve(COUNT as usize);
    let side = f64::from(COUNT).sqrt().ceil();
    for number in 0..COUNT {
        // a prime steps through places, directions and speeds in no order
        let mixed = number * 7919;
        let place = DVec2::new(f64::from(mixed % COUNT) % side, (f64::from(mixed % COUNT) / side).floor());
        let preferred_speed = 1.3 + 0.2 * (mixed % 101) as f32 / 101.0;
        let body = Agent { radius: 0.25, preferred_speed, max_speed: 2.0, ..Agent::default() };
        let journey = journeys[mixed as usize % journeys.len()];
        world.add_agent(Agent { position: (place - 0.5 * side) * 2.0, journey, ..body }).unwrap();
    }
    world
}

/// Bytes an agent that are in use since a region began.
fn bytes(region: &Region<'_, System>) -> f64 {
    let change = region.change();
    (change.bytes_allocated - change.bytes_deallocated) as f64 / f64::from(COUNT)
}

#[test]
fn the_state_of_an_agent_takes_at_most_120_bytes() {
    let region = Region::new(MEMORY);
    let mut world = crossing();
    let state = bytes(&region);
    for _ in 0..40 {
        world.step();
    }
    let step = bytes(&region) - state;
    println!("{state:.1} bytes of state an agent, {step:.1} of memory of a step");
    assert!(state <= 120.0, "{state} bytes of state");
    // positions, velocities and numbers alone take more than 20
    assert!(state > 20.0 && step > 20.0, "{state} and {step} bytes: not all is counted");
}
