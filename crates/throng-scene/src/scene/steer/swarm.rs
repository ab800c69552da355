//! Swarms of insects.

use super::{ObstacleNames, Target, parameters};
use crate::registry::Flow;
use crate::scene::flow::Noise;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

parameters! {
    /// Moves by noise and guides, as insects of a swarm do (Wang et al. 2014).
    Swarm {
        /// The guides, which add up.
        guides: Option<Vec<SwarmGuide>>,
        /// The noise. Without it, 0.6 m/s in eddies of 0.4 m and 0.5 s.
        noise: Option<Noise>,
        /// Whether each agent has its own noise; else near agents fly alike. Without it, true.
        own_noise: Option<bool>,
        /// Separation from other agents.
        apart: Option<KeepApart>,
        /// Repulsion from surfaces. Without it, none.
        keep_off: Option<KeepOff>,
    }
    /// Separation from other agents.
    KeepApart {
        /// Distance between centres within which agents repel each other, metres; 0 disables the separation and its
        /// neighbour search. Without it, 0.06. Limit: >= 0.
        distance: Option<f64>,
        /// Speed of the repulsion at distance 0, m/s. Without it, 1. Limit: >= 0.
        speed: Option<f64>,
    }
    /// Repulsion from surfaces.
    KeepOff {
        /// Names of surfaces and obstacles, `"obstacles"`, or `"everything"`.
        obstacles: ObstacleNames,
        /// Distance within which the surface repels, metres. Without it, 0.3. Limit: > 0.
        distance: Option<f64>,
        /// Speed of the repulsion at contact, m/s. Without it, 1. Limit: >= 0.
        speed: Option<f64>,
    }
    /// Follows a field.
    GuideFlow {
        /// The field.
        flow: Flow,
        /// Weight of the field. Without it, 1. Limit: >= 0.
        weight: Option<f64>,
    }
    /// Gathers at a marker.
    Aggregate {
        /// The marker.
        marker: Target,
        /// Speed for every metre beyond the distance `beyond`, 1/s. Without it, 1. Limit: >= 0.
        rate: Option<f64>,
        /// Distance within which the marker does not attract, metres. Without it, 0. Limit: >= 0.
        beyond: Option<f64>,
    }
    /// Flies to a light, and around it.
    Phototaxis {
        /// The light.
        light: Target,
        /// Its intensity at a distance of 1 m. Without it, 1. Limit: >= 0.
        power: Option<f64>,
        /// The intensity that attracts with half of the speed. Without it, 0.01. Limit: > 0.
        threshold: Option<f64>,
        /// Greatest speed of the attraction, m/s. Without it, 1. Limit: >= 0.
        speed: Option<f64>,
        /// Distance within which it circles, metres. Without it, 0.5. Limit: > 0.
        orbit: Option<f64>,
        /// Factor of the noise in the orbit. Without it, 1.5. Limit: >= 0.
        agitation: Option<f64>,
    }
    /// Is sedated by smoke.
    Sedation {
        /// A surface with an inside, which is full of smoke.
        smoke: String,
        /// Depth inside the surface at which the smoke has its full density, metres. Without it, 0.3. Limit: > 0.
        rim: Option<f64>,
        /// The dose of full smoke, 1/s: a dose of 1 leaves a vigour of 1/e. Without it, 0.5. Limit: >= 0.
        uptake: Option<f64>,
        /// Rate at which the dose wears off outside, 1/s. Without it, 0.1. Limit: >= 0.
        recovery: Option<f64>,
        /// Sinking speed without any vigour, m/s. Without it, 0.5. Limit: >= 0.
        sink: Option<f64>,
        /// Height above the ground at which it settles, metres. Without it, 0.02. Limit: >= 0.
        landing: Option<f64>,
    }
    /// Attacks a target.
    Attack {
        /// The prey.
        prey: Target,
        /// Greatest distance at which it attacks, metres. Without it, any distance. Limit: > 0.
        within: Option<f64>,
        /// Speed of the attack, m/s. Without it, 1.5. Limit: >= 0.
        speed: Option<f64>,
        /// Distance to the prey within which the noise fades, metres. Without it, 1. Limit: > 0.
        near: Option<f64>,
        /// Part of the noise that is left at the prey. Without it, 0.2. Limit: 0 to 1.
        calm: Option<f64>,
        /// Part of the agents that lead. Without it, 1. Limit: 0 to 1.
        leaders: Option<f64>,
        /// Distance within which the other agents look for agents to follow, metres. Without it, 0. Limit: >= 0.
        follow: Option<f64>,
    }
    /// Migrates along a path.
    Migrate {
        /// The path, by its name; inside its radius no guide draws to its centre line.
        path: String,
        /// Speed along the path, m/s. Without it, 1.5. Limit: >= 0.
        speed: Option<f64>,
        /// Speed back to the path for every metre outside of it, 1/s. Without it, 1. Limit: >= 0.
        rate: Option<f64>,
    }
    /// Matches the velocity of near agents, as locusts do.
    Align {
        /// Reach, metres. Without it, 0.5. Limit: >= 0.
        distance: Option<f64>,
        /// Weight of the match. Without it, 0.5. Limit: >= 0.
        weight: Option<f64>,
    }
    /// Stays between two heights.
    HeightBand {
        /// The lower height, metres.
        low: f64,
        /// The upper height, metres. Limit: at least `low`.
        high: f64,
        /// Speed back into the band for every metre outside of it, 1/s. Without it, 1. Limit: >= 0.
        rate: Option<f64>,
    }
    /// Flees from a predator.
    Escape {
        /// The predator.
        predator: Target,
        /// Distance of the predator at which it flees, metres. Without it, 1. Limit: > 0.
        within: Option<f64>,
        /// Speed of the escape, m/s. Without it, 2. Limit: >= 0.
        speed: Option<f64>,
        /// How long it continues to flee once the predator is no longer near, seconds. Without it, 0.5. Limit: >= 0.
        memory: Option<f64>,
    }
    /// Repulsion, alignment and attraction in nested zones around the agent (Wang et al. 2015).
    Zones {
        /// Outer radius of each zone, the innermost first, metres. Without it, 0.08, 0.3 and 0.8. Limit: >= 0,
        /// ascending.
        reach: Option<[f64; 3]>,
        /// Speed of the repulsion at distance 0, m/s. Without it, 1. Limit: >= 0.
        repulsion: Option<f64>,
        /// Part of the difference of velocities that it makes up. Without it, 0.5. Limit: >= 0.
        alignment: Option<f64>,
        /// Speed of the attraction in the middle of the outermost zone, m/s. Without it, 0.5. Limit: >= 0.
        attraction: Option<f64>,
    }
}

/// A guide of an insect.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SwarmGuide {
    /// Follows a field: wind, a path to a goal.
    Flow(GuideFlow),
    /// Gathers at a marker.
    Aggregate(Aggregate),
    /// Flies to a light, and around it.
    Phototaxis(Phototaxis),
    /// Is sedated by smoke.
    Sedation(Sedation),
    /// Attacks a target.
    Attack(Attack),
    /// Migrates along a path.
    Migrate(Migrate),
    /// Matches the velocity of near agents.
    Align(Align),
    /// Stays between two heights.
    HeightBand(HeightBand),
    /// Flees from a predator.
    Escape(Escape),
    /// Zones of repulsion, alignment and attraction.
    Zones(Zones),
}
