//! Wander: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use crate::Error;
use crate::motion::Steering;
use crate::steer::{Behaviour, Reason, View, Why};
use glam::Vec3;
use std::f32::consts::{SQRT_2, TAU};

/// Strolls about: turns now to this, now to that side, without jerks.
///
/// It goes to a point on a sphere ahead of it (a circle, on the ground), that walks about the sphere by chance. The walk
/// is a Brownian motion, so its statistics do not depend on the time step; Reynolds' displacement in each frame does.
///
/// ```
/// use throng::steer::{Behaviour, View, Wander, Why};
/// let wander = Wander { strength: 0.5, rate: 2.0 };
/// let mut memory = vec![0.0; wander.memory()];
/// assert!(wander.steer(&View::default(), &mut memory, &mut Why::default()).is_some());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wander {
    /// Radius of the sphere; its centre is the square root of 2 ahead, so that 1 leads at most 45° aside. Limit: 0 to 1.4.
    pub strength: f32,
    /// How fast the point walks, radians per square root of a second: the standard deviation after a second. Limit: >= 0.
    pub rate: f32,
}

impl Default for Wander {
    fn default() -> Self {
        Self { strength: 1.0, rate: 1.0 }
    }
}

impl Behaviour for Wander {
    /// The point on the sphere of radius 1, in the agent's frame.
    fn memory(&self) -> usize {
        3
    }

    fn steer(&self, view: &View<'_>, memory: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let point = self.walk(view, Vec3::from_slice(memory));
        memory.copy_from_slice(&point.to_array());
        let direction = view.passable(view.motion.basis.to_world(Vec3::X * SQRT_2 + point * self.strength));
        why.note(|| Reason::Aim(view.position() + direction));
        view.turn(direction)
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless((0.0..=1.4).contains(&self.strength), "strength of wandering", self.strength, "from 0 to 1.4")?;
        Error::unless(self.rate >= 0.0, "rate of wandering", self.rate, "0 or more")
    }
}

impl Wander {
    /// The point after the step; anywhere on the sphere if there was none.
    fn walk(&self, view: &View<'_>, point: Vec3) -> Vec3 {
        let spread = self.rate * view.seconds.sqrt();
        let dice = view.dice;
        if view.is_on_ground() {
            let angle = match point {
                Vec3::ZERO => TAU * dice.draw(9),
                _ => libm::atan2f(point.y, point.x) + dice.normal(0) * spread,
            };
            let (sin, cos) = libm::sincosf(angle);
            return Vec3::new(cos, sin, 0.0);
        }
        let any = Vec3::new(dice.normal(0), dice.normal(1), dice.normal(2));
        if point == Vec3::ZERO {
            return any.normalize_or(Vec3::X);
        }
        // along a great circle
        let step = any.reject_from_normalized(point) * spread;
        let (sin, cos) = libm::sincosf(step.length());
        (point * cos + step.normalize_or_zero() * sin).normalize_or(Vec3::X)
    }
}
