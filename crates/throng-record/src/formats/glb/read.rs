//! Reads binary glTF.

use super::data::Data;
use super::json::{Extras, Node, Person};
use super::sampler::{Channels, SampledNode};
use super::{TIMES, seconds};
use crate::formats::names::Names;
use crate::formats::{FormatFlaw, Reading, describe, keys};
use crate::people::axes;
use crate::trajectories::{RADIUS, Sample, Trajectories};
use glam::{DMat4, DVec3, Quat, Vec3};
use throng::Status;

const HINT: &str =
    "supported is binary glTF 2.0 with an animation that moves nodes, as `throng run -o NAME.glb` writes it";
/// Greatest number of samples per byte of the file. Agents that hardly move take little space, but no recorded crowd
/// takes less than this.
pub(super) const MOST: usize = 32;

/// Reads a file that throng or another program wrote.
pub(super) fn read(bytes: &[u8], reading: &Reading) -> Result<Trajectories, FormatFlaw> {
    parse(bytes, reading).map_err(|why| FormatFlaw { line: None, why, hint: Some(HINT) })
}

fn parse(bytes: &[u8], reading: &Reading) -> Result<Trajectories, String> {
    let data = Data::open(bytes)?;
    let extras = &data.root.asset.extras;
    let mut names = Names::default();
    let value = |key: &str| extras.get(key).and_then(|value| value.as_str()).map(str::to_owned);
    let mut tracks = Trajectories { setting: describe::setting(value, &mut names)?, ..Trajectories::default() };
    let ours = value(keys::PROGRAM).is_some();
    let times = moments(&data)?;
    let seconds = seconds(&times);
    let most = bytes.len().saturating_mul(MOST);
    let channels = Channels::new(&data, most)?;
    let agents = agents(&data, &channels)?;
    if agents.is_empty() && !ours {
        return Err("no animation moves a node".to_owned());
    }
    let keys = if times.is_empty() { channels.seconds(&data, agents.iter().map(|&(at, _)| at))? } else { Vec::new() };
    for &(at, parent) in &agents {
        let node = &data.root.nodes[at];
        let sampled = channels.of(&data, at, node)?;
        let (person, group) = match &node.extras {
            Some(Extras::Person(person)) => (Some(person), names.index(&person.group)),
            _ => (None, names.index("")),
        };
        let moments: Vec<(f64, f32)> = if times.is_empty() {
            let covered = keys.iter().filter(|&&second| sampled.covers(second));
            covered.map(|&second| (f64::from(second), second)).collect()
        } else {
            times.iter().copied().zip(seconds.iter().copied()).collect()
        };
        if tracks.spots.len() + moments.len() > most {
            return Err("the file lists more samples than its size allows".to_owned());
        }
        let agent = FileAgent { number: person.map_or(at as u32, |person| person.number), group, person, parent };
        tracks.spots.extend(agent.spots(&sampled, &moments, reading.unit.unwrap_or(1.0)));
    }
    if tracks.spots.iter().any(|spot| !(spot.place.is_finite() && spot.heading.is_finite())) {
        return Err("the position or the heading of an agent is not finite".to_owned());
    }
    tracks.setting.groups = names.into_names();
    tracks.sort();
    tracks.complete(true, false);
    Ok(tracks)
}

/// Returns the times of the frames of a file that throng wrote; empty for files of other programs.
pub(super) fn moments(data: &Data) -> Result<Vec<f64>, String> {
    let Some(view) = data.root.asset.extras.get(TIMES) else { return Ok(Vec::new()) };
    let view = view.as_u64().and_then(|view| usize::try_from(view).ok());
    let (bytes, _) = data.view(view.ok_or_else(|| format!("{TIMES} is no buffer view"))?)?;
    let times = bytes.chunks_exact(8).map(|b| f64::from_le_bytes([b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7]]));
    let times: Vec<f64> = times.collect();
    let grow = times.iter().all(|time| time.is_finite()) && times.windows(2).all(|two| two[0] < two[1]);
    if grow { Ok(times) } else { Err(format!("{TIMES} are not increasing times")) }
}

/// Returns the nodes that are agents, with the transform from the parent node to the scene. A node is an agent if its
/// extras say so or the animation moves it, unless it is a part of an agent or the animation changes a node above it.
fn agents(data: &Data, channels: &Channels) -> Result<Vec<(usize, DMat4)>, String> {
    let nodes = &data.root.nodes;
    let parents = parents(nodes)?;
    let mut agents = Vec::new();
    for (at, node) in nodes.iter().enumerate() {
        if !(matches!(node.extras, Some(Extras::Person(_))) || channels.moves(at)) {
            continue;
        }
        let (mut above, mut steps, mut moved, mut matrix) = (parents[at], 0, false, DMat4::IDENTITY);
        while let Some(parent) = above {
            matrix = local(&nodes[parent]) * matrix;
            moved |= channels.changes(parent) || matches!(nodes[parent].extras, Some(Extras::Person(_)));
            (above, steps) = (parents[parent], steps + 1);
            if steps > nodes.len() {
                return Err(format!("node {at} is its own ancestor"));
            }
        }
        if !moved {
            agents.push((at, matrix));
        }
    }
    Ok(agents)
}

/// Returns the parent of each node.
pub(super) fn parents(nodes: &[Node]) -> Result<Vec<Option<usize>>, String> {
    let mut parents = vec![None; nodes.len()];
    for (at, node) in nodes.iter().enumerate() {
        for &child in &node.children {
            *parents.get_mut(child).ok_or_else(|| format!("there is no node {child}"))? = Some(at);
        }
    }
    Ok(parents)
}

/// Returns the transform of a node within its parent.
pub(super) fn local(node: &Node) -> DMat4 {
    if let Some(matrix) = &node.matrix {
        return DMat4::from_cols_array(matrix);
    }
    let scale = node.scale.map_or(Vec3::ONE, Vec3::from).as_dvec3();
    let rotation = node.rotation.map_or(Quat::IDENTITY, Quat::from_array).as_dquat();
    DMat4::from_scale_rotation_translation(scale, rotation, node.translation.map_or(DVec3::ZERO, DVec3::from))
}

/// An agent of the file.
struct FileAgent<'a> {
    number: u32,
    group: u32,
    person: Option<&'a Person>,
    parent: DMat4,
}

impl FileAgent<'_> {
    /// Returns the samples at `moments` (time and second of the animation each). `unit` is the file's unit in metres.
    fn spots(&self, sampled: &SampledNode, moments: &[(f64, f32)], unit: f64) -> Vec<Sample> {
        let turned = self.parent.to_scale_rotation_translation().1.as_quat();
        let there = moments.iter().filter(|&&(_, second)| sampled.is_there(second));
        let spot = |&(time, second): &(f64, f32)| {
            let ahead = axes::ahead(turned * sampled.rotation(second));
            Sample {
                number: self.number,
                group: self.group,
                time,
                place: axes::place(self.parent.transform_point3(sampled.translation(second))) * unit,
                velocity: Vec3::ZERO,
                heading: ahead.y.atan2(ahead.x),
                radius: self.person.and_then(|person| person.radius).unwrap_or(RADIUS),
                status: Status::Walking,
            }
        };
        there.map(spot).collect()
    }
}
