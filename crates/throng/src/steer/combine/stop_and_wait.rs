//! Stop and wait: the cure for collisions that turning aside does not prevent.

use crate::Error;
use crate::motion::Steering;
use crate::steer::approach::time_to_touch;
use crate::steer::{Behaviour, Branch, Neighbour, Reason, View, Who, Why};
use glam::Vec3;

/// Stops where a part would run into somebody, waits for a moment of random length, and goes on when its way is clear.
///
/// ```
/// use throng::steer::{Seek, StopAndWait, Target};
/// let patient = StopAndWait::new(Seek { target: Target::Goal });
/// ```
#[derive(Clone, Debug)]
pub struct StopAndWait {
    /// Whom it stops for.
    pub who: Who,
    /// It stops this many seconds before it would touch somebody, both keeping their velocities. Limit: > 0.
    pub within: f32,
    /// The least and the most it waits, seconds. Limit: 0 < least <= most.
    pub wait: (f32, f32),
    /// For how many seconds its way must be clear before it goes on. Limit: >= 0.
    pub clear: f32,
    /// What it would do.
    pub of: Branch,
}

impl StopAndWait {
    /// Stops for anybody 0.3 s before contact, for 0.2 to 1 s, until the way is clear for 0.5 s.
    pub fn new(of: impl Into<Branch>) -> Self {
        Self { who: Who::Anybody, within: 0.3, wait: (0.2, 1.0), clear: 0.5, of: of.into() }
    }
}

impl Behaviour for StopAndWait {
    /// How many more seconds it waits; 0: it goes.
    fn memory(&self) -> usize {
        1 + self.of.words()
    }

    fn steer(&self, view: &View<'_>, memory: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let [left, memory @ ..] = memory else { return None };
        let mut memory = memory;
        let said = self.of.steer_as(0, view, &mut memory, why);
        if *left > view.seconds {
            *left -= view.seconds;
        } else {
            let waits = *left > 0.0;
            let (velocity, seconds) =
                if waits { (view.wish(said), self.clear) } else { (view.velocity(), self.within) };
            let Some(other) = self.in_the_way(view, velocity, seconds) else {
                *left = 0.0;
                return said;
            };
            why.note(|| Reason::Regards(other.number));
            let (least, most) = self.wait;
            *left = least + (most - least) * view.dice.draw(0);
        }
        // as hard as its vehicle can
        let stop = view.velocity() * -(view.vehicle.mass / view.seconds);
        Some(Steering { force: stop, facing: said.and_then(|said| said.facing) })
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless_positive("time before contact", self.within)?;
        let (least, most) = self.wait;
        Error::unless_positive("least wait", least)?;
        Error::unless(most >= least && most.is_finite(), "longest wait", most, "the least or more, and finite")?;
        Error::unless(self.clear >= 0.0, "time that the way is clear", self.clear, "0 or more")?;
        self.of.check()
    }
}

impl StopAndWait {
    /// The nearest that it would touch within so many seconds at this velocity.
    fn in_the_way<'a>(&self, view: &View<'a>, velocity: Vec3, seconds: f32) -> Option<&'a Neighbour> {
        let touches = |other: &Neighbour| {
            time_to_touch(other.offset, other.velocity - velocity, view.radius + other.radius) < seconds
                && other.offset.dot(other.velocity - velocity) < 0.0
        };
        view.neighbours.iter().find(|other| self.who.counts(view, other) && touches(other))
    }
}
