//! Facing: a direction of the body that does not depend on the direction of motion (gdx-ai's Face and
//! LookWhereYouAreGoing).

use glam::Vec3;
use throng::motion::Steering;
use throng::parameters::parameters;
use throng::steer::{Behaviour, SteeringInput, SteeringReason, Target, TraceRecorder};

/// Turns to a target; does not move.
///
/// As a part of a sum, for agents that walk sideways.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::{Behaviour, SteeringInput, Target, TraceRecorder};
/// use throng_steer::Face;
/// let face = Face { target: Target::Point(Vec3::Y * 3.0) };
/// let steering = face.steer(&SteeringInput::default(), &mut [], &mut TraceRecorder::default()).expect("it is elsewhere");
/// assert_eq!((steering.force, steering.facing), (Vec3::ZERO, Some(Vec3::Y * 3.0)));
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Face {
    /// The target.
    #[parameter(required)]
    pub target: Target,
}

impl Behaviour for Face {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let place = self.target.find(view)?.position;
        why.note(|| SteeringReason::Aim(place));
        facing(view.to(place))
    }
}

/// Turns to its direction of motion.
///
/// Vehicles do so without a facing: for the first place in a sum, before other facings.
///
/// ```
/// use throng::steer::{Behaviour, SteeringInput, TraceRecorder};
/// use throng_steer::LookWhereYouGo;
/// assert_eq!(LookWhereYouGo.steer(&SteeringInput::default(), &mut [], &mut TraceRecorder::default()), None, "it stands");
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LookWhereYouGo;

impl Behaviour for LookWhereYouGo {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], _: &mut TraceRecorder<'_>) -> Option<Steering> {
        facing(view.velocity())
    }
}

/// Turns to the orientation of another agent.
///
/// It faces in the same direction, wherever that agent is: gdx-ai's ReachOrientation.
///
/// ```
/// use throng::steer::{Behaviour, SteeringInput, Target, TraceRecorder};
/// use throng_steer::MatchOrientation;
/// let drill = MatchOrientation { with: Target::Agent(0) };
/// assert_eq!(drill.steer(&SteeringInput::default(), &mut [], &mut TraceRecorder::default()), None, "there is no such agent");
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MatchOrientation {
    /// The agent.
    #[parameter(required)]
    pub with: Target,
}

impl Behaviour for MatchOrientation {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], _: &mut TraceRecorder<'_>) -> Option<Steering> {
        facing(view.passable(self.with.find(view)?.basis.forward))
    }
}

fn facing(direction: Vec3) -> Option<Steering> {
    (direction != Vec3::ZERO).then_some(Steering { force: Vec3::ZERO, facing: Some(direction) })
}
