//! Holding an avoidance: the cure for going round and round along an obstacle.
//!
//! Who has just avoided something turns back at once, since it no longer sees it, and must avoid it again. If the
//! avoidance lasts for a while, it gets past.

use crate::Error;
use crate::motion::Steering;
use crate::steer::approach::time_to_touch;
use crate::steer::{Behaviour, Branch, Reason, View, Why};
use glam::Vec3;

/// Keeps the force of a part for a while after the part has nothing more to correct, fading. A weaker force does not end
/// what it keeps, a stronger one renews it; it is forgotten where it would lead into somebody who is not in the way as it is.
///
/// It knows nothing of walls: [`AvoidObstacles`](crate::steer::AvoidObstacles) keeps to its side of them by itself.
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
            _ if kept == Vec3::ZERO || causes_a_hit(view, kept, *left) => {
                *left = 0.0;
                said
            }
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

/// Whether somebody is touched within so many seconds at the velocity that a force leads to, but not at the present one.
fn causes_a_hit(view: &View<'_>, force: Vec3, seconds: f32) -> bool {
    let (wish, velocity) = (view.wish(Some(force.into())), view.velocity());
    view.neighbours.iter().any(|other| {
        let touches = |own: Vec3| {
            let time = time_to_touch(other.offset, other.velocity - own, view.radius + other.radius);
            time > 0.0 && time < seconds
        };
        touches(wish) && !touches(velocity)
    })
}
