//! People with all poses in one buffer, for shaders that draw thousands of them.
//!
//! `asset.extras["throng.baked"]` describes the buffer ([`Baked`]). A pose is a position of the hips (three `f32`, in
//! the axes of the file, against the node `World`) and a rotation of each joint (four signed 16-bit parts of 1: x, y, z,
//! w), from the axes of the body (left, up, ahead) to those of the file. Rotations are not relative to the joint above:
//! the joint `j` is where `hips` is, plus `rotation(parent) * offset * height` along the way from the hips to `j`. A
//! vertex is moved by its joints: `place(j) + rotation(j) * (position - rest(j)) * height`, where `rest` is the sum of
//! the offsets along the same way, or what [`BakedFigure::rests`] says.

use super::bin::Bin;
use super::json::{BodyLegs, Root};
use super::people::{linear, vertices};
use super::write::{POINTS, TRIANGLES};
use crate::Output;
use crate::color::light;
use crate::formats::spill::beside;
use crate::people::{PersonBody, axes};
use glam::{DQuat, Quat};
use serde::{Deserialize, Serialize};
use serde_json::json;
use std::fs::File;
use std::io::{self, BufReader, BufWriter, Read, Seek, Write};
use throng_figure::{JOINTS, Joint, LOOKS, Level, Look, Mesh, Region, Skeleton, Walk};

/// The key of the description, in `asset.extras`.
pub const BAKED: &str = "throng.baked";
/// Bytes of the hips and of the rotations of a pose.
pub const HIPS: usize = 12;
pub const TURNS: usize = 8 * JOINTS;

/// The description of the buffer.
#[derive(Debug, Serialize, Deserialize)]
pub struct Baked {
    /// The names of the joints.
    pub joints: Vec<String>,
    /// The joint above each, which is before it; -1 for the hips.
    pub parents: Vec<i32>,
    /// The bodies.
    pub bodies: Vec<BakedBody>,
    /// The colours of the regions, which the vertex attribute `_REGION` counts, by look: linear red, green, blue; none for a
    /// region that the look does not wear.
    pub looks: Vec<Vec<Option<[f32; 3]>>>,
    /// The buffer view of the positions of the hips, and that of the rotations of all joints, pose by pose.
    pub hips: usize,
    pub rotations: usize,
    /// The people.
    pub people: Vec<BakedPerson>,
}

/// A body of a height of 1 m.
#[derive(Debug, Serialize, Deserialize)]
pub struct BakedBody {
    /// `woman`, `man` or `child`; `figure 1` and so on for bodies of files.
    pub build: String,
    /// What only a body of a file has.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub figure: Option<BakedFigure>,
    /// The position of each joint against the joint above it, in the axes of that joint; of the hips, against the ground.
    pub offsets: Vec<[f32; 3]>,
    /// The meshes, the finest first. A body of a file has one mesh, with colours of its vertices.
    pub levels: Vec<usize>,
}

/// A body of a file, for a height of 1 m. It is modelled in any pose; rotations turn it from there.
#[derive(Debug, Serialize, Deserialize)]
pub struct BakedFigure {
    /// The lengths of the legs.
    pub legs: BodyLegs,
    /// Where the joints are in the mesh.
    pub rests: Vec<[f32; 3]>,
    /// The turn of each joint from the pose of the mesh to that of throng's bodies: x, y, z, w.
    pub turns: Vec<[f32; 4]>,
}

/// A person.
#[derive(Debug, Serialize, Deserialize)]
pub struct BakedPerson {
    /// The number of the agent.
    pub number: u32,
    /// The number of the body.
    pub body: usize,
    /// The number of the look; none for a body of a file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub look: Option<u8>,
    /// Metres.
    pub height: f64,
    /// When the person is there: the first frame, the number of frames, and the first pose of each visit. Frames count
    /// in `throng.times`.
    pub visits: Vec<[u64; 3]>,
}

/// The buffer of poses under construction.
pub struct Poses<'a> {
    hips: BufWriter<File>,
    turns: BufWriter<File>,
    count: u64,
    bodies: Vec<PersonBody<'a>>,
    people: Vec<BakedPerson>,
}

impl<'a> Poses<'a> {
    /// Starts an empty buffer.
    ///
    /// # Errors
    /// A system error.
    pub fn new(output: &Output) -> io::Result<Self> {
        let file = || beside(output).map(BufWriter::new);
        Ok(Self { hips: file()?, turns: file()?, count: 0, bodies: Vec::new(), people: Vec::new() })
    }

    /// Adds a person that is there at these frames; `times` are those of all frames.
    ///
    /// # Errors
    /// A system error, such as a full disk.
    pub fn add(
        &mut self,
        (number, walk, own): (u32, &Walk, PersonBody<'a>),
        moments: &[usize],
        times: &[f64],
    ) -> io::Result<()> {
        let person = walk.person();
        let body = self.bodies.iter().position(|known| known.key().0 == own.key().0).unwrap_or_else(|| {
            self.bodies.push(own);
            self.bodies.len() - 1
        });
        let skeleton = own.skeleton(person.height);
        let turns = turns(&skeleton);
        let mut visits = Vec::new();
        for visit in moments.chunk_by(|a, b| a + 1 == *b) {
            visits.push([visit[0] as u64, visit.len() as u64, self.count]);
            for &moment in visit {
                let pose = walk.pose(times[moment]);
                let hips = axes::point(pose.hips.as_vec3()).to_array();
                self.hips.write_all(hips.map(f32::to_le_bytes).as_flattened())?;
                for (joint, turn) in skeleton.world(&pose).into_iter().zip(turns) {
                    self.turns.write_all(shorts(joint.rotation * turn).as_flattened())?;
                }
                self.count += 1;
            }
        }
        let look = match own {
            PersonBody::Build(_, look) => Some(look),
            PersonBody::Character(..) => None,
        };
        self.people.push(BakedPerson { number, body, look, height: person.height, visits });
        Ok(())
    }

    /// Adds the poses, the meshes and the description to the file.
    ///
    /// # Errors
    /// A system error, or the file becomes too large.
    pub fn finish(self, root: &mut Root, bin: &mut Bin) -> io::Result<()> {
        if self.people.is_empty() {
            return Ok(());
        }
        let bodies = self.bodies.into_iter().map(|body| described(root, bin, body)).collect::<io::Result<_>>()?;
        let colours =
            |look| Region::ALL.map(|region| Look::new(look).colour(region).map(|rgb| rgb.map(light))).to_vec();
        let baked = Baked {
            joints: Joint::ALL.map(|joint| joint.name().to_owned()).to_vec(),
            parents: Joint::ALL.map(|joint| joint.parent().map_or(-1, |parent| parent.index() as i32)).to_vec(),
            bodies,
            looks: (0..LOOKS).map(colours).collect(),
            hips: copied(bin, self.hips)?,
            rotations: copied(bin, self.turns)?,
            people: self.people,
        };
        root.asset.extras.insert(BAKED.to_owned(), serde_json::to_value(baked)?);
        Ok(())
    }
}

/// Adds the meshes of a body: all levels of throng's, and that of a file with its colours.
fn described(root: &mut Root, bin: &mut Bin, body: PersonBody<'_>) -> io::Result<BakedBody> {
    let name = body.name().into_owned();
    let skeleton = body.skeleton(1.0);
    let turns = turns(&skeleton);
    let (levels, figure) = match body {
        PersonBody::Build(build, _) => {
            let level = |level: Level| {
                let mesh = Mesh::new(build, level);
                let mut attributes = vertices(bin, &mesh)?;
                bin.view(Some(POINTS))?;
                let regions: Vec<f32> = mesh.regions.iter().map(|&region| f32::from(region as u8)).collect();
                attributes["_REGION"] = bin.scalars(&regions)?.into();
                add_mesh(root, bin, (format!("{name} {level:?}"), &mesh, attributes))
            };
            (Level::ALL.into_iter().map(level).collect::<io::Result<_>>()?, None)
        }
        PersonBody::Character(_, character) => {
            let mut attributes = vertices(bin, character.mesh())?;
            bin.view(Some(POINTS))?;
            let colours: Vec<[u8; 4]> = character.colours().iter().copied().map(linear).collect();
            attributes["COLOR_0"] = bin.fours(&colours, true)?.into();
            let mesh = add_mesh(root, bin, (name.clone(), character.mesh(), attributes))?;
            let rests = skeleton.bind_matrices().map(|bind| axes::own(bind.w_axis.truncate().as_vec3()).to_array());
            let turns = turns.map(|turn| axes::own_turn(turn).as_quat().to_array());
            let legs = character.legs().into();
            (vec![mesh], Some(BakedFigure { legs, rests: rests.to_vec(), turns: turns.to_vec() }))
        }
    };
    let offset = |joint: Joint| {
        let above = joint.parent().map_or(DQuat::IDENTITY, |parent| turns[parent.index()]);
        axes::own((above.conjugate() * skeleton.offset(joint)).as_vec3()).to_array()
    };
    Ok(BakedBody { build: name, figure, offsets: Joint::ALL.map(offset).to_vec(), levels })
}

/// Returns the turn of each joint from the pose in which the body is modelled to that of throng's bodies.
fn turns(skeleton: &Skeleton) -> [DQuat; JOINTS] {
    skeleton.bind_matrices().map(|bind| DQuat::from_mat4(&bind).conjugate())
}

/// Adds a mesh with these attributes. Returns its number.
fn add_mesh(
    root: &mut Root,
    bin: &mut Bin,
    (name, mesh, attributes): (String, &Mesh, serde_json::Value),
) -> io::Result<usize> {
    bin.view(Some(TRIANGLES))?;
    let primitive = json!({ "attributes": attributes, "indices": bin.triangles(&mesh.triangles)? });
    root.meshes.push(json!({ "name": name, "primitives": [primitive] }));
    Ok(root.meshes.len() - 1)
}

/// Adds a file as a view. Returns the view.
fn copied(bin: &mut Bin, file: BufWriter<File>) -> io::Result<usize> {
    let mut file = file.into_inner().map_err(io::IntoInnerError::into_error)?;
    file.rewind()?;
    let view = bin.view(None)?;
    let (mut reader, mut bytes) = (BufReader::new(file), vec![0; 1 << 16]);
    loop {
        match reader.read(&mut bytes)? {
            0 => return Ok(view),
            count => bin.put(&bytes[..count])?,
        }
    }
}

/// Returns the bytes of a rotation of a joint in the world, in the axes of the file.
fn shorts(rotation: DQuat) -> [[u8; 2]; 4] {
    let turn: Quat = axes::turn(rotation.as_quat());
    turn.to_array().map(|part| ((part * f32::from(i16::MAX)).round() as i16).to_le_bytes())
}
