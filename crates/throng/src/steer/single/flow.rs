//! Flow field following: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use crate::Error;
use crate::field::Field;
use crate::motion::Steering;
use crate::steer::{Behaviour, Reason, View, Why};
use glam::Vec3;
use std::fmt;
use std::sync::Arc;

/// Goes with a flow: takes on the velocity of a field where it will be. Nothing to correct where the field says nothing.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::{Behaviour, FollowFlow, View, Why};
/// // round the origin, all at 1 m/s
/// let whirl = FollowFlow::new(|place: Vec3, _: f64| Vec3::Z.cross(place).normalize_or_zero(), 0.5);
/// assert_eq!(whirl.steer(&View::default(), &mut [], &mut Why::default()), None, "in its middle");
/// ```
#[derive(Clone)]
pub struct FollowFlow {
    /// The field.
    pub field: Arc<dyn Field>,
    /// How many seconds ahead. Limit: >= 0.
    pub prediction: f32,
}

impl FollowFlow {
    /// Follows a field, so many seconds ahead.
    pub fn new(field: impl Field + 'static, prediction: f32) -> Self {
        Self { field: Arc::new(field), prediction }
    }
}

impl fmt::Debug for FollowFlow {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("FollowFlow").field("prediction", &self.prediction).finish_non_exhaustive()
    }
}

impl Behaviour for FollowFlow {
    fn steer(&self, view: &View<'_>, _: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let place = view.motion.position_in(self.prediction);
        let flow = view.passable(self.field.velocity(place, view.time));
        why.note(|| Reason::Expects(place));
        why.note(|| Reason::Wishes(flow));
        (flow != Vec3::ZERO).then(|| view.reach(flow.clamp_length_max(view.vehicle.max_speed)))
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless(self.prediction >= 0.0, "prediction", self.prediction, "0 or more")
    }
}
