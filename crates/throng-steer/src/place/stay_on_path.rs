//! Staying on a path without a direction along it: OpenSteer's steerToStayOnPath.

use std::sync::Arc;
use throng::Error;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::space::Pathway;
use throng::steer::{Behaviour, SteeringInput, SteeringReason, TraceRecorder};

/// Returns to a path that it is about to leave, as in OpenSteer.
///
/// Whichever way it moves: nothing to correct while the predicted position is on the path, in any direction, even round a
/// corner.
///
/// ```
/// use glam::Vec3;
/// use throng::space::Pathway;
/// use throng::steer::{Behaviour, SteeringInput, TraceRecorder};
/// use throng_steer::StayOnPath;
///
/// let path = Pathway::new(&[Vec3::Y * 5.0, Vec3::new(9.0, 5.0, 0.0)], 1.0, false)?;
/// let steering = StayOnPath::new(path).steer(&SteeringInput::default(), &mut [], &mut TraceRecorder::default());
/// assert!(steering.expect("it is off the path").force.y > 0.0);
/// # Ok::<(), throng::Error>(())
/// ```
#[parameters]
#[derive(Clone, Debug)]
pub struct StayOnPath {
    /// The name of the path.
    ///
    /// In code, the path: metres in the coordinates of the [`SteeringInput`].
    #[parameter(required)]
    pub path: Arc<Pathway>,
    /// How far ahead it looks, seconds.
    #[parameter(default = 1.0, unit = "s", least = 0)]
    pub horizon: f32,
}

impl Behaviour for StayOnPath {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let future = view.motion.position_in(self.horizon);
        let on_path = self.path.nearest(future);
        if on_path.outside <= 0.0 {
            return None;
        }
        why.note(|| SteeringReason::Expects { now: view.position(), then: future });
        why.note(|| SteeringReason::Projects { from: future, to: on_path.point });
        view.seek(on_path.point, why)
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}
