//! The names of joints in programs of animators.

/// The joints of the figure, in the order of its nodes: the name in Mixamo's rigs, the parent.
pub(super) const JOINTS: [(&str, Option<usize>); 19] = [
    ("Hips", None),
    ("Spine", Some(0)),
    ("Spine1", Some(1)),
    ("Neck", Some(2)),
    ("Head", Some(3)),
    ("LeftArm", Some(2)),
    ("LeftForeArm", Some(5)),
    ("LeftHand", Some(6)),
    ("RightArm", Some(2)),
    ("RightForeArm", Some(8)),
    ("RightHand", Some(9)),
    ("LeftUpLeg", Some(0)),
    ("LeftLeg", Some(11)),
    ("LeftFoot", Some(12)),
    ("LeftToeBase", Some(13)),
    ("RightUpLeg", Some(0)),
    ("RightLeg", Some(15)),
    ("RightFoot", Some(16)),
    ("RightToeBase", Some(17)),
];
/// The names of the same joints in VRM, Blender's metarig and Unreal.
const VRM: [&str; 19] = [
    "J_Bip_C_Hips",
    "J_Bip_C_Spine",
    "J_Bip_C_Chest",
    "J_Bip_C_Neck",
    "J_Bip_C_Head",
    "J_Bip_L_UpperArm",
    "J_Bip_L_LowerArm",
    "J_Bip_L_Hand",
    "J_Bip_R_UpperArm",
    "J_Bip_R_LowerArm",
    "J_Bip_R_Hand",
    "J_Bip_L_UpperLeg",
    "J_Bip_L_LowerLeg",
    "J_Bip_L_Foot",
    "J_Bip_L_ToeBase",
    "J_Bip_R_UpperLeg",
    "J_Bip_R_LowerLeg",
    "J_Bip_R_Foot",
    "J_Bip_R_ToeBase",
];
const BLENDER: [&str; 19] = [
    "spine",
    "spine.001",
    "spine.002",
    "spine.004",
    "spine.006",
    "upper_arm.L",
    "forearm.L",
    "hand.L",
    "upper_arm.R",
    "forearm.R",
    "hand.R",
    "thigh.L",
    "shin.L",
    "foot.L",
    "toe.L",
    "thigh.R",
    "shin.R",
    "foot.R",
    "toe.R",
];
const UNREAL: [&str; 19] = [
    "pelvis",
    "spine_01",
    "spine_02",
    "neck_01",
    "head",
    "upperarm_l",
    "lowerarm_l",
    "hand_l",
    "upperarm_r",
    "lowerarm_r",
    "hand_r",
    "thigh_l",
    "calf_l",
    "foot_l",
    "ball_l",
    "thigh_r",
    "calf_r",
    "foot_r",
    "ball_r",
];

/// How joints are named.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Names {
    Mixamo,
    /// With the prefix `mixamorig1:`.
    Prefixed,
    Vrm,
    Blender,
    Unreal,
    /// Bones without meaning; the extension of VRM 1.0 (or 0.x) says what they are.
    Extension(bool),
}

/// The humanoid bones of VRM, in the same order.
pub(super) const HUMANOID: [&str; 19] = [
    "hips",
    "spine",
    "chest",
    "neck",
    "head",
    "leftUpperArm",
    "leftLowerArm",
    "leftHand",
    "rightUpperArm",
    "rightLowerArm",
    "rightHand",
    "leftUpperLeg",
    "leftLowerLeg",
    "leftFoot",
    "leftToes",
    "rightUpperLeg",
    "rightLowerLeg",
    "rightFoot",
    "rightToes",
];

impl Names {
    /// Returns the name of a joint in the file.
    pub(super) fn of(self, joint: usize) -> String {
        match self {
            Names::Mixamo => JOINTS[joint].0.to_owned(),
            Names::Prefixed => format!("mixamorig1:{}", JOINTS[joint].0),
            Names::Vrm => VRM[joint].to_owned(),
            Names::Blender => BLENDER[joint].to_owned(),
            Names::Unreal => UNREAL[joint].to_owned(),
            Names::Extension(_) => format!("bone {joint}"),
        }
    }
}
