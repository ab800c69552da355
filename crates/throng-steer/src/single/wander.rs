//! Wander: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use glam::Vec3;
use std::f32::consts::{SQRT_2, TAU};
use throng::Error;
use throng::motion::Steering;
use throng::parameters::{Angle, Value, parameters};
use throng::steer::{Behaviour, SteeringInput, SteeringReason, TraceRecorder};

/// Wanders at random (Reynolds 1999).
///
/// It turns to one side and the other, without jerks.
///
/// The agent goes to a point on a sphere ahead of it (a circle, on the ground); the point moves on the sphere at
/// random. The motion of the point is Brownian, so its statistics do not depend on the time step; those of Reynolds'
/// displacement in each frame do.
///
/// ```
/// use throng::parameters::Angle;
/// use throng::steer::{Behaviour, SteeringInput, TraceRecorder};
/// use throng_steer::Wander;
/// let wander = Wander { strength: 0.5, rate: Angle::degrees(120.0) };
/// let mut memory = vec![0.0; wander.memory()];
/// assert!(wander.steer(&SteeringInput::default(), &mut memory, &mut TraceRecorder::default()).is_some());
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wander {
    /// Strength of the turns: 1 turns at most 45° aside.
    ///
    /// It is the radius of the sphere. The centre of the sphere is the square root of 2 ahead.
    #[parameter(default = 1.0, least = 0, most = 1.4)]
    pub strength: f32,
    /// Rate of change of the side, degrees per square root of a second.
    ///
    /// It is the speed of the point: the standard deviation after a second.
    #[parameter(default = Angle::from_radians(1.0), unit = "°/√s", least = 0)]
    pub rate: Angle,
}

impl Behaviour for Wander {
    /// The point on the sphere of radius 1, in the agent's frame.
    fn memory(&self) -> usize {
        3
    }

    fn steer(&self, view: &SteeringInput<'_>, memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let before = Vec3::from_slice(memory);
        let point = self.walk(view, before);
        memory.copy_from_slice(&point.to_array());
        let direction = view.passable(view.motion.basis.to_world(Vec3::X * SQRT_2 + point * self.strength));
        why.note(|| SteeringReason::Aim(view.position() + direction));
        let place = |local| view.position() + view.passable(view.motion.basis.to_world(local));
        why.note(|| SteeringReason::Circle { center: place(Vec3::X * SQRT_2), radius: self.strength });
        why.note(|| {
            let spread = self.strength * self.spread(view);
            SteeringReason::Circle { center: place(Vec3::X * SQRT_2 + before * self.strength), radius: spread }
        });
        view.turn(direction)
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}

impl Wander {
    /// Returns the standard deviation of the angle by which the point moves in a step, radians.
    fn spread(&self, view: &SteeringInput<'_>) -> f32 {
        self.rate.radians() * view.seconds.sqrt()
    }

    /// Returns the point after the step; a random point of the sphere if there was none.
    fn walk(&self, view: &SteeringInput<'_>, point: Vec3) -> Vec3 {
        let spread = self.spread(view);
        let rng = view.rng;
        if view.is_on_ground() {
            let angle = match point {
                Vec3::ZERO => TAU * rng.draw(9),
                _ => libm::atan2f(point.y, point.x) + rng.normal(0) * spread,
            };
            let (sin, cos) = libm::sincosf(angle);
            return Vec3::new(cos, sin, 0.0);
        }
        let any = Vec3::new(rng.normal(0), rng.normal(1), rng.normal(2));
        if point == Vec3::ZERO {
            return any.normalize_or(Vec3::X);
        }
        // along a great circle
        let step = any.reject_from_normalized(point) * spread;
        let (sin, cos) = libm::sincosf(step.length());
        (point * cos + step.normalize_or_zero() * sin).normalize_or(Vec3::X)
    }
}
