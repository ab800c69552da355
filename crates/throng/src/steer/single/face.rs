//! Facing: a direction of the body that does not depend on where it goes (gdx-ai's Face and LookWhereYouAreGoing).

use crate::motion::Steering;
use crate::steer::{Behaviour, Reason, Target, View, Why};
use glam::Vec3;

/// Turns to a target, and leaves it to others where to go: as a part of a sum, for who walks sideways.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::{Behaviour, Face, Target, View, Why};
/// let face = Face { target: Target::Point(Vec3::Y * 3.0) };
/// let steering = face.steer(&View::default(), &mut [], &mut Why::default()).expect("it is elsewhere");
/// assert_eq!((steering.force, steering.facing), (Vec3::ZERO, Some(Vec3::Y * 3.0)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Face {
    /// Whom or what.
    pub target: Target,
}

impl Behaviour for Face {
    fn steer(&self, view: &View<'_>, _: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let place = self.target.find(view)?.position;
        why.note(|| Reason::Aim(place));
        facing(view.to(place))
    }
}

/// Turns to where it goes, as vehicles do that are not told what to face: for the first place in a sum, before other
/// facings.
///
/// ```
/// use throng::steer::{Behaviour, LookWhereYouGo, View, Why};
/// assert_eq!(LookWhereYouGo.steer(&View::default(), &mut [], &mut Why::default()), None, "it stands");
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LookWhereYouGo;

impl Behaviour for LookWhereYouGo {
    fn steer(&self, view: &View<'_>, _: &mut [f32], _: &mut Why<'_>) -> Option<Steering> {
        facing(view.velocity())
    }
}

/// Faces as somebody else does, wherever that is: gdx-ai's ReachOrientation.
///
/// ```
/// use throng::steer::{Behaviour, MatchOrientation, Target, View, Why};
/// let drill = MatchOrientation { with: Target::Agent(0) };
/// assert_eq!(drill.steer(&View::default(), &mut [], &mut Why::default()), None, "nobody is there");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MatchOrientation {
    /// As whom.
    pub with: Target,
}

impl Behaviour for MatchOrientation {
    fn steer(&self, view: &View<'_>, _: &mut [f32], _: &mut Why<'_>) -> Option<Steering> {
        facing(view.passable(self.with.find(view)?.basis.forward))
    }
}

fn facing(direction: Vec3) -> Option<Steering> {
    (direction != Vec3::ZERO).then_some(Steering { force: Vec3::ZERO, facing: Some(direction) })
}
