//! glTF read.

use super::data::Data;
use super::json::{Extras, Node, Person};
use super::sampler::{Channels, Sampled};
use super::{TIMES, axes, seconds};
use crate::formats::names::Names;
use crate::formats::{Flaw, Reading, describe, keys};
use crate::tracks::{RADIUS, Spot, Tracks};
use glam::{DMat4, DVec3, Quat, Vec3};
use throng::Status;

const HINT: &str = "what is read is binary glTF 2.0 whose animation moves nodes, as `throng run -o NAME.glb` writes it";
/// So many places a byte of the file at most: those that hardly move take little, but what takes less than this is no crowd.
const MOST: usize = 32;

/// Reads a file, ours or others'.
pub(super) fn read(bytes: &[u8], reading: &Reading) -> Result<Tracks, Flaw> {
    parse(bytes, reading).map_err(|why| Flaw { line: None, why, hint: Some(HINT) })
}

fn parse(bytes: &[u8], reading: &Reading) -> Result<Tracks, String> {
    let data = Data::open(bytes)?;
    let extras = &data.root.asset.extras;
    let mut names = Names::default();
    let value = |key: &str| extras.get(key).and_then(|value| value.as_str()).map(str::to_owned);
    let mut tracks = Tracks { setting: describe::setting(value, &mut names)?, ..Tracks::default() };
    let ours = value(keys::PROGRAM).is_some();
    let times = moments(&data)?;
    let seconds = seconds(&times);
    let most = bytes.len().saturating_mul(MOST);
    let channels = Channels::new(&data, most)?;
    let people = people(&data, &channels)?;
    if people.is_empty() && !ours {
        return Err("no animation moves anybody in it".to_owned());
    }
    let keys = if times.is_empty() { channels.seconds(&data, people.iter().map(|&(at, _)| at))? } else { Vec::new() };
    for &(at, parent) in &people {
        let node = &data.root.nodes[at];
        let sampled = channels.of(&data, at, node)?;
        let (person, group) = match &node.extras {
            Some(Extras::Person(person)) => (Some(person), names.index(&person.group)),
            _ => (None, names.index("")),
        };
        let moments: Vec<(f64, f32)> = if times.is_empty() {
            let said = keys.iter().filter(|&&second| sampled.covers(second));
            said.map(|&second| (f64::from(second), second)).collect()
        } else {
            times.iter().copied().zip(seconds.iter().copied()).collect()
        };
        if tracks.spots.len() + moments.len() > most {
            return Err("it says of more moments where everybody is than a file of this size can".to_owned());
        }
        let who = Who { number: person.map_or(at as u32, |person| person.number), group, person, parent };
        tracks.spots.extend(who.spots(&sampled, &moments, reading.unit.unwrap_or(1.0)));
    }
    if tracks.spots.iter().any(|spot| !(spot.place.is_finite() && spot.heading.is_finite())) {
        return Err("somebody in it is nowhere".to_owned());
    }
    tracks.setting.groups = names.into_names();
    tracks.sort();
    tracks.complete(true, false);
    Ok(tracks)
}

/// The times of the moments of a file of ours.
fn moments(data: &Data) -> Result<Vec<f64>, String> {
    let Some(view) = data.root.asset.extras.get(TIMES) else { return Ok(Vec::new()) };
    let view = view.as_u64().and_then(|view| usize::try_from(view).ok());
    let (bytes, _) = data.view(view.ok_or_else(|| format!("{TIMES} is no buffer view"))?)?;
    let times = bytes.chunks_exact(8).map(|b| f64::from_le_bytes([b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7]]));
    let times: Vec<f64> = times.collect();
    let grow = times.iter().all(|time| time.is_finite()) && times.windows(2).all(|two| two[0] < two[1]);
    if grow { Ok(times) } else { Err(format!("{TIMES} are no times that grow")) }
}

/// The nodes that are somebody, with what stands between them and the scene: those that say so, and those that are moved, if nothing
/// above them is.
fn people(data: &Data, channels: &Channels) -> Result<Vec<(usize, DMat4)>, String> {
    let nodes = &data.root.nodes;
    let mut parents = vec![None; nodes.len()];
    for (at, node) in nodes.iter().enumerate() {
        for &child in &node.children {
            *parents.get_mut(child).ok_or_else(|| format!("there is no node {child}"))? = Some(at);
        }
    }
    let mut people = Vec::new();
    for (at, node) in nodes.iter().enumerate() {
        if !(matches!(node.extras, Some(Extras::Person(_))) || channels.moves(at)) {
            continue;
        }
        let (mut above, mut steps, mut moved, mut matrix) = (parents[at], 0, false, DMat4::IDENTITY);
        while let Some(parent) = above {
            matrix = local(&nodes[parent]) * matrix;
            moved |= channels.changes(parent);
            (above, steps) = (parents[parent], steps + 1);
            if steps > nodes.len() {
                return Err(format!("node {at} is below itself"));
            }
        }
        if !moved {
            people.push((at, matrix));
        }
    }
    Ok(people)
}

/// Where a node stands in the one above.
fn local(node: &Node) -> DMat4 {
    if let Some(matrix) = &node.matrix {
        return DMat4::from_cols_array(matrix);
    }
    let scale = node.scale.map_or(Vec3::ONE, Vec3::from).as_dvec3();
    let rotation = node.rotation.map_or(Quat::IDENTITY, Quat::from_array).as_dquat();
    DMat4::from_scale_rotation_translation(scale, rotation, node.translation.map_or(DVec3::ZERO, DVec3::from))
}

/// Somebody.
struct Who<'a> {
    number: u32,
    group: u32,
    person: Option<&'a Person>,
    parent: DMat4,
}

impl Who<'_> {
    /// Where it is at moments, of which the seconds of the animation are said too; in metres of a unit.
    fn spots(&self, sampled: &Sampled, moments: &[(f64, f32)], unit: f64) -> Vec<Spot> {
        let turned = self.parent.to_scale_rotation_translation().1.as_quat();
        let there = moments.iter().filter(|&&(_, second)| sampled.is_there(second));
        let spot = |&(time, second): &(f64, f32)| {
            let ahead = axes::ahead(turned * sampled.rotation(second));
            Spot {
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
