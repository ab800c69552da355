//! Queueing: Reynolds, Steering behaviors for autonomous characters, GDC 1999 (the doorway of its demos).

use crate::single::settling_time;
use throng::Error;
use throng::motion::Steering;
use throng::steer::{
    Behaviour, BoxedBehaviour, GroupFilter, SteeringInput, SteeringNeighbour, SteeringReason, TraceRecorder,
};

/// Limits the speed of a part by the agents right ahead that go the same way or stand: the agent does not push.
///
/// The limit is half of the speed of the agent ahead, and more in proportion to the distance between the bodies. With
/// the whole of that speed the agent would come nearer than the gap when the agent ahead brakes, since it follows with
/// a delay. With half of it the agent never does, however suddenly the agent ahead stops, and it follows by half the
/// headway in time.
///
/// ```
/// use throng::steer::Target;
/// use throng_steer::{Queue, Seek};
/// let patient = Queue { gap: 0.3, ..Queue::new(Seek { target: Target::Goal }) };
/// ```
#[derive(Clone, Debug)]
pub struct Queue {
    /// The agents to queue behind.
    pub groups: GroupFilter,
    /// How far ahead it looks, metres between centres. Limit: > 0.
    pub distance: f32,
    /// How much wider than the two bodies the checked strip is, metres. Limit: >= 0.
    pub width: f32,
    /// Least distance between standing bodies, metres. Limit: >= 0.
    pub gap: f32,
    /// Seconds in which the agent closes all but a third of a greater gap, and twice the time by which it follows;
    /// longer if the vehicle responds too slowly. Limit: > 0.
    pub headway: f32,
    /// The part.
    pub of: BoxedBehaviour,
}

impl Queue {
    /// Returns a queue behind all agents within 2 m, with a gap of 0.1 m.
    pub fn new(of: impl Into<BoxedBehaviour>) -> Self {
        Self { groups: GroupFilter::All, distance: 2.0, width: 0.0, gap: 0.1, headway: 0.5, of: of.into() }
    }
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

    fn check(&self) -> Result<(), Error> {
        Error::unless(self.distance > 0.0, "distance", self.distance, "greater than 0")?;
        Error::unless(self.width >= 0.0, "width of the lane", self.width, "0 or more")?;
        Error::unless(self.gap >= 0.0, "gap", self.gap, "0 or more")?;
        Error::unless_positive("headway", self.headway)?;
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
