//! What a vehicle can do of the force that it is steered by.

use super::{Locomotion, Motion, Vehicle, angle_between, turned_towards};
use glam::Vec3;
use std::f32::consts::PI;

/// Part of the top speed that is no speed backwards.
const REST: f32 = 1e-4;

/// The force that is left.
pub(super) fn limited(vehicle: &Vehicle, motion: &Motion, force: Vec3, seconds: f32) -> Vec3 {
    let force = if vehicle.locomotion == Locomotion::Ground { force.with_z(0.0) } else { force };
    let force = steerable(vehicle, motion, circling(vehicle, motion, force, seconds), seconds);
    let most = vehicle.forces;
    let local = motion.basis.to_local(force);
    let low = Vec3::new(-most.brake, -most.side, -most.up);
    let high = Vec3::new(most.thrust, most.side, most.up);
    let clamped = local.max(low).min(high);
    let force = if clamped == local { force } else { motion.basis.to_world(clamped) };
    force.clamp_length_max(vehicle.max_force)
}

/// Who cannot stop cannot turn back on the spot, but circles: of a force that would lead back, what its least speed leaves
/// no brakes for leads aside instead, to the left if it leads straight back.
fn circling(vehicle: &Vehicle, motion: &Motion, force: Vec3, seconds: f32) -> Vec3 {
    let forward = motion.basis.forward;
    let least = (vehicle.min_speed - motion.velocity.dot(forward)).min(0.0) * vehicle.mass / seconds;
    let leads_back = || vehicle.velocity_of(motion, force, seconds).dot(forward) < 0.0;
    if vehicle.min_speed == 0.0 || force.dot(forward) >= least || !leads_back() {
        return force;
    }
    let force = force.clamp_length_max(vehicle.max_force);
    let aside = motion.basis.lateral(force).try_normalize().unwrap_or(motion.basis.side);
    forward * least + aside * (force.length_squared() - least * least).max(0.0).sqrt()
}

/// At low speed a force may lead aside only within a cone about forward, which opens with the speed: OpenSteer's
/// adjustRawSteeringForce, smooth, and without its fault that who brakes to rest sets out again.
fn steerable(vehicle: &Vehicle, motion: &Motion, force: Vec3, seconds: f32) -> Vec3 {
    if vehicle.low_speed == 0.0 || force == Vec3::ZERO {
        return force;
    }
    let part = motion.speed() / (vehicle.low_speed * vehicle.max_speed);
    let brakes = || {
        let stops = vehicle.velocity_of(motion, force, seconds).dot(motion.basis.forward) >= -REST * vehicle.max_speed;
        stops && force.dot(motion.basis.forward) < 0.0
    };
    // at rest there is nothing to brake
    if part >= 1.0 || part > 0.0 && brakes() {
        return force;
    }
    let cone = PI * part * part * (3.0 - 2.0 * part);
    if angle_between(force, motion.basis.forward) <= cone {
        return force;
    }
    let length = force.length();
    turned_towards(motion.basis.forward, force / length, cone, motion.basis.up) * length
}
