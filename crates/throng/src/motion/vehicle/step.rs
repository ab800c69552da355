//! One step of a vehicle: force, velocity, position, orientation.

use super::limit::limited;
use super::{Basis, Integrator, Locomotion, Motion, Steering, Vehicle, part_in, turned_towards};
use glam::Vec3;

/// Time constant of the smoothing of the path's curvature, seconds (OpenSteer: a rate of 4).
pub(super) const CURVATURE_TIME: f32 = 0.25;
/// Time constant with which a flying vehicle levels or banks, seconds (OpenSteer: a rate of 3).
pub(super) const ROLL_TIME: f32 = 1.0 / 3.0;
/// Gravity, m/s².
pub(super) const GRAVITY: f32 = 9.81;
/// Fraction of the top speed below which the velocity does not define the direction.
pub(super) const REST: f32 = 1e-3;

impl Vehicle {
    /// Advances the motion by `seconds` (> 0), under a force (newtons) or a [`Steering`].
    ///
    /// The force is limited and becomes an acceleration, which is smoothed. The acceleration changes the velocity, and
    /// its speed and direction are limited. The velocity changes the position. Then the vehicle turns to its direction
    /// of motion, or to the requested facing. With a requested facing it may move in any direction.
    pub fn step(&self, motion: &mut Motion, steering: impl Into<Steering>, seconds: f32) {
        let Steering { force, facing } = steering.into();
        let before = *motion;
        let acceleration = limited(self, motion, force, seconds) / self.mass;
        let smoothed = before.acceleration.lerp(acceleration, part_in(seconds, self.smoothing));
        let chosen = before.velocity + smoothed * seconds;
        let chosen = if self.locomotion == Locomotion::Ground { chosen.with_z(0.0) } else { chosen };
        let chosen = chosen.clamp_length_max(self.max_speed);
        let forward = self.forward(&before, chosen, facing, seconds);
        motion.velocity = self.velocity(chosen, forward, facing.is_some());
        motion.position += seconds
            * match self.integrator {
                Integrator::SemiImplicit => motion.velocity,
                Integrator::Euler => before.velocity,
            };
        motion.acceleration = smoothed;
        motion.basis = self.basis(&before.basis, forward, smoothed, seconds);
        motion.curvature = curvature(&before, motion, seconds);
    }

    /// Returns the motion `wanted` by a step after avoidance or the guard replaced its velocity. The vehicle faces its
    /// direction of motion, unless `faces` says that a facing was requested.
    pub fn diverted(&self, before: &Motion, wanted: Motion, faces: bool, velocity: Vec3, seconds: f32) -> Motion {
        let forward = if faces { wanted.basis.forward } else { self.forward(before, velocity, None, seconds) };
        let mut motion = Motion { position: before.position + velocity * seconds, velocity, ..wanted };
        motion.basis = self.basis(&before.basis, forward, wanted.acceleration, seconds);
        motion.curvature = curvature(before, &motion, seconds);
        motion
    }

    /// Returns the direction that the vehicle faces after the step.
    fn forward(&self, motion: &Motion, chosen: Vec3, facing: Option<Vec3>, seconds: f32) -> Vec3 {
        let before = motion.basis.forward;
        let to = match facing {
            Some(direction) if self.locomotion == Locomotion::Ground => direction.with_z(0.0),
            Some(direction) => direction,
            None if chosen.length() > REST * self.max_speed => chosen,
            None => return before,
        };
        let Some(to) = to.try_normalize() else { return before };
        turned_towards(before, to, self.max_turn_rate.radians() * seconds, motion.basis.up)
    }

    /// Returns the part of a velocity that the vehicle can have with this forward direction: the component along it,
    /// unless the vehicle may move in any direction.
    fn velocity(&self, chosen: Vec3, forward: Vec3, any_direction: bool) -> Vec3 {
        let velocity = if any_direction || self.max_turn_rate.radians().is_infinite() {
            chosen
        } else {
            forward * chosen.dot(forward).max(0.0)
        };
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

/// Returns the curvature after a step: the change of direction divided by the path length, smoothed. The previous
/// curvature is rotated with the direction, by the smallest rotation. It is zero when the vehicle stands.
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
