//! One step of a vehicle: force, velocity, place, direction.

use super::limit::limited;
use super::{Basis, Integrator, Locomotion, Motion, Steering, Vehicle, part_in, turned_towards};
use glam::Vec3;

/// Seconds over which the curvature of the path is smoothed (OpenSteer: a rate of 4).
pub(super) const CURVATURE_TIME: f32 = 0.25;
/// Seconds in which one that flies rights itself, or leans (OpenSteer: a rate of 3).
pub(super) const ROLL_TIME: f32 = 1.0 / 3.0;
/// Gravity, m/s².
pub(super) const GRAVITY: f32 = 9.81;
/// Part of the top speed below which the velocity says nothing about the direction.
pub(super) const REST: f32 = 1e-3;

impl Vehicle {
    /// Moves by a step of so many seconds (> 0), steered by a force (newtons) or a [`Steering`].
    ///
    /// The force is limited, becomes an acceleration, smoothed; that changes the velocity, whose speed and direction are
    /// limited; that changes the place. The vehicle then looks where it goes, or turns to what it is told to face, and
    /// then it may move in any direction.
    pub fn step(&self, motion: &mut Motion, steering: impl Into<Steering>, seconds: f32) {
        let Steering { force, facing } = steering.into();
        let before = *motion;
        let acceleration = limited(self, motion, force, seconds) / self.mass;
        let smoothed = before.acceleration.lerp(acceleration, part_in(seconds, self.smoothing));
        let wish = before.velocity + smoothed * seconds;
        let wish = if self.locomotion == Locomotion::Ground { wish.with_z(0.0) } else { wish };
        let wish = wish.clamp_length_max(self.max_speed);
        let forward = self.forward(&before, wish, facing, seconds);
        motion.velocity = self.velocity(wish, forward, facing.is_some());
        motion.position += seconds
            * match self.integrator {
                Integrator::SemiImplicit => motion.velocity,
                Integrator::Euler => before.velocity,
            };
        motion.acceleration = smoothed;
        motion.basis = self.basis(&before.basis, forward, smoothed, seconds);
        motion.curvature = curvature(&before, motion, seconds);
    }

    /// What becomes of the motion that a step wanted if others leave it another velocity: it looks where it goes, unless it
    /// faces where it was told to.
    pub fn diverted(&self, before: &Motion, wanted: Motion, faces: bool, velocity: Vec3, seconds: f32) -> Motion {
        let forward = if faces { wanted.basis.forward } else { self.forward(before, velocity, None, seconds) };
        let mut motion = Motion { position: before.position + velocity * seconds, velocity, ..wanted };
        motion.basis = self.basis(&before.basis, forward, wanted.acceleration, seconds);
        motion.curvature = curvature(before, &motion, seconds);
        motion
    }

    /// The direction it will face.
    fn forward(&self, motion: &Motion, wish: Vec3, facing: Option<Vec3>, seconds: f32) -> Vec3 {
        let before = motion.basis.forward;
        let to = match facing {
            Some(direction) if self.locomotion == Locomotion::Ground => direction.with_z(0.0),
            Some(direction) => direction,
            None if wish.length() > REST * self.max_speed => wish,
            None => return before,
        };
        let Some(to) = to.try_normalize() else { return before };
        turned_towards(before, to, self.max_turn_rate * seconds, motion.basis.up)
    }

    /// What is left of a velocity when it faces so: what leads along, unless it may move in any direction.
    fn velocity(&self, wish: Vec3, forward: Vec3, any_direction: bool) -> Vec3 {
        let velocity =
            if any_direction || self.max_turn_rate.is_infinite() { wish } else { forward * wish.dot(forward).max(0.0) };
        let too_slow = velocity.length() < self.min_speed;
        if too_slow { velocity.normalize_or(forward) * self.min_speed } else { velocity }
    }

    fn basis(&self, before: &Basis, forward: Vec3, acceleration: Vec3, seconds: f32) -> Basis {
        let up = match self.locomotion {
            Locomotion::Ground => return Basis { up: Vec3::Z, ..before.turned_to(forward, Vec3::Z) },
            Locomotion::Level => Vec3::Z,
            Locomotion::Banking => {
                (acceleration.reject_from_normalized(forward) / GRAVITY + Vec3::Z).normalize_or_zero()
            }
        };
        before.turned_to(forward, before.up.lerp(up, part_in(seconds, ROLL_TIME)))
    }
}

/// The curvature after a step: the change of direction over the length of the way, smoothed. What it was before turns
/// with the direction, by the least rotation. At rest there is none.
fn curvature(before: &Motion, after: &Motion, seconds: f32) -> Vec3 {
    let length = after.position.distance(before.position);
    let (Some(from), Some(to)) = (before.velocity.try_normalize(), after.velocity.try_normalize()) else {
        return Vec3::ZERO;
    };
    let both = 1.0 + from.dot(to);
    if both < 1e-3 || length == 0.0 {
        return Vec3::ZERO;
    }
    let carried = before.curvature - (from + to) * (before.curvature.dot(to) / both);
    carried.lerp((to - from).reject_from_normalized(to) / length, part_in(seconds, CURVATURE_TIME))
}
