//! People as skinned figures that walk.

use super::bin::Bin;
use super::json::{Node, Root};
use super::motion::{GlbMotion, Visit};
use super::write::{POINTS, TRIANGLES};
use crate::color::light;
use crate::people::{PersonBody, axes};
use glam::{Quat, Vec3};
use serde_json::json;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::io;
use throng_figure::{Joint, Mesh, Pose, Region, Walk};

/// Greatest error of the position of the hips along each axis, metres.
const PLACE: f64 = 2e-4;
/// Greatest error of a rotation about each axis, radians: of the joints from the hips to the feet, and of the others.
const TURN_OF_LEG: f64 = 4e-4;
const TURN: f64 = 3.5e-3;

/// The skins of a file.
#[derive(Default)]
pub struct Skins {
    /// The shapes of the bodies: accessors of the attributes, and of the inverse bind matrices.
    shapes: BTreeMap<usize, Shape>,
    /// The triangles, by body and by the regions that looks wear.
    triangles: BTreeMap<(usize, Vec<Region>), usize>,
    /// The meshes, by body and look.
    meshes: BTreeMap<(usize, u8), usize>,
    material: Option<usize>,
}

struct Shape {
    attributes: serde_json::Value,
    binds: usize,
    mesh: Mesh,
}

impl Skins {
    /// Adds the figure of an agent: joints below its node, their motion, a skin, and a mesh.
    ///
    /// # Errors
    /// A system error, or the file becomes too large.
    pub fn add(
        &mut self,
        (root, bin, motion): (&mut Root, &mut Bin, &mut GlbMotion<'_>),
        (node, walk, body): (usize, &Walk, PersonBody<'_>),
        (visit, times): (&Visit, &[f64]),
        (places, turns): (Vec<Vec3>, Vec<Quat>),
    ) -> io::Result<()> {
        let person = walk.person();
        let poses: Vec<Pose> = visit.moments.iter().map(|&moment| walk.pose(times[moment])).collect();
        let skeleton = body.skeleton(1.0);
        let first = root.nodes.len();
        let at = |joint: Joint| first + joint.index();
        for joint in Joint::ALL {
            let turned: Vec<Quat> = match joint {
                Joint::Hips => poses.iter().zip(&turns).map(|(pose, turn)| turn.conjugate() * hips(pose)).collect(),
                _ => poses.iter().map(|pose| axes::own_turn(pose.rotations[joint.index()]).as_quat()).collect(),
            };
            let rest = turned.first().copied().unwrap_or_default();
            let mut child = Node { name: joint.name().into(), rotation: Some(rest.to_array()), ..Node::default() };
            let offset = axes::own(skeleton.offset(joint).as_vec3());
            child.translation = Some(offset.as_dvec3().to_array());
            if joint == Joint::Hips {
                let beside = |(pose, (place, turn)): (&Pose, (&Vec3, &Quat))| {
                    turn.conjugate() * (axes::point(pose.hips.as_vec3()) - place)
                };
                let points: Vec<Vec3> = poses.iter().zip(places.iter().zip(&turns)).map(beside).collect();
                let rest = points.first().copied().unwrap_or_default().as_dvec3();
                child.translation = Some(rest.to_array());
                child.scale = Some([person.height as f32; 3]);
                motion.translate(bin, (at(joint), rest), visit, points, PLACE)?;
            }
            let error = if carries_feet(joint) { TURN_OF_LEG } else { TURN };
            motion.rotate(bin, (at(joint), rest), visit, turned, error)?;
            child.children = Joint::ALL.into_iter().filter(|other| other.parent() == Some(joint)).map(at).collect();
            root.nodes.push(child);
        }
        root.nodes[node].children.push(first);
        let joints: Vec<usize> = (first..root.nodes.len()).collect();
        let (mesh, binds) = self.body(root, bin, body)?;
        root.skins.push(json!({ "inverseBindMatrices": binds, "joints": joints, "skeleton": first }));
        // a skin moves its mesh, and no other node does
        let name = root.nodes[node].name.replace("Agent", "Body");
        if let Some(all) = root.scenes.first_mut().and_then(|scene| scene["nodes"].as_array_mut()) {
            all.push(root.nodes.len().into());
        }
        root.nodes.push(Node { name, mesh: Some(mesh), skin: Some(root.skins.len() - 1), ..Node::default() });
        Ok(())
    }

    /// Returns the mesh of a person, and the inverse bind matrices of its skeleton.
    fn body(&mut self, root: &mut Root, bin: &mut Bin, body: PersonBody<'_>) -> io::Result<(usize, usize)> {
        let (number, look) = body.key();
        let shape = match self.shapes.entry(number) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(new) => new.insert(Shape::new(bin, body)?),
        };
        if let Some(&mesh) = self.meshes.get(&(number, look)) {
            return Ok((mesh, shape.binds));
        }
        let material = *self.material.get_or_insert_with(|| {
            root.materials.push(json!({
                "name": "People",
                "pbrMetallicRoughness": { "metallicFactor": 0.0, "roughnessFactor": 0.85 },
            }));
            root.materials.len() - 1
        });
        let triangles = match self.triangles.entry((number, body.worn(&shape.mesh))) {
            Entry::Occupied(known) => *known.get(),
            Entry::Vacant(new) => {
                bin.view(Some(TRIANGLES))?;
                *new.insert(bin.triangles(&body.triangles(&shape.mesh))?)
            }
        };
        let colors: Vec<[u8; 4]> = body.colours(&shape.mesh).iter().copied().map(linear).collect();
        bin.view(Some(POINTS))?;
        let mut attributes = shape.attributes.clone();
        attributes["COLOR_0"] = bin.fours(&colors, true)?.into();
        // what follows is no data of vertices
        bin.view(None)?;
        let primitive = json!({ "attributes": attributes, "indices": triangles, "material": material });
        let mesh = root.meshes.len();
        let name = match body {
            PersonBody::Build(build, look) => format!("{} {look}", build.name()),
            PersonBody::Character(..) => body.name().into_owned(),
        };
        root.meshes.push(json!({ "name": name, "primitives": [primitive] }));
        self.meshes.insert((number, look), mesh);
        Ok((mesh, shape.binds))
    }
}

impl Shape {
    fn new(bin: &mut Bin, body: PersonBody<'_>) -> io::Result<Self> {
        let mesh = body.mesh().into_owned();
        let attributes = vertices(bin, &mesh)?;
        bin.view(None)?;
        let binds = bin.matrices(&body.skeleton(1.0).inverse_bind_matrices().map(axes::own_matrix))?;
        Ok(Self { attributes, binds, mesh })
    }
}

/// Adds the vertices of a mesh, each attribute in a view of its own. Returns the accessors by attribute.
pub(super) fn vertices(bin: &mut Bin, mesh: &Mesh) -> io::Result<serde_json::Value> {
    let own = |all: &[Vec3]| all.iter().map(|&point| axes::own(point)).collect::<Vec<_>>();
    let mut add = |attribute: &dyn Fn(&mut Bin) -> io::Result<usize>| {
        bin.view(Some(POINTS))?;
        attribute(bin)
    };
    let positions = add(&|bin| bin.vectors(&own(&mesh.positions), true))?;
    let normals = add(&|bin| bin.vectors(&own(&mesh.normals), false))?;
    let (numbers, parts): (Vec<[u8; 4]>, Vec<[u8; 4]>) = bones(mesh).unzip();
    let joints = add(&|bin| bin.fours(&numbers, false))?;
    let weights = add(&|bin| bin.fours(&parts, true))?;
    Ok(json!({ "POSITION": positions, "NORMAL": normals, "JOINTS_0": joints, "WEIGHTS_0": weights }))
}

/// Returns the joints that carry each vertex, and their parts in 255ths, which sum to 255.
fn bones(mesh: &Mesh) -> impl Iterator<Item = ([u8; 4], [u8; 4])> + '_ {
    mesh.joints.iter().zip(&mesh.weights).map(|(joints, weights)| {
        let (mut numbers, mut parts) = ([0; 4], [0u8; 4]);
        for (k, (&joint, &weight)) in joints.iter().zip(weights).enumerate() {
            parts[k] = (weight * 255.0).round() as u8;
            // a joint without a part is the first one, as validators want it
            numbers[k] = if parts[k] > 0 { joint } else { 0 };
        }
        let sum: i32 = parts.iter().map(|&part| i32::from(part)).sum();
        let most = (0..4).max_by_key(|&k| parts[k]).unwrap_or(0);
        parts[most] = (i32::from(parts[most]) + 255 - sum) as u8;
        (numbers, parts)
    })
}

/// Returns a colour of sRGB as glTF has colours of vertices: linear, with an alpha.
pub(super) fn linear(color: [u8; 3]) -> [u8; 4] {
    let [r, g, b] = color.map(|part| (light(part) * 255.0).round() as u8);
    [r, g, b, 255]
}

/// Whether feet slide if a joint turns wrongly.
pub(super) fn carries_feet(joint: Joint) -> bool {
    use Joint::{Hips, LeftFoot, LeftLeg, LeftUpLeg, RightFoot, RightLeg, RightUpLeg};
    matches!(joint, Hips | LeftUpLeg | LeftLeg | LeftFoot | RightUpLeg | RightLeg | RightFoot)
}

/// Returns the rotation of the hips in the scene of the file.
fn hips(pose: &Pose) -> Quat {
    axes::turn(pose.rotations[Joint::Hips.index()].as_quat())
}
