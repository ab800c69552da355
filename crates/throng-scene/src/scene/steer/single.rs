//! Behaviours of one agent, or of one towards another.

use super::{Position, Steer, Target, parameters};
use crate::scene::Flow;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

parameters! {
    /// Goes to a target at the top speed, and past it.
    Seek {
        /// Whom or what.
        target: Target,
    }
    /// Goes straight away from a target.
    Flee {
        /// From whom or what.
        target: Target,
        /// How near it must be, metres. Without it, however far. Limit: > 0.
        panic_distance: Option<f64>,
    }
    /// Goes to a target, slows down, and comes to rest there.
    Arrive {
        /// Where, or to whom.
        target: Target,
        /// How far away it begins to slow down, metres. Without it, 1. Limit: >= 0.
        slowing_distance: Option<f64>,
        /// How near is there, metres. Without it, 0.01. Limit: >= 0.
        tolerance: Option<f64>,
    }
    /// Goes to where a quarry will be.
    Pursue {
        /// Whom.
        quarry: Target,
        /// How far ahead of it to aim. Without it, cases of at most 10 s.
        prediction: Option<Prediction>,
    }
    /// Goes away from where a menace will be.
    Evade {
        /// From whom.
        menace: Target,
        /// How far ahead of it to look. Without it, cases of at most 10 s.
        prediction: Option<Prediction>,
        /// How near the menace must be, metres. Without it, however far. Limit: > 0.
        panic_distance: Option<f64>,
    }
    /// Passes a quarry at a distance.
    OffsetPursuit {
        /// Whom.
        quarry: Target,
        /// How far ahead of it to aim. Without it, cases of at most 10 s.
        prediction: Option<Prediction>,
        /// How far beside it to pass, metres. Limit: >= 0.
        distance: f64,
    }
    /// Comes up to a quarry, then goes as it goes.
    Shadow {
        /// Whom.
        quarry: Target,
        /// How near it comes, metres. Limit: >= 0.
        distance: f64,
        /// How far from there it begins to slow down, metres. Without it, 1. Limit: >= 0.
        slowing_distance: Option<f64>,
    }
    /// Goes between two others.
    Interpose {
        /// The one.
        from: Target,
        /// The other.
        to: Target,
        /// Where on the line: 0 at the one, 1 at the other. Without it, 0.5. Limit: 0 to 1.
        ratio: Option<f64>,
        /// How far away it begins to slow down, metres. Without it, 1. Limit: >= 0.
        slowing_distance: Option<f64>,
    }
    /// Keeps a place beside a leader.
    KeepStation {
        /// Whom.
        leader: Target,
        /// Where: ahead of the leader, to its left, and above, metres.
        offset: Position,
        /// How far away it begins to slow down, metres. Without it, 1. Limit: >= 0.
        slowing_distance: Option<f64>,
    }
    /// Comes to a place in a direction: to rest there, or through it at a speed.
    Dock {
        /// Where.
        place: Position,
        /// In which direction, degrees counter-clockwise from +x.
        heading: f64,
        /// How far upwards, degrees. Without it, level. Limit: -90 to 90.
        pitch: Option<f64>,
        /// How fast it goes there, m/s; 0: it stays. Without it, 0. Limit: >= 0.
        speed: Option<f64>,
        /// When, seconds since the start. Without it, as soon as it can. Limit: >= 0.
        time: Option<f64>,
    }
    /// Runs up to a place, in the direction and at the speed at which who takes off there lands at another.
    Takeoff {
        /// Where it takes off.
        from: Position,
        /// Where it lands.
        to: Position,
        /// How fast it rises when it takes off, m/s. Limit: enough to come as high as it lands.
        rise: f64,
        /// By how much it falls faster every second, m/s². Without it, 9.81. Limit: > 0.
        gravity: Option<f64>,
    }
    /// Strolls about: turns now to this, now to that side.
    #[derive(Default)]
    Wander {
        /// How far aside: 1 leads at most 45° aside. Without it, 1. Limit: 0 to 1.4.
        strength: Option<f64>,
        /// How fast the side changes, degrees per square root of a second. Without it, 57.3. Limit: >= 0.
        rate: Option<f64>,
    }
    /// Strolls about: the angle at which it turns aside is noise.
    #[derive(Default)]
    FractalWander {
        /// The most it turns aside, degrees. Without it, 45.8. Limit: 0 to 85.
        angle: Option<f64>,
        /// How the angle changes.
        noise: Option<Noise>,
    }
    /// Sweeps a region: goes to where it has been least.
    Explore {
        /// The least corner of the region.
        min: Position,
        /// The greatest corner. Limit: not below the least.
        max: Position,
        /// How many cells along x. Limit: 1 to 4096 cells in all.
        columns: u64,
        /// How many cells along y.
        rows: u64,
        /// How many cells one above the other. Without it, 1.
        levels: Option<u64>,
    }
    /// Wanders until it sees what it looks for, then goes there.
    Forage {
        /// What it looks for.
        food: Target,
        /// How near it must be to see it, metres. Limit: > 0.
        range: f64,
        /// What it does until then. Without it, it wanders.
        of: Option<Box<Steer>>,
    }
    /// Turns to a target.
    Face {
        /// Whom or what.
        target: Target,
    }
    /// Faces as somebody else does.
    MatchOrientation {
        /// As whom.
        with: Target,
    }
    /// Turns to where it goes: nothing to say.
    #[derive(Default)]
    LookWhereYouGo {}
    /// Turns to a direction, and leaves it to others how fast it goes.
    HeadFor {
        /// The direction, degrees counter-clockwise from +x.
        heading: f64,
        /// How far upwards, degrees. Without it, level. Limit: -90 to 90.
        pitch: Option<f64>,
        /// How great the difference of the two directions is, 0 to 2, from which it has all of the force. Without it, 0.2.
        /// Limit: >= 0.
        full: Option<f64>,
    }
    /// Goes away from events (`World::notify`) near it; the less the longer ago and the farther off they are.
    Fear {
        /// How far off events frighten, metres. Limit: > 0.
        range: f64,
        /// Seconds until an event is forgotten. Limit: > 0, at most 600.
        fades: f64,
    }
    /// Goes with a flow.
    FollowFlow {
        /// The flow.
        flow: Flow,
        /// How many seconds ahead. Without it, 0. Limit: >= 0.
        prediction: Option<f64>,
    }
    /// Presses ahead with part of its force.
    MoveForward {
        /// Part of the top force. Limit: 0 to 1.
        part: f64,
    }
    /// Goes at a speed, wherever it goes.
    TargetSpeed {
        /// The speed, m/s. Limit: >= 0.
        speed: f64,
    }
    /// Comes back when it is too far from something.
    Tether {
        /// Whom or what it keeps near to.
        to: Target,
        /// How far it may go, metres. Limit: >= 0.
        length: f64,
    }
    /// In proportion to the distance.
    ByDistance {
        /// Seconds for every metre. Limit: >= 0.
        per_metre: f64,
        /// The most seconds. Limit: >= 0.
        most: f64,
    }
    /// By OpenSteer's nine cases.
    #[derive(Default)]
    Cases {
        /// The most seconds. Without it, 10. Limit: >= 0.
        most: Option<f64>,
    }
    /// How a value changes by chance as time goes by: Perlin's noise.
    #[derive(Default)]
    Noise {
        /// Seconds from one random slope to the next, of the slowest octave. Without it, 2. Limit: > 0.
        period: Option<f64>,
        /// How many octaves. Without it, 3. Limit: 1 to 8.
        octaves: Option<u32>,
        /// How much smaller each octave is than the one before it. Without it, 0.5. Limit: 0 to 1.
        gain: Option<f64>,
        /// Turbulence: with creases where it turns. Without it, `false`.
        turbulent: Option<bool>,
    }
}

/// Presses with a force that is always the same, newtons.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ConstantForce(pub Position);

/// How many seconds ahead somebody's place is predicted.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Prediction {
    /// Always so many seconds. Limit: >= 0.
    Constant(f64),
    /// In proportion to the distance.
    Distance(ByDistance),
    /// The time in which the agent covers the distance, by whether the other is ahead, aside or behind, and how it goes.
    Cases(Cases),
}
