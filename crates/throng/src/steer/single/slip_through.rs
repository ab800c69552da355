//! Past defenders to a goal: the seeker of OpenSteer's capture the flag.

use super::evade_all::{EvadeAll, expected};
use crate::Error;
use crate::motion::{Steering, angle_between, turned_towards};
use crate::steer::{Behaviour, Reason, Target, View, Who, Why};
use std::f32::consts::PI;

/// Goes to a target at the top speed while the corridor there is clear, and out of the way of all who close it while it is
/// not. It turns by degrees, and never back. Nothing to correct if the target is not there.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::{Behaviour, SlipThrough, Neighbour, Target, View, Why};
/// let defender = Neighbour {
///     offset: Vec3::new(5.0, 0.5, 0.0), velocity: Vec3::ZERO, forward: -Vec3::X, radius: 0.2, number: 1, group: 1,
/// };
/// let slip = SlipThrough::from(Target::Point(Vec3::X * 20.0));
/// let alone = View::default();
/// let met = View { neighbours: &[defender], ..alone };
/// assert!(slip.is_clear(&alone) && !slip.is_clear(&met));
/// let steering = slip.steer(&met, &mut [], &mut Why::default()).expect("it is on its way");
/// assert!(steering.force.y < 0.0, "past it on the other side");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlipThrough {
    /// Where to.
    pub target: Target,
    /// How it keeps away from those who close the corridor, and who they are.
    pub evade: EvadeAll,
    /// How far ahead it looks for who will be in the corridor: a part of the time in which it would be there itself.
    /// Limit: >= 0.
    pub ahead: f32,
    /// How far the corridor reaches to either side, radii of its body. Limit: > 0.
    pub width: f32,
    /// The most that its way leads aside from ahead, radians. Limit: > 0 to pi.
    pub turn: f32,
}

impl From<Target> for SlipThrough {
    /// OpenSteer's numbers: past everybody of other groups.
    fn from(target: Target) -> Self {
        Self { target, evade: EvadeAll::default(), ahead: 0.3, width: 8.0, turn: PI / 4.0 }
    }
}

/// Cosine of the angle from which on the target is to the side.
const ASIDE: f32 = std::f32::consts::FRAC_1_SQRT_2;

impl SlipThrough {
    /// Past those of a group, or of several.
    pub fn past(self, who: Who) -> Self {
        Self { evade: EvadeAll { who, ..self.evade }, ..self }
    }

    /// Whether nobody is, or soon will be, between the agent and its target; who is safely behind does not count.
    pub fn is_clear(&self, view: &View<'_>) -> bool {
        let Some(offset) = self.target.find(view).map(|mark| view.to(mark.position)) else { return true };
        let (radius, length) = (view.radius, offset.length());
        let Some(way) = offset.try_normalize() else { return true };
        let target_aside = view.forward().dot(way).abs() < ASIDE;
        let closes = |then: glam::Vec3| {
            let (along, front) = (then.dot(way), then.dot(view.forward()));
            let across = then.reject_from_normalized(way).length();
            let behind = front < -4.0 * radius || target_aside && front < -2.0 * radius;
            !behind && across < self.width * radius && (-2.0 * radius..=length).contains(&along)
        };
        let mut others = view.neighbours.iter().filter(|other| self.evade.who.counts(view, other));
        !others.any(|other| closes(expected(view, other, self.ahead)))
    }
}

impl Behaviour for SlipThrough {
    fn steer(&self, view: &View<'_>, _: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let target = self.target.find(view)?.position;
        why.note(|| Reason::Aim(target));
        let seek = view.to(target).normalize_or_zero();
        let away = if self.is_clear(view) { glam::Vec3::ZERO } else { self.evade.away(view, why) };
        let wish = (seek + away).try_normalize()?;
        let forward = view.forward();
        let angle = angle_between(forward, wish).min(self.turn);
        view.go(turned_towards(forward, wish, angle, view.motion.basis.up))
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless(self.ahead >= 0.0 && self.ahead.is_finite(), "ahead", self.ahead, "0 or more and finite")?;
        Error::unless_positive("width", self.width)?;
        Error::unless(self.turn > 0.0 && self.turn <= PI, "turn", self.turn, "greater than 0, at most pi")?;
        self.evade.check()
    }
}
