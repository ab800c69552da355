//! Queueing: Reynolds, Steering behaviors for autonomous characters, GDC 1999 (the doorway of its demos).

use crate::single::settling_time;
use std::sync::Arc;
use throng::Error;
use throng::field::Field;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::steer::{
    Behaviour, BoxedBehaviour, GroupFilter, SteeringInput, SteeringNeighbour, SteeringReason, TraceRecorder,
};

/// Moves no faster than the neighbours right ahead (Reynolds 1999).
///
/// Limits the speed of a part by the agents right ahead that move the same way or stand: the agent does not push. The
/// limit is half of the speed of the agent ahead, and more in proportion to the distance between the bodies. With
/// the whole of that speed the agent would come nearer than the gap when the agent ahead brakes, since it follows with
/// a delay. With half of it the agent never does, however suddenly the agent ahead stops, and it follows by half the
/// headway in time.
///
/// ```
/// use throng::steer::Target;
/// use throng_steer::{Queue, Seek};
/// let patient = Queue { gap: 0.3, ..Queue::new(Seek { target: Target::Goal }) };
/// ```
#[parameters]
#[derive(Clone, Debug)]
pub struct Queue {
    /// The neighbours that it queues behind.
    pub groups: GroupFilter,
    /// How far ahead it looks, metres between centres.
    #[parameter(default = 2.0, unit = "m", above = 0, infinite)]
    pub distance: f32,
    /// Width of its corridor beyond the widths of the two bodies, metres.
    #[parameter(unit = "m", least = 0)]
    pub width: f32,
    /// Gap between bodies at rest, metres.
    #[parameter(default = 0.1, unit = "m", least = 0)]
    pub gap: f32,
    /// Seconds in which it closes all but a third of a greater gap.
    ///
    /// Twice the time by which it follows; longer if the vehicle responds too slowly.
    #[parameter(default = 0.5, unit = "s", above = 0)]
    pub headway: f32,
    /// The behaviour that it restrains.
    #[parameter(required)]
    pub of: BoxedBehaviour,
}

impl Behaviour for Queue {
    fn memory(&self) -> usize {
        self.of.words()
    }

    fn steer(&self, view: &SteeringInput<'_>, mut memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let said = self.of.steer_as(0, view, &mut memory, why);
        let chosen = view.chosen(said);
        let speed = chosen.dot(view.forward());
        let counting = view.neighbours.iter().filter(|other| self.groups.counts(view, other));
        let limits = counting.map(|other| (self.allowed(view, other), other));
        let Some((allowed, other)) = limits.min_by(|a, b| a.0.total_cmp(&b.0)).filter(|limit| limit.0 < speed) else {
            return said;
        };
        why.note(|| SteeringReason::Regards(other.number));
        let facing = said.and_then(|said| said.facing);
        Some(Steering { facing, ..view.reach(chosen + view.forward() * (allowed - speed)) })
    }

    fn fields(&self, see: &mut dyn FnMut(&Arc<dyn Field>)) {
        self.of.fields(see);
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()?;
        self.of.check()
    }
}

/// Part of the speed of the agent ahead in the limit. Gap and velocity are a linear system. Up to a half, the gap stays
/// positive for every motion of the agent ahead: then the zero of the system is no farther out than its slower pole.
const THEIRS: f32 = 0.5;

impl Queue {
    /// Returns the speed that an agent ahead permits.
    fn allowed(&self, view: &SteeringInput<'_>, other: &SteeringNeighbour) -> f32 {
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
