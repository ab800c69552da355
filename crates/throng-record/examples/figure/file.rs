//! The figure as a file.

use super::names::{HUMANOID, JOINTS};
use super::{Blocks, Names};
use glam::{DMat4, DQuat, DVec3};
use serde_json::{Value, json};

impl Blocks {
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
                "name": self.names.of(joint),
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
            json["extensions"] = if new {
                let all = HUMANOID.iter().enumerate().map(|(k, bone)| ((*bone).to_owned(), json!({ "node": k + 1 })));
                json!({ "VRMC_vrm": { "humanoid": { "humanBones": Value::Object(all.collect()) } } })
            } else {
                let all: Vec<Value> =
                    HUMANOID.iter().enumerate().map(|(k, bone)| json!({ "bone": bone, "node": k + 1 })).collect();
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
