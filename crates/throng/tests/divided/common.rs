//! Parts of the crowds.

use glam::DVec2;
use throng::{Goal, Journey, JourneyId, Settings, Stop, SubSteps, World};

/// An empty world with this time step round an origin.
pub fn with_settings(step: f64, sub_steps: SubSteps, origin: DVec2) -> World {
    World::new(Settings { step, sub_steps, seed: 11, origin }).unwrap()
}

/// A journey to one goal.
pub fn journey_to(world: &mut World, goal: impl Into<Goal>) -> JourneyId {
    let goal = world.add_goal(goal.into()).unwrap();
    world.add_journey(Journey { stops: vec![Stop { goal, wait: 0.0 }], repeat: false }).unwrap()
}

/// Corners of a rectangle about a centre.
pub fn rectangle(center: DVec2, size: DVec2) -> Vec<DVec2> {
    [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)].map(|(x, y)| center + size * DVec2::new(x, y)).to_vec()
}
