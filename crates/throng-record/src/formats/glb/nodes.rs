//! The nodes of a file in its world.

use super::json::Node;
use super::read::{local, parents};
use glam::DMat4;

/// The nodes of a file.
pub(super) struct Nodes {
    /// The node that contains each node.
    pub parents: Vec<Option<usize>>,
    /// The nodes, each after its parent.
    pub order: Vec<usize>,
    /// The transform of each node to the world of the file.
    pub world: Vec<DMat4>,
}

impl Nodes {
    /// Returns where the nodes are.
    ///
    /// # Errors
    /// A node is its own ancestor, does not exist, or its transform is not finite.
    pub fn of(nodes: &[Node]) -> Result<Self, String> {
        let parents = parents(nodes)?;
        let order = from_the_roots(&parents)?;
        let mut world = vec![DMat4::IDENTITY; nodes.len()];
        for &at in &order {
            let above = parents[at].map_or(DMat4::IDENTITY, |parent| world[parent]);
            world[at] = above * local(&nodes[at]);
            if !world[at].is_finite() {
                return Err(format!("the transform of {} is not finite", called(nodes, at)));
            }
        }
        Ok(Self { parents, order, world })
    }
}

/// Returns the nodes, each after its parent.
fn from_the_roots(parents: &[Option<usize>]) -> Result<Vec<usize>, String> {
    let mut children = vec![Vec::new(); parents.len()];
    let mut order: Vec<usize> = Vec::new();
    for (at, parent) in parents.iter().enumerate() {
        match parent {
            Some(parent) => children[*parent].push(at),
            None => order.push(at),
        }
    }
    let mut next = 0;
    while next < order.len() {
        order.extend_from_slice(&children[order[next]]);
        next += 1;
    }
    let mut reached = vec![false; parents.len()];
    order.iter().for_each(|&at| reached[at] = true);
    match reached.iter().position(|reached| !reached) {
        Some(at) => Err(format!("node {at} is its own ancestor")),
        None => Ok(order),
    }
}

/// Returns the name of a node in messages.
pub(super) fn called(nodes: &[Node], at: usize) -> String {
    match nodes.get(at) {
        Some(node) if !node.name.is_empty() => format!("node {at} (`{}`)", node.name),
        _ => format!("node {at}"),
    }
}
