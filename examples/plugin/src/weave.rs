//! The behaviour `weave`.

use glam::Vec3;
use schemars::JsonSchema;
use serde::Deserialize;
use std::f32::consts::TAU;
use throng::motion::Steering;
use throng::steer::{Behaviour, Reason, View, Why};

/// Swings from one side to the other on its way ahead, as skaters do.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(default)]
pub struct Weave {
    /// How far to a side it leans, degrees.
    #[schemars(range(min = 0, max = 80))]
    pub angle: f32,
    /// From one side to the other and back, seconds.
    #[schemars(range(min = 0.2, max = 20))]
    pub period: f32,
}

impl Default for Weave {
    fn default() -> Self {
        Self { angle: 40.0, period: 3.0 }
    }
}

impl Behaviour for Weave {
    /// How many swings it has made.
    fn memory(&self) -> usize {
        1
    }

    fn steer(&self, view: &View<'_>, memory: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        if memory[0] == 0.0 {
            // everybody begins somewhere in a swing
            memory[0] = view.dice.draw(0);
        }
        memory[0] += view.seconds / self.period;
        let lean = self.angle.to_radians() * libm::sinf(TAU * memory[0]);
        let ahead = Vec3::new(libm::cosf(lean), libm::sinf(lean), 0.0);
        let ahead = view.motion.basis.to_world(ahead);
        why.note(|| Reason::Aim(view.position() + ahead));
        view.turn(ahead)
    }
}
