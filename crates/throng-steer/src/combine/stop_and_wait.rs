//! Stop and wait: the cure for collisions that turning aside does not prevent.

use crate::approach::time_to_touch;
use glam::Vec3;
use std::sync::Arc;
use throng::Error;
use throng::field::Field;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::steer::{
    Behaviour, BoxedBehaviour, GroupFilter, SteeringInput, SteeringNeighbour, SteeringReason, TraceRecorder,
};

/// Stops where a part would collide with an agent, and waits for a random time.
///
/// ```
/// use throng::steer::Target;
/// use throng_steer::{Seek, StopAndWait};
/// let patient = StopAndWait::new(Seek { target: Target::Goal });
/// ```
#[parameters]
#[derive(Clone, Debug)]
pub struct StopAndWait {
    /// The agents that it stops for.
    pub groups: GroupFilter,
    /// It stops this many seconds before contact.
    #[parameter(default = 0.3, unit = "s", above = 0)]
    pub within: f32,
    /// The least waiting time, seconds.
    #[parameter(default = 0.2, unit = "s", above = 0)]
    pub least_wait: f32,
    /// The greatest waiting time, seconds. Limit: at least `least_wait`.
    #[parameter(default = 1.0, unit = "s")]
    pub most_wait: f32,
    /// Seconds for which its way must be clear before it continues.
    #[parameter(default = 0.5, unit = "s", least = 0)]
    pub clear: f32,
    /// The part.
    #[parameter(required)]
    pub of: BoxedBehaviour,
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
            let (least, most) = (self.least_wait, self.most_wait);
            *left = least + (most - least) * view.rng.draw(0);
        }
        // the vehicle limits the force
        let stop = view.velocity() * -(view.vehicle.mass / view.seconds);
        Some(Steering { force: stop, facing: said.and_then(|said| said.facing) })
    }

    fn fields(&self, see: &mut dyn FnMut(&Arc<dyn Field>)) {
        self.of.fields(see);
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()?;
        Error::unless(self.most_wait >= self.least_wait, "most_wait", self.most_wait, "least_wait or more")?;
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
