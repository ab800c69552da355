//! Behaviours among neighbours: formations.

use super::{GroupFilter, Target, parameters};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

parameters! {
    /// The neighbours that a behaviour takes into account, of those that the agent's neighbour search finds.
    #[derive(Default)]
    Near {
        /// Reach, metres between centres. Without it, that of the neighbour search. Limit: > 0.
        distance: Option<f64>,
        /// Half the angle of view, degrees from straight ahead. Without it, 180: all round. Limit: 0 to 180.
        angle: Option<f64>,
        /// Within this many of its own radii all neighbours count, at any angle. Without it, 0. Limit: >= 0.
        always: Option<f64>,
        /// Greatest number of neighbours, the nearest first. Without it, all. Limit: >= 1.
        most: Option<u64>,
        /// The agents that count. Without it, all agents.
        groups: Option<GroupFilter>,
    }
    /// Keeps its place in a formation that moves with a leader: the k-th agent of the group has the k-th place.
    KeepFormation {
        /// The leader.
        leader: Target,
        /// The arrangement of the places.
        pattern: Pattern,
        /// The number of places. Without it, as many as the group has agents. Limit: >= 1.
        count: Option<u64>,
        /// Distance between neighbouring places, metres. Limit: > 0.
        spacing: f64,
        /// Distance from its place at which it starts to slow down, metres. Without it, 1. Limit: >= 0.
        slowing_distance: Option<f64>,
    }
}

/// The arrangement of the places of a formation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Pattern {
    /// Abreast, alternating left and right, farther and farther out.
    Line,
    /// In single file.
    Column,
    /// A wedge, alternating left and right, each pair farther out and back.
    Wedge,
    /// Around the leader, from ahead to the left.
    Circle,
    /// A square behind the leader, row by row from its left.
    Grid,
}
