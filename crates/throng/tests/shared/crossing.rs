//! The reference workload for comparisons of crowd simulators.

use glam::DVec2;
use std::f64::consts::TAU;
use throng::motion::Holonomic;
use throng::{Agent, Goal, Group, GroupId, Journey, JourneyId, Settings, Stop, SubSteps, World};

/// 0.25 agents per m2 in the open, added in no spatial order, each with a distant goal in one of 64 directions.
pub fn crossing(count: u32, group: Group) -> World {
    let settings = Settings { step: 0.1, sub_steps: SubSteps::Fixed(1), ..Settings::default() };
    let mut world = World::new(settings).unwrap();
    let group: GroupId = world.add_group(group).unwrap();
    let journeys: Vec<JourneyId> = (0..64)
        .map(|k| {
            let at = DVec2::from_angle(f64::from(k) / 64.0 * TAU) * 10_000.0;
            let goal = world.add_goal(Goal::Point { at, tolerance: 0.5 }).unwrap();
            world.add_journey(Journey { stops: vec![Stop { goal, wait: 0.0 }], repeat: false }).unwrap()
        })
        .collect();
    world.reserve(count as usize);
    let side = f64::from(count).sqrt().ceil();
    for number in 0..count {
        // a prime step goes through places, directions and speeds in no order
        let mixed = number * 7919;
        let place = DVec2::new(f64::from(mixed % count) % side, (f64::from(mixed % count) / side).floor());
        let preferred_speed = 1.3 + 0.2 * (mixed % 101) as f32 / 101.0;
        let body = Agent {
            radius: 0.25,
            preferred_speed,
            motor: Holonomic { max_speed: 2.0, ..Holonomic::default() }.into(),
            ..Agent::default()
        };
        let journey = journeys[mixed as usize % journeys.len()];
        world.add_agent(Agent { position: ((place - 0.5 * side) * 2.0).extend(0.0), group, journey, ..body }).unwrap();
    }
    world
}
