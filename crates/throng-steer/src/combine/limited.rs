//! Limits of a single behaviour (gdx-ai's limiters).

use std::sync::Arc;
use throng::Error;
use throng::field::Field;
use throng::motion::{Steering, Vehicle};
use throng::parameters::{Value, parameters};
use throng::steer::{Behaviour, BoxedBehaviour, SteeringInput, TraceRecorder};

/// Limits the speed and force of a part.
///
/// For an agent that can run, but strolls.
///
/// ```
/// use throng_steer::{Limited, Wander};
/// let stroll = Limited { max_speed: 0.7, max_force: 1.0, of: Wander::default().into() };
/// ```
#[parameters]
#[derive(Clone, Debug)]
pub struct Limited {
    /// The speed that the part uses as the greatest speed, m/s. Without it, that of the vehicle.
    #[parameter(default = f32::INFINITY, infinite, unit = "m/s", above = 0)]
    pub max_speed: f32,
    /// The greatest force of the part, newtons. Without it, that of the vehicle.
    #[parameter(default = f32::INFINITY, infinite, unit = "N", above = 0)]
    pub max_force: f32,
    /// The part.
    #[parameter(required)]
    pub of: BoxedBehaviour,
}

impl Behaviour for Limited {
    fn memory(&self) -> usize {
        self.of.words()
    }

    fn steer(&self, view: &SteeringInput<'_>, mut memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let own = view.vehicle;
        let (max_speed, max_force) = (own.max_speed.min(self.max_speed), own.max_force.min(self.max_force));
        let view = SteeringInput { vehicle: Vehicle { max_speed, max_force, ..own }, ..*view };
        let said = self.of.steer_as(0, &view, &mut memory, why)?;
        Some(Steering { force: said.force.clamp_length_max(max_force), ..said })
    }

    fn fields(&self, see: &mut dyn FnMut(&Arc<dyn Field>)) {
        self.of.fields(see);
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()?;
        self.of.check()
    }
}
