//! Parts of the scenes: numbers drawn from a seed, journeys, running.

pub use crate::draw::Draw;
use glam::DVec2;
use throng::{Agent, Goal, Journey, JourneyId, Settings, Stop, SubSteps, World};

impl Draw {
    pub fn shuffle<T>(&mut self, items: &mut [T]) {
        for end in (1..items.len()).rev() {
            items.swap(end, self.index(end + 1));
        }
    }
}

/// An empty world with this time step round an origin.
pub fn world(step: f64, origin: DVec2) -> World {
    with_settings(step, SubSteps::Auto, origin)
}

pub fn with_settings(step: f64, sub_steps: SubSteps, origin: DVec2) -> World {
    World::new(Settings { step, sub_steps, seed: 11, origin }).unwrap()
}

/// A journey to one point.
pub fn journey_to(world: &mut World, at: DVec2) -> JourneyId {
    journey_into(world, Goal::Point { at, tolerance: 0.1 })
}

/// A journey to one goal.
pub fn journey_into(world: &mut World, goal: Goal) -> JourneyId {
    let goal = world.add_goal(goal).unwrap();
    world.add_journey(Journey { stops: vec![Stop { goal, wait: 0.0 }], repeat: false }).unwrap()
}

/// A pedestrian on the way from one point to another.
pub fn walker(world: &mut World, from: DVec2, to: DVec2) -> Agent {
    Agent { position: from.extend(0.0), journey: journey_to(world, to), ..Agent::default() }
}

/// Corners of a rectangle between two points, turned about `center`.
pub fn rectangle(center: DVec2, size: DVec2, angle: f64) -> Vec<DVec2> {
    let along = DVec2::from_angle(angle);
    let (a, b) = (along * (0.5 * size.x), along.perp() * (0.5 * size.y));
    vec![center - a - b, center + a - b, center + a + b, center - a + b]
}

/// Steps until all agents have arrived or `limit` seconds have passed; calls `each` after every step.
pub fn run(world: &mut World, limit: f64, mut each: impl FnMut(&World)) {
    while !world.finished() && world.time() < limit {
        world.step();
        each(world);
    }
}

/// Steps for some seconds.
pub fn run_for(world: &mut World, seconds: f64, mut each: impl FnMut(&World)) {
    let end = world.time() + seconds - 1e-9;
    while world.time() < end {
        world.step();
        each(world);
    }
}
