//! Behaviours among others: flocks, queues, followers, formations.

use super::{Steer, Target, Who, parameters};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

parameters! {
    /// Whom a behaviour takes into account, of those whom the agent sees.
    #[derive(Default)]
    Near {
        /// How far it reaches, metres between centres. Without it, as far as the agent sees. Limit: > 0.
        distance: Option<f64>,
        /// How far to either side of ahead, degrees. Without it, 180: all round. Limit: 0 to 180.
        angle: Option<f64>,
        /// Within so many times its own radius everybody counts, at any angle. Without it, 0. Limit: >= 0.
        always: Option<f64>,
        /// How many at most, the nearest. Without it, all. Limit: >= 1.
        most: Option<u64>,
        /// Who at all. Without it, anybody.
        who: Option<Who>,
    }
    /// Keeps away from those who are near.
    #[derive(Default)]
    Separation {
        /// From whom. Without it, from all within 2 m.
        near: Option<Near>,
        /// How their push falls off. Without it, by the distance.
        falloff: Option<Falloff>,
        /// How long the sum of pushes is from which it has all of the force; one neighbour at 1 m is 1; 0: always all.
        /// Without it, 2. Limit: >= 0.
        full: Option<f64>,
    }
    /// Turns to where those who are near face.
    #[derive(Default)]
    Alignment {
        /// With whom. Without it, with all whom it sees.
        near: Option<Near>,
        /// How great the difference is, 0 to 2, from which it has all of the force; 0: always all. Without it, 0. Limit:
        /// >= 0.
        full: Option<f64>,
    }
    /// Goes to the middle of those who are near.
    #[derive(Default)]
    Cohesion {
        /// Of whom. Without it, of all whom it sees.
        near: Option<Near>,
        /// How far off the middle is, metres, from where it has all of the force; 0: always all. Without it, 0. Limit:
        /// >= 0.
        full: Option<f64>,
    }
    /// Takes on the velocity of those who are near.
    #[derive(Default)]
    MatchVelocity {
        /// Whose. Without it, that of all whom it sees.
        near: Option<Near>,
    }
    /// Separation, alignment and cohesion together. Without numbers, those of OpenSteer's boids.
    #[derive(Default)]
    Flocking {
        /// Away from those who are near. Without it, weight 0.444, 5 m, 135°.
        separation: Option<Rule>,
        /// To where they face. Without it, weight 0.296, 7.5 m, 45.6°.
        alignment: Option<Rule>,
        /// To their middle. Without it, weight 0.296, 9 m, 98.6°.
        cohesion: Option<Rule>,
        /// Within so many times its own radius everybody counts, at any angle. Without it, 3. Limit: >= 0.
        always: Option<f64>,
        /// Who is of the flock. Without it, its own group.
        who: Option<Who>,
    }
    /// One of the three rules of a flock.
    #[derive(Default)]
    Rule {
        /// Its force, as a part of the vehicle's top force. Limit: >= 0.
        weight: Option<f64>,
        /// How far it reaches, metres. Limit: > 0.
        distance: Option<f64>,
        /// How far to either side of ahead, degrees. Limit: 0 to 180.
        angle: Option<f64>,
    }
    /// The flock of 1987.
    #[derive(Default)]
    Boids {
        /// Whom it sees. Without it, all within 9 m and 137.5° of ahead.
        near: Option<Near>,
        /// How much more it minds those ahead, at its top speed. Without it, 1. Limit: >= 0.
        forward: Option<f64>,
        /// How near another is, metres, when the urge to avoid it is 1. Without it, 1.5. Limit: > 0.
        avoidance: Option<f64>,
        /// The most of each urge.
        strengths: Option<Strengths>,
        /// Where it migrates, if anywhere.
        migration: Option<Target>,
    }
    /// The most of the urges of a flock, 0 to 1 each.
    #[derive(Default)]
    Strengths {
        /// To keep apart. Without it, 1.
        avoid: Option<f64>,
        /// To go as the others. Without it, 0.8.
        matching: Option<f64>,
        /// To come to the middle. Without it, 0.5.
        center: Option<f64>,
        /// To migrate. Without it, 0.4.
        migrate: Option<f64>,
    }
    /// Turns aside from the first who will come too near; never changes its speed.
    #[derive(Default)]
    AvoidNeighbours {
        /// Whom. Without it, anybody.
        who: Option<Who>,
        /// How many seconds ahead. Without it, 3. Limit: > 0.
        horizon: Option<f64>,
    }
    /// Turns aside from who is too close.
    #[derive(Default)]
    CloseAvoidance {
        /// From whom. Without it, anybody.
        who: Option<Who>,
        /// How far bodies should be apart, metres. Without it, 0. Limit: >= 0.
        gap: Option<f64>,
    }
    /// Turns, brakes or speeds up for the first who will come too near.
    #[derive(Default)]
    UnalignedAvoidance {
        /// For whom. Without it, anybody.
        who: Option<Who>,
        /// How many seconds ahead. Without it, 3. Limit: > 0.
        horizon: Option<f64>,
        /// How far bodies should be apart when they pass, metres. Without it, 0.1. Limit: >= 0.
        gap: Option<f64>,
    }
    /// Goes no faster than those right ahead who go the same way, or stand.
    Queue {
        /// Behind whom. Without it, anybody.
        who: Option<Who>,
        /// How far ahead it looks, metres between centres. Without it, 2. Limit: > 0.
        distance: Option<f64>,
        /// How much wider than the two bodies its lane is, metres. Without it, 0. Limit: >= 0.
        width: Option<f64>,
        /// How far bodies should be apart at rest, metres. Without it, 0.1. Limit: >= 0.
        gap: Option<f64>,
        /// Seconds in which it closes all but a third of a greater gap. Without it, 0.5. Limit: > 0.
        headway: Option<f64>,
        /// What it would do.
        of: Box<Steer>,
    }
    /// Goes behind a leader, out of its way, apart from other followers.
    FollowLeader {
        /// Whom.
        leader: Target,
        /// One behind the other, in the order of the group. Without it, `false`: in a bunch.
        single_file: Option<bool>,
        /// How far behind, metres. Without it, 1. Limit: >= 0.
        gap: Option<f64>,
        /// How far ahead of the leader its way is to be free, metres. Without it, 3. Limit: >= 0.
        free: Option<f64>,
        /// How far to either side of it, metres. Without it, 0.6. Limit: >= 0.
        width: Option<f64>,
        /// How far away it begins to slow down, metres. Without it, 2. Limit: >= 0.
        slowing_distance: Option<f64>,
        /// How far apart followers are, metres. Without it, 0.8. Limit: > 0.
        spacing: Option<f64>,
    }
    /// Keeps its own place in a formation that moves with a leader: the k-th of the group has the k-th place.
    KeepFormation {
        /// Whom they move with.
        leader: Target,
        /// How the places lie.
        pattern: Pattern,
        /// How many places there are. Without it, as many as the group has agents. Limit: >= 1.
        count: Option<u64>,
        /// How far neighbouring places are apart, metres. Limit: > 0.
        spacing: f64,
        /// How far from its place it begins to slow down, metres. Without it, 1. Limit: >= 0.
        slowing_distance: Option<f64>,
    }
}

/// How the push of a neighbour falls off.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Falloff {
    /// By the distance (Reynolds 1999, OpenSteer).
    Inverse,
    /// By the square of the distance: better damped (Reynolds 1987).
    InverseSquare,
}

/// How the places of a formation lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Pattern {
    /// Abreast: left, right, left, ever farther out.
    Line,
    /// One behind the other.
    Column,
    /// A wedge: left, right, left, each pair farther out and back.
    Wedge,
    /// Round the leader, from ahead to the left.
    Circle,
    /// A square behind the leader, row by row from its left.
    Grid,
}
