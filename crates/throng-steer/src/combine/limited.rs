//! Limits of a single behaviour (gdx-ai's limiters).

use throng::Error;
use throng::motion::{Steering, Vehicle};
use throng::steer::{Behaviour, BoxedBehaviour, SteeringInput, TraceRecorder};

/// A part with lower limits than the vehicle's: for an agent that can run, but strolls.
///
/// ```
/// use throng_steer::{Limited, Wander};
/// let stroll = Limited { max_speed: 0.7, max_force: 1.0, of: Wander::default().into() };
/// ```
#[derive(Clone, Debug)]
pub struct Limited {
    /// The top speed for the part, m/s; that of the vehicle if it is less. Limit: > 0.
    pub max_speed: f32,
    /// The top force of the part, newtons; that of the vehicle if it is less. Limit: > 0.
    pub max_force: f32,
    /// The part.
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

    fn check(&self) -> Result<(), Error> {
        Error::unless(self.max_speed > 0.0, "top speed", self.max_speed, "greater than 0")?;
        Error::unless(self.max_force > 0.0, "top force", self.max_force, "greater than 0")?;
        self.of.check()
    }
}
