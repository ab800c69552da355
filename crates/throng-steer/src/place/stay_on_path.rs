//! Staying on a path without a direction along it: OpenSteer's steerToStayOnPath.

use std::sync::Arc;
use throng::Error;
use throng::motion::Steering;
use throng::space::Pathway;
use throng::steer::{Behaviour, SteeringInput, SteeringReason, TraceRecorder};

/// Comes back to a path that the agent is about to leave, or has left. Nothing to correct while the predicted position
/// is on the path, in any direction, even round a corner.
///
/// ```
/// use glam::Vec3;
/// use std::sync::Arc;
/// use throng::space::Pathway;
/// use throng::steer::{Behaviour, SteeringInput, TraceRecorder};
/// use throng_steer::StayOnPath;
///
/// let path = Pathway::new(&[Vec3::Y * 5.0, Vec3::new(9.0, 5.0, 0.0)], 1.0, false)?;
/// let steering = StayOnPath { path: Arc::new(path), seconds: 1.0 }.steer(&SteeringInput::default(), &mut [], &mut TraceRecorder::default());
/// assert!(steering.expect("it is off the path").force.y > 0.0);
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct StayOnPath {
    /// The path, metres in the coordinates of the [`SteeringInput`].
    pub path: Arc<Pathway>,
    /// How far ahead the position is predicted, seconds. Limit: >= 0.
    pub seconds: f32,
}

impl Behaviour for StayOnPath {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let future = view.motion.position_in(self.seconds);
        let on_path = self.path.nearest(future);
        if on_path.outside <= 0.0 {
            return None;
        }
        why.note(|| SteeringReason::Expects(future));
        view.seek(on_path.point, why)
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless(self.seconds >= 0.0 && self.seconds.is_finite(), "horizon", self.seconds, "0 or more and finite")
    }
}
