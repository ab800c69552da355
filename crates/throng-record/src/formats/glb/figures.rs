//! Reads the figures of a file: where the joints of people are.

use super::baked::BAKED;
use super::baked_read;
use super::data::Data;
use super::json::Extras;
use super::read::{MOST, moments};
use super::sampler::{Channels, SampledNode};
use crate::formats::FormatFlaw;
use crate::people::{Figure, Figures, axes};
use glam::{DQuat, DVec3};
use throng_figure::{Build, JOINTS, Joint, Person, Placed};

const HINT: &str =
    "figures are skins (or baked poses) with the 19 joints that `throng run -o NAME.glb` writes: Hips, Spine and so on";

/// A person: its node, and its joints in the order of [`Joint::ALL`].
struct Skin {
    agent: SampledNode,
    joints: Vec<SampledNode>,
    /// The scale of the hips.
    scale: f64,
}

/// Reads the figures of a file.
///
/// # Errors
/// The file is not binary glTF, has no skins, or its skins have other joints.
pub(super) fn read(bytes: &[u8]) -> Result<Figures, FormatFlaw> {
    parse(bytes).map_err(|why| FormatFlaw { line: None, why, hint: Some(HINT) })
}

fn parse(bytes: &[u8]) -> Result<Figures, String> {
    let data = Data::open(bytes)?;
    let channels = Channels::new(&data, bytes.len().saturating_mul(MOST))?;
    let nodes = &data.root.nodes;
    let times = moments(&data)?;
    let (Some(first), Some(last)) = (times.first(), times.last()) else {
        return Err("the file does not say the times of its frames".to_owned());
    };
    let period = (last - first) / (times.len().max(2) - 1) as f64;
    if data.root.asset.extras.contains_key(BAKED) {
        return baked_read::figures(&data, &times, period);
    }
    if data.root.skins.is_empty() {
        return Err("the file has no people".to_owned());
    }
    let mut all = Vec::new();
    for (index, skin) in data.root.skins.iter().enumerate() {
        let found = skin["joints"].as_array().map(Vec::as_slice).unwrap_or_default();
        let found: Vec<usize> = found.iter().filter_map(|at| usize::try_from(at.as_u64()?).ok()).collect();
        let named = |joint: &Joint| {
            let at = found.iter().copied().find(|&at| nodes.get(at).is_some_and(|node| node.name == joint.name()));
            at.ok_or_else(|| format!("skin {index} has no joint {}", joint.name()))
        };
        let joints: Vec<usize> = Joint::ALL.iter().map(named).collect::<Result<_, _>>()?;
        let agent = nodes.iter().position(|node| node.children.contains(&joints[0]));
        let agent = agent.ok_or_else(|| format!("the hips of skin {index} stand nowhere"))?;
        all.push(figure(&data, &channels, *first, agent, &joints)?);
    }
    Ok(Figures { all, period })
}

fn figure(data: &Data, channels: &Channels, first: f64, agent: usize, joints: &[usize]) -> Result<Figure, String> {
    let nodes = &data.root.nodes;
    let sampled = |at: usize| channels.of(data, at, &nodes[at]);
    let Some(Extras::Person(known)) = &nodes[agent].extras else {
        return Err(format!("the extras of node {agent} do not say which agent it is"));
    };
    let scale = nodes[joints[0]].scale.map_or(1.0, |scale| f64::from(scale[0]));
    let build = known
        .build
        .as_deref()
        .and_then(Build::named)
        .ok_or_else(|| format!("the extras of node {agent} name no build"))?;
    let (from, to) = known.from.zip(known.to).ok_or_else(|| format!("the extras of node {agent} have no times"))?;
    let skin =
        Skin { agent: sampled(agent)?, joints: joints.iter().map(|&at| sampled(at)).collect::<Result<_, _>>()?, scale };
    let person = Person::new(0, u64::from(known.number)).with_build(build).with_height(scale);
    let legs = known.legs.as_ref().map_or(person.legs, Into::into);
    let person = Person { legs, ..person };
    Ok(Figure::new((known.number, person, [from - first, to - first]), move |second| skin.joints(second as f32)))
}

impl Skin {
    /// Returns where the joints are at a second of the animation; `None` while the agent is not there.
    fn joints(&self, second: f32) -> Option<[Placed; JOINTS]> {
        if !self.agent.is_there(second) {
            return None;
        }
        let rest = Placed { position: DVec3::ZERO, rotation: DQuat::IDENTITY };
        let mut placed = [rest; JOINTS];
        let (base, turn) = (self.agent.translation(second), self.agent.rotation(second).as_dquat());
        for joint in Joint::ALL {
            let node = &self.joints[joint.index()];
            let (own, turned) = (node.translation(second), node.rotation(second).as_dquat());
            placed[joint.index()] = match joint.parent().map(|parent| placed[parent.index()]) {
                None => Placed { position: base + turn * own, rotation: turn * turned },
                Some(parent) => Placed {
                    position: parent.position + parent.rotation * (own * self.scale),
                    rotation: parent.rotation * turned,
                },
            };
        }
        Some(placed.map(|joint| Placed { position: axes::place(joint.position), rotation: axes::body(joint.rotation) }))
    }
}
