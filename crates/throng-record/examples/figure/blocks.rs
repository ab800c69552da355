//! A figure of blocks as glTF, as programs of animators write it: each has its own names, axes, units and pose.

use glam::{DMat4, DQuat, DVec3};
use serde_json::{Value, json};

/// The joints of the figure, in the order of its nodes: the name in Mixamo's rigs, the parent.
const JOINTS: [(&str, Option<usize>); 19] = [
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

/// A figure of blocks. Lengths are metres.
#[derive(Clone, Debug)]
pub struct Blocks {
    pub thigh: f64,
    pub shank: f64,
    pub ankle: f64,
    pub heel: f64,
    pub ball: f64,
    pub foot: f64,
    pub toe_height: f64,
    /// Half the distance of the hip joints.
    pub hip: f64,
    pub torso: f64,
    pub head: f64,
    pub arm: f64,
    pub forearm: f64,
    /// Half the distance of the shoulder joints.
    pub shoulder: f64,
    /// The angle of the arms below the horizontal, rad: 0 is a T pose.
    pub drop: f64,
    /// The direction that the figure faces, rad from +z of the file towards +x.
    pub yaw: f64,
    pub names: Names,
    /// Lengths of nodes are centimetres, under a root with the scale 0.01 that also turns z up to y up.
    pub centimetres: bool,
    /// The axes of bones are turned.
    pub turned: bool,
    /// Two joints of fingers on each hand move the hand too, and a joint of a twist each thigh.
    pub extra: bool,
    /// Whether there are joints of the toes.
    pub toes: bool,
}

impl Default for Blocks {
    fn default() -> Self {
        Self {
            thigh: 0.43,
            shank: 0.42,
            ankle: 0.08,
            heel: 0.06,
            ball: 0.13,
            foot: 0.27,
            toe_height: 0.025,
            hip: 0.1,
            torso: 0.5,
            head: 0.26,
            arm: 0.29,
            forearm: 0.26,
            shoulder: 0.19,
            drop: 0.0,
            yaw: 0.0,
            names: Names::Mixamo,
            centimetres: false,
            turned: false,
            extra: false,
            toes: true,
        }
    }
}

/// A block: its joint, its corners in the axes of the body (ahead, left, up), its colour (linear).
struct Block {
    joint: usize,
    low: DVec3,
    high: DVec3,
    colour: [f64; 3],
}

/// A vertex of the figure at rest, in the axes of the body (ahead, left, up), from the ground below the hips, and its
/// joint.
pub type Corner = (DVec3, usize);

impl Blocks {
    /// Returns the height of the highest vertex.
    pub fn height(&self) -> f64 {
        self.hips() + self.torso + self.head
    }

    fn hips(&self) -> f64 {
        self.ankle + self.shank + self.thigh
    }

    /// Returns where the joints are: ahead, left, up.
    pub fn joints(&self) -> [DVec3; 19] {
        let mut at = [DVec3::ZERO; 19];
        at[0] = DVec3::new(0.01, 0.0, self.hips() + 0.05);
        at[1] = DVec3::new(0.0, 0.0, self.hips() + 0.12);
        at[2] = DVec3::new(-0.01, 0.0, self.hips() + 0.6 * self.torso);
        at[3] = DVec3::new(-0.01, 0.0, self.hips() + self.torso);
        at[4] = DVec3::new(0.01, 0.0, self.hips() + self.torso + 0.05);
        for (sign, arm, leg) in [(1.0, 5, 11), (-1.0, 8, 15)] {
            let along = DVec3::new(0.0, sign * self.drop.cos(), -self.drop.sin());
            at[arm] = DVec3::new(0.0, sign * self.shoulder, self.hips() + self.torso - 0.06);
            at[arm + 1] = at[arm] + along * self.arm;
            at[arm + 2] = at[arm + 1] + along * self.forearm;
            at[leg] = DVec3::new(0.0, sign * self.hip, self.hips());
            at[leg + 1] = at[leg] - DVec3::Z * self.thigh;
            at[leg + 2] = at[leg + 1] - DVec3::Z * self.shank;
            at[leg + 3] = DVec3::new(self.ball, sign * self.hip, self.toe_height);
        }
        at
    }

    /// Returns the blocks. Those of limbs are along x, and are turned to the bone later.
    fn blocks(&self) -> Vec<Block> {
        let at = self.joints();
        let (skin, cloth, shoe) = ([0.55, 0.3, 0.2], [0.05, 0.2, 0.5], [0.02, 0.02, 0.02]);
        let mut blocks = Vec::new();
        let mut add = |joint: usize, low: DVec3, high: DVec3, colour: [f64; 3]| {
            blocks.push(Block { joint, low, high, colour });
        };
        let wide = self.shoulder - 0.03;
        add(0, DVec3::new(-0.1, -wide, self.hips() - 0.04), DVec3::new(0.1, wide, at[1].z), [0.02, 0.05, 0.1]);
        add(1, DVec3::new(-0.09, -wide, at[1].z), DVec3::new(0.09, wide, at[2].z), cloth);
        add(2, DVec3::new(-0.1, -wide, at[2].z), DVec3::new(0.11, wide, at[3].z), cloth);
        add(3, DVec3::new(-0.04, -0.04, at[3].z), DVec3::new(0.04, 0.04, at[4].z), skin);
        add(4, DVec3::new(-0.09, -0.08, at[4].z), DVec3::new(0.1, 0.08, self.height()), skin);
        // the nose says where the figure looks
        add(4, DVec3::new(0.1, -0.015, at[4].z + 0.08), DVec3::new(0.13, 0.015, at[4].z + 0.11), [0.8, 0.1, 0.1]);
        for (leg, sign) in [(11, 1.0), (15, -1.0)] {
            let y = sign * self.hip;
            let box_of = |x: [f64; 2], half: f64, z: [f64; 2]| {
                (DVec3::new(x[0], y - half, z[0]), DVec3::new(x[1], y + half, z[1]))
            };
            let (low, high) = box_of([-0.07, 0.07], 0.07, [at[leg + 1].z, at[leg].z]);
            add(leg, low, high, [0.02, 0.05, 0.1]);
            let (low, high) = box_of([-0.055, 0.055], 0.055, [at[leg + 2].z, at[leg + 1].z]);
            add(leg + 1, low, high, [0.02, 0.05, 0.1]);
            let (low, high) = box_of([-self.heel, self.ball], 0.045, [0.0, self.ankle]);
            add(leg + 2, low, high, shoe);
            let (low, high) = box_of([self.ball, self.foot - self.heel], 0.045, [0.0, 2.0 * self.toe_height]);
            add(leg + 3, low, high, shoe);
        }
        for arm in [5, 8] {
            for (joint, to, thick, colour) in
                [(arm, arm + 1, 0.05, cloth), (arm + 1, arm + 2, 0.04, skin), (arm + 2, arm + 2, 0.035, skin)]
            {
                let length = if joint == to { 0.16 } else { at[joint].distance(at[to]) };
                let (low, high) = (DVec3::new(0.0, -thick, -thick), DVec3::new(length, thick, thick));
                add(joint, low, high, colour);
            }
        }
        blocks
    }

    /// Returns the corners of all blocks at rest, 24 a block, with their normals and colours.
    fn corners(&self) -> Vec<(DVec3, DVec3, usize, [f64; 3])> {
        let at = self.joints();
        let mut corners = Vec::new();
        for block in self.blocks() {
            let limb = (5..11).contains(&block.joint);
            let sign = if block.joint < 8 { 1.0 } else { -1.0 };
            let along = DQuat::from_rotation_arc(DVec3::X, DVec3::new(0.0, sign * self.drop.cos(), -self.drop.sin()));
            let placed = |own: DVec3| if limb { at[block.joint] + along * own } else { own };
            for axis in 0..3 {
                for side in [0.0, 1.0] {
                    let mut normal = DVec3::ZERO;
                    normal[axis] = 2.0 * side - 1.0;
                    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
                    // counterclockwise from outside
                    let order =
                        if side > 0.5 { [[0, 0], [1, 0], [1, 1], [0, 1]] } else { [[0, 0], [0, 1], [1, 1], [1, 0]] };
                    for [a, b] in order {
                        let mut share = DVec3::ZERO;
                        (share[axis], share[u], share[v]) = (side, f64::from(a), f64::from(b));
                        let own = block.low + (block.high - block.low) * share;
                        let turned = if limb { along * normal } else { normal };
                        corners.push((placed(own), turned, block.joint, block.colour));
                    }
                }
            }
        }
        corners
    }

    /// Returns the vertices at rest and the joints that move them.
    pub fn vertices(&self) -> Vec<Corner> {
        self.corners().into_iter().map(|(place, _, joint, _)| (place, joint)).collect()
    }

    /// Returns the name of a joint in the file.
    fn name(&self, joint: usize) -> String {
        match self.names {
            Names::Mixamo => JOINTS[joint].0.to_owned(),
            Names::Prefixed => format!("mixamorig1:{}", JOINTS[joint].0),
            Names::Vrm => VRM[joint].to_owned(),
            Names::Blender => BLENDER[joint].to_owned(),
            Names::Unreal => UNREAL[joint].to_owned(),
            Names::Extension(_) => format!("bone {joint}"),
        }
    }

    /// Returns the JSON and the binary chunk of the file. The JSON can be changed before it is packed.
    pub fn parts(&self) -> (Value, Vec<u8>) {
        let turn = DQuat::from_rotation_y(self.yaw);
        // ahead, left, up of the body to x, y, z of the file
        let file = |v: DVec3| turn * DVec3::new(v.y, v.z, v.x);
        let root = if self.centimetres {
            DMat4::from_scale(DVec3::splat(0.01)) * DMat4::from_rotation_x(-std::f64::consts::FRAC_PI_2)
        } else {
            DMat4::IDENTITY
        };
        let at = self.joints();
        // the transform of each joint to the world: with axes of its own
        let world: Vec<DMat4> = (0..19)
            .map(|joint| {
                let k = joint as f64;
                let axes =
                    DQuat::from_axis_angle(DVec3::new((k * 1.7).sin(), (k * 0.9).cos(), 0.3).normalize(), 0.5 + k);
                let axes = if self.turned { axes } else { DQuat::IDENTITY };
                let scale = if self.centimetres { 0.01 } else { 1.0 };
                DMat4::from_scale_rotation_translation(DVec3::splat(scale), axes, file(at[joint]))
            })
            .collect();
        let mut nodes = vec![json!({ "name": "Armature", "children": [1], "matrix": root.to_cols_array() })];
        let mut worlds = vec![root];
        for (joint, (_, parent)) in JOINTS.iter().enumerate() {
            let above = parent.map_or(root, |parent| world[parent]);
            let local = above.inverse() * world[joint];
            let (scale, rotation, place) = local.to_scale_rotation_translation();
            let children: Vec<usize> =
                (0..19).filter(|&other| JOINTS[other].1 == Some(joint)).map(|other| other + 1).collect();
            let mut node = json!({
                "name": self.name(joint),
                "translation": place.to_array(), "rotation": rotation.to_array(), "scale": scale.to_array(),
            });
            if !children.is_empty() {
                node["children"] = children.into();
            }
            nodes.push(node);
            worlds.push(world[joint]);
        }
        // joints that are none of the 19: two for each hand, one for each thigh
        let mut extra: Vec<(usize, usize)> = Vec::new();
        if self.extra {
            for (parent, name) in
                [(7, "LeftHandIndex1"), (10, "RightHandIndex1"), (11, "thigh_twist_01_l"), (15, "thigh_twist_01_r")]
            {
                let node = nodes.len();
                extra.push((parent, node));
                nodes.push(json!({ "name": name, "translation": [0.03, 0.02, 0.01] }));
                worlds.push(world[parent] * DMat4::from_translation(DVec3::new(0.03, 0.02, 0.01)));
                let children = &mut nodes[parent + 1]["children"];
                match children.as_array_mut() {
                    Some(all) => all.push(node.into()),
                    None => *children = json!([node]),
                }
            }
        }
        let corners = self.corners();
        // a mesh has a space of its own: here that of the root
        let own = root.inverse();
        let mut bin: Vec<u8> = Vec::new();
        let (mut views, mut accessors) = (Vec::new(), Vec::new());
        let mut put = |bytes: Vec<u8>, kind: &str, component: u32, count: usize| {
            views.push(json!({ "buffer": 0, "byteOffset": bin.len(), "byteLength": bytes.len() }));
            accessors.push(
                json!({ "bufferView": views.len() - 1, "componentType": component, "type": kind, "count": count }),
            );
            bin.extend(bytes);
            bin.resize(bin.len().next_multiple_of(4), 0);
            accessors.len() - 1
        };
        let floats = |all: &mut dyn Iterator<Item = f32>| all.flat_map(f32::to_le_bytes).collect::<Vec<u8>>();
        let count = corners.len();
        let point = |v: DVec3| own.transform_point3(file(v)).as_vec3().to_array();
        let normal = |v: DVec3| own.transform_vector3(file(v)).normalize().as_vec3().to_array();
        let positions = put(floats(&mut corners.iter().flat_map(|corner| point(corner.0))), "VEC3", 5126, count);
        let normals = put(floats(&mut corners.iter().flat_map(|corner| normal(corner.1))), "VEC3", 5126, count);
        let colours =
            put(floats(&mut corners.iter().flat_map(|corner| corner.3.map(|part| part as f32))), "VEC3", 5126, count);
        let mut joints: Vec<u8> = Vec::new();
        let mut weights: Vec<f32> = Vec::new();
        for &(_, _, joint, _) in &corners {
            let joint = if !self.toes && (joint == 14 || joint == 18) { joint - 1 } else { joint };
            // the number of a joint in the skin is that of its node, less one
            match extra.iter().find(|(parent, _)| *parent == joint) {
                Some((_, node)) => {
                    joints.extend([joint as u8, (*node - 1) as u8, 0, 0]);
                    weights.extend([0.4, 0.2, 0.0, 0.0]);
                }
                None => {
                    joints.extend([joint as u8, 0, 0, 0]);
                    weights.extend([1.0, 0.0, 0.0, 0.0]);
                }
            }
        }
        let joints = put(joints, "VEC4", 5121, count);
        let weights = put(floats(&mut weights.into_iter()), "VEC4", 5126, count);
        let corner = |face: u16| [0, 1, 2, 0, 2, 3].map(|k| 4 * face + k);
        let triangles: Vec<u16> = (0..count as u16 / 4).flat_map(corner).collect();
        let indices = triangles.len();
        let triangles = put(triangles.into_iter().flat_map(u16::to_le_bytes).collect(), "SCALAR", 5123, indices);
        let binds: Vec<f32> =
            worlds[1..].iter().flat_map(|world| (world.inverse() * root).as_mat4().to_cols_array()).collect();
        let skin_joints: Vec<usize> = (1..nodes.len()).collect();
        let binds = put(floats(&mut binds.into_iter()), "MAT4", 5126, skin_joints.len());
        nodes.push(json!({ "name": "Body", "mesh": 0, "skin": 0 }));
        if !self.toes {
            // as if the figure had none: their names mean nothing
            (nodes[15]["name"], nodes[19]["name"]) = ("tip l".into(), "tip r".into());
        }
        let body = nodes.len() - 1;
        let mut json = json!({
            "asset": { "version": "2.0", "generator": "blocks" },
            "scene": 0,
            "scenes": [{ "nodes": [0, body] }],
            "nodes": nodes,
            "meshes": [{ "primitives": [{
                "attributes": {
                    "POSITION": positions, "NORMAL": normals, "COLOR_0": colours, "JOINTS_0": joints, "WEIGHTS_0": weights,
                },
                "indices": triangles,
            }] }],
            "skins": [{ "joints": skin_joints, "inverseBindMatrices": binds }],
            "accessors": accessors,
            "bufferViews": views,
            "buffers": [{ "byteLength": bin.len() }],
        });
        if let Names::Extension(new) = self.names {
            let bones = [
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
            json["extensions"] = if new {
                let all = bones.iter().enumerate().map(|(k, bone)| ((*bone).to_owned(), json!({ "node": k + 1 })));
                json!({ "VRMC_vrm": { "humanoid": { "humanBones": Value::Object(all.collect()) } } })
            } else {
                let all: Vec<Value> =
                    bones.iter().enumerate().map(|(k, bone)| json!({ "bone": bone, "node": k + 1 })).collect();
                json!({ "VRM": { "humanoid": { "humanBones": all } } })
            };
        }
        (json, bin)
    }

    /// Returns the file.
    pub fn glb(&self) -> Vec<u8> {
        let (json, bin) = self.parts();
        packed(&json, &bin)
    }
}

/// Returns a `.glb` file of JSON and a binary chunk.
pub fn packed(json: &Value, bin: &[u8]) -> Vec<u8> {
    let mut text = serde_json::to_vec(json).expect("JSON can be written");
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut bin = bin.to_vec();
    bin.resize(bin.len().next_multiple_of(4), 0);
    let whole = 12 + 8 + text.len() + 8 + bin.len();
    let mut bytes = Vec::new();
    let word = |number: usize| (number as u32).to_le_bytes();
    bytes.extend([*b"glTF", word(2), word(whole), word(text.len()), *b"JSON"].concat());
    bytes.extend(text);
    bytes.extend([word(bin.len()), *b"BIN\0"].concat());
    bytes.extend(bin);
    bytes
}
