//! People with all poses in one buffer, for shaders that draw thousands of them.
//!
//! `asset.extras["throng.baked"]` describes the buffer ([`Baked`]). A pose is a position of the hips (three `f32`, in
//! the axes of the file, against the node `World`) and a rotation of each joint (four signed 16-bit parts of 1: x, y, z,
//! w), from the axes of the body (left, up, ahead) to those of the file. Rotations are not relative to the joint above:
//! the joint `j` is where `hips` is, plus `rotation(parent) * offset * height` along the way from the hips to `j`. A
//! vertex is moved by its joints: `place(j) + rotation(j) * (position - rest(j)) * height`, where `rest` is the sum of
//! the offsets along the same way.

use super::bin::Bin;
use super::json::Root;
use super::people::vertices;
use super::write::{POINTS, TRIANGLES};
use crate::Output;
use crate::color::light;
use crate::formats::spill::beside;
use crate::people::axes;
use glam::{DQuat, Quat};
use serde::{Deserialize, Serialize};
use serde_json::json;
use std::fs::File;
use std::io::{self, BufReader, BufWriter, Read, Seek, Write};
use throng_figure::{Build, JOINTS, Joint, LOOKS, Level, Look, Mesh, Region, Skeleton, Walk};

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
    /// `woman`, `man` or `child`.
    pub build: String,
    /// The position of each joint against the joint above it; of the hips, against the ground.
    pub offsets: Vec<[f32; 3]>,
    /// The meshes, the finest first.
    pub levels: Vec<usize>,
}

/// A person.
#[derive(Debug, Serialize, Deserialize)]
pub struct BakedPerson {
    /// The number of the agent.
    pub number: u32,
    /// The body and the look, by number.
    pub body: usize,
    pub look: u8,
    /// Metres.
    pub height: f64,
    /// When the person is there: the first frame, the number of frames, and the first pose of each visit. Frames count
    /// in `throng.times`.
    pub visits: Vec<[u64; 3]>,
}

/// The buffer of poses under construction.
pub struct Poses {
    hips: BufWriter<File>,
    turns: BufWriter<File>,
    count: u64,
    bodies: Vec<Build>,
    people: Vec<BakedPerson>,
}

impl Poses {
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
    pub fn add(&mut self, number: u32, walk: &Walk, moments: &[usize], times: &[f64]) -> io::Result<()> {
        let person = walk.person();
        let body = self.bodies.iter().position(|build| *build == person.build).unwrap_or_else(|| {
            self.bodies.push(person.build);
            self.bodies.len() - 1
        });
        let skeleton = Skeleton::new(person);
        let mut visits = Vec::new();
        for visit in moments.chunk_by(|a, b| a + 1 == *b) {
            visits.push([visit[0] as u64, visit.len() as u64, self.count]);
            for &moment in visit {
                let pose = walk.pose(times[moment]);
                let hips = axes::point(pose.hips.as_vec3()).to_array();
                self.hips.write_all(hips.map(f32::to_le_bytes).as_flattened())?;
                for joint in skeleton.world(&pose) {
                    self.turns.write_all(shorts(joint.rotation).as_flattened())?;
                }
                self.count += 1;
            }
        }
        let (look, height) = (person.look, person.height);
        self.people.push(BakedPerson { number, body, look, height, visits });
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
        let bodies = self.bodies.into_iter().map(|build| body(root, bin, build)).collect::<io::Result<_>>()?;
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

/// Adds the meshes of a build: all levels.
fn body(root: &mut Root, bin: &mut Bin, build: Build) -> io::Result<BakedBody> {
    let mut levels = Vec::new();
    for level in Level::ALL {
        let mesh = Mesh::new(build, level);
        let mut attributes = vertices(bin, &mesh)?;
        bin.view(Some(POINTS))?;
        let regions: Vec<f32> = mesh.regions.iter().map(|&region| f32::from(region as u8)).collect();
        attributes["_REGION"] = bin.scalars(&regions)?.into();
        bin.view(Some(TRIANGLES))?;
        let primitive = json!({ "attributes": attributes, "indices": bin.triangles(&mesh.triangles)? });
        levels.push(root.meshes.len());
        root.meshes.push(json!({ "name": format!("{} {level:?}", build.name()), "primitives": [primitive] }));
    }
    let skeleton = Skeleton::scaled(build, 1.0);
    let offsets = Joint::ALL.map(|joint| axes::own(skeleton.offset(joint).as_vec3()).to_array()).to_vec();
    Ok(BakedBody { build: build.name().to_owned(), offsets, levels })
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
