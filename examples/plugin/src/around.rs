//! The goal `around`.

use glam::DVec3;
use std::f64::consts::TAU;
use throng::parameters::parameters;
use throng_scene::{AgentJourney, AgentStart, GoalRule, Random};

/// To a circle around the centre of the place: each agent to a point of its own, evenly spaced.
#[parameters]
#[derive(Clone, Debug)]
pub struct Around {
    /// The radius of the circle, metres.
    #[parameter(default = 10.0, unit = "m", above = 0, most = 10000)]
    pub radius: f64,
    /// Distance that counts as arrival, metres.
    #[parameter(default = 0.2, unit = "m", above = 0, most = 10)]
    pub tolerance: f64,
}

impl GoalRule for Around {
    fn goal(&self, agent: &AgentStart, _: &mut Random) -> AgentJourney {
        let (sin, cos) = libm::sincos(TAU * agent.k as f64 / agent.n as f64);
        agent.point(agent.center + self.radius * DVec3::new(cos, sin, 0.0), self.tolerance).into()
    }
}
