//! Limits of the steering force of a vehicle.

use super::{Locomotion, Motion, Vehicle, angle_between, turned_towards};
use glam::Vec3;
use std::f32::consts::PI;

/// Fraction of the top speed up to which backward motion counts as none.
const REST: f32 = 1e-4;

/// Returns the steering force, limited to what the vehicle can do.
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

/// Redirects a force that leads a vehicle with a least speed backwards. Such a vehicle cannot turn on the spot, so it
/// circles: it brakes only as far as the least speed allows, and the rest of the force acts sideways, to the left if
/// the force leads straight back.
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

/// Restricts the force at low speed to a cone about forward that widens with the speed: OpenSteer's
/// `adjustRawSteeringForce`, but smooth, and without its fault that a vehicle that brakes to a stop sets out again.
fn steerable(vehicle: &Vehicle, motion: &Motion, force: Vec3, seconds: f32) -> Vec3 {
    if vehicle.low_speed == 0.0 || force == Vec3::ZERO {
        return force;
    }
    let part = motion.speed() / (vehicle.low_speed * vehicle.max_speed);
    let brakes = || {
        let stops = vehicle.velocity_of(motion, force, seconds).dot(motion.basis.forward) >= -REST * vehicle.max_speed;
        stops && force.dot(motion.basis.forward) < 0.0
    };
    // a vehicle that stands has nothing to brake
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
