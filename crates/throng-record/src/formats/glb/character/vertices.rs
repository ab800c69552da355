//! The vertices of a file, at rest in the world of the file.

use super::joints::{Joints, called, joints_of};
use super::materials::Materials;
use crate::formats::glb::data::Data;
use crate::people::axes;
use glam::{DMat3, DMat4, DVec3, Vec3};
use serde_json::Value;
use throng_figure::{JOINTS, Joint, RestBody};

/// The most vertices and triangles of a body.
const MOST_VERTICES: usize = 200_000;
const MOST_TRIANGLES: usize = 400_000;
/// The most groups of four joints that move a vertex.
const SETS: usize = 4;

/// The joints that move the vertices of a mesh.
struct Skin {
    /// For each joint of the skin: ours that it follows, and the transform of vertices at rest.
    joints: Vec<(Joint, DMat4)>,
    name: String,
}

/// Adds all meshes that joints move to a body.
///
/// # Errors
/// The data are damaged, mirrored or too large.
pub(super) fn add(body: &mut RestBody, data: &Data, joints: &Joints) -> Result<(), String> {
    let nodes = &data.root.nodes;
    let mut materials = Materials::default();
    for (at, node) in nodes.iter().enumerate() {
        let Some(mesh) = node.mesh else { continue };
        let skin = match node.skin {
            Some(skin) => Skin::of(data, joints, skin)?,
            // what a joint carries, such as a hat; what none carries is no part of the body
            None => match joints.follows[at] {
                Some(joint) => Skin { joints: vec![(joint, joints.world[at])], name: called(nodes, at) },
                None => continue,
            },
        };
        skin.check()?;
        let mesh = data.root.meshes.get(mesh).ok_or_else(|| format!("there is no mesh {mesh}"))?;
        for primitive in mesh["primitives"].as_array().into_iter().flatten() {
            add_primitive((body, &mut materials), data, &skin, node.skin.is_some(), primitive)?;
        }
    }
    Ok(())
}

impl Skin {
    fn of(data: &Data, joints: &Joints, at: usize) -> Result<Self, String> {
        let skin = data.root.skins.get(at).ok_or_else(|| format!("there is no skin {at}"))?;
        let nodes = joints_of(skin);
        let binds = match skin["inverseBindMatrices"].as_u64() {
            Some(accessor) => data.numbers::<16>(usize::try_from(accessor).unwrap_or(usize::MAX))?,
            None => vec![glam::Mat4::IDENTITY.to_cols_array(); nodes.len()],
        };
        if binds.len() < nodes.len() {
            return Err(format!("skin {at} has {} joints, but {} inverse bind matrices", nodes.len(), binds.len()));
        }
        let joint = |(&node, bind): (&usize, &[f32; 16])| {
            let world =
                joints.world.get(node).ok_or_else(|| format!("skin {at} names node {node}, which does not exist"))?;
            // what is above all joints moves with the hips
            let follows = joints.follows[node].unwrap_or(Joint::Hips);
            Ok((follows, *world * DMat4::from_cols_array(&bind.map(f64::from))))
        };
        let joints = nodes.iter().zip(&binds).map(joint).collect::<Result<_, String>>()?;
        Ok(Self { joints, name: format!("skin {at}") })
    }

    /// Checks that no joint mirrors or flattens its vertices.
    fn check(&self) -> Result<(), String> {
        for (number, (_, matrix)) in self.joints.iter().enumerate() {
            let determinant = matrix.determinant();
            let name = &self.name;
            if determinant < 0.0 {
                return Err(format!(
                    "joint {number} of {name} mirrors the mesh (its matrix has a negative determinant); apply all negative scales before export"
                ));
            }
            if !(determinant > 0.0 && determinant.is_finite()) {
                return Err(format!("joint {number} of {name} flattens the mesh (its matrix has no inverse)"));
            }
        }
        Ok(())
    }
}

/// Adds a part of a mesh.
fn add_primitive(
    (body, materials): (&mut RestBody, &mut Materials),
    data: &Data,
    skin: &Skin,
    skinned: bool,
    primitive: &Value,
) -> Result<(), String> {
    match primitive["mode"].as_u64().unwrap_or(4) {
        4 => {}
        // points and lines
        0..=3 => return Ok(()),
        mode => return Err(format!("a mesh has strips or fans of triangles (mode {mode}); export plain triangles")),
    }
    let attributes = &primitive["attributes"];
    let accessor = |value: &Value| value.as_u64().and_then(|at| usize::try_from(at).ok());
    let attribute = |name: &str| accessor(&attributes[name]);
    let positions = attribute("POSITION").ok_or("a mesh has no positions")?;
    let count = |at: usize| data.root.accessors.get(at).map_or(0, |accessor| accessor.count);
    let indices = accessor(&primitive["indices"]);
    let corners = indices.map_or_else(|| count(positions), count);
    if body.positions.len() as u64 + count(positions) > MOST_VERTICES as u64 {
        return Err(format!("the body has more than {MOST_VERTICES} vertices; export a coarser body"));
    }
    if body.triangles.len() as u64 + corners / 3 > MOST_TRIANGLES as u64 {
        return Err(format!("the body has more than {MOST_TRIANGLES} triangles; export a coarser body"));
    }
    let positions = data.numbers::<3>(positions)?;
    let normals = attribute("NORMAL").map(|at| data.numbers::<3>(at)).transpose()?;
    let normals = normals.filter(|normals| normals.len() == positions.len());
    let sets = if skinned { weights(data, attributes, positions.len())? } else { Vec::new() };
    let colours = materials.colours(data, primitive, positions.len())?;
    let first = body.positions.len() as u32;
    // a body has all normals, or none
    let all = body.normals.len() == body.positions.len();
    for (vertex, position) in positions.iter().enumerate() {
        let (matrix, shares) = if skinned {
            skin.moved(sets.iter().map(|(joints, weights)| (&joints[vertex], &weights[vertex])))
                .map_err(|why| format!("vertex {vertex} of {}: {why}", skin.name))?
        } else {
            let mut shares = [0.0; JOINTS];
            shares[skin.joints[0].0.index()] = 1.0;
            (skin.joints[0].1, shares)
        };
        let position = DVec3::from_array(position.map(f64::from));
        body.positions.push(axes::place(matrix.transform_point3(position)));
        if let Some(normals) = normals.as_ref().filter(|_| all) {
            let normal = DVec3::from_array(normals[vertex].map(f64::from));
            let turned = DMat3::from_mat4(matrix).inverse().transpose() * normal;
            body.normals.push(axes::place(turned).as_vec3().normalize_or(Vec3::Z));
        }
        let (numbers, weights) = largest(&shares);
        body.numbers.push(numbers);
        body.weights.push(weights);
    }
    body.colours.extend(colours);
    if body.normals.len() < body.positions.len() {
        body.normals.clear();
    }
    let corners: Vec<u32> = match indices {
        Some(at) => data.whole_numbers::<1>(at)?.into_iter().map(|[index]| index).collect(),
        None => (0..positions.len() as u32).collect(),
    };
    if let Some(index) = corners.iter().find(|&&index| index as usize >= positions.len()) {
        return Err(format!("a triangle names vertex {index} of {}", positions.len()));
    }
    body.triangles
        .extend(corners.chunks_exact(3).map(|corner| [corner[0] + first, corner[1] + first, corner[2] + first]));
    Ok(())
}

/// The joints of all vertices, four each, and their weights.
type WeightSet = (Vec<[u32; 4]>, Vec<[f32; 4]>);

/// Returns the joints and weights of a part of a mesh.
fn weights(data: &Data, attributes: &Value, vertices: usize) -> Result<Vec<WeightSet>, String> {
    let mut sets = Vec::new();
    for set in 0..SETS {
        let accessor = |name: &str| attributes[format!("{name}_{set}")].as_u64().map(|at| at as usize);
        let Some((joints, weights)) = accessor("JOINTS").zip(accessor("WEIGHTS")) else { break };
        let found = (data.whole_numbers::<4>(joints)?, data.numbers::<4>(weights)?);
        if found.0.len() != vertices || found.1.len() != vertices {
            return Err(format!("a mesh has {vertices} vertices, but other numbers of joints and weights"));
        }
        sets.push(found);
    }
    if sets.is_empty() { Err("a mesh with a skin has no joints and weights".to_owned()) } else { Ok(sets) }
}

impl Skin {
    /// Returns the mixed transform of a vertex to its place at rest, and the share of each of our joints.
    fn moved<'a>(
        &self,
        sets: impl Iterator<Item = (&'a [u32; 4], &'a [f32; 4])> + Clone,
    ) -> Result<(DMat4, [f32; JOINTS]), String> {
        let parts =
            || sets.clone().flat_map(|(joints, weights)| joints.iter().zip(weights)).filter(|(_, w)| **w != 0.0);
        let sum: f32 = parts().map(|(_, weight)| *weight).sum();
        if !(sum > 0.0 && sum.is_finite()) || parts().any(|(_, weight)| *weight < 0.0) {
            return Err("it has no weight for any joint; give each vertex a joint (normalise all weights)".to_owned());
        }
        let (mut matrix, mut shares) = (DMat4::ZERO, [0.0; JOINTS]);
        for (&number, &weight) in parts() {
            let joint = self.joints.get(number as usize);
            let (joint, own) = joint.ok_or_else(|| format!("it names joint {number} of {}", self.joints.len()))?;
            matrix += *own * f64::from(weight / sum);
            shares[joint.index()] += weight / sum;
        }
        Ok((matrix, shares))
    }
}

/// Returns the four largest shares and their joints.
fn largest(shares: &[f32; JOINTS]) -> ([u8; 4], [f32; 4]) {
    let mut order: [usize; JOINTS] = std::array::from_fn(|joint| joint);
    order.sort_by(|&a, &b| shares[b].total_cmp(&shares[a]));
    let numbers = [0, 1, 2, 3].map(|k| order[k]);
    let weights = numbers.map(|joint| shares[joint]);
    (numbers.map(|joint| joint as u8), weights)
}
