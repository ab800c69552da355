//! Unaligned collision avoidance: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use super::avoid_neighbours::{first_threat, note_threat};
use crate::Error;
use crate::motion::Steering;
use crate::steer::{Behaviour, Neighbour, View, Who, Why};

/// Keeps clear of the first who will come too near: turns aside, and is there earlier or later, by speeding up or braking.
///
/// It changes its velocity so that both are apart by a gap when they would be nearest; who touches somebody parts first. Who
/// would meet exactly go to the right.
///
/// ```
/// use throng::steer::{UnalignedAvoidance, Who};
/// let walker = UnalignedAvoidance { who: Who::Anybody, horizon: 4.0, gap: 0.2 };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UnalignedAvoidance {
    /// Of whom.
    pub who: Who,
    /// How many seconds ahead. Limit: > 0.
    pub horizon: f32,
    /// How far bodies should be apart when they pass, metres. Limit: >= 0.
    pub gap: f32,
}

impl Default for UnalignedAvoidance {
    fn default() -> Self {
        Self { who: Who::Anybody, horizon: 3.0, gap: 0.1 }
    }
}

/// Part of the radii below which two meet exactly: then there is no side on which to pass.
const EXACT: f32 = 0.01;

impl Behaviour for UnalignedAvoidance {
    fn steer(&self, view: &View<'_>, _: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let touches =
            |other: &&Neighbour| self.who.counts(view, other) && other.offset.length() < view.radius + other.radius;
        let touching = view.neighbours.iter().find(touches).map(|other| (0.0, other));
        let (time, threat) = touching.or_else(|| first_threat(view, self.who, self.horizon, self.gap))?;
        note_threat(view, time, threat, why);
        let apart = view.radius + threat.radius + self.gap;
        let miss = -view.passable(threat.offset + (threat.velocity - view.velocity()) * time);
        let away = if miss.length() > EXACT * apart { miss.normalize() } else { -view.motion.basis.side };
        let time = time.max(view.vehicle.response).max(view.seconds);
        let wish = view.velocity() + away * ((apart - miss.length()).max(0.0) / time);
        Some(view.reach(wish.clamp_length_max(view.vehicle.max_speed)))
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless_positive("time horizon", self.horizon)?;
        Error::unless(self.gap >= 0.0, "gap", self.gap, "0 or more")
    }
}
