//! The vertices of a file, at rest in the world of the file.

use super::joints::{Joints, joints_of};
use crate::formats::glb::data::{Data, number};
use crate::formats::glb::nodes::called;
use crate::formats::glb::part::{Limits, Part, Parts, attribute};
use crate::people::axes;
use glam::{DMat3, DMat4, DVec3, Vec3};
use serde_json::Value;
use throng_figure::{JOINTS, Joint, RestBody};

/// The most vertices of a body.
const MOST_VERTICES: usize = 200_000;
/// How much of a file is read.
const LIMITS: Limits = Limits { of: "body", parts: 1_024, triangles: 400_000 };
/// The most groups of four joints that move a vertex.
const SETS: usize = 4;
/// The most joints of a skin.
const MOST_JOINTS: usize = 4_096;

/// The joints that move the vertices of a mesh.
struct Skin {
    /// For each joint of the skin: ours that it follows, and the transform of vertices at rest.
    joints: Vec<(Joint, DMat4)>,
    /// Whether vertices have weights; otherwise the only joint moves all of them.
    bends: bool,
    name: String,
}

/// A body under construction.
struct Builder<'a> {
    body: &'a mut RestBody,
    data: &'a Data<'a>,
    parts: Parts<'a>,
}

/// Adds all meshes that joints move to a body.
///
/// # Errors
/// The data are damaged, mirrored or too large.
pub(super) fn add(body: &mut RestBody, data: &Data, joints: &Joints) -> Result<(), String> {
    let nodes = &data.root.nodes;
    let mut builder = Builder { body, data, parts: Parts::of(data, LIMITS)? };
    for (at, node) in nodes.iter().enumerate() {
        let Some(mesh) = node.mesh else { continue };
        let skin = match node.skin {
            Some(skin) => Skin::of(data, joints, skin)?,
            // what a joint carries, such as a hat; what none carries is no part of the body
            None => match joints.follows[at] {
                Some(joint) => Skin::rigid(joint, joints.world[at], called(nodes, at)),
                None => continue,
            },
        };
        skin.check()?;
        let mesh = data.root.meshes.get(mesh).ok_or_else(|| format!("there is no mesh {mesh}"))?;
        for primitive in mesh["primitives"].as_array().into_iter().flatten() {
            builder.add(&skin, primitive)?;
        }
    }
    // a body has all normals, or none
    if builder.body.normals.len() < builder.body.positions.len() {
        builder.body.normals.clear();
    }
    Ok(())
}

impl Skin {
    fn of(data: &Data, joints: &Joints, at: usize) -> Result<Self, String> {
        let skin = data.root.skins.get(at).ok_or_else(|| format!("there is no skin {at}"))?;
        let nodes = joints_of(skin);
        if nodes.len() > MOST_JOINTS {
            return Err(format!("skin {at} has more than {MOST_JOINTS} joints"));
        }
        let binds = match number(&skin["inverseBindMatrices"]) {
            Some(accessor) => data.numbers::<16>(accessor)?,
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
        Ok(Self { joints, bends: true, name: format!("skin {at}") })
    }

    /// Returns the skin of a mesh that one joint carries.
    fn rigid(joint: Joint, matrix: DMat4, name: String) -> Self {
        Self { joints: vec![(joint, matrix)], bends: false, name }
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

impl Builder<'_> {
    /// Adds a part of a mesh.
    fn add(&mut self, skin: &Skin, primitive: &Value) -> Result<(), String> {
        let Some(Part { positions, normals, colours, corners }) = self.parts.read(primitive)? else { return Ok(()) };
        let (attributes, vertices) = (&primitive["attributes"], positions.len() as u64);
        let sets = if skin.bends { weights(self.data, attributes, vertices)? } else { Vec::new() };
        // parts of a mesh may share their vertices: only those of the triangles count
        let mut numbers: Vec<Option<u32>> = vec![None; positions.len()];
        for corner in corners.chunks_exact(3) {
            let mut triangle = [0; 3];
            for (own, &index) in triangle.iter_mut().zip(corner) {
                let vertex = index as usize;
                *own = match numbers[vertex] {
                    Some(known) => known,
                    None => {
                        let new = self.body.positions.len() as u32;
                        let sets = sets.iter().map(|(joints, weights)| (&joints[vertex], &weights[vertex]));
                        let moved = skin.moved(sets).map_err(|why| format!("vertex {vertex} of {}: {why}", skin.name));
                        let normal = normals.as_ref().map(|normals| normals[vertex]);
                        self.vertex(moved?, positions[vertex], normal, colours[vertex])?;
                        numbers[vertex] = Some(new);
                        new
                    }
                };
            }
            self.body.triangles.push(triangle);
        }
        Ok(())
    }

    /// Adds a vertex: its transform and the shares of our joints, its position, normal and colour.
    fn vertex(
        &mut self,
        (matrix, shares): (DMat4, [f32; JOINTS]),
        position: [f32; 3],
        normal: Option<[f32; 3]>,
        colour: [u8; 3],
    ) -> Result<(), String> {
        let body = &mut *self.body;
        if body.positions.len() >= MOST_VERTICES {
            return Err(format!("the body has more than {MOST_VERTICES} vertices; export a coarser body"));
        }
        let exact = |v: [f32; 3]| DVec3::from_array(v.map(f64::from));
        body.positions.push(axes::place(matrix.transform_point3(exact(position))));
        if let Some(normal) = normal {
            let turned = DMat3::from_mat4(matrix).inverse().transpose() * exact(normal);
            body.normals.push(axes::place(turned).as_vec3().normalize_or(Vec3::Z));
        }
        let (numbers, weights) = largest(&shares);
        body.numbers.push(numbers);
        body.weights.push(weights);
        body.colours.push(colour);
        Ok(())
    }
}

/// The joints of all vertices, four each, and their weights.
type WeightSet = (Vec<[u32; 4]>, Vec<[f32; 4]>);

/// Returns the joints and weights of a part of a mesh.
fn weights(data: &Data, attributes: &Value, vertices: u64) -> Result<Vec<WeightSet>, String> {
    let mut sets = Vec::new();
    for set in 0..SETS {
        let accessor = |name: &str| attribute(data, attributes, &format!("{name}_{set}"), vertices);
        let Some((joints, weights)) = accessor("JOINTS")?.zip(accessor("WEIGHTS")?) else { break };
        sets.push((data.whole_numbers::<4>(joints)?, data.numbers::<4>(weights)?));
    }
    if sets.is_empty() { Err("a mesh with a skin has no joints and weights".to_owned()) } else { Ok(sets) }
}

impl Skin {
    /// Returns the mixed transform of a vertex to its place at rest, and the share of each of our joints.
    fn moved<'a>(
        &self,
        sets: impl Iterator<Item = (&'a [u32; 4], &'a [f32; 4])> + Clone,
    ) -> Result<(DMat4, [f32; JOINTS]), String> {
        if let ([(joint, matrix)], false) = (self.joints.as_slice(), self.bends) {
            return Ok((*matrix, std::array::from_fn(|at| if at == joint.index() { 1.0 } else { 0.0 })));
        }
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
