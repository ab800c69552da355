//! The joints of a file: where they are, and which of ours each node follows.

use super::names;
use crate::formats::glb::data::Data;
use crate::formats::glb::json::Root;
use crate::formats::glb::nodes::Nodes;
use crate::people::axes;
use glam::{DMat4, DVec3};
use serde_json::Value;
use throng_figure::{JOINTS, Joint};

/// How many names of joints an error lists.
const SHOWN: usize = 24;

/// The nodes of a file.
pub(super) struct Joints {
    /// The transform of each node to the world of the file.
    pub world: Vec<DMat4>,
    /// The joint of ours that each node follows: itself, or that of the nearest node above it; `None` without one.
    pub follows: Vec<Option<Joint>>,
    /// Where our joints are, m, z up.
    pub places: [Option<DVec3>; JOINTS],
}

impl Joints {
    /// Finds the joints of a file.
    ///
    /// # Errors
    /// A node is its own ancestor, joints are missing, or two nodes are one joint.
    pub fn of(data: &Data) -> Result<Self, String> {
        let Nodes { parents, order, world } = Nodes::of(&data.root.nodes)?;
        let found = find(&data.root)?;
        let mut follows = vec![None; world.len()];
        for joint in Joint::ALL {
            if let Some(at) = found[joint.index()] {
                follows[at] = Some(joint);
            }
        }
        for &at in &order {
            follows[at] = follows[at].or_else(|| parents[at].and_then(|parent| follows[parent]));
        }
        let places = found.map(|at| at.map(|at| axes::place(world[at].w_axis.truncate())));
        Ok(Self { world, follows, places })
    }
}

/// Returns the node of each of our joints: as the file says for humanoids (VRM), or by the names of the joints of skins.
fn find(root: &Root) -> Result<[Option<usize>; JOINTS], String> {
    let said = humanoid(root);
    let mut nodes: Vec<(usize, &str)> = said.iter().map(|(node, bone)| (*node, bone.as_str())).collect();
    if nodes.is_empty() {
        let mut skinned: Vec<usize> = root.skins.iter().flat_map(joints_of).collect();
        skinned.sort_unstable();
        skinned.dedup();
        nodes = skinned.into_iter().filter_map(|at| Some((at, root.nodes.get(at)?.name.as_str()))).collect();
    }
    if let Some((at, bone)) = nodes.iter().find(|(at, _)| *at >= root.nodes.len()) {
        return Err(format!("the humanoid bone {bone} is node {at}, which does not exist"));
    }
    if nodes.is_empty() {
        return Err("the file has no skin: no joints move its mesh".to_owned());
    }
    let found = names::mapped(nodes.iter().copied())?;
    let missing = NEEDED.iter().filter(|joint| found[joint.index()].is_none());
    let missing: Vec<&str> = missing.map(|joint| joint.name()).collect();
    if missing.is_empty() {
        return Ok(found);
    }
    let more = if nodes.len() > SHOWN { format!(" and {} more", nodes.len() - SHOWN) } else { String::new() };
    let shown: Vec<&str> = nodes.iter().take(SHOWN).map(|(_, name)| *name).collect();
    Err(format!("missing joints: {}; the joints of the file: {}{more}", missing.join(", "), shown.join(", ")))
}

/// The joints without which a body does not walk.
const NEEDED: [Joint; 13] = [
    Joint::Hips,
    Joint::Spine1,
    Joint::Head,
    Joint::LeftArm,
    Joint::LeftForeArm,
    Joint::RightArm,
    Joint::RightForeArm,
    Joint::LeftUpLeg,
    Joint::LeftLeg,
    Joint::LeftFoot,
    Joint::RightUpLeg,
    Joint::RightLeg,
    Joint::RightFoot,
];

/// Returns the nodes and the names of humanoid bones, as VRM 0.x and 1.0 say them.
fn humanoid(root: &Root) -> Vec<(usize, String)> {
    let node = |value: &Value| usize::try_from(value["node"].as_u64()?).ok();
    let old = root.extensions["VRM"]["humanoid"]["humanBones"].as_array();
    let old = old.into_iter().flatten().filter_map(|bone| Some((node(bone)?, bone["bone"].as_str()?.to_owned())));
    let new = root.extensions["VRMC_vrm"]["humanoid"]["humanBones"].as_object();
    let new = new.into_iter().flatten().filter_map(|(name, bone)| Some((node(bone)?, name.clone())));
    new.chain(old.filter(|_| root.extensions["VRMC_vrm"].is_null())).collect()
}

/// Returns the nodes of the joints of a skin.
pub(super) fn joints_of(skin: &Value) -> Vec<usize> {
    let joints = skin["joints"].as_array().map(Vec::as_slice).unwrap_or_default();
    // a number that is no node has no joint
    joints.iter().map(|at| at.as_u64().and_then(|at| usize::try_from(at).ok()).unwrap_or(usize::MAX)).collect()
}
