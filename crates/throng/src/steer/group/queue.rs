//! Queueing: Reynolds, Steering behaviors for autonomous characters, GDC 1999 (the doorway of its demos).

use crate::Error;
use crate::motion::Steering;
use crate::steer::{Behaviour, Neighbour, Reason, View, Who, Why};

/// Brakes behind those ahead who are slower and go the same way, or stand: nobody pushes. Nothing to correct while there is
/// room.
///
/// ```
/// use throng::steer::{Queue, Who};
/// let patient = Queue { who: Who::Anybody, distance: 2.0, width: 0.1, gap: 0.2, headway: 0.5 };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Queue {
    /// Behind whom.
    pub who: Who,
    /// How far ahead it looks, metres between centres. Limit: > 0.
    pub distance: f32,
    /// How much wider than the two bodies its lane is, metres. Limit: >= 0.
    pub width: f32,
    /// How far bodies should be apart at rest, metres. Limit: >= 0.
    pub gap: f32,
    /// Seconds in which it would close a greater gap. Limit: > 0.
    pub headway: f32,
}

impl Default for Queue {
    fn default() -> Self {
        Self { who: Who::Anybody, distance: 2.0, width: 0.0, gap: 0.1, headway: 0.5 }
    }
}

impl Behaviour for Queue {
    fn steer(&self, view: &View<'_>, _: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let speed = view.velocity().dot(view.forward());
        let mut slowest = (speed, None);
        for other in view.neighbours.iter().filter(|other| self.who.counts(view, other)) {
            let allowed = self.allowed(view, other);
            if allowed < slowest.0 {
                slowest = (allowed, Some(other));
            }
        }
        let (allowed, other) = (slowest.0, slowest.1?);
        why.note(|| Reason::Regards(other.number));
        Some(view.reach(view.velocity() + view.forward() * (allowed - speed)))
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless(self.distance > 0.0, "distance", self.distance, "greater than 0")?;
        Error::unless(self.width >= 0.0, "width of the lane", self.width, "0 or more")?;
        Error::unless(self.gap >= 0.0, "gap", self.gap, "0 or more")?;
        Error::unless_positive("headway", self.headway)
    }
}

impl Queue {
    /// How fast another lets it go ahead.
    fn allowed(&self, view: &View<'_>, other: &Neighbour) -> f32 {
        let radii = view.radius + other.radius;
        let ahead = other.offset.dot(view.forward());
        let beside = view.motion.basis.lateral(other.offset).length();
        let theirs = other.velocity.dot(view.forward());
        if ahead <= 0.0 || ahead > self.distance || beside > radii + self.width || theirs < 0.0 {
            return f32::INFINITY;
        }
        theirs + (ahead - radii - self.gap).max(0.0) / self.headway
    }
}
