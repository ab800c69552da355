//! Steering in scene files: the behaviours of [`throng::steer`] and their combinations.
//!
//! Each behaviour is a table of its parameters. Optional parameters are `Option`s and have the library's defaults.
//! Angles are degrees, places are world coordinates, agents and groups are referred to by group names.
//!
//! ```
//! use throng_scene::Steer;
//! use throng_scene::steer::{Arrive, Target};
//!
//! let in_code = Steer::Arrive(Arrive { target: Target::At([3.0, 4.0].into()), slowing_distance: Some(2.0), tolerance: None });
//! let in_a_file: Steer = toml::from_str("arrive = { target = [3, 4], slowing_distance = 2 }")?;
//! assert_eq!(in_code, in_a_file);
//! # Ok::<(), toml::de::Error>(())
//! ```

mod combine;
mod custom;
mod group;
mod place;
mod position;
mod single;
mod slip;
mod swarm;
mod target;

pub use combine::*;
pub use custom::Custom;
pub use group::*;
pub use place::*;
pub use position::Position;
pub use single::*;
pub use slip::*;
pub use swarm::*;
pub use target::{GroupFilter, Member, Target};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

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

/// What an agent steers by: a behaviour, or a combination of behaviours.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Steer {
    /// Moves to a target at top speed, and past it (Reynolds 1999).
    Seek(Seek),
    /// Moves straight away from a target (Reynolds 1999).
    Flee(Flee),
    /// Moves to a target, and stops there (Reynolds 1999).
    Arrive(Arrive),
    /// Moves to the predicted position of a quarry (Reynolds 1999).
    Pursue(Pursue),
    /// Moves away from the predicted position of a menace (Reynolds 1999).
    Evade(Evade),
    /// Passes a quarry at a distance (Reynolds 1999).
    OffsetPursuit(OffsetPursuit),
    /// Approaches a quarry, then moves as it moves (Reynolds 1999).
    Shadow(Shadow),
    /// Moves between two targets (Reynolds 1999).
    Interpose(Interpose),
    /// Keeps a place beside a leader, as wingmen do.
    KeepStation(KeepStation),
    /// Moves to a place, in a direction, at a speed, at a time (Reynolds 1999, "arrival").
    Dock(Dock),
    /// Runs up to a leap, as gdx-ai's jump does.
    Takeoff(Takeoff),
    /// Wanders at random (Reynolds 1999).
    Wander(Wander),
    /// Wanders by noise (Reynolds 1999).
    FractalWander(FractalWander),
    /// Sweeps a region (Reynolds 1999).
    Explore(Explore),
    /// Wanders until it sees its food, then moves there (Reynolds 1999).
    Forage(Forage),
    /// Turns to a target; does not move.
    Face(Face),
    /// Turns to the orientation of another agent.
    MatchOrientation(MatchOrientation),
    /// Turns to its direction of motion.
    LookWhereYouGo(LookWhereYouGo),
    /// Moves away from events until they are forgotten.
    Fear(Fear),
    /// Turns to a direction.
    HeadFor(HeadFor),
    /// Applies a constant force.
    ConstantForce(ConstantForce),
    /// Moves away from the predicted positions of several agents.
    EvadeAll(EvadeAll),
    /// Moves past the defenders of a target.
    SlipThrough(SlipThrough),
    /// Moves with a flow (Reynolds 1999).
    FollowFlow(FollowFlow),
    /// Applies a force straight ahead.
    MoveForward(MoveForward),
    /// Reaches a speed, whatever its direction.
    TargetSpeed(TargetSpeed),
    /// Returns when it is too far from something.
    Tether(Tether),
    /// Keeps away from near neighbours (Reynolds 1999).
    Separation(Separation),
    /// Turns to the mean direction of near neighbours (Reynolds 1999).
    Alignment(Alignment),
    /// Moves to the centre of near neighbours (Reynolds 1999).
    Cohesion(Cohesion),
    /// Matches the mean velocity of near neighbours (Reynolds 1987).
    MatchVelocity(MatchVelocity),
    /// Separation, alignment and cohesion together (Reynolds 1999).
    Flocking(Flocking),
    /// The flock of 1987 (Reynolds 1987).
    Boids(Boids),
    /// Turns aside from the first neighbour that will come too near, as OpenSteer does.
    AvoidNeighbours(AvoidNeighbours),
    /// Turns aside from a neighbour that is too close, as OpenSteer does.
    CloseAvoidance(CloseAvoidance),
    /// Turns, brakes or speeds up for the first neighbour that will come too near (Reynolds 1999).
    UnalignedAvoidance(UnalignedAvoidance),
    /// Moves no faster than the neighbours right ahead (Reynolds 1999).
    Queue(Queue),
    /// Follows behind a leader, out of its way (Reynolds 1999).
    FollowLeader(FollowLeader),
    /// Keeps its place in a formation that moves with a leader.
    KeepFormation(KeepFormation),
    /// Avoids obstacles in its way (Reynolds 1999).
    AvoidObstacles(AvoidObstacles),
    /// Avoids obstacles by a map of them, as OpenSteer's cars do.
    AvoidMap(AvoidMap),
    /// Moves away from what its whiskers touch, as in gdx-ai.
    Whiskers(Whiskers),
    /// Stays on one side of a surface (Reynolds 1999).
    Contain(Contain),
    /// Moves along a path (Reynolds 1999).
    FollowPath(FollowPath),
    /// Returns to a path that it is about to leave, as in OpenSteer.
    StayOnPath(StayOnPath),
    /// Moves along a wall (Reynolds 1999).
    FollowWall(FollowWall),
    /// Hides from another agent behind an obstacle (Reynolds 1999).
    Hide(Hide),
    /// Moves along a path among other agents (Reynolds 1999, "crowd path following").
    CrowdPath(CrowdPath),
    /// Moves through a door among other agents (Reynolds 1999, "queuing").
    QueueAtDoor(QueueAtDoor),
    /// Moves by noise and guides, as insects do (Wang et al. 2014).
    Swarm(Swarm),
    /// The sum of all parts, each times its weight (Reynolds 1999).
    WeightedSum(WeightedSum),
    /// The sum of parts in order, up to the vehicle's greatest force.
    RunningSum(RunningSum),
    /// The first part that has something to correct (Reynolds 1999).
    Priority(Priority),
    /// The first part that has something to correct, of parts drawn at random (Reynolds 1999).
    Dithering(Dithering),
    /// The force is a budget: the parts take from it in order (Reynolds 1987).
    Allocation(Allocation),
    /// Moves in the direction with the greatest interest minus danger (Fray 2015).
    ContextSteering(ContextSteering),
    /// One behaviour at a time: a state machine.
    Switch(Switch),
    /// Evaluates a part only at intervals.
    Amortised(Amortised),
    /// Keeps the force of a part for some time.
    Hold(Hold),
    /// Adds noise to a part, so that the motion looks less mechanical.
    Irregular(Irregular),
    /// Limits the speed and force of a part.
    Limited(Limited),
    /// Stops where a part would collide with an agent.
    StopAndWait(StopAndWait),
    /// A behaviour that a program has added to the scene, by its name: see `Behaviours`.
    Custom(Custom),
}
