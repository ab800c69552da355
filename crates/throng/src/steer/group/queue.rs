//! Queueing: Reynolds, Steering behaviors for autonomous characters, GDC 1999 (the doorway of its demos).

use crate::Error;
use crate::motion::Steering;
use crate::steer::single::settling_time;
use crate::steer::{Behaviour, Branch, Neighbour, Reason, View, Who, Why};

/// Lets a part go no faster than those right ahead who go the same way, or stand, allow: nobody pushes.
///
/// They allow half of their speed, and more in proportion to the room between. With the whole of their speed it would come
/// nearer than the gap when they brake, since it follows with delay; with half of it never, however suddenly they stop, and
/// it goes behind them by half the headway in time.
///
/// ```
/// use throng::steer::{Queue, Seek, Target};
/// let patient = Queue { gap: 0.3, ..Queue::new(Seek { target: Target::Goal }) };
/// ```
#[derive(Clone, Debug)]
pub struct Queue {
    /// Behind whom.
    pub who: Who,
    /// How far ahead it looks, metres between centres. Limit: > 0.
    pub distance: f32,
    /// How much wider than the two bodies its lane is, metres. Limit: >= 0.
    pub width: f32,
    /// How far bodies should be apart at rest, metres. Limit: >= 0.
    pub gap: f32,
    /// Seconds in which it closes all but a third of a greater gap, and twice those by which it goes behind others; more, if
    /// the vehicle follows too slowly. Limit: > 0.
    pub headway: f32,
    /// What it would do.
    pub of: Branch,
}

impl Queue {
    /// Behind anybody within 2 m, with a gap of 0.1 m.
    pub fn new(of: impl Into<Branch>) -> Self {
        Self { who: Who::Anybody, distance: 2.0, width: 0.0, gap: 0.1, headway: 0.5, of: of.into() }
    }
}

impl Behaviour for Queue {
    fn memory(&self) -> usize {
        self.of.words()
    }

    fn steer(&self, view: &View<'_>, mut memory: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let said = self.of.steer_as(0, view, &mut memory, why);
        let wish = view.wish(said);
        let speed = wish.dot(view.forward());
        let counting = view.neighbours.iter().filter(|other| self.who.counts(view, other));
        let limits = counting.map(|other| (self.allowed(view, other), other));
        let Some((allowed, other)) = limits.min_by(|a, b| a.0.total_cmp(&b.0)).filter(|limit| limit.0 < speed) else {
            return said;
        };
        why.note(|| Reason::Regards(other.number));
        let facing = said.and_then(|said| said.facing);
        Some(Steering { facing, ..view.reach(wish + view.forward() * (allowed - speed)) })
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless(self.distance > 0.0, "distance", self.distance, "greater than 0")?;
        Error::unless(self.width >= 0.0, "width of the lane", self.width, "0 or more")?;
        Error::unless(self.gap >= 0.0, "gap", self.gap, "0 or more")?;
        Error::unless_positive("headway", self.headway)?;
        self.of.check()
    }
}

/// Part of their speed that others allow. Gap and velocity are a linear system, whose gap is positive for all that others
/// may do up to a half: then its zero is no farther out than its slower pole.
const THEIRS: f32 = 0.5;

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
        THEIRS * theirs + (ahead - radii - self.gap).max(0.0) / settling_time(view, self.headway)
    }
}
