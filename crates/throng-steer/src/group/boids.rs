//! Boids: Reynolds, Flocks, herds, and schools: a distributed behavioral model, SIGGRAPH 1987.
//!
//! The paper has no formulas. It gives three urges in strict order: collision avoidance, velocity matching and flock
//! centering; migration comes last. Each urge is an acceleration of length 0 to 1, and an urge gets what the urges
//! before it have left of the acceleration budget. The inverse square of the distance as the weight, and more weight
//! ahead, are from the paper's text; the formulas are this crate's.

use super::Neighbourhood;
use super::separation::aside;
use crate::combine::Budget;
use glam::Vec3;
use throng::Error;
use throng::motion::Steering;
use throng::steer::{Behaviour, SteeringInput, SteeringReason, Target, TraceRecorder};

/// The flock of 1987.
///
/// ```
/// use throng::steer::Target;
/// use throng_steer::Boids;
/// let starlings = Boids { migration: Some(Target::Goal), ..Boids::default() };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Boids {
    /// The neighbourhood.
    pub near: Neighbourhood,
    /// Extra weight of a neighbour straight ahead at the top speed. Limit: >= 0.
    pub forward: f32,
    /// Distance at which the urge to avoid a neighbour is 1, metres; the urge falls off by the square of the distance.
    /// Limit: > 0.
    pub avoidance: f32,
    /// Upper bounds of the three urges of the flock and of migration. Limit: 0 to 1.
    pub strengths: [f32; 4],
    /// The target of migration, if any.
    pub migration: Option<Target>,
}

impl Default for Boids {
    fn default() -> Self {
        Self {
            near: Neighbourhood { distance: 9.0, angle: 2.4, ..Neighbourhood::default() },
            forward: 1.0,
            avoidance: 1.5,
            strengths: [1.0, 0.8, 0.5, 0.4],
            migration: None,
        }
    }
}

impl Behaviour for Boids {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        self.near.tell(view, why);
        let urges = self.urges(view);
        if urges.iter().all(|urge| *urge == Vec3::ZERO) {
            return None;
        }
        let mut budget = Budget(1.0);
        let mut sum = Vec3::ZERO;
        for (urge, strength) in urges.into_iter().zip(self.strengths) {
            let granted = budget.grant(view.passable(urge).clamp_length_max(1.0) * strength);
            why.note(|| SteeringReason::Wishes(granted));
            sum += granted;
        }
        Some((sum * view.vehicle.max_force).into())
    }

    fn check(&self) -> Result<(), Error> {
        self.near.check()?;
        Error::unless(self.forward >= 0.0, "forward bias", self.forward, "0 or more")?;
        Error::unless_positive("distance of avoidance", self.avoidance)?;
        for strength in self.strengths {
            Error::unless((0.0..=1.0).contains(&strength), "strength", strength, "from 0 to 1")?;
        }
        Ok(())
    }
}

impl Boids {
    /// Returns the urges to avoid, to match, to centre and to migrate; 1 is the most.
    fn urges(&self, view: &SteeringInput<'_>) -> [Vec3; 4] {
        let (mut avoid, mut matching, mut center, mut weights) = (Vec3::ZERO, Vec3::ZERO, Vec3::ZERO, 0.0);
        let speed = view.motion.speed() / view.vehicle.max_speed;
        for other in self.near.of(view) {
            let distance = other.offset.length();
            let towards = other.offset.normalize_or(-aside(view, other));
            let ahead = 1.0 + self.forward * speed * view.forward().dot(towards).max(0.0);
            let near = self.avoidance / distance.max(view.radius);
            let weight = near * near * ahead;
            avoid -= towards * weight;
            matching += (other.velocity - view.velocity()) * weight;
            center += other.offset * weight;
            weights += weight;
        }
        let mean = |sum: Vec3, scale: f32| if weights > 0.0 { sum / (weights * scale) } else { Vec3::ZERO };
        let migration = self.migration.and_then(|target| target.find(view));
        let migrate = migration.map_or(Vec3::ZERO, |target| view.to(target.position).normalize_or_zero());
        [avoid, mean(matching, view.vehicle.max_speed), mean(center, 3.0 * self.avoidance), migrate]
    }
}
