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
    /// Optimal reciprocal collision avoidance in space, for agents that fly.
    #[serde(rename = "orca_3d")]
    Orca3d(Orca3d),
    /// Acceleration-velocity obstacles (van den Berg, Snape, Guy, Manocha, 2011): ORCA for bodies that reach a new
    /// velocity with a delay.
    Avo(Avo),
    /// Hybrid reciprocal velocity obstacles (Snape, van den Berg, Guy, Manocha, 2011).
    Hrvo(Hrvo),
    /// Reciprocal velocity obstacles that end at a time horizon, solved exactly (ClearPath; Guy et al., 2009).
    Clearpath(Clearpath),
    /// Reciprocal velocity obstacles (van den Berg, Lin, Manocha, 2008).
    Rvo(Rvo),
    /// Reciprocal velocity obstacles as in two students' lab reports, with their faults, for comparison.
    RvoLab(RvoLab),
    /// Velocity obstacles (Fiorini, Shiller, 1998): every agent takes all of the avoidance, and oscillates.
    Vo(Vo),
    /// The collision-free speed model (Tordeux, Chraibi, Seyfried, 2016), as in JuPedSim.
    CollisionFreeSpeed(CollisionFreeSpeed),
    /// The anticipation velocity model (Xu, Chraibi, Seyfried, 2021), as in JuPedSim.
    AnticipationVelocity(AnticipationVelocity),
    /// The social force model (Helbing, Molnar, 1995).
    SocialForce(SocialForce),
    /// The social force model measured in experiments (Moussaid and others, 2009).
    #[serde(rename = "moussaid_2009")]
    Moussaid2009(Moussaid2009),
    /// The power law of human interaction with an implicit step (Karamouzas, Skinner, Guy, 2014; Karamouzas, Sohre,
    /// Narain, Guy, 2017): accelerations by the time to a collision.
    PowerLaw(PowerLaw),
    /// No avoidance: only the guard keeps agents apart.
    None(NoAvoidance),
}

impl Default for Avoid {
    fn default() -> Self {
        Self::Orca(Orca::default())
    }
}

/// Defines the parameters of models, each with its default. All models have the two parameters of the neighbour search.
macro_rules! parameters {
    ($($(#[$meta:meta])* $name:ident $(sees $distance:literal)? { $($(#[$about:meta])* $key:ident: $type:ty = $default:expr,)* })*) => { $(
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(deny_unknown_fields, default)]
        pub struct $name {
            $($(#[$about])* pub $key: $type,)*
            /// The maximum number of neighbours taken into account, the nearest first. Limit: 1 to 1000.
            pub neighbours: u32,
            /// Reach of the neighbour search, metres between centres. Limit: > 0.
            pub neighbour_distance: f64,
        }

        impl Default for $name {
            fn default() -> Self {
                Self { $($key: $default,)* neighbours: 10, neighbour_distance: [$($distance,)? 8.0][0] }
            }
        }
    )* };
}

parameters! {
    /// Parameters of optimal reciprocal collision avoidance.
    Orca {
        /// Seconds ahead for which a velocity must be safe from other agents. Limit: > 0.
        time_horizon: f64 = 1.0,
        /// Seconds ahead for which a velocity must be safe from obstacles. Limit: > 0.
        time_horizon_obstacles: f64 = 0.7,
        /// Cost of a change of speed relative to a turn: above 1 agents prefer to turn, below 1 they prefer to brake.
        /// Limit: 0.1 to 10.
        turning_bias: f64 = 1.0,
        /// The velocity from which half-planes are built.
        built_from: BuiltFrom = BuiltFrom::Current,
    }
    /// Parameters of optimal reciprocal collision avoidance in space.
    Orca3d {
        /// Seconds ahead for which a velocity must be safe from other agents. Limit: > 0.
        time_horizon: f64 = 2.0,
        /// Seconds ahead for which a velocity must be safe from obstacles. Limit: > 0.
        time_horizon_obstacles: f64 = 0.7,
        /// Factor by which bodies are taken to be taller than they are: above 1 agents prefer to avoid sideways. Limit:
        /// 1 to 10.
        vertical_scale: f64 = 1.0,
    }
    /// Parameters of acceleration-velocity obstacles.
    Avo {
        /// Seconds ahead for which a velocity must be safe from other agents. Limit: > 0.
        time_horizon: f64 = 2.0,
        /// Seconds ahead for which a velocity must be safe from obstacles. Limit: > 0.
        time_horizon_obstacles: f64 = 0.7,
        /// Seconds in which a body completes all but a third of a change of velocity. Limit: > 0, at most 10.
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
        /// The part of the avoidance that an agent does if both agents have the same right of way (the paper's alpha).
        /// Limit: 0.1 to 1.
        responsibility: f64 = 0.5,
        /// Seconds ahead beyond which collisions with other agents do not count. Limit: > 0.
        time_horizon: f64 = 5.0,
        /// Seconds ahead beyond which collisions with obstacles do not count. Limit: > 0.
        time_horizon_obstacles: f64 = 0.7,
        /// Obstacles count only if braking does not suffice, as in the authors' library; `time_horizon_obstacles` has
        /// no effect then.
        braking: bool = false,
        /// Only velocities that can be reached within a step are candidates, as in the paper.
        kinodynamic: bool = false,
        /// Number of random candidate velocities in each step, as in the authors' library (250). 0: a pattern that is
        /// refined replaces them. Limit: at most 100,000.
        candidates: u32 = 0,
    }
    /// Parameters of the labs' algorithm: only those of the neighbour search.
    RvoLab {}
    /// Parameters of the power law. The neighbour search must reach as far as two agents walk within the time horizon.
    PowerLaw sees 10.0 {
        /// Strength of the interaction, m^2 (the paper's k over the mass). Limit: >= 0.
        strength: f64 = 1.5,
        /// Seconds beyond which collisions are screened off (the paper's tau0). Limit: > 0.
        time_horizon: f64 = 3.0,
        /// Seconds to reach the preferred velocity (the paper's xi). Limit: > 0.
        relaxation_time: f64 = 0.54,
        /// The part of the radii within which a collision counts as grazing (epsilon). Limit: 0.01 to 0.9.
        grazing: f64 = 0.2,
        /// Strength of the repulsion at contact, m^3/s^3 (eta). Limit: >= 0.
        contact: f64 = 0.01,
    }
    /// Parameters of the social force model of 2009. Distances are between centres.
    Moussaid2009 {
        /// Seconds to reach the preferred velocity (the paper's tau). Limit: > 0.
        relaxation_time: f64 = 0.54,
        /// Greatest acceleration by one neighbour, m/s^2 (A). Limit: >= 0.
        strength: f64 = 4.5,
        /// Range of an interaction with a direction of length 1, metres. Limit: > 0.
        gamma: f64 = 0.35,
        /// Weight of the relative velocity against the direction to the neighbour, s/m. Limit: >= 0.
        lambda: f64 = 2.0,
        /// How narrow the angle is in which neighbours make the agent turn, 1/m (n). Limit: >= 0.
        turning: f64 = 2.0,
        /// How narrow the angle is in which neighbours make the agent brake, 1/m (n'). Limit: >= 0.
        braking: f64 = 3.0,
        /// Preference for passing on the right, 1/m (epsilon); negative: on the left.
        side_preference: f64 = 0.005,
        /// Acceleration at the surface of an obstacle, m/s^2 (a). Limit: >= 0.
        strength_obstacles: f64 = 3.0,
        /// Range of that acceleration, metres (b). Limit: > 0.
        range_obstacles: f64 = 0.1,
    }
    /// Parameters of the social force model of 1995. Distances are between centres.
    SocialForce {
        /// Seconds to reach the preferred velocity (the paper's tau). Limit: > 0.
        relaxation_time: f64 = 0.5,
        /// Strength of the potential of a neighbour, m^2/s^2 (V0). Limit: >= 0.
        strength: f64 = 2.1,
        /// Range of that potential, metres (sigma). Limit: > 0.
        range: f64 = 0.3,
        /// How far ahead a neighbour needs room for its step, seconds (Delta t). Limit: >= 0.
        anticipation_time: f64 = 2.0,
        /// Strength of the potential of an obstacle, m^2/s^2 (U0). Limit: >= 0.
        strength_obstacles: f64 = 10.0,
        /// Range of that potential, metres (R). Limit: > 0.
        range_obstacles: f64 = 0.2,
        /// Angle of view, degrees (2 phi). Limit: 0 to 360.
        view_angle: f64 = 200.0,
        /// Weight of neighbours outside the angle of view (c). Limit: 0 to 1.
        out_of_view: f64 = 0.5,
    }
    /// Parameters of the anticipation velocity model.
    AnticipationVelocity {
        /// Seconds that an agent stays behind the neighbour ahead (T). Limit: > 0.
        time_gap: f64 = 1.06,
        /// How far ahead positions are predicted, seconds. Limit: >= 0.
        anticipation_time: f64 = 1.0,
        /// Seconds in which the direction completes all but 1/e of a change. Limit: > 0.
        reaction_time: f64 = 0.3,
        /// Influence of a neighbour at contact on the direction, relative to the preferred direction. Limit: >= 0.
        strength: f64 = 8.0,
        /// Metres of predicted gap over which that influence falls to 1/e. Limit: > 0.
        range: f64 = 0.1,
        /// Gap to an obstacle, metres, within which an agent does not walk towards it. Limit: >= 0.
        wall_buffer: f64 = 0.1,
        /// How strongly such an agent turns away from the obstacle. Limit: >= 0.
        wall_pushout: f64 = 0.3,
    }
    /// Parameters of the collision-free speed model.
    CollisionFreeSpeed {
        /// Seconds that an agent stays behind the neighbour ahead (T). Limit: > 0.
        time_gap: f64 = 1.0,
        /// Influence of a neighbour at contact on the direction, relative to the preferred direction. Limit: >= 0.
        strength: f64 = 8.0,
        /// Metres of gap over which that influence falls to 1/e. Limit: > 0.
        range: f64 = 0.1,
        /// As `strength`, for obstacles. Limit: >= 0.
        strength_obstacles: f64 = 5.0,
        /// As `range`, for obstacles. Limit: > 0.
        range_obstacles: f64 = 0.02,
    }
    /// Parameters of velocity obstacles.
    Vo {
        /// Seconds ahead for which a velocity must be safe from other agents. Limit: > 0.
        time_horizon: f64 = 2.0,
        /// Seconds ahead for which a velocity must be safe from obstacles. Limit: > 0.
        time_horizon_obstacles: f64 = 0.7,
    }
}

/// The velocity from which ORCA's half-planes are built.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum BuiltFrom {
    /// The present velocity.
    #[default]
    Current,
    /// The preferred velocity: better where there is room, too strict where there is none.
    Preferred,
    /// Zero: dense crowds stop.
    Zero,
}

/// Parameters of agents without avoidance: those of the neighbour search.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct NoAvoidance {
    /// The maximum number of neighbours taken into account, the nearest first, 1 to 1000; or `"all"` within the
    /// distance, for flocks.
    pub neighbours: Neighbours,
    /// Reach of the neighbour search, metres between centres. Limit: > 0.
    pub neighbour_distance: f64,
}

impl Default for NoAvoidance {
    fn default() -> Self {
        Self { neighbours: Neighbours::Nearest(10), neighbour_distance: 5.0 }
    }
}

impl Avoid {
    /// Returns the number of neighbours that an agent takes into account, and the reach of its neighbour search,
    /// metres.
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
            Self::PowerLaw(model) => (model.neighbours, model.neighbour_distance),
            Self::Moussaid2009(model) => (model.neighbours, model.neighbour_distance),
            Self::SocialForce(model) => (model.neighbours, model.neighbour_distance),
            Self::AnticipationVelocity(model) => (model.neighbours, model.neighbour_distance),
            Self::CollisionFreeSpeed(model) => (model.neighbours, model.neighbour_distance),
            Self::Vo(model) => (model.neighbours, model.neighbour_distance),
        };
        (Neighbours::Nearest(nearest), distance)
    }
}
