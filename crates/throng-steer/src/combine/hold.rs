//! Holding an avoidance: the cure for circling along an obstacle.
//!
//! An agent that has just avoided an obstacle turns back at once, since it no longer sees the obstacle, and must avoid
//! it again. If the avoidance lasts for a while, the agent gets past.

use crate::approach::time_to_touch;
use glam::Vec3;
use std::sync::Arc;
use throng::Error;
use throng::field::Field;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::steer::{Behaviour, BoxedBehaviour, SteeringInput, SteeringReason, TraceRecorder};

/// Keeps the force of a part for some time after the part has nothing to correct, and fades it out.
///
/// A weaker force of the
/// part does not replace the kept force; a stronger force renews it. The kept force is dropped if it would cause a
/// collision with a neighbour that is not on a collision course now.
///
/// Walls are not considered: [`AvoidObstacles`](crate::AvoidObstacles) keeps to its side of a wall itself.
///
/// ```
/// use throng_steer::{AvoidNeighbours, Hold};
/// let steady = Hold { seconds: 0.5, of: AvoidNeighbours::default().into() };
/// ```
#[parameters]
#[derive(Clone, Debug)]
pub struct Hold {
    /// The time, seconds.
    #[parameter(required, unit = "s", above = 0)]
    pub seconds: f32,
    /// The part.
    #[parameter(required)]
    pub of: BoxedBehaviour,
}

/// Words of memory without those of the part.
const OWN: usize = 4;

impl Behaviour for Hold {
    /// The seconds for which a force is still kept, and the force.
    fn memory(&self) -> usize {
        OWN + self.of.words()
    }

    fn steer(&self, view: &SteeringInput<'_>, memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
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
                why.note(|| SteeringReason::Keeps(kept));
                Some(Steering { force: kept, facing: said.and_then(|said| said.facing) })
            }
        }
    }

    fn fields(&self, see: &mut dyn FnMut(&Arc<dyn Field>)) {
        self.of.fields(see);
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()?;
        self.of.check()
    }
}

/// Whether the velocity that a force leads to touches a neighbour within some seconds and the present velocity does
/// not.
fn causes_a_hit(view: &SteeringInput<'_>, force: Vec3, seconds: f32) -> bool {
    let (chosen, velocity) = (view.chosen(Some(force.into())), view.velocity());
    view.neighbours.iter().any(|other| {
        let touches = |own: Vec3| {
            let time = time_to_touch(other.offset, other.velocity - own, view.radius + other.radius);
            time > 0.0 && time < seconds
        };
        touches(chosen) && !touches(velocity)
    })
}
