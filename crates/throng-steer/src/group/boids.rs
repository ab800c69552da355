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
use throng::parameters::{Angle, Value, parameters};
use throng::steer::{Behaviour, SteeringInput, SteeringReason, Target, TraceRecorder};

/// The flock of 1987 (Reynolds 1987).
///
/// ```
/// use throng::steer::Target;
/// use throng_steer::Boids;
/// let starlings = Boids { migration: Some(Target::Goal), ..Boids::default() };
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Boids {
    /// The neighbours. Without it, all within 9 m and 137.5° of ahead.
    #[parameter(default = Neighbourhood {
        distance: 9.0,
        angle: Angle::from_radians(2.4),
        ..Neighbourhood::default()
    })]
    pub near: Neighbourhood,
    /// Additional weight of neighbours ahead, at the greatest speed.
    #[parameter(default = 1.0, least = 0)]
    pub forward: f32,
    /// Distance of a neighbour, metres, at which the urge to avoid it is 1.
    ///
    /// The urge falls off with the square of the distance.
    #[parameter(default = 1.5, unit = "m", above = 0)]
    pub avoidance: f32,
    /// The greatest strength of each urge.
    pub strengths: Strengths,
    /// The target of a migration, if there is one.
    pub migration: Option<Target>,
}

/// The greatest strength of each urge of a flock, 0 to 1.
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Strengths {
    /// To avoid neighbours.
    #[parameter(default = 1.0, least = 0, most = 1)]
    pub avoid: f32,
    /// To match the neighbours' velocity.
    #[parameter(default = 0.8, least = 0, most = 1)]
    pub matching: f32,
    /// To move to the neighbours' centre.
    #[parameter(default = 0.5, least = 0, most = 1)]
    pub center: f32,
    /// To migrate.
    #[parameter(default = 0.4, least = 0, most = 1)]
    pub migrate: f32,
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
        let Strengths { avoid, matching, center, migrate } = self.strengths;
        for (urge, strength) in urges.into_iter().zip([avoid, matching, center, migrate]) {
            let granted = budget.grant(view.passable(urge).clamp_length_max(1.0) * strength);
            why.note(|| SteeringReason::Adds(granted * view.vehicle.max_force / view.vehicle.mass));
            sum += granted;
        }
        Some((sum * view.vehicle.max_force).into())
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
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
