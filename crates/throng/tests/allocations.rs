//! A step of a world that has run for a while allocates nothing.

#[path = "shared/crossing.rs"]
mod crossing;

use crossing::crossing;
use glam::Vec3;
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;
use throng::perceive::Instructions;
use throng::space::surface::{SeenFrom, Sphere};
use throng::steer::swarm::{Aggregate, Align, Apart, Swarm, midge};
use throng::steer::{Barriers, Target};
use throng::{Agent, Group, Settings, SubSteps, World};

#[global_allocator]
static MEMORY: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

const COUNT: u32 = 3000;

/// Allocations of so many steps.
fn allocations(world: &mut World, steps: u32) -> usize {
    let region = Region::new(MEMORY);
    for _ in 0..steps {
        world.step();
    }
    let change = region.change();
    change.allocations + change.reallocations
}

/// One test: allocations of another that runs beside it would count.
#[test]
fn a_step_allocates_nothing() {
    a_step_of_a_crowd_allocates_nothing();
    a_step_of_a_swarm_allocates_nothing();
}

/// Agreeing on standoffs and planning ways allocate, and so does a list that is longer than it ever was: a crowd that
/// has walked for a while makes no longer ones.
fn a_step_of_a_crowd_allocates_nothing() {
    let manners = Group { resolve: false, ..Group::default() };
    let bare = Group { look_ahead: false, keep_right: 0.0, ..manners.clone() };
    let ball = Sphere::new(Vec3::ZERO, 2.0).unwrap();
    let solid = Group { solid: Barriers::default().with(ball, SeenFrom::Outside), ..bare.clone() };
    let groups = [
        ("bare", Group { guard: false, ..bare.clone() }),
        ("guarded", bare),
        ("with manners", manners),
        ("a ball, unguarded", Group { guard: false, ..solid.clone() }),
        ("a ball", solid),
    ];
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    for (name, group) in groups {
        for instructions in [Instructions::Best, Instructions::Plain, Instructions::Avx2] {
            one_thread.install(|| {
                let mut world = crossing(COUNT, group.clone());
                world.use_instructions(instructions);
                assert!(allocations(&mut world, 400) > 0, "they are counted");
                assert_eq!(allocations(&mut world, 40), 0, "{name}, {instructions:?}");
                world.sort_rows();
                assert_eq!(allocations(&mut world, 5), 0, "{name}, {instructions:?}, rows sorted");
            });
        }
    }
}

/// Midges, that keep apart and fly along with those near them, or see nobody.
fn a_step_of_a_swarm_allocates_nothing() {
    // they fill a ball, and so are as dense at the end as at the start
    let marker = Aggregate { beyond: 2.0, ..Aggregate::from(Target::Point(Vec3::new(2.5, 3.0, 2.0))) };
    let sees_all = Swarm::default().with(marker).with(Align { distance: 0.1, weight: 0.2 });
    let sees_nobody = Swarm { apart: Apart { distance: 0.0, speed: 0.0 }, ..Swarm::default() };
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    for swarm in [sees_all, sees_nobody.with(marker)] {
        for instructions in [Instructions::Best, Instructions::Plain] {
            one_thread.install(|| {
                let settings = Settings { step: 1.0 / 60.0, sub_steps: SubSteps::Fixed(1), ..Settings::default() };
                let mut world = World::new(settings).unwrap();
                world.use_instructions(instructions);
                let group = world.add_group(swarm.clone().group(midge())).unwrap();
                for k in 0..COUNT {
                    let position = glam::DVec2::new(0.1 * f64::from(k % 50), 0.1 * f64::from(k / 50));
                    let midge =
                        Agent { position, altitude: 2.0, radius: 0.005, max_speed: 2.0, group, ..Agent::default() };
                    world.add_agent(midge).unwrap();
                }
                assert!(allocations(&mut world, 600) > 0, "they are counted");
                assert_eq!(allocations(&mut world, 40), 0, "{swarm:?}, {instructions:?}");
            });
        }
    }
}
