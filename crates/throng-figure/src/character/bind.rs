//! The skeleton of a body: the turns from the body as it was modelled to the pose at rest.

use super::CharacterError;
use super::measured::{Measured, leg_of};
use crate::math::arc;
use crate::person::Side;
use crate::pose::{ARM_AT_REST, Bind, JOINTS, Joint, Skeleton};
use glam::{DQuat, DVec3};

/// Returns the skeleton of a body, at its height.
pub(super) fn skeleton(body: &Measured) -> Result<Skeleton, CharacterError> {
    let mut turns = [DQuat::IDENTITY; JOINTS];
    let mut offsets = [DVec3::ZERO; JOINTS];
    body.legs.put(&mut offsets);
    let mut offsets = offsets.map(|offset| offset * body.height);
    for joint in [Joint::Spine, Joint::Spine1, Joint::Neck, Joint::Head, Joint::LeftArm, Joint::RightArm] {
        let parent = joint.parent().map_or(DVec3::ZERO, |parent| body.joint(parent));
        offsets[joint.index()] = body.joint(joint) - parent;
    }
    for (side, arm) in [
        (Side::Left, [Joint::LeftArm, Joint::LeftForeArm, Joint::LeftHand]),
        (Side::Right, [Joint::RightArm, Joint::RightForeArm, Joint::RightHand]),
    ] {
        let aim = DVec3::new(0.0, side.sign(), -1.0) * ARM_AT_REST;
        for (at, length) in straighten(body, &mut turns, &arm, aim)?.into_iter().enumerate() {
            offsets[arm[at + 1].index()] = aim * length;
        }
        turns[arm[2].index()] = turns[arm[1].index()];
    }
    for side in Side::BOTH {
        let [hip, knee, ankle, toes] = leg_of(side);
        straighten(body, &mut turns, &[hip, knee, ankle], -DVec3::Z)?;
        // soles are flat at rest
        let turn = arc(body.feet[side.index()].extend(0.0), DVec3::X);
        (turns[ankle.index()], turns[toes.index()]) = (turn, turn);
    }
    let binds = std::array::from_fn(|joint| Bind { position: body.joints[joint], turn: turns[joint] });
    Ok(Skeleton::bound(offsets, binds))
}

/// Turns the bones between joints to a direction, each beyond the turn of the bone before. Returns their lengths.
fn straighten(
    body: &Measured,
    turns: &mut [DQuat; JOINTS],
    joints: &[Joint; 3],
    aim: DVec3,
) -> Result<[f64; 2], CharacterError> {
    let mut turn = DQuat::IDENTITY;
    let mut lengths = [0.0; 2];
    for (length, pair) in lengths.iter_mut().zip(joints.windows(2)) {
        let bone = body.joint(pair[1]) - body.joint(pair[0]);
        *length = bone.length();
        if *length < 1e-3 * body.height {
            return Err(CharacterError::NoLength { from: pair[0], to: pair[1] });
        }
        turn = (arc(turn * bone / *length, aim) * turn).normalize();
        turns[pair[0].index()] = turn;
    }
    Ok(lengths)
}
