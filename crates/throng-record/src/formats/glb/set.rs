//! Sets: all meshes of a file, to look at.

use super::data::{Data, number};
use super::nodes::{Nodes, called};
use super::part::{Limits, Part, Parts};
use crate::SetMesh;
use crate::formats::FormatFlaw;
use crate::people::axes;
use glam::{DMat3, DMat4, DVec3, Vec3};
use serde_json::Value;

const HINT: &str = "a set is a .glb file (or a .gltf file with everything in it) of at most 64 MB, with plain triangles (docs/scenes.md)";

/// How much of a file is read.
const LIMITS: Limits = Limits { of: "set", parts: 65_536, triangles: 2_000_000 };
/// Materials with less opacity are left out: one sees through them.
const CLEAR: f64 = 0.5;

/// Reads a set.
///
/// # Errors
/// The file is no glTF, has no triangles, is damaged or too large.
pub(crate) fn read(bytes: &[u8]) -> Result<SetMesh, FormatFlaw> {
    parse(bytes).map_err(|why| FormatFlaw { line: None, why, hint: Some(HINT) })
}

fn parse(bytes: &[u8]) -> Result<SetMesh, String> {
    let data = Data::open_any(bytes)?;
    let nodes = Nodes::of(&data.root.nodes)?;
    let mut parts = Parts::of(&data, LIMITS)?;
    let mut set = SetMesh::default();
    for at in nodes.order {
        let Some(mesh) = data.root.nodes[at].mesh else { continue };
        let mesh = data.root.meshes.get(mesh).ok_or_else(|| format!("there is no mesh {mesh}"))?;
        let opaque = |part: &&Value| !is_clear(&data, part);
        for primitive in mesh["primitives"].as_array().into_iter().flatten().filter(opaque) {
            let Some(part) = parts.read(primitive)? else { continue };
            add(&mut set, &part, nodes.world[at]);
        }
        if set.positions.iter().any(|place| !place.is_finite()) {
            return Err(format!("{} has a vertex that is not finite", called(&data.root.nodes, at)));
        }
    }
    if set.triangles.is_empty() { Err("the file has no triangles".to_owned()) } else { Ok(set) }
}

/// Whether one sees through the material of a part.
fn is_clear(data: &Data, primitive: &Value) -> bool {
    let material = number(&primitive["material"]).and_then(|at| data.root.materials.get(at));
    material.is_some_and(|material| {
        let opacity = material["pbrMetallicRoughness"]["baseColorFactor"][3].as_f64().unwrap_or(1.0);
        material["alphaMode"].as_str() == Some("BLEND") && opacity < CLEAR
    })
}

/// Adds a part with the transform of its node. A part without normals has those of its triangles.
fn add(set: &mut SetMesh, part: &Part, world: DMat4) {
    let place = |vertex: u32| {
        let position = DVec3::from_array(part.positions[vertex as usize].map(f64::from));
        axes::place(world.transform_point3(position)).as_vec3()
    };
    let mirrored = world.determinant() < 0.0;
    let order = |corners: [u32; 3]| if mirrored { [corners[0], corners[2], corners[1]] } else { corners };
    let triangles = part.corners.as_chunks::<3>().0.iter().copied().map(order);
    let first = set.positions.len() as u32;
    match &part.normals {
        Some(normals) => {
            // of a flat node, which has no inverse, the normals stay
            let matrix = DMat3::from_mat4(world);
            let turn = if matrix.determinant() == 0.0 { matrix } else { matrix.inverse().transpose() };
            let normal = |normal: &[f32; 3]| {
                axes::place(turn * DVec3::from_array(normal.map(f64::from))).as_vec3().normalize_or(Vec3::Z)
            };
            set.positions.extend((0..part.positions.len() as u32).map(place));
            set.normals.extend(normals.iter().map(normal));
            set.colors.extend(&part.colours);
            set.triangles.extend(triangles.map(|corners| corners.map(|vertex| first + vertex)));
        }
        None => {
            for (at, corners) in triangles.enumerate() {
                let places = corners.map(place);
                let normal = (places[1] - places[0]).cross(places[2] - places[0]).normalize_or(Vec3::Z);
                set.positions.extend(places);
                set.normals.extend([normal; 3]);
                set.colors.extend(corners.map(|vertex| part.colours[vertex as usize]));
                let corner = first + 3 * at as u32;
                set.triangles.push([corner, corner + 1, corner + 2]);
            }
        }
    }
}
