//! The behaviour `weave`.

use glam::Vec3;
use schemars::JsonSchema;
use serde::Deserialize;
use std::f32::consts::TAU;
use throng::motion::Steering;
use throng::steer::{Behaviour, SteeringInput, SteeringReason, TraceRecorder};

/// Swings from side to side while moving ahead, like a skater.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(default)]
pub struct Weave {
    /// Largest angle to a side, degrees.
    #[schemars(range(min = 0, max = 80))]
    pub angle: f32,
    /// Period of a full swing, seconds.
    #[schemars(range(min = 0.2, max = 20))]
    pub period: f32,
}

impl Default for Weave {
    fn default() -> Self {
        Self { angle: 40.0, period: 3.0 }
    }
}

impl Behaviour for Weave {
    /// Returns 1: the phase of the swing, in periods.
    fn memory(&self) -> usize {
        1
    }

    fn steer(&self, view: &SteeringInput<'_>, memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        if memory[0] == 0.0 {
            // each agent starts at a random phase
            memory[0] = view.rng.draw(0);
        }
        memory[0] += view.seconds / self.period;
        let lean = self.angle.to_radians() * libm::sinf(TAU * memory[0]);
        let ahead = Vec3::new(libm::cosf(lean), libm::sinf(lean), 0.0);
        let ahead = view.motion.basis.to_world(ahead);
        why.note(|| SteeringReason::Aim(view.position() + ahead));
        view.turn(ahead)
    }
}
