//! Behaviours among neighbours: flocks, queues, followers, formations.

use super::{GroupFilter, Steer, Target, parameters};
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
    /// Keeps away from near neighbours.
    #[derive(Default)]
    Separation {
        /// The neighbours. Without it, all within 2 m.
        near: Option<Near>,
        /// How the repulsion falls off. Without it, `inverse`.
        falloff: Option<Falloff>,
        /// Length of the sum of repulsions from which on it uses all of the force; one neighbour at 1 m has length 1;
        /// 0: it always does. Without it, 2. Limit: >= 0.
        full: Option<f64>,
    }
    /// Turns to the mean direction of near neighbours.
    #[derive(Default)]
    Alignment {
        /// The neighbours. Without it, all that the neighbour search finds.
        near: Option<Near>,
        /// Difference of the directions, 0 to 2, from which on it uses all of the force; 0: it always does. Without it,
        /// 0. Limit: >= 0.
        full: Option<f64>,
    }
    /// Moves to the centre of near neighbours.
    #[derive(Default)]
    Cohesion {
        /// The neighbours. Without it, all that the neighbour search finds.
        near: Option<Near>,
        /// Distance of the centre, metres, from which on it uses all of the force; 0: it always does. Without it, 0.
        /// Limit: >= 0.
        full: Option<f64>,
    }
    /// Matches the mean velocity of near neighbours.
    #[derive(Default)]
    MatchVelocity {
        /// The neighbours. Without it, all that the neighbour search finds.
        near: Option<Near>,
    }
    /// Separation, alignment and cohesion together. The defaults are those of OpenSteer's boids.
    #[derive(Default)]
    Flocking {
        /// Separation. Without it, weight 0.444, 5 m, 135°.
        separation: Option<Rule>,
        /// Alignment. Without it, weight 0.296, 7.5 m, 45.6°.
        alignment: Option<Rule>,
        /// Cohesion. Without it, weight 0.296, 9 m, 98.6°.
        cohesion: Option<Rule>,
        /// Within this many of its own radii all neighbours count, at any angle. Without it, 3. Limit: >= 0.
        always: Option<f64>,
        /// The agents of the flock. Without it, its own group.
        groups: Option<GroupFilter>,
    }
    /// A rule of a flock.
    #[derive(Default)]
    Rule {
        /// Its force, as a part of the vehicle's greatest force. Limit: >= 0.
        weight: Option<f64>,
        /// Reach, metres. Limit: > 0.
        distance: Option<f64>,
        /// Half the angle of view, degrees from straight ahead. Limit: 0 to 180.
        angle: Option<f64>,
    }
    /// The flock of Reynolds 1987.
    #[derive(Default)]
    Boids {
        /// The neighbours. Without it, all within 9 m and 137.5° of ahead.
        near: Option<Near>,
        /// Additional weight of neighbours ahead, at the greatest speed. Without it, 1. Limit: >= 0.
        forward: Option<f64>,
        /// Distance of a neighbour, metres, at which the urge to avoid it is 1. Without it, 1.5. Limit: > 0.
        avoidance: Option<f64>,
        /// The greatest strength of each urge.
        strengths: Option<Strengths>,
        /// The target of a migration, if there is one.
        migration: Option<Target>,
    }
    /// The greatest strength of each urge of a flock, 0 to 1.
    #[derive(Default)]
    Strengths {
        /// To avoid neighbours. Without it, 1.
        avoid: Option<f64>,
        /// To match the neighbours' velocity. Without it, 0.8.
        matching: Option<f64>,
        /// To move to the neighbours' centre. Without it, 0.5.
        center: Option<f64>,
        /// To migrate. Without it, 0.4.
        migrate: Option<f64>,
    }
    /// Turns aside from the first neighbour that will come too near; does not change its speed.
    #[derive(Default)]
    AvoidNeighbours {
        /// The neighbours. Without it, all agents.
        groups: Option<GroupFilter>,
        /// How far ahead it looks, seconds. Without it, 3. Limit: > 0.
        horizon: Option<f64>,
    }
    /// Turns aside from a neighbour that is too close.
    #[derive(Default)]
    CloseAvoidance {
        /// The neighbours. Without it, all agents.
        groups: Option<GroupFilter>,
        /// Least gap between bodies, metres. Without it, 0. Limit: >= 0.
        gap: Option<f64>,
    }
    /// Turns, brakes or speeds up for the first neighbour that will come too near.
    #[derive(Default)]
    UnalignedAvoidance {
        /// The neighbours. Without it, all agents.
        groups: Option<GroupFilter>,
        /// How far ahead it looks, seconds. Without it, 3. Limit: > 0.
        horizon: Option<f64>,
        /// Gap between bodies that pass each other, metres. Without it, 0.1. Limit: >= 0.
        gap: Option<f64>,
    }
    /// Moves no faster than the neighbours right ahead that move the same way or stand.
    Queue {
        /// The neighbours that it queues behind. Without it, all agents.
        groups: Option<GroupFilter>,
        /// How far ahead it looks, metres between centres. Without it, 2. Limit: > 0.
        distance: Option<f64>,
        /// Width of its corridor beyond the widths of the two bodies, metres. Without it, 0. Limit: >= 0.
        width: Option<f64>,
        /// Gap between bodies at rest, metres. Without it, 0.1. Limit: >= 0.
        gap: Option<f64>,
        /// Seconds in which it closes all but a third of a greater gap. Without it, 0.5. Limit: > 0.
        headway: Option<f64>,
        /// The behaviour that it restrains.
        of: Box<Steer>,
    }
    /// Follows behind a leader, out of its way, apart from other followers.
    FollowLeader {
        /// The leader.
        leader: Target,
        /// Whether followers form a single file, in the order of the group. Without it, `false`: they form a bunch.
        single_file: Option<bool>,
        /// Distance behind the leader or the follower ahead, metres. Without it, 1. Limit: >= 0.
        gap: Option<f64>,
        /// Length of the area ahead of the leader that it keeps free, metres. Without it, 3. Limit: >= 0.
        free: Option<f64>,
        /// Extent of that area to either side, metres. Without it, 0.6. Limit: >= 0.
        width: Option<f64>,
        /// Distance at which it starts to slow down, metres. Without it, 2. Limit: >= 0.
        slowing_distance: Option<f64>,
        /// Distance between followers, metres. Without it, 0.8. Limit: > 0.
        spacing: Option<f64>,
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

/// How the repulsion of a neighbour falls off.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Falloff {
    /// With the distance (Reynolds 1999, OpenSteer).
    Inverse,
    /// With the square of the distance: better damped (Reynolds 1987).
    InverseSquare,
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
