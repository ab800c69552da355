//! How agents avoid each other.

use super::Neighbours;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The local model of a group.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Avoid {
    /// Optimal reciprocal collision avoidance (van den Berg, Guy, Lin, Manocha, 2011).
    Orca(Orca),
    /// Optimal reciprocal collision avoidance in space, for those who fly.
    #[serde(rename = "orca_3d")]
    Orca3d(Orca3d),
    /// Acceleration-velocity obstacles (van den Berg, Snape, Guy, Manocha, 2011): ORCA for bodies that come to a new
    /// velocity with a delay.
    Avo(Avo),
    /// Hybrid reciprocal velocity obstacles (Snape, van den Berg, Guy, Manocha, 2011).
    Hrvo(Hrvo),
    /// Reciprocal velocity obstacles that end at a time horizon, solved exactly (ClearPath; Guy et al., 2009).
    Clearpath(Clearpath),
    /// Reciprocal velocity obstacles (van den Berg, Lin, Manocha, 2008).
    Rvo(Rvo),
    /// Reciprocal velocity obstacles as in two students' lab reports, faults included: to compare with.
    RvoLab(RvoLab),
    /// Velocity obstacles (Fiorini, Shiller, 1998): everybody takes all of the avoiding, and oscillates.
    Vo(Vo),
    /// No avoidance: only the guard keeps people apart.
    None(Unavoiding),
}

impl Default for Avoid {
    fn default() -> Self {
        Self::Orca(Orca::default())
    }
}

/// Parameters of models, each with its default; whom an agent sees is a part of all of them.
macro_rules! parameters {
    ($($(#[$meta:meta])* $name:ident { $($(#[$about:meta])* $key:ident: $type:ty = $default:expr,)* })*) => { $(
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(deny_unknown_fields, default)]
        pub struct $name {
            $($(#[$about])* pub $key: $type,)*
            /// How many of the nearest others are taken into account. Limit: 1 to 1000.
            pub neighbours: u32,
            /// How far an agent looks for others, metres between centres. Limit: > 0.
            pub neighbour_distance: f64,
        }

        impl Default for $name {
            fn default() -> Self {
                Self { $($key: $default,)* neighbours: 10, neighbour_distance: 5.0 }
            }
        }
    )* };
}

parameters! {
    /// Parameters of optimal reciprocal collision avoidance.
    Orca {
        /// Seconds ahead for which a velocity must be safe from other agents. Limit: > 0.
        time_horizon: f64 = 2.0,
        /// Seconds ahead for which a velocity must be safe from obstacles. Limit: > 0.
        time_horizon_obstacles: f64 = 0.7,
        /// How much cheaper it is to turn than to change speed: above 1 agents rather turn, below 1 they rather brake.
        /// Limit: 0.1 to 10.
        turning_bias: f64 = 1.0,
        /// The velocity that half-planes are built from.
        built_from: BuiltFrom = BuiltFrom::Current,
    }
    /// Parameters of optimal reciprocal collision avoidance in space.
    Orca3d {
        /// Seconds ahead for which a velocity must be safe from other agents. Limit: > 0.
        time_horizon: f64 = 2.0,
        /// Seconds ahead for which a velocity must be safe from obstacles. Limit: > 0.
        time_horizon_obstacles: f64 = 0.7,
        /// How much taller than they are bodies are taken to be: above 1 they rather avoid sideways than up and down.
        /// Limit: 1 to 10.
        vertical_scale: f64 = 1.0,
    }
    /// Parameters of acceleration-velocity obstacles.
    Avo {
        /// Seconds ahead for which a velocity must be safe from other agents. Limit: > 0.
        time_horizon: f64 = 2.0,
        /// Seconds ahead for which a velocity must be safe from obstacles. Limit: > 0.
        time_horizon_obstacles: f64 = 0.7,
        /// Seconds in which a body makes up all but a third of the way to its new velocity. Limit: > 0, at most 10.
        delay: f64 = 0.25,
    }
    /// Parameters of hybrid reciprocal velocity obstacles.
    Hrvo {
        /// Seconds ahead for which a velocity must be safe from obstacles. Limit: > 0.
        time_horizon_obstacles: f64 = 0.7,
    }
    /// Parameters of ClearPath.
    Clearpath {
        /// Seconds ahead for which a velocity must be safe from other agents. Limit: > 0.
        time_horizon: f64 = 2.0,
        /// Seconds ahead for which a velocity must be safe from obstacles. Limit: > 0.
        time_horizon_obstacles: f64 = 0.7,
    }
    /// Parameters of reciprocal velocity obstacles.
    Rvo {
        /// Weight of the time to a collision against the distance from the preferred velocity, metres. Limit: > 0.
        weight: f64 = 1.0,
        /// The part of the avoiding that is done where both have the same right of way (the paper's alpha). Limit: 0.1
        /// to 1.
        responsibility: f64 = 0.5,
        /// Seconds ahead beyond which collisions with other agents count for nothing. Limit: > 0.
        time_horizon: f64 = 5.0,
        /// The same for obstacles. Limit: > 0.
        time_horizon_obstacles: f64 = 0.7,
        /// Obstacles count only where braking would not do, as in the authors' library; `time_horizon_obstacles` has no
        /// meaning then.
        braking: bool = false,
        /// Only velocities that can be reached within a step are tried, as in the paper.
        kinodynamic: bool = false,
        /// How many velocities are drawn by chance in every step, as in the authors' library (250). 0: they are searched
        /// for by a pattern that is refined. Limit: at most 100,000.
        candidates: u32 = 0,
    }
    /// Parameters of the labs' algorithm: it has none but whom an agent sees.
    RvoLab {}
    /// Parameters of velocity obstacles.
    Vo {
        /// Seconds ahead for which a velocity must be safe from other agents. Limit: > 0.
        time_horizon: f64 = 2.0,
        /// Seconds ahead for which a velocity must be safe from obstacles. Limit: > 0.
        time_horizon_obstacles: f64 = 0.7,
    }
}

/// The velocity that ORCA's half-planes are built from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum BuiltFrom {
    /// The present one.
    #[default]
    Current,
    /// The preferred one: better where there is room, too much where there is none.
    Preferred,
    /// None: dense crowds stand.
    Zero,
}

/// Parameters of no avoidance: whom an agent sees.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Unavoiding {
    /// How many of the nearest others are taken into account, 1 to 1000; or `"all"` within the distance: for flocks.
    pub neighbours: Neighbours,
    /// How far an agent looks for others, metres between centres. Limit: > 0.
    pub neighbour_distance: f64,
}

impl Default for Unavoiding {
    fn default() -> Self {
        Self { neighbours: Neighbours::Nearest(10), neighbour_distance: 5.0 }
    }
}

impl Avoid {
    /// Which of the others are taken into account, and how far an agent looks for them.
    pub fn sight(&self) -> (Neighbours, f64) {
        let (nearest, distance) = match self {
            Self::None(model) => return (model.neighbours, model.neighbour_distance),
            Self::Orca(model) => (model.neighbours, model.neighbour_distance),
            Self::Orca3d(model) => (model.neighbours, model.neighbour_distance),
            Self::Avo(model) => (model.neighbours, model.neighbour_distance),
            Self::Hrvo(model) => (model.neighbours, model.neighbour_distance),
            Self::Clearpath(model) => (model.neighbours, model.neighbour_distance),
            Self::Rvo(model) => (model.neighbours, model.neighbour_distance),
            Self::RvoLab(model) => (model.neighbours, model.neighbour_distance),
            Self::Vo(model) => (model.neighbours, model.neighbour_distance),
        };
        (Neighbours::Nearest(nearest), distance)
    }
}
