//! The leg between the hip and the ankle.

use crate::math::{about_y, about_z, direction, from_axes};
use crate::person::{Person, Side};
use crate::steps::FootPose;
use glam::{DQuat, DVec3};

/// The share of its length to which a leg is stretched at most.
const STRAIGHT: f64 = 0.9985;

/// Returns the hip joints of a pelvis, left first, m.
pub(crate) fn hip_joints(person: &Person, pelvis: DVec3, rotation: DQuat) -> [DVec3; 2] {
    let across = rotation * DVec3::Y * (person.legs.hip * person.height);
    [pelvis + across, pelvis - across]
}

/// Returns the rotations of thigh, shank, foot and toes, each against its parent.
///
/// `pelvis` is the rotation of the pelvis, `facing` its direction (rad).
pub(crate) fn leg(person: &Person, side: Side, hip: DVec3, pelvis: DQuat, facing: f64, foot: &FootPose) -> [DQuat; 4] {
    let body = person.legs;
    let (thigh, shank) = (body.thigh * person.height, body.shank * person.height);
    let way = foot.ankle - hip;
    let distance = way.length().clamp(0.2 * thigh, STRAIGHT * (thigh + shank));
    let down = if way.length_squared() > 1e-12 { way.normalize() } else { -DVec3::Z };
    // knees point half to where the foot points
    let knees = facing + 0.5 * (foot.yaw - facing).clamp(-1.2, 1.2) + 0.02 * side.sign();
    let forward = direction(knees).extend(0.0);
    let axis = (-down).cross(forward);
    let axis = if axis.length_squared() > 1e-6 { axis.normalize() } else { direction(knees).perp().extend(0.0) };
    let cos_hip = (thigh * thigh + distance * distance - shank * shank) / (2.0 * thigh * distance);
    let cos_knee = (thigh * thigh + shank * shank - distance * distance) / (2.0 * thigh * shank);
    let raise = libm::acos(cos_hip.clamp(-1.0, 1.0));
    let bend = std::f64::consts::PI - libm::acos(cos_knee.clamp(-1.0, 1.0));
    // the leg as if it were straight, then the thigh forward, and the shank back
    let straight = from_axes(axis.cross(-down), axis, -down);
    let thigh_world = straight * about_y(-raise);
    let shank_local = about_y(bend);
    let foot_world = about_z(foot.yaw) * about_y(-foot.pitch);
    let shank_world = thigh_world * shank_local;
    [
        pelvis.conjugate() * thigh_world,
        shank_local,
        shank_world.conjugate() * foot_world,
        about_y(foot.pitch - foot.toes),
    ]
}
