//! Steering in scene files: the behaviours of [`throng::steer`] and their combinations.
//!
//! Each behaviour is a table of its parameters.
//! Angles are degrees, places are world coordinates, agents and groups are referred to by group names.
//!
//! ```
//! use throng_scene::Steer;
//!
//! let in_code = Steer::named("arrive").with("target", vec![3.0, 4.0]).with("slowing_distance", 2);
//! let in_a_file: Steer = toml::from_str("arrive = { target = [3, 4], slowing_distance = 2 }")?;
//! assert_eq!(in_code, in_a_file);
//! # Ok::<(), toml::de::Error>(())
//! ```

mod combine;
mod group;
mod place;
mod position;
mod single;
mod target;

pub use combine::*;
pub use group::*;
pub use place::*;
pub use position::Position;
pub use single::*;
pub use target::{GroupFilter, Member, Target};

use crate::registry::{Behaviours, Steer, described};

/// Defines tables of parameters.
macro_rules! parameters {
    ($($(#[$meta:meta])* $name:ident { $($(#[$about:meta])* $key:ident: $type:ty,)* })*) => { $(
        $(#[$meta])*
        #[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
        #[serde(deny_unknown_fields)]
        pub struct $name {
            $($(#[$about])* pub $key: $type,)*
        }
    )* };
}
pub(in crate::scene) use parameters;

described! {
    Steer in Behaviours:
    /// Runs up to a leap, as gdx-ai's jump does.
    Takeoff = "takeoff",
    /// Keeps away from near neighbours (Reynolds 1999).
    Separation = "separation",
    /// Turns to the mean direction of near neighbours (Reynolds 1999).
    Alignment = "alignment",
    /// Moves to the centre of near neighbours (Reynolds 1999).
    Cohesion = "cohesion",
    /// Matches the mean velocity of near neighbours (Reynolds 1987).
    MatchVelocity = "match_velocity",
    /// Separation, alignment and cohesion together (Reynolds 1999).
    Flocking = "flocking",
    /// The flock of 1987 (Reynolds 1987).
    Boids = "boids",
    /// Turns aside from the first neighbour that will come too near, as OpenSteer does.
    AvoidNeighbours = "avoid_neighbours",
    /// Turns aside from a neighbour that is too close, as OpenSteer does.
    CloseAvoidance = "close_avoidance",
    /// Turns, brakes or speeds up for the first neighbour that will come too near (Reynolds 1999).
    UnalignedAvoidance = "unaligned_avoidance",
    /// Moves no faster than the neighbours right ahead (Reynolds 1999).
    Queue = "queue",
    /// Follows behind a leader, out of its way (Reynolds 1999).
    FollowLeader = "follow_leader",
    /// Keeps its place in a formation that moves with a leader.
    KeepFormation = "keep_formation",
    /// Avoids obstacles in its way (Reynolds 1999).
    AvoidObstacles = "avoid_obstacles",
    /// Avoids obstacles by a map of them, as OpenSteer's cars do.
    AvoidMap = "avoid_map",
    /// Moves away from what its whiskers touch, as in gdx-ai.
    Whiskers = "whiskers",
    /// Stays on one side of a surface (Reynolds 1999).
    Contain = "contain",
    /// Moves along a path (Reynolds 1999).
    FollowPath = "follow_path",
    /// Returns to a path that it is about to leave, as in OpenSteer.
    StayOnPath = "stay_on_path",
    /// Moves along a wall (Reynolds 1999).
    FollowWall = "follow_wall",
    /// Hides from another agent behind an obstacle (Reynolds 1999).
    Hide = "hide",
    /// Moves along a path among other agents (Reynolds 1999, "crowd path following").
    CrowdPath = "crowd_path",
    /// Moves through a door among other agents (Reynolds 1999, "queuing").
    QueueAtDoor = "queue_at_door",
    /// One behaviour at a time: a state machine.
    Switch = "switch",
}
