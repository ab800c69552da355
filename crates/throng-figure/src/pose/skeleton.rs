//! The skeleton: joints, lengths, the pose at rest.

use super::Pose;
use super::proportions::{ARM_AT_REST, Proportions};
use crate::person::{Build, Person};
use glam::{DMat4, DQuat, DVec3, Mat4};

/// Number of joints.
pub const JOINTS: usize = 19;

/// A joint of the skeleton.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[allow(missing_docs)]
pub enum Joint {
    Hips,
    Spine,
    Spine1,
    Neck,
    Head,
    LeftArm,
    LeftForeArm,
    LeftHand,
    RightArm,
    RightForeArm,
    RightHand,
    LeftUpLeg,
    LeftLeg,
    LeftFoot,
    LeftToeBase,
    RightUpLeg,
    RightLeg,
    RightFoot,
    RightToeBase,
}

use Joint::{
    Head, Hips, LeftArm, LeftFoot, LeftForeArm, LeftHand, LeftLeg, LeftToeBase, LeftUpLeg, Neck, RightArm, RightFoot,
    RightForeArm, RightHand, RightLeg, RightToeBase, RightUpLeg, Spine, Spine1,
};

impl Joint {
    /// All joints. A parent is before its children.
    pub const ALL: [Joint; JOINTS] = [
        Hips,
        Spine,
        Spine1,
        Neck,
        Head,
        LeftArm,
        LeftForeArm,
        LeftHand,
        RightArm,
        RightForeArm,
        RightHand,
        LeftUpLeg,
        LeftLeg,
        LeftFoot,
        LeftToeBase,
        RightUpLeg,
        RightLeg,
        RightFoot,
        RightToeBase,
    ];

    /// Returns the name of the joint, which is that of Mixamo's rigs without their prefix.
    pub fn name(self) -> &'static str {
        match self {
            Hips => "Hips",
            Spine => "Spine",
            Spine1 => "Spine1",
            Neck => "Neck",
            Head => "Head",
            LeftArm => "LeftArm",
            LeftForeArm => "LeftForeArm",
            LeftHand => "LeftHand",
            RightArm => "RightArm",
            RightForeArm => "RightForeArm",
            RightHand => "RightHand",
            LeftUpLeg => "LeftUpLeg",
            LeftLeg => "LeftLeg",
            LeftFoot => "LeftFoot",
            LeftToeBase => "LeftToeBase",
            RightUpLeg => "RightUpLeg",
            RightLeg => "RightLeg",
            RightFoot => "RightFoot",
            RightToeBase => "RightToeBase",
        }
    }

    /// Returns the parent of the joint: none for the hips.
    pub fn parent(self) -> Option<Joint> {
        Some(match self {
            Hips => return None,
            Spine | LeftUpLeg | RightUpLeg => Hips,
            Spine1 => Spine,
            Neck | LeftArm | RightArm => Spine1,
            Head => Neck,
            LeftForeArm => LeftArm,
            LeftHand => LeftForeArm,
            RightForeArm => RightArm,
            RightHand => RightForeArm,
            LeftLeg => LeftUpLeg,
            LeftFoot => LeftLeg,
            LeftToeBase => LeftFoot,
            RightLeg => RightUpLeg,
            RightFoot => RightLeg,
            RightToeBase => RightFoot,
        })
    }

    /// Returns the number of the joint in [`Joint::ALL`].
    pub fn index(self) -> usize {
        self as usize
    }
}

/// Where a joint is in the world, and how it is turned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placed {
    /// Position, m.
    pub position: DVec3,
    /// Rotation against the pose at rest.
    pub rotation: DQuat,
}

/// The lengths of the bones of a person.
///
/// At rest the person faces along the x axis, with y to the left and z up, the arms 45° from the body. All joints then
/// have no rotation, so the matrix of a joint at rest is a translation, and none mirrors.
///
/// ```
/// use throng_figure::{Joint, Person, Skeleton};
///
/// let skeleton = Skeleton::new(&Person::new(1, 1).with_height(1.8));
/// let joints = skeleton.world(&skeleton.rest());
/// assert!(joints[Joint::LeftHand.index()].position.y > 0.0);
/// assert!(joints.iter().all(|joint| joint.position.z > 0.0 && joint.position.z < 1.8));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Skeleton {
    offsets: [DVec3; JOINTS],
    binds: [Bind; JOINTS],
}

/// Where a joint is in the body as it was modelled, and the turn from there to the pose at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bind {
    pub position: DVec3,
    pub turn: DQuat,
}

impl Skeleton {
    /// Returns the skeleton of a person.
    pub fn new(person: &Person) -> Skeleton {
        Skeleton::scaled(person.build, person.height)
    }

    /// Returns the skeleton of a build, with this height (m).
    pub fn scaled(build: Build, height: f64) -> Skeleton {
        let body = Proportions::of(build);
        let mut offsets = [DVec3::ZERO; JOINTS];
        body.legs.put(&mut offsets);
        let mut put = |joint: Joint, x: f64, y: f64, z: f64| offsets[joint.index()] = DVec3::new(x, y, z);
        put(Spine, -0.006, 0.0, 0.058);
        put(Spine1, -0.006, 0.0, 0.100);
        put(Neck, -0.004, 0.0, body.torso - 0.158);
        put(Head, 0.016, 0.0, body.neck);
        let down = ARM_AT_REST;
        for (sign, [arm, forearm, hand]) in
            [(1.0, [LeftArm, LeftForeArm, LeftHand]), (-1.0, [RightArm, RightForeArm, RightHand])]
        {
            put(arm, -0.002, sign * body.shoulder, body.torso - 0.158 - 0.022);
            put(forearm, 0.0, sign * body.upper_arm * down, -body.upper_arm * down);
            put(hand, 0.0, sign * body.forearm * down, -body.forearm * down);
        }
        let offsets = offsets.map(|offset| offset * height);
        let binds = positions(&offsets).map(|position| Bind { position, turn: DQuat::IDENTITY });
        Skeleton { offsets, binds }
    }

    /// Returns the skeleton of a body that was modelled with its joints at `binds`.
    pub(crate) fn bound(offsets: [DVec3; JOINTS], binds: [Bind; JOINTS]) -> Skeleton {
        Skeleton { offsets, binds }
    }

    /// Returns the skeleton, larger by a factor.
    pub(crate) fn times(&self, factor: f64) -> Skeleton {
        Skeleton {
            offsets: self.offsets.map(|offset| offset * factor),
            binds: self.binds.map(|bind| Bind { position: bind.position * factor, ..bind }),
        }
    }

    /// Returns the position of a joint against its parent at rest, m: of the hips, against the ground.
    pub fn offset(&self, joint: Joint) -> DVec3 {
        self.offsets[joint.index()]
    }

    /// Returns the pose at rest, at the origin of the world.
    pub fn rest(&self) -> Pose {
        Pose { hips: self.offset(Hips), rotations: [DQuat::IDENTITY; JOINTS] }
    }

    /// Returns where each joint is in a pose, in the order of [`Joint::ALL`].
    pub fn world(&self, pose: &Pose) -> [Placed; JOINTS] {
        let mut placed = [Placed { position: pose.hips, rotation: pose.rotations[0] }; JOINTS];
        for joint in &Joint::ALL[1..] {
            let i = joint.index();
            let parent = placed[joint.parent().map_or(0, Joint::index)];
            placed[i] = Placed {
                position: parent.position + parent.rotation * self.offsets[i],
                rotation: parent.rotation * pose.rotations[i],
            };
        }
        placed
    }

    /// Returns where each joint is in the body as it was modelled, m.
    pub(crate) fn binds(&self) -> &[Bind; JOINTS] {
        &self.binds
    }

    /// Returns the bind matrix of each joint: its place and axes in a body as it was modelled, m.
    pub fn bind_matrices(&self) -> [DMat4; JOINTS] {
        self.binds.map(|bind| DMat4::from_rotation_translation(bind.turn.conjugate(), bind.position))
    }

    /// Returns the inverse bind matrix of each joint, as files of skins need it: it moves a body as it was modelled (m) to the
    /// axes of the joint.
    pub fn inverse_bind_matrices(&self) -> [DMat4; JOINTS] {
        self.binds.map(|bind| DMat4::from_rotation_translation(bind.turn, -(bind.turn * bind.position)))
    }

    /// Returns the matrix of each joint that moves a body as it was modelled (m) to where it is relative to `origin`, as
    /// pictures need it.
    pub fn skin_matrices(&self, joints: &[Placed; JOINTS], origin: DVec3) -> [Mat4; JOINTS] {
        std::array::from_fn(|joint| {
            let Placed { position, rotation } = joints[joint];
            let bind = self.binds[joint];
            let rotation = rotation * bind.turn;
            let shift = position - origin - rotation * bind.position;
            Mat4::from_translation(shift.as_vec3()) * Mat4::from_quat(rotation.as_quat())
        })
    }
}

/// Returns where joints with these offsets are at rest.
fn positions(offsets: &[DVec3; JOINTS]) -> [DVec3; JOINTS] {
    let mut positions = *offsets;
    for joint in &Joint::ALL[1..] {
        positions[joint.index()] += positions[joint.parent().map_or(0, Joint::index)];
    }
    positions
}
