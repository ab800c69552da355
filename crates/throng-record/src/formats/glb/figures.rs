//! Reads the figures of a file: where the joints of people are.

use super::axes;
use super::data::Data;
use super::json::Extras;
use super::read::{MOST, moments};
use super::sampler::{Channels, SampledNode};
use crate::formats::FormatFlaw;
use crate::person::BUILDS;
use glam::{DQuat, DVec3};
use throng_figure::{JOINTS, Joint, Person, Placed};

const HINT: &str = "figures are skins with the 19 joints that `throng run -o NAME.glb` writes: Hips, Spine and so on";

/// A person of a file.
pub struct Figure {
    /// The number of the agent.
    pub number: u32,
    /// The person: build and height.
    pub person: Person,
    /// The seconds of the animation in which the person is there: first and last.
    pub seconds: [f32; 2],
    /// The agent's node, then the joints in the order of [`Joint::ALL`].
    agent: SampledNode,
    joints: Vec<SampledNode>,
    /// The scale of the hips.
    scale: f64,
}

/// The figures of a file.
pub struct Figures {
    /// The figures, in the order of the skins.
    pub all: Vec<Figure>,
    /// Seconds from one frame to the next, on average.
    pub period: f64,
}

/// Reads the figures of a file.
///
/// # Errors
/// The file is not binary glTF, has no skins, or its skins have other joints.
///
/// ```
/// use throng_record::formats::glb::figures;
/// assert!(figures(b"no glTF").is_err());
/// ```
pub fn figures(bytes: &[u8]) -> Result<Figures, FormatFlaw> {
    parse(bytes).map_err(|why| FormatFlaw { line: None, why, hint: Some(HINT) })
}

fn parse(bytes: &[u8]) -> Result<Figures, String> {
    let data = Data::open(bytes)?;
    let channels = Channels::new(&data, bytes.len().saturating_mul(MOST))?;
    let nodes = &data.root.nodes;
    if data.root.skins.is_empty() {
        return Err("the file has no skins".to_owned());
    }
    let times = moments(&data)?;
    let (Some(first), Some(last)) = (times.first(), times.last()) else {
        return Err("the file does not say the times of its frames".to_owned());
    };
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
    Ok(Figures { all, period: (last - first) / (times.len().max(2) - 1) as f64 })
}

fn figure(data: &Data, channels: &Channels, first: f64, agent: usize, joints: &[usize]) -> Result<Figure, String> {
    let nodes = &data.root.nodes;
    let sampled = |at: usize| channels.of(data, at, &nodes[at]);
    let Some(Extras::Person(known)) = &nodes[agent].extras else {
        return Err(format!("the extras of node {agent} do not say which agent it is"));
    };
    let scale = nodes[joints[0]].scale.map_or(1.0, |scale| f64::from(scale[0]));
    let build = known.build.as_deref().and_then(|name| BUILDS.into_iter().find(|(_, known)| *known == name));
    let (build, _) = build.ok_or_else(|| format!("the extras of node {agent} name no build"))?;
    let (from, to) = known.from.zip(known.to).ok_or_else(|| format!("the extras of node {agent} have no times"))?;
    Ok(Figure {
        number: known.number,
        person: Person::new(0, u64::from(known.number)).with_build(build).with_height(scale),
        seconds: [from, to].map(|time| (time - first) as f32),
        agent: sampled(agent)?,
        joints: joints.iter().map(|&at| sampled(at)).collect::<Result<_, _>>()?,
        scale,
    })
}

impl Figure {
    /// Returns where the joints are at a second of the animation, metres from the origin of the scene, in the order of
    /// [`Joint::ALL`]; `None` while the agent is not there.
    pub fn joints(&self, second: f32) -> Option<[Placed; JOINTS]> {
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
