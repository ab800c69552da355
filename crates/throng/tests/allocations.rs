//! A step of a world that has run for a while does not allocate.
//!
//! This binary is separate: it counts the allocations of the whole process.

#[path = "shared/crossing.rs"]
mod crossing;

use crossing::crossing;
use glam::Vec3;
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;
use throng::perceive::SimdLevel;
use throng::space::surface::{SeenFrom, Sphere};
use throng::steer::{Barriers, Target};
use throng::{Agent, Group, Settings, SubSteps, World};
use throng_steer::swarm::{Aggregate, Align, Swarm, SwarmSpacing, midge};

#[global_allocator]
static MEMORY: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

const COUNT: u32 = 3000;

/// Returns the number of allocations of some steps.
fn allocations(world: &mut World, steps: u32) -> usize {
    let region = Region::new(MEMORY);
    for _ in 0..steps {
        world.step();
    }
    let change = region.change();
    change.allocations + change.reallocations
}

/// A single test, because allocations of a test in parallel would count.
#[test]
#[ignore = "slow: half a minute"]
fn slow_a_step_allocates_nothing() {
    a_step_of_a_crowd_allocates_nothing();
    a_step_of_a_swarm_allocates_nothing();
}

/// Agreements on standoffs and path planning allocate, and so does a list that becomes longer than before: a crowd that
/// has walked for a while has no longer lists.
fn a_step_of_a_crowd_allocates_nothing() {
    let interaction = Group { resolve: false, ..Group::default() };
    let bare = Group { look_ahead: false, keep_right: 0.0, ..interaction.clone() };
    let ball = Sphere::new(Vec3::ZERO, 2.0).unwrap();
    let solid = Group { solid: Barriers::default().with(ball, SeenFrom::Outside), ..bare.clone() };
    let groups = [
        ("bare", Group { guard: false, ..bare.clone() }),
        ("guarded", bare),
        ("with interaction rules", interaction),
        ("a ball, unguarded", Group { guard: false, ..solid.clone() }),
        ("a ball", solid),
    ];
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    for (name, group) in groups {
        for instructions in [SimdLevel::Best, SimdLevel::Plain, SimdLevel::Avx2] {
            one_thread.install(|| {
                let mut world = crossing(COUNT, group.clone());
                world.set_simd_level(instructions);
                assert!(allocations(&mut world, 400) > 0, "they are counted");
                assert_eq!(allocations(&mut world, 40), 0, "{name}, {instructions:?}");
                world.sort_rows();
                assert_eq!(allocations(&mut world, 5), 0, "{name}, {instructions:?}, rows sorted");
            });
        }
    }
}

/// Midges that keep apart and align with their neighbours, or that have no neighbours.
fn a_step_of_a_swarm_allocates_nothing() {
    // the swarm fills a ball, so the density at the end is the density at the start
    let marker = Aggregate { beyond: 2.0, ..Aggregate::new(Target::Point(Vec3::new(2.5, 3.0, 2.0))) };
    let with_neighbours = Swarm::default().with(marker).with(Align { distance: 0.1, weight: 0.2 });
    let without_neighbours = Swarm { apart: SwarmSpacing { distance: 0.0, speed: 0.0 }, ..Swarm::default() };
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    for swarm in [with_neighbours, without_neighbours.with(marker)] {
        for instructions in [SimdLevel::Best, SimdLevel::Plain] {
            one_thread.install(|| {
                let settings = Settings { step: 1.0 / 60.0, sub_steps: SubSteps::Fixed(1), ..Settings::default() };
                let mut world = World::new(settings).unwrap();
                world.set_simd_level(instructions);
                let group = world.add_group(swarm.clone().group()).unwrap();
                for k in 0..COUNT {
                    let position = glam::DVec2::new(0.1 * f64::from(k % 50), 0.1 * f64::from(k / 50));
                    let midge = Agent {
                        position: position.extend(2.0),
                        radius: 0.005,
                        group,
                        motor: midge().into(),
                        ..Agent::default()
                    };
                    world.add_agent(midge).unwrap();
                }
                assert!(allocations(&mut world, 600) > 0, "they are counted");
                assert_eq!(allocations(&mut world, 40), 0, "{swarm:?}, {instructions:?}");
            });
        }
    }
}
