//! Station keeping: a place in the frame of a leader, as for wingmen.

use super::{SLOWING_DISTANCE, approach};
use glam::Vec3;
use throng::Error;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::steer::{Behaviour, Kinematics, SteeringInput, SteeringReason, Target, TraceRecorder};

/// Keeps a place beside a leader, as wingmen do.
///
/// Offset pursuit in the leader's frame (yuka), with the leader's velocity once there.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::Target;
/// use throng_steer::KeepStation;
/// let wingman = KeepStation { leader: Target::Agent(1), offset: Vec3::new(-4.0, 3.0, 0.0), slowing_distance: 3.0 };
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KeepStation {
    /// The leader.
    #[parameter(required)]
    pub leader: Target,
    /// The place: ahead of the leader, to its left, and above it, metres.
    #[parameter(required, unit = "m")]
    pub offset: Vec3,
    /// Distance at which it starts to slow down, metres.
    #[parameter(default = SLOWING_DISTANCE, unit = "m", least = 0)]
    pub slowing_distance: f32,
}

impl Behaviour for KeepStation {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let leader = self.leader.find(view)?;
        Some(keep(view, &leader, self.offset, self.slowing_distance, why))
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}

/// Steers to a place in the frame of a leader.
pub(crate) fn keep(
    view: &SteeringInput<'_>,
    leader: &Kinematics,
    offset: Vec3,
    slowing: f32,
    why: &mut TraceRecorder<'_>,
) -> Steering {
    let place = leader.position + leader.basis.to_world(offset);
    why.note(|| SteeringReason::Aim(place));
    why.note(|| SteeringReason::Circle { center: place, radius: view.radius });
    view.reach(approach(view, view.to(place), leader.velocity, slowing))
}
