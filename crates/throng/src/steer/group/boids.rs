//! Boids: Reynolds, Flocks, herds, and schools: a distributed behavioral model, SIGGRAPH 1987.
//!
//! The paper has no formulas; MODELS 4.1 says what is known of them. Three urges in strict order, collision avoidance, velocity
//! matching, flock centering, and then migration. Each is a wish for acceleration of length 0 to 1; they share out the
//! acceleration that there is, the first first.

use super::Neighbourhood;
use super::separation::aside;
use crate::Error;
use crate::motion::Steering;
use crate::steer::combine::Budget;
use crate::steer::{Behaviour, Reason, Target, View, Why};
use glam::Vec3;

/// The flock of 1987.
///
/// ```
/// use throng::steer::{Boids, Target};
/// let starlings = Boids { migration: Some(Target::Goal), ..Boids::default() };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Boids {
    /// Whom it sees.
    pub near: Neighbourhood,
    /// How much more it minds those ahead, at its top speed. Limit: >= 0.
    pub forward: f32,
    /// How near another is, metres, when the urge to avoid it is 1; it falls off by the square of the distance. Limit: > 0.
    pub avoidance: f32,
    /// The most of the three urges of the flock, and of migration. Limit: 0 to 1.
    pub strengths: [f32; 4],
    /// Where it migrates, if anywhere.
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
    fn steer(&self, view: &View<'_>, _: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        self.near.tell(view, why);
        let urges = self.urges(view);
        if urges.iter().all(|urge| *urge == Vec3::ZERO) {
            return None;
        }
        let mut budget = Budget(1.0);
        let mut sum = Vec3::ZERO;
        for (urge, strength) in urges.into_iter().zip(self.strengths) {
            let granted = budget.grant(view.passable(urge).clamp_length_max(1.0) * strength);
            why.note(|| Reason::Wishes(granted));
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
    /// To avoid, to match, to centre, to migrate: 1 is as much as can be.
    fn urges(&self, view: &View<'_>) -> [Vec3; 4] {
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
