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
mod slip;
mod swarm;
mod target;

pub use combine::*;
pub use group::*;
pub use place::*;
pub use position::Position;
pub use single::*;
pub use slip::*;
pub use swarm::*;
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
    /// Moves straight away from a target (Reynolds 1999).
    Flee = "flee",
    /// Moves to the predicted position of a quarry (Reynolds 1999).
    Pursue = "pursue",
    /// Moves away from the predicted position of a menace (Reynolds 1999).
    Evade = "evade",
    /// Passes a quarry at a distance (Reynolds 1999).
    OffsetPursuit = "offset_pursuit",
    /// Approaches a quarry, then moves as it moves (Reynolds 1999).
    Shadow = "shadow",
    /// Moves between two targets (Reynolds 1999).
    Interpose = "interpose",
    /// Keeps a place beside a leader, as wingmen do.
    KeepStation = "keep_station",
    /// Moves to a place, in a direction, at a speed, at a time (Reynolds 1999, "arrival").
    Dock = "dock",
    /// Runs up to a leap, as gdx-ai's jump does.
    Takeoff = "takeoff",
    /// Wanders at random (Reynolds 1999).
    Wander = "wander",
    /// Wanders by noise (Reynolds 1999).
    FractalWander = "fractal_wander",
    /// Sweeps a region (Reynolds 1999).
    Explore = "explore",
    /// Wanders until it sees its food, then moves there (Reynolds 1999).
    Forage = "forage",
    /// Turns to a target; does not move.
    Face = "face",
    /// Turns to the orientation of another agent.
    MatchOrientation = "match_orientation",
    /// Turns to its direction of motion.
    LookWhereYouGo = "look_where_you_go",
    /// Moves away from events until they are forgotten.
    Fear = "fear",
    /// Turns to a direction.
    HeadFor = "head_for",
    /// Applies a constant force.
    ConstantForce = "constant_force",
    /// Moves away from the predicted positions of several agents.
    EvadeAll = "evade_all",
    /// Moves past the defenders of a target.
    SlipThrough = "slip_through",
    /// Moves with a flow (Reynolds 1999).
    FollowFlow = "follow_flow",
    /// Applies a force straight ahead.
    MoveForward = "move_forward",
    /// Reaches a speed, whatever its direction.
    TargetSpeed = "target_speed",
    /// Returns when it is too far from something.
    Tether = "tether",
    /// Keeps its place in a formation that moves with a leader.
    KeepFormation = "keep_formation",
    /// Moves by noise and guides, as insects do (Wang et al. 2014).
    Swarm = "swarm",
    /// The sum of all parts, each times its weight (Reynolds 1999).
    WeightedSum = "weighted_sum",
    /// The sum of parts in order, up to the vehicle's greatest force.
    RunningSum = "running_sum",
    /// The first part that has something to correct (Reynolds 1999).
    Priority = "priority",
    /// The first part that has something to correct, of parts drawn at random (Reynolds 1999).
    Dithering = "dithering",
    /// The force is a budget: the parts take from it in order (Reynolds 1987).
    Allocation = "allocation",
    /// Moves in the direction with the greatest interest minus danger (Fray 2015).
    ContextSteering = "context_steering",
    /// One behaviour at a time: a state machine.
    Switch = "switch",
    /// Evaluates a part only at intervals.
    Amortised = "amortised",
    /// Keeps the force of a part for some time.
    Hold = "hold",
    /// Adds noise to a part, so that the motion looks less mechanical.
    Irregular = "irregular",
    /// Limits the speed and force of a part.
    Limited = "limited",
    /// Stops where a part would collide with an agent.
    StopAndWait = "stop_and_wait",
}
