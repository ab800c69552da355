//! Evasion of many: steerToEvadeAllDefenders of OpenSteer's capture the flag.

use crate::Error;
use crate::motion::Steering;
use crate::steer::{Behaviour, Neighbour, Reason, View, Who, Why};
use glam::Vec3;

/// Goes away from where all of them will be, the more the nearer they are, and less from who is left behind. Nothing to
/// correct while it sees none.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::{Behaviour, EvadeAll, Neighbour, View, Why};
/// let other = |y: f32| Neighbour {
///     offset: Vec3::new(3.0, y, 0.0), velocity: Vec3::ZERO, forward: Vec3::X, radius: 0.2, number: 1, group: 1,
/// };
/// let view = View { neighbours: &[other(1.0), other(2.0)], ..View::default() };
/// let steering = EvadeAll::default().steer(&view, &mut [], &mut Why::default()).expect("there are two");
/// assert!(steering.force.x < 0.0 && steering.force.y < 0.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EvadeAll {
    /// Who they are.
    pub who: Who,
    /// How far ahead it looks: a part of the time in which it would be there itself. Limit: >= 0.
    pub ahead: f32,
    /// How near another is, metres, from whom it goes away with all of the force. Limit: > 0.
    pub near: f32,
    /// How much those count whom it has left behind, 0 to 1.
    pub behind: f32,
}

impl Default for EvadeAll {
    /// OpenSteer's numbers.
    fn default() -> Self {
        Self { who: Who::OtherGroups, ahead: 0.5, near: 4.0, behind: 0.5 }
    }
}

/// Part of the top speed at least by which it tells when it would be somewhere.
const SLOW: f32 = 0.2;

/// Where another will be, from the agent, after a part of the time in which the agent would be where the other is now.
pub(super) fn expected(view: &View<'_>, other: &Neighbour, part: f32) -> Vec3 {
    let speed = view.motion.speed().max(SLOW * view.vehicle.max_speed);
    view.passable(other.offset + other.velocity * (part * other.offset.length() / speed))
}

impl EvadeAll {
    /// Away from all of them; as long as that matters, 1 is one who is [`near`](Self::near).
    pub(super) fn away(&self, view: &View<'_>, why: &mut Why<'_>) -> Vec3 {
        let mut sum = Vec3::ZERO;
        for other in view.neighbours.iter().filter(|other| self.who.counts(view, other)) {
            let then = expected(view, other, self.ahead);
            why.note(|| Reason::Expects(view.position() + then));
            let left_behind = view.forward().dot(other.offset) < -2.0 * view.radius;
            let weight =
                self.near / other.offset.length().max(view.radius) * if left_behind { self.behind } else { 1.0 };
            sum -= then.normalize_or(view.forward()) * weight;
        }
        sum
    }
}

impl Behaviour for EvadeAll {
    fn steer(&self, view: &View<'_>, _: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        view.urge(self.away(view, why), 1.0)
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless(self.ahead >= 0.0 && self.ahead.is_finite(), "ahead", self.ahead, "0 or more and finite")?;
        Error::unless_positive("near", self.near)?;
        Error::unless((0.0..=1.0).contains(&self.behind), "behind", self.behind, "from 0 to 1")
    }
}
