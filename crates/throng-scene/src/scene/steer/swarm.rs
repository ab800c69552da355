//! Swarms of insects.

use super::{Target, What, parameters};
use crate::scene::Flow;
use crate::scene::flow::Noise;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

parameters! {
    /// Goes by noise, and by what guides it, as insects of a swarm do (Wang et al. 2014).
    Swarm {
        /// What guides it; all add up.
        guides: Option<Vec<SwarmGuide>>,
        /// Its noise. Without it, 0.6 m/s in eddies of 0.4 m and 0.5 s.
        noise: Option<Noise>,
        /// Whether each has a noise of its own; else those who are near each other fly alike. Without it, true.
        own_noise: Option<bool>,
        /// How it keeps apart from others.
        apart: Option<KeepApart>,
        /// What it keeps off. Without it, nothing.
        keep_off: Option<KeepOff>,
    }
    /// Keeps apart from others.
    KeepApart {
        /// From those within this distance between centres, metres; 0: from nobody, and nobody is looked for. Without it, 0.06.
        /// Limit: >= 0.
        distance: Option<f64>,
        /// How fast it goes away from one that is where it is itself, m/s. Without it, 1. Limit: >= 0.
        speed: Option<f64>,
    }
    /// Keeps off surfaces.
    KeepOff {
        /// Names of surfaces and obstacles, `"obstacles"`, or `"everything"`.
        what: What,
        /// From within this distance, metres. Without it, 0.3. Limit: > 0.
        distance: Option<f64>,
        /// How fast it goes away where it touches, m/s. Without it, 1. Limit: >= 0.
        speed: Option<f64>,
    }
    /// Goes with a field.
    GuideFlow {
        /// The field.
        flow: Flow,
        /// How much of it. Without it, 1. Limit: >= 0.
        weight: Option<f64>,
    }
    /// Gathers at a marker.
    Aggregate {
        /// Whom or what.
        marker: Target,
        /// How fast for every metre that it is too far off, 1/s. Without it, 1. Limit: >= 0.
        rate: Option<f64>,
        /// Within this distance nothing draws it, metres. Without it, 0. Limit: >= 0.
        beyond: Option<f64>,
    }
    /// Flies to a light, and round it.
    Phototaxis {
        /// The light.
        light: Target,
        /// Its intensity at a distance of 1 m. Without it, 1. Limit: >= 0.
        power: Option<f64>,
        /// The intensity that draws with half of the speed. Without it, 0.01. Limit: > 0.
        threshold: Option<f64>,
        /// How fast it draws at most, m/s. Without it, 1. Limit: >= 0.
        speed: Option<f64>,
        /// Within this distance it circles, metres. Without it, 0.5. Limit: > 0.
        orbit: Option<f64>,
        /// How many times as strong the noise is in the orbit. Without it, 1.5. Limit: >= 0.
        agitation: Option<f64>,
    }
    /// Is sedated by smoke.
    Sedation {
        /// A surface with an inside, full of smoke.
        smoke: String,
        /// How far inside of it the smoke is in full, metres. Without it, 0.3. Limit: > 0.
        rim: Option<f64>,
        /// The dose of full smoke, 1/s: 1 leaves a vigour of 1/e. Without it, 0.5. Limit: >= 0.
        uptake: Option<f64>,
        /// How fast the dose wears off outside, 1/s. Without it, 0.1. Limit: >= 0.
        recovery: Option<f64>,
        /// How fast it sinks without any vigour, m/s. Without it, 0.5. Limit: >= 0.
        sink: Option<f64>,
        /// How near the ground it settles, metres. Without it, 0.02. Limit: >= 0.
        landing: Option<f64>,
    }
    /// Attacks somebody.
    Attack {
        /// Whom.
        prey: Target,
        /// How near it must be, metres. Without it, however far. Limit: > 0.
        within: Option<f64>,
        /// How fast, m/s. Without it, 1.5. Limit: >= 0.
        speed: Option<f64>,
        /// Within this distance of it the noise fades, metres. Without it, 1. Limit: > 0.
        near: Option<f64>,
        /// What part of the noise is left at the prey. Without it, 0.2. Limit: 0 to 1.
        calm: Option<f64>,
        /// What part of all lead. Without it, 1. Limit: 0 to 1.
        leaders: Option<f64>,
        /// How far the others look for those they go with, metres. Without it, 0. Limit: >= 0.
        follow: Option<f64>,
    }
    /// Migrates along a path.
    Migrate {
        /// The path, by its name; within its radius nothing draws to its middle.
        path: String,
        /// How fast along it, m/s. Without it, 1.5. Limit: >= 0.
        speed: Option<f64>,
        /// How fast back for every metre outside of it, 1/s. Without it, 1. Limit: >= 0.
        rate: Option<f64>,
    }
    /// Goes as those near do, as locusts.
    Align {
        /// How far it looks, metres. Without it, 0.5. Limit: >= 0.
        distance: Option<f64>,
        /// How much. Without it, 0.5. Limit: >= 0.
        weight: Option<f64>,
    }
    /// Stays between two heights.
    HeightBand {
        /// Not below, metres.
        low: f64,
        /// Not above, metres. Limit: at least `low`.
        high: f64,
        /// How fast back for every metre beyond, 1/s. Without it, 1. Limit: >= 0.
        rate: Option<f64>,
    }
    /// Flees from a predator.
    Escape {
        /// From whom.
        predator: Target,
        /// How near it must come, metres. Without it, 1. Limit: > 0.
        within: Option<f64>,
        /// How fast, m/s. Without it, 2. Limit: >= 0.
        speed: Option<f64>,
        /// How long it goes on once it is no longer near, seconds. Without it, 0.5. Limit: >= 0.
        memory: Option<f64>,
    }
    /// Keeps others at a distance, goes as they go, or comes nearer, by how near they are (Wang et al. 2015).
    Zones {
        /// How far each zone reaches, the innermost first, metres. Without it, 0.08, 0.3 and 0.8. Limit: >= 0, ascending.
        reach: Option<[f64; 3]>,
        /// How fast away from one that is where it is itself, m/s. Without it, 1. Limit: >= 0.
        repulsion: Option<f64>,
        /// What part of the difference of velocities it makes up. Without it, 0.5. Limit: >= 0.
        alignment: Option<f64>,
        /// How fast to those in the middle of the outermost zone, m/s. Without it, 0.5. Limit: >= 0.
        attraction: Option<f64>,
    }
}

/// What guides an insect.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SwarmGuide {
    /// With a field: wind, a way to a goal.
    Flow(GuideFlow),
    /// To a marker.
    Aggregate(Aggregate),
    /// To a light and round it.
    Phototaxis(Phototaxis),
    /// Sedated by smoke.
    Sedation(Sedation),
    /// At somebody.
    Attack(Attack),
    /// Along a path.
    Migrate(Migrate),
    /// As those near.
    Align(Align),
    /// Between two heights.
    HeightBand(HeightBand),
    /// Away from a predator.
    Escape(Escape),
    /// Zones of repulsion, alignment and attraction.
    Zones(Zones),
}
