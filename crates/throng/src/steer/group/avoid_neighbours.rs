//! Unaligned collision avoidance as OpenSteer has it: steerToAvoidNeighbors.

use super::CloseAvoidance;
use crate::Error;
use crate::motion::Steering;
use crate::steer::approach::nearest_time;
use crate::steer::{Behaviour, Neighbour, Reason, View, Who, Why};
use std::f32::consts::FRAC_1_SQRT_2;

/// Turns aside from the first who will come too near, with all of the force; it never changes its speed.
/// [`UnalignedAvoidance`](super::UnalignedAvoidance) does.
///
/// Those too close already come first ([`CloseAvoidance`]). Who comes, or goes the same way, is passed on the side on which
/// it is not; of two whose ways cross the faster passes behind the other.
///
/// ```
/// use throng::steer::{AvoidNeighbours, Who};
/// let walker = AvoidNeighbours { who: Who::Anybody, horizon: 3.0 };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AvoidNeighbours {
    /// Whom.
    pub who: Who,
    /// How many seconds ahead. Limit: > 0.
    pub horizon: f32,
}

impl Default for AvoidNeighbours {
    fn default() -> Self {
        Self { who: Who::Anybody, horizon: 3.0 }
    }
}

impl Behaviour for AvoidNeighbours {
    fn steer(&self, view: &View<'_>, memory: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let close = CloseAvoidance { who: self.who, gap: 0.0 };
        close.steer(view, memory, why).or_else(|| self.turn(view, why))
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless_positive("time horizon", self.horizon)
    }
}

impl AvoidNeighbours {
    fn turn(&self, view: &View<'_>, why: &mut Why<'_>) -> Option<Steering> {
        let (time, threat) = first_threat(view, self.who, self.horizon, 0.0)?;
        note_threat(view, time, threat, why);
        let side = view.motion.basis.side;
        let parallel = view.forward().dot(threat.forward);
        let on = if parallel < -FRAC_1_SQRT_2 {
            (threat.offset + threat.velocity * time).dot(side)
        } else if parallel > FRAC_1_SQRT_2 {
            threat.offset.dot(side)
        } else if threat.velocity.length() <= view.motion.speed() {
            threat.velocity.dot(side)
        } else {
            return None;
        };
        // on neither side: to the right
        view.veer(if on >= 0.0 { -side } else { side })
    }
}

/// Who comes nearer than touching and a gap first, within so many seconds, if both keep their velocities; and when they are
/// nearest. Of equal times the nearest now.
pub(super) fn first_threat<'a>(view: &View<'a>, who: Who, horizon: f32, gap: f32) -> Option<(f32, &'a Neighbour)> {
    let mut first = None;
    let mut least = horizon;
    for other in view.neighbours.iter().filter(|other| who.counts(view, other)) {
        let velocity = other.velocity - view.velocity();
        let time = nearest_time(other.offset, velocity);
        let near = (other.offset + velocity * time).length() < view.radius + other.radius + gap;
        if near && time > 0.0 && time < least {
            (least, first) = (time, Some((time, other)));
        }
    }
    first
}

/// Tells where the two will be.
pub(super) fn note_threat(view: &View<'_>, seconds: f32, other: &Neighbour, why: &mut Why<'_>) {
    why.note(|| Reason::Threat {
        number: other.number,
        seconds,
        own: view.motion.position_in(seconds),
        theirs: view.position() + other.offset + other.velocity * seconds,
    });
}
