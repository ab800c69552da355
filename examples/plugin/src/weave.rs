//! The behaviour `weave`.

use glam::Vec3;
use std::f32::consts::TAU;
use throng::motion::Steering;
use throng::parameters::{Angle, parameters};
use throng::steer::{Behaviour, SteeringInput, SteeringReason, TraceRecorder};

/// Swings from side to side while moving ahead, like a skater.
#[parameters]
#[derive(Clone, Debug)]
pub struct Weave {
    /// Largest angle to a side, degrees.
    #[parameter(default = Angle::degrees(40.0), unit = "°", least = 0, most = 80)]
    pub angle: Angle,
    /// Period of a full swing, seconds.
    #[parameter(default = 3.0, unit = "s", least = 0.2, most = 20)]
    pub period: f32,
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
        let lean = self.angle.radians() * libm::sinf(TAU * memory[0]);
        let ahead = Vec3::new(libm::cosf(lean), libm::sinf(lean), 0.0);
        let ahead = view.motion.basis.to_world(ahead);
        why.note(|| SteeringReason::Aim(view.position() + ahead));
        view.turn(ahead)
    }
}
