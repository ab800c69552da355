//! Writes binary glTF.

use super::baked::Poses;
use super::bin::{Bin, TOO_LARGE};
use super::json::{Asset, Buffer, Extras, Node, Person, Root};
use super::motion::GlbMotion;
use super::people::Skins;
use super::{TIMES, seconds};
use crate::formats::by_agent::by_agent;
use crate::formats::mesh::{self, Mesh};
use crate::formats::spill::{Spill, SpilledAgent, SpilledState, beside};
use crate::formats::{PROGRAM, Writer, body, describe, keys};
use crate::people::{FigureStyle, People, PersonBody, axes};
use crate::{Frame, Output, OutputError, Setting, color};
use glam::{Quat, Vec3};
use serde_json::{Value, json};
use std::io::{self, Write};
use throng_figure::gait::FASTEST_TURN;

/// The targets of buffer views: vertex data and indices.
pub const POINTS: u32 = 34962;
pub const TRIANGLES: u32 = 34963;
/// Size of a vertex, bytes.
const POINT: u64 = 12;

/// Collects trajectories during a run and writes them at the end. The [module](super) describes the nodes.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("run.glb");
/// use throng_record::formats::glb::GlbWriter;
/// use throng_record::{Frame, Output, Setting, Writer};
/// let mut writer = GlbWriter::new(Output::create(&path)?, &Setting::default())?;
/// writer.push(&Frame::default())?;
/// Box::new(writer).finish()?;
/// assert!(std::fs::read(&path)?.starts_with(b"glTF"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct GlbWriter {
    output: Output,
    setting: Setting,
    spill: Spill,
    style: FigureStyle,
}

impl GlbWriter {
    /// Starts to collect.
    ///
    /// # Errors
    /// A system error, such as a full disk.
    pub fn new(output: Output, setting: &Setting) -> Result<Self, OutputError> {
        let spill = Spill::new(&output, setting)?;
        Ok(Self { output, setting: setting.clone(), spill, style: FigureStyle::Auto })
    }

    /// Returns the writer, which writes people in this style.
    #[must_use]
    pub fn style(self, style: FigureStyle) -> Self {
        Self { style, ..self }
    }

    /// Returns the JSON and the binary chunk of the whole file.
    fn scene(&mut self) -> io::Result<(Root, Bin)> {
        let people = People::of(self.style, &self.setting, &mut self.spill, &self.output)?;
        let mut scene = Scene { root: Root::default(), bin: Bin::new(&self.output)? };
        let times: Vec<f64> = self.spill.moments.iter().map(|&(time, _)| time).collect();
        let seconds = seconds(&times);
        scene.asset(&self.setting, &self.spill);
        scene.times(&times)?;
        let agents = scene.place(&self.setting, &self.spill)?;
        let agents_of = &self.spill.agents;
        let mut skins = Skins::default();
        let baked = people.style == FigureStyle::Baked;
        let people = people.with_characters(&self.setting);
        let plain = baked || agents_of.iter().any(|agent| !people.has(agent));
        let meshes = if plain { scene.bodies(&self.setting, agents_of)? } else { 0 };
        let (mut motion, flies) = (GlbMotion::new(&seconds), self.setting.in_space);
        let mut poses = Poses::new(&self.output)?;
        scene.bin.view(None)?;
        by_agent(&mut self.spill, beside(&self.output)?, |agent, track| {
            let (mut node, visit) = (named(agent, track, &self.setting, &times), motion.visit(track));
            let at = scene.root.nodes.len();
            scene.root.nodes[agents].children.push(at);
            let walk = people.walk(agent, track)?;
            if let Some(walk) = walk.as_ref().filter(|_| baked) {
                let body = people.body(agent, walk.person());
                poses.add((agent.number, walk, body), &visit.moments, &times)?;
            }
            let Some(walk) = walk.filter(|_| !baked) else {
                node.mesh = Some(meshes + agent.group as usize);
                let scale = axes::own(body::scale(agent.radius, flies));
                motion.agent(&mut scene.bin, (at, &mut node), scale, (agent, track, &visit))?;
                scene.root.nodes.push(node);
                return Ok(());
            };
            let body = people.body(agent, walk.person());
            if let Some(Extras::Person(known)) = &mut node.extras {
                known.build = Some(walk.person().build.name().to_owned());
                known.legs = matches!(body, PersonBody::Character(..)).then(|| walk.person().legs.into());
            }
            let track = turned(track, &times);
            let moved = motion.agent(&mut scene.bin, (at, &mut node), Vec3::ONE, (agent, &track, &visit))?;
            scene.root.nodes.push(node);
            skins.add((&mut scene.root, &mut scene.bin, &mut motion), (at, &walk, body), (&visit, &times), moved)
        })?;
        scene.root.animations = vec![motion.finish(&mut scene.bin)?];
        poses.finish(&mut scene.root, &mut scene.bin)?;
        scene.root.animations.retain(|animation| !animation.channels.is_empty());
        Ok((scene.root, scene.bin))
    }

    fn write(&mut self) -> io::Result<()> {
        let (mut root, mut bin) = self.scene()?;
        root.accessors = std::mem::take(&mut bin.accessors);
        root.buffer_views = std::mem::take(&mut bin.views);
        // without agents that move, the last view is empty
        while root.buffer_views.last().is_some_and(|view| view.byte_length == 0) {
            root.buffer_views.pop();
        }
        let (length, mut bytes) = bin.read()?;
        if length > 0 {
            root.buffers.push(Buffer { byte_length: length, uri: None });
        }
        let mut json = serde_json::to_vec(&root)?;
        json.resize(json.len().next_multiple_of(4), b' ');
        let whole = 12 + 8 + json.len() as u64 + if length > 0 { 8 + length } else { 0 };
        let size = |size: u64| u32::try_from(size).map_err(|_| io::Error::other(TOO_LARGE)).map(u32::to_le_bytes);
        let head = [*b"glTF", 2u32.to_le_bytes(), size(whole)?, size(json.len() as u64)?, *b"JSON"];
        self.output.write_all(head.as_flattened())?;
        self.output.write_all(&json)?;
        if length > 0 {
            self.output.write_all([size(length)?, *b"BIN\0"].as_flattened())?;
            io::copy(&mut bytes, &mut self.output)?;
        }
        Ok(())
    }
}

impl Writer for GlbWriter {
    fn push(&mut self, frame: &Frame) -> Result<(), OutputError> {
        self.spill.push(frame).map_err(|error| self.output.error(error))
    }

    fn finish(mut self: Box<Self>) -> Result<(), OutputError> {
        self.write().map_err(|error| self.output.error(error))?;
        self.output.finish()
    }
}

/// A file under construction.
struct Scene {
    root: Root,
    bin: Bin,
}

impl Scene {
    /// Adds the metadata of the scene.
    fn asset(&mut self, setting: &Setting, spill: &Spill) {
        let extras = describe::pairs(setting).map(|(key, value)| (key.to_owned(), value.into()));
        let mut asset =
            Asset { version: "2.0".into(), generator: PROGRAM.into(), extras: extras.into_iter().collect() };
        if let Some(rate) = spill.rate.even() {
            asset.extras.insert(keys::RATE.to_owned(), rate.to_string().into());
        }
        self.root.asset = asset;
        (self.root.scene, self.root.scenes) = (Some(0), vec![json!({ "nodes": [0] })]);
    }

    /// Adds the times of the frames.
    fn times(&mut self, times: &[f64]) -> io::Result<()> {
        if !times.is_empty() {
            let view = self.bin.view(None)?;
            let bytes: Vec<u8> = times.iter().flat_map(|time| time.to_le_bytes()).collect();
            self.bin.put(&bytes)?;
            self.root.asset.extras.insert(TIMES.to_owned(), view.into());
        }
        Ok(())
    }

    /// Adds the place. Returns the parent node of all agents.
    fn place(&mut self, setting: &Setting, spill: &Spill) -> io::Result<usize> {
        let origin = setting.origin;
        let node = |name: &str| Node { name: name.to_owned(), ..Node::default() };
        self.root.nodes.push(Node { translation: Some([origin.x, 0.0, -origin.y]), ..node("World") });
        let meshes = [("Ground", mesh::ground(setting, spill.seen), 0.6), ("Obstacles", mesh::solids(setting), 0.1)];
        for (name, mesh, light) in meshes {
            if !mesh.triangles.is_empty() {
                let material = self.material(name, [light; 3], true);
                let shape = self.shape(&mesh, axes::point)?;
                let mesh = self.mesh(name, &shape, material);
                self.root.nodes.push(Node { mesh: Some(mesh), ..node(name) });
            }
        }
        self.root.nodes.push(node("Agents"));
        self.root.nodes[0].children = (1..self.root.nodes.len()).collect();
        Ok(self.root.nodes.len() - 1)
    }

    /// Adds one mesh per group: the same body in the colour of the group. Returns the first mesh.
    fn bodies(&mut self, setting: &Setting, agents: &[SpilledAgent]) -> io::Result<usize> {
        let first = self.root.meshes.len();
        let groups = agents.iter().map(|agent| agent.group as usize + 1).max().unwrap_or(0);
        if groups > 0 {
            let shape = self.shape(&body::mesh(setting.in_space), axes::own)?;
            for group in 0..groups {
                let name = setting.group_name(group as u32);
                let material = self.material(&name, color::linear(group), false);
                self.mesh(&name, &shape, material);
            }
        }
        Ok(first)
    }

    /// Adds the bytes of a mesh. Returns the accessors of its points and its triangles.
    fn shape(&mut self, mesh: &Mesh, turned: fn(Vec3) -> Vec3) -> io::Result<[usize; 2]> {
        let points: Vec<_> = mesh.points.iter().map(|&point| turned(point)).collect();
        let view = self.bin.view(Some(POINTS))?;
        let points = self.bin.vectors(&points, true)?;
        self.bin.views[view].byte_stride = Some(POINT);
        self.bin.view(Some(TRIANGLES))?;
        Ok([points, self.bin.triangles(&mesh.triangles)?])
    }

    fn mesh(&mut self, name: &str, [points, triangles]: &[usize; 2], material: usize) -> usize {
        let primitive = json!({ "attributes": { "POSITION": points }, "indices": triangles, "material": material });
        self.root.meshes.push(json!({ "name": name, "primitives": [primitive] }));
        self.root.meshes.len() - 1
    }

    fn material(&mut self, name: &str, color: [f32; 3], both_sides: bool) -> usize {
        let [r, g, b] = color.map(|c| (f64::from(c) * 1e4).round() / 1e4);
        let mut material = json!({
            "name": name,
            "pbrMetallicRoughness": { "baseColorFactor": [r, g, b, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.8 },
        });
        if both_sides {
            material["doubleSided"] = Value::Bool(true);
        }
        self.root.materials.push(material);
        self.root.materials.len() - 1
    }
}

/// Returns the track of a person that turns no faster than a person can. Recorded directions may jump: the hips, which are
/// beside the node, would swing around it between two frames.
fn turned(track: &[(u32, SpilledState)], times: &[f64]) -> Vec<(u32, SpilledState)> {
    let mut track = track.to_vec();
    for k in 1..track.len() {
        let [before, now] = [k - 1, k].map(|k| (times[track[k].0 as usize], track[k].1.rotation));
        let most = FASTEST_TURN * (now.0 - before.0);
        let [from, to] = [before.1, now.1].map(|rotation| (rotation * Vec3::X).truncate().as_dvec2());
        let turn = libm::atan2(from.perp_dot(to), from.dot(to));
        if turn.abs() > most {
            track[k].1.rotation = Quat::from_rotation_z(most.copysign(turn) as f32) * before.1;
        }
    }
    track
}

/// Returns the node of an agent, without mesh and motion.
fn named(agent: &SpilledAgent, track: &[(u32, SpilledState)], setting: &Setting, times: &[f64]) -> Node {
    let time = |row: Option<&(u32, SpilledState)>| row.map(|&(moment, _)| times[moment as usize]);
    let person = Person {
        number: agent.number,
        group: setting.group_name(agent.group).into_owned(),
        radius: Some(agent.radius),
        from: time(track.first()),
        to: time(track.last()),
        build: None,
        legs: None,
    };
    Node { name: format!("Agent_{}", agent.number), extras: Some(Extras::Person(person)), ..Node::default() }
}
