//! The whole body over its feet.

use super::leg::{hip_joints, leg};
use super::{JOINTS, Joint, Pose, idle};
use crate::gait;
use crate::math::{about_x, about_y, about_z, mix};
use crate::person::{Person, Side};
use crate::steps::FootPose;
use glam::{DQuat, DVec3};
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_4};

/// What the pose of a body depends on besides its feet.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BodyState {
    pub time: f64,
    /// Position of the pelvis, m, with its sway.
    pub pelvis: DVec3,
    /// Direction in which the body faces, rad.
    pub heading: f64,
    /// Speed along the heading, in lengths of the leg per second; less than 0 backwards.
    pub forward: f64,
    /// Speed, in lengths of the leg per second.
    pub relative_speed: f64,
    /// Acceleration along the heading, and to the left, m/s².
    pub acceleration: [f64; 2],
    /// Phase of the gait.
    pub phase: f64,
    /// How much the person runs, and stands: 0 to 1.
    pub run: f64,
    pub still: f64,
    /// To which side a standing person shifts its weight: -1 (right) to 1 (left).
    pub weight: f64,
    /// The turn of the gaze against the heading, rad.
    pub gaze: f64,
}

impl BodyState {
    /// Returns the rotation of the pelvis.
    pub fn pelvis_rotation(&self) -> DQuat {
        let rv = self.relative_speed.min(2.2);
        let walk = if self.forward < 0.0 { 0.5 } else { 1.0 };
        let yaw = walk * gait::pelvis_yaw(rv, self.phase);
        let tilt = gait::pelvis_tilt(rv, self.phase) + self.run * 0.07;
        let list = gait::pelvis_list(rv, self.phase) + 0.05 * self.weight;
        about_z(self.heading + yaw) * about_y(tilt) * about_x(list + 0.3 * self.bank())
    }

    /// Returns the lean to the right in a turn to the right, rad.
    fn bank(&self) -> f64 {
        (-0.6 * self.acceleration[1] / 9.81).clamp(-0.25, 0.25)
    }
}

/// Returns the pose of a body over its feet, left first. `pelvis` is the rotation of the pelvis.
pub(crate) fn pose(person: &Person, state: &BodyState, pelvis: DQuat, feet: &[FootPose; 2]) -> Pose {
    let hips = hip_joints(person, state.pelvis, pelvis);
    let mut rotations = [DQuat::IDENTITY; JOINTS];
    let mut put = |joint: Joint, rotation: DQuat| rotations[joint.index()] = rotation;
    put(Joint::Hips, pelvis);

    let rv = state.relative_speed.min(2.4);
    let breath = idle::breath(person.seed, state.time);
    let glance = if state.still > 0.0 { state.still * idle::glance(person.seed, state.time) } else { 0.0 };
    let thorax_yaw = gait::thorax_yaw(rv, state.phase) * mix(1.0, 1.6, state.run);
    let lean = person.lean + 0.02 + 0.05 * state.run + (0.05 * state.acceleration[0]).clamp(-0.1, 0.1);
    // the gaze: 30 % by the neck, 70 % by the head, and a little by the trunk
    let gaze = (state.gaze + 0.5 * glance).clamp(-1.1, 1.1);
    let trunk_yaw = thorax_yaw + 0.1 * gaze;
    let facing = about_z(state.heading);
    let spine = facing * about_z(trunk_yaw * 0.4) * about_y(lean * 0.7) * about_x(0.7 * state.bank());
    let chest = facing * about_z(trunk_yaw) * about_y(lean + 0.008 * breath) * about_x(state.bank());
    put(Joint::Spine, pelvis.conjugate() * spine);
    put(Joint::Spine1, spine.conjugate() * chest);
    let neck = facing * about_z(mix(trunk_yaw, gaze, 0.3)) * about_y(0.5 * lean + 0.06) * about_x(0.5 * state.bank());
    let head = facing * about_z(gaze) * about_y(0.04 + 0.1 * lean);
    put(Joint::Neck, chest.conjugate() * neck);
    put(Joint::Head, neck.conjugate() * head);

    for (side, [arm, forearm, hand, up_leg, low_leg, foot, toes]) in
        [(Side::Left, &Joint::ALL[5..8], &Joint::ALL[11..15]), (Side::Right, &Joint::ALL[8..11], &Joint::ALL[15..19])]
            .map(|(side, arm, leg)| (side, [arm[0], arm[1], arm[2], leg[0], leg[1], leg[2], leg[3]]))
    {
        let sign = side.sign();
        let phase = state.phase + if side == Side::Left { 0.0 } else { 0.5 };
        let backwards = if state.forward < 0.0 { 0.5 } else { 1.0 };
        let swing = gait::shoulder(rv, phase) * person.arms * backwards * mix(1.0, 1.5, state.run);
        let flexion = mix(gait::elbow(rv, phase), 1.45 + 0.25 * (swing - 0.1), state.run) + 0.1;
        let abduction = mix(0.10, 0.16, state.run);
        // the arm turns inward as it swings forward
        let inward = -sign * (0.15 + 0.3 * swing.max(0.0) + 0.2 * state.run);
        let hang = about_y(-swing) * about_z(inward) * about_x(sign * (abduction - FRAC_PI_4));
        put(arm, hang);
        put(forearm, about_hinge(sign, -flexion));
        put(hand, about_hinge(sign, -0.12));
        let [a, b, c, d] = leg(person, side, hips[side.index()], pelvis, state.heading, &feet[side.index()]);
        put(up_leg, a);
        put(low_leg, b);
        put(foot, c);
        put(toes, d);
    }
    Pose { hips: state.pelvis, rotations }
}

/// Returns the rotation by `angle` (rad) about the hinge of an elbow, which is across the arm at rest. `sign` is that
/// of the side.
fn about_hinge(sign: f64, angle: f64) -> DQuat {
    let (sin, cos) = libm::sincos(angle / 2.0);
    DQuat::from_xyzw(0.0, sin * FRAC_1_SQRT_2, sign * sin * FRAC_1_SQRT_2, cos)
}
