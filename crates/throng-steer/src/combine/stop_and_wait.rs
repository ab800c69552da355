//! Stop and wait: the cure for collisions that turning aside does not prevent.

use crate::approach::time_to_touch;
use glam::Vec3;
use throng::Error;
use throng::motion::Steering;
use throng::steer::{
    Behaviour, BoxedBehaviour, GroupFilter, SteeringInput, SteeringNeighbour, SteeringReason, TraceRecorder,
};

/// Stops before a collision with a neighbour, waits for a random time, and goes on when the way is clear.
///
/// ```
/// use throng::steer::Target;
/// use throng_steer::{Seek, StopAndWait};
/// let patient = StopAndWait::new(Seek { target: Target::Goal });
/// ```
#[derive(Clone, Debug)]
pub struct StopAndWait {
    /// The agents to stop for.
    pub groups: GroupFilter,
    /// Time to contact at which the agent stops, seconds, at constant velocities. Limit: > 0.
    pub within: f32,
    /// Least and greatest time of waiting, seconds. Limit: 0 < least <= most.
    pub wait: (f32, f32),
    /// Seconds for which the way must be clear before the agent goes on. Limit: >= 0.
    pub clear: f32,
    /// The part.
    pub of: BoxedBehaviour,
}

impl StopAndWait {
    /// Returns a behaviour that stops for all agents 0.3 s before contact, waits 0.2 to 1 s, and goes on when the way
    /// is clear for 0.5 s.
    pub fn new(of: impl Into<BoxedBehaviour>) -> Self {
        Self { groups: GroupFilter::All, within: 0.3, wait: (0.2, 1.0), clear: 0.5, of: of.into() }
    }
}

impl Behaviour for StopAndWait {
    /// The seconds that are left to wait; 0: the agent moves.
    fn memory(&self) -> usize {
        1 + self.of.words()
    }

    fn steer(&self, view: &SteeringInput<'_>, memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let [left, memory @ ..] = memory else { return None };
        let mut memory = memory;
        let said = self.of.steer_as(0, view, &mut memory, why);
        if *left > view.seconds {
            *left -= view.seconds;
        } else {
            let waits = *left > 0.0;
            let (velocity, seconds) =
                if waits { (view.chosen(said), self.clear) } else { (view.velocity(), self.within) };
            let Some(other) = self.in_the_way(view, velocity, seconds) else {
                *left = 0.0;
                return said;
            };
            why.note(|| SteeringReason::Regards(other.number));
            let (least, most) = self.wait;
            *left = least + (most - least) * view.rng.draw(0);
        }
        // the vehicle limits the force
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
    /// Returns the nearest neighbour that the agent would touch within some seconds at this velocity.
    fn in_the_way<'a>(&self, view: &SteeringInput<'a>, velocity: Vec3, seconds: f32) -> Option<&'a SteeringNeighbour> {
        let touches = |other: &SteeringNeighbour| {
            time_to_touch(other.offset, other.velocity - velocity, view.radius + other.radius) < seconds
                && other.offset.dot(other.velocity - velocity) < 0.0
        };
        view.neighbours.iter().find(|other| self.groups.counts(view, other) && touches(other))
    }
}
