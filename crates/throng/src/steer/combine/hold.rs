//! Holding an avoidance: the cure for going round and round along an obstacle.
//!
//! Who has just avoided something turns back at once, since it no longer sees it, and must avoid it again. If the
//! avoidance lasts for a while, it gets past.

use crate::Error;
use crate::motion::Steering;
use crate::steer::{Behaviour, Branch, Reason, View, Why};
use glam::Vec3;

/// Keeps the force of a part for a while after the part has nothing more to correct, fading. A weaker force does not end
/// what it keeps, a stronger one renews it.
///
/// ```
/// use throng::steer::{AvoidNeighbours, Hold};
/// let steady = Hold { seconds: 0.5, of: AvoidNeighbours::default().into() };
/// ```
#[derive(Clone, Debug)]
pub struct Hold {
    /// How long, seconds. Limit: > 0.
    pub seconds: f32,
    /// What is held.
    pub of: Branch,
}

/// Words that are its own.
const OWN: usize = 4;

impl Behaviour for Hold {
    /// How many seconds it still keeps a force, and the force.
    fn memory(&self) -> usize {
        OWN + self.of.words()
    }

    fn steer(&self, view: &View<'_>, memory: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let (own, mut memory) = memory.split_at_mut(OWN);
        let [left, force @ ..] = own else { return None };
        let said = self.of.steer_as(0, view, &mut memory, why);
        *left = (*left - view.seconds).max(0.0);
        let kept = Vec3::from_slice(force) * (*left / self.seconds);
        match said {
            Some(said) if said.force.length() >= kept.length() => {
                *left = self.seconds;
                force.copy_from_slice(&said.force.to_array());
                Some(said)
            }
            None if kept == Vec3::ZERO => None,
            _ => {
                why.note(|| Reason::Keeps(kept));
                Some(Steering { force: kept, facing: said.and_then(|said| said.facing) })
            }
        }
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless_positive("time that a force is held", self.seconds)?;
        self.of.check()
    }
}
