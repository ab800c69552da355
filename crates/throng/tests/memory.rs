//! Memory per agent: its state, and the buffers of a step.
//!
//! This binary is separate: it counts the memory of the whole process.
#![allow(clippy::print_stdout)]

#[path = "shared/crossing.rs"]
mod crossing;

use crossing::crossing;
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;
use throng::Group;

#[global_allocator]
static MEMORY: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

const COUNT: u32 = 20_000;

/// Bytes per agent that are in use since the start of a region.
fn bytes(region: &Region<'_, System>) -> f64 {
    let change = region.change();
    (change.bytes_allocated - change.bytes_deallocated) as f64 / f64::from(COUNT)
}

#[test]
fn the_state_of_an_agent_takes_at_most_120_bytes() {
    let region = Region::new(MEMORY);
    let mut world = crossing(COUNT, Group::default());
    let state = bytes(&region);
    for _ in 0..40 {
        world.step();
    }
    let step = bytes(&region) - state;
    println!("{state:.1} bytes of state an agent, {step:.1} of memory of a step");
    assert!(state <= 120.0, "{state} bytes of state");
    // positions, velocities and numbers alone take more than 20 bytes
    assert!(state > 20.0 && step > 20.0, "{state} and {step} bytes: not all is counted");
}
