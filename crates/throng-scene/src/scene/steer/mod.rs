//! What agents steer by, as scene files say it: the behaviours of [`throng::steer`] and ways to combine them.
//!
//! Each is a table of its parameters; those that can be left out are `Option`s, and have the library's defaults then.
//! Angles are degrees, places are world coordinates, agents and groups go by their groups' names.
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
pub use target::{Member, Target, Who};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Tables of parameters.
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

/// What an agent steers by: a behaviour, or several combined.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Steer {
    /// To a target at the top speed, and past it (Reynolds 1999).
    Seek(Seek),
    /// Straight away from a target (Reynolds 1999).
    Flee(Flee),
    /// To a target, and to rest there (Reynolds 1999).
    Arrive(Arrive),
    /// To where a quarry will be (Reynolds 1999).
    Pursue(Pursue),
    /// Away from where a menace will be (Reynolds 1999).
    Evade(Evade),
    /// Past a quarry at a distance (Reynolds 1999).
    OffsetPursuit(OffsetPursuit),
    /// Up to a quarry, then as it goes (Reynolds 1999).
    Shadow(Shadow),
    /// Between two others (Reynolds 1999).
    Interpose(Interpose),
    /// A place beside a leader, as wingmen have.
    KeepStation(KeepStation),
    /// To a place, in a direction, at a speed, at a time (Reynolds 1999, "arrival").
    Dock(Dock),
    /// A run-up to a leap, as gdx-ai's jump.
    Takeoff(Takeoff),
    /// Strolls about (Reynolds 1999).
    Wander(Wander),
    /// Strolls about by noise (Reynolds 1999).
    FractalWander(FractalWander),
    /// Sweeps a region (Reynolds 1999).
    Explore(Explore),
    /// Wanders until it sees what it looks for, then goes there (Reynolds 1999).
    Forage(Forage),
    /// Turns to a target, and leaves it to others where to go.
    Face(Face),
    /// Faces as somebody else does.
    MatchOrientation(MatchOrientation),
    /// Turns to where it goes.
    LookWhereYouGo(LookWhereYouGo),
    /// Away from what happened, until it is forgotten.
    Fear(Fear),
    /// Turns to a direction.
    HeadFor(HeadFor),
    /// Presses with a force that is always the same.
    ConstantForce(ConstantForce),
    /// Away from where all of them will be.
    EvadeAll(EvadeAll),
    /// Past those who defend a target.
    SlipThrough(SlipThrough),
    /// With a flow (Reynolds 1999).
    FollowFlow(FollowFlow),
    /// Presses ahead.
    MoveForward(MoveForward),
    /// Goes at a speed, wherever it goes.
    TargetSpeed(TargetSpeed),
    /// Comes back when it is too far from something.
    Tether(Tether),
    /// Away from those who are near (Reynolds 1999).
    Separation(Separation),
    /// Turns to where those who are near face (Reynolds 1999).
    Alignment(Alignment),
    /// To the middle of those who are near (Reynolds 1999).
    Cohesion(Cohesion),
    /// Takes on the velocity of those who are near (Reynolds 1987).
    MatchVelocity(MatchVelocity),
    /// Separation, alignment and cohesion together (Reynolds 1999).
    Flocking(Flocking),
    /// The flock of 1987 (Reynolds 1987).
    Boids(Boids),
    /// Turns aside from the first who will come too near, as OpenSteer does.
    AvoidNeighbours(AvoidNeighbours),
    /// Turns aside from who is too close, as OpenSteer does.
    CloseAvoidance(CloseAvoidance),
    /// Turns, brakes or speeds up for the first who will come too near (Reynolds 1999).
    UnalignedAvoidance(UnalignedAvoidance),
    /// Goes no faster than those right ahead (Reynolds 1999).
    Queue(Queue),
    /// Behind a leader, out of its way (Reynolds 1999).
    FollowLeader(FollowLeader),
    /// Its own place in a formation that moves with a leader.
    KeepFormation(KeepFormation),
    /// Round what is in the way (Reynolds 1999).
    AvoidObstacles(AvoidObstacles),
    /// By a map of what is solid, as OpenSteer's cars drive.
    AvoidMap(AvoidMap),
    /// Away from what its whiskers touch, as gdx-ai does.
    Whiskers(Whiskers),
    /// On one side of a surface (Reynolds 1999).
    Contain(Contain),
    /// Along a path (Reynolds 1999).
    FollowPath(FollowPath),
    /// Back to a path that it is about to leave, as OpenSteer does.
    StayOnPath(StayOnPath),
    /// Along a wall (Reynolds 1999).
    FollowWall(FollowWall),
    /// Behind an obstacle, hidden from somebody (Reynolds 1999).
    Hide(Hide),
    /// Along a path with others (Reynolds 1999, "crowd path following").
    CrowdPath(CrowdPath),
    /// Through a door with others (Reynolds 1999, "queuing").
    QueueAtDoor(QueueAtDoor),
    /// By noise and what guides it, as insects (Wang et al. 2014).
    Swarm(Swarm),
    /// The sum of all, each times its weight (Reynolds 1999).
    WeightedSum(WeightedSum),
    /// The sum of the first, up to the vehicle's top force.
    RunningSum(RunningSum),
    /// The first that has anything to correct (Reynolds 1999).
    Priority(Priority),
    /// The first that has anything to correct, of those drawn by chance (Reynolds 1999).
    Dithering(Dithering),
    /// What there is of force is granted to the first, then to the next (Reynolds 1987).
    Allocation(Allocation),
    /// In the direction that is the most interesting less its danger (Fray 2015).
    ContextSteering(ContextSteering),
    /// One at a time: a state machine.
    Switch(Switch),
    /// Asked only every so often.
    Amortised(Amortised),
    /// Kept for a while.
    Hold(Hold),
    /// Wavers by noise, so that motion is not like a robot's.
    Irregular(Irregular),
    /// With a speed and a force of its own.
    Limited(Limited),
    /// Stops where it would run into somebody.
    StopAndWait(StopAndWait),
    /// A behaviour that a program has added to the scene, by its name: see `Behaviours`.
    Custom(Custom),
}
