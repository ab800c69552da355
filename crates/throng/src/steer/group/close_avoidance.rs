//! Avoiding those who are close already: OpenSteer's steerToAvoidCloseNeighbors.

use super::separation::aside;
use crate::Error;
use crate::motion::Steering;
use crate::steer::{Behaviour, Reason, View, Who, Why};

/// Turns aside, with all of the force, from the nearest who is too close.
///
/// ```
/// use throng::steer::{CloseAvoidance, Who};
/// let careful = CloseAvoidance { who: Who::Anybody, gap: 0.1 };
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CloseAvoidance {
    /// From whom.
    pub who: Who,
    /// How far bodies should be apart, metres. Limit: >= 0.
    pub gap: f32,
}

impl Behaviour for CloseAvoidance {
    fn steer(&self, view: &View<'_>, _: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let mut all = view.neighbours.iter().filter(|other| self.who.counts(view, other));
        let close = all.find(|other| other.offset.length() < self.gap + view.radius + other.radius)?;
        why.note(|| Reason::Regards(close.number));
        let away = view.passable(-view.motion.basis.lateral(close.offset));
        // right ahead or behind there is no side
        let away = if away.length() > 1e-3 * view.radius { away } else { aside(view, close) };
        view.veer(away)
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless(self.gap >= 0.0, "gap", self.gap, "0 or more")
    }
}
