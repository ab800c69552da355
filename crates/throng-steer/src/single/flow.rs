//! Flow field following: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use crate::swarm::tell_spine;
use glam::Vec3;
use std::fmt;
use std::sync::Arc;
use throng::Error;
use throng::field::Field;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::steer::{Behaviour, SteeringInput, SteeringReason, TraceRecorder};

/// Moves with a flow (Reynolds 1999).
///
/// It matches the velocity of the flow at the predicted position. Nothing to correct where the flow is 0.
///
/// ```
/// use glam::Vec3;
/// use std::sync::Arc;
/// use throng::steer::{Behaviour, SteeringInput, TraceRecorder};
/// use throng_steer::FollowFlow;
/// // round the origin, all at 1 m/s
/// let whirl = |place: Vec3, _: f64| Vec3::Z.cross(place).normalize_or_zero();
/// let whirl = FollowFlow { flow: Arc::new(whirl), prediction: 0.5 };
/// assert_eq!(whirl.steer(&SteeringInput::default(), &mut [], &mut TraceRecorder::default()), None, "in its middle");
/// ```
#[parameters]
#[derive(Clone)]
pub struct FollowFlow {
    /// The flow.
    #[parameter(required)]
    pub flow: Arc<dyn Field>,
    /// How far ahead its position is predicted, seconds.
    #[parameter(default = 0.0, unit = "s", least = 0)]
    pub prediction: f32,
}

impl fmt::Debug for FollowFlow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("FollowFlow").field("prediction", &self.prediction).finish_non_exhaustive()
    }
}

impl Behaviour for FollowFlow {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let place = view.motion.position_in(self.prediction);
        let flow = view.passable(self.flow.velocity(place, view.time));
        why.note(|| SteeringReason::Expects { now: view.position(), then: place });
        why.note(|| SteeringReason::Samples { place, velocity: flow });
        tell_spine(&*self.flow, why);
        (flow != Vec3::ZERO).then(|| view.reach(flow.clamp_length_max(view.vehicle.max_speed)))
    }

    fn fields(&self, see: &mut dyn FnMut(&Arc<dyn Field>)) {
        see(&self.flow);
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}
