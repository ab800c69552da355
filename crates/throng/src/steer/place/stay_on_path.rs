//! Staying on a path, whichever way one goes: OpenSteer's steerToStayOnPath.

use crate::Error;
use crate::motion::Steering;
use crate::space::Pathway;
use crate::steer::{Behaviour, Reason, View, Why};
use std::sync::Arc;

/// Comes back to a path that it is about to leave, or has left. Nothing to correct while it will be on the path, in any
/// direction, be it round a corner.
///
/// ```
/// use glam::Vec3;
/// use std::sync::Arc;
/// use throng::space::Pathway;
/// use throng::steer::{Behaviour, StayOnPath, View, Why};
///
/// let path = Pathway::new(&[Vec3::Y * 5.0, Vec3::new(9.0, 5.0, 0.0)], 1.0, false)?;
/// let steering = StayOnPath { path: Arc::new(path), seconds: 1.0 }.steer(&View::default(), &mut [], &mut Why::default());
/// assert!(steering.expect("it is off the path").force.y > 0.0);
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct StayOnPath {
    /// Which path, metres in the coordinates of the [`View`].
    pub path: Arc<Pathway>,
    /// How far ahead it looks, seconds. Limit: >= 0.
    pub seconds: f32,
}

impl Behaviour for StayOnPath {
    fn steer(&self, view: &View<'_>, _: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let future = view.motion.position_in(self.seconds);
        let on_path = self.path.nearest(future);
        if on_path.outside <= 0.0 {
            return None;
        }
        why.note(|| Reason::Expects(future));
        view.seek(on_path.point, why)
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless(self.seconds >= 0.0 && self.seconds.is_finite(), "horizon", self.seconds, "0 or more and finite")
    }
}
