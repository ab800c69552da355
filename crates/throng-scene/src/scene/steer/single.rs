//! Behaviours of a single agent, or of an agent towards a target.

use super::{Position, Steer, Target, parameters};
use crate::registry::Flow;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

parameters! {
    /// Moves straight away from a target.
    Flee {
        /// The target.
        target: Target,
        /// Greatest distance at which it flees, metres. Without it, any distance. Limit: > 0.
        panic_distance: Option<f64>,
    }
    /// Moves to the predicted position of a quarry.
    Pursue {
        /// The quarry.
        quarry: Target,
        /// How far ahead its position is predicted. Without it, cases of at most 10 s.
        prediction: Option<Prediction>,
    }
    /// Moves away from the predicted position of a menace.
    Evade {
        /// The menace.
        menace: Target,
        /// How far ahead its position is predicted. Without it, cases of at most 10 s.
        prediction: Option<Prediction>,
        /// Greatest distance at which it flees, metres. Without it, any distance. Limit: > 0.
        panic_distance: Option<f64>,
    }
    /// Passes a quarry at a distance.
    OffsetPursuit {
        /// The quarry.
        quarry: Target,
        /// How far ahead its position is predicted. Without it, cases of at most 10 s.
        prediction: Option<Prediction>,
        /// Distance at which it passes the quarry, metres. Limit: >= 0.
        distance: f64,
    }
    /// Approaches a quarry, then moves as it moves.
    Shadow {
        /// The quarry.
        quarry: Target,
        /// Distance that it keeps, metres. Limit: >= 0.
        distance: f64,
        /// Distance from that point at which it starts to slow down, metres. Without it, 1. Limit: >= 0.
        slowing_distance: Option<f64>,
    }
    /// Moves between two targets.
    Interpose {
        /// The first target.
        from: Target,
        /// The second target.
        to: Target,
        /// Position on the line: 0 at the first target, 1 at the second. Without it, 0.5. Limit: 0 to 1.
        ratio: Option<f64>,
        /// Distance at which it starts to slow down, metres. Without it, 1. Limit: >= 0.
        slowing_distance: Option<f64>,
    }
    /// Keeps a place beside a leader.
    KeepStation {
        /// The leader.
        leader: Target,
        /// The place: ahead of the leader, to its left, and above it, metres.
        offset: Position,
        /// Distance at which it starts to slow down, metres. Without it, 1. Limit: >= 0.
        slowing_distance: Option<f64>,
    }
    /// Moves to a place in a direction, and stops there or passes it at a speed.
    Dock {
        /// The place.
        place: Position,
        /// Direction of motion at the place, degrees counter-clockwise from +x.
        heading: f64,
        /// Elevation of that direction, degrees. Without it, level. Limit: -90 to 90.
        pitch: Option<f64>,
        /// Speed at the place, m/s; 0: it stops there. Without it, 0. Limit: >= 0.
        speed: Option<f64>,
        /// Time of arrival, seconds since the start. Without it, as soon as possible. Limit: >= 0.
        time: Option<f64>,
    }
    /// Runs up to a take-off point, in the direction and at the speed that make a leap land at another point.
    Takeoff {
        /// The take-off point.
        from: Position,
        /// The landing point.
        to: Position,
        /// Vertical velocity at take-off, m/s. Limit: enough to reach the height of the landing point.
        rise: f64,
        /// Gravitational acceleration, m/s². Without it, 9.81. Limit: > 0.
        gravity: Option<f64>,
    }
    /// Wanders: turns to one side and the other at random.
    #[derive(Default)]
    Wander {
        /// Strength of the turns: 1 turns at most 45° aside. Without it, 1. Limit: 0 to 1.4.
        strength: Option<f64>,
        /// Rate of change of the side, degrees per square root of a second. Without it, 57.3. Limit: >= 0.
        rate: Option<f64>,
    }
    /// Wanders: the angle by which it turns aside is noise.
    #[derive(Default)]
    FractalWander {
        /// Greatest angle by which it turns aside, degrees. Without it, 45.8. Limit: 0 to 85.
        angle: Option<f64>,
        /// The noise of the angle.
        noise: Option<Noise>,
    }
    /// Sweeps a region: moves to the cells that it visited least.
    Explore {
        /// The corner of the region with the least coordinates.
        min: Position,
        /// The corner with the greatest coordinates. Limit: not below `min`.
        max: Position,
        /// Number of cells along x. Limit: 1 to 4096 cells in all.
        columns: u64,
        /// Number of cells along y.
        rows: u64,
        /// Number of cells along z. Without it, 1.
        levels: Option<u64>,
    }
    /// Wanders until it sees its food, then moves there.
    Forage {
        /// The food.
        food: Target,
        /// Distance at which it sees the food, metres. Limit: > 0.
        range: f64,
        /// The behaviour until then. Without it, it wanders.
        of: Option<Box<Steer>>,
    }
    /// Turns to a target.
    Face {
        /// The target.
        target: Target,
    }
    /// Turns to the orientation of another agent.
    MatchOrientation {
        /// The agent.
        with: Target,
    }
    /// Turns to its direction of motion.
    #[derive(Default)]
    LookWhereYouGo {}
    /// Turns to a direction; does not change its speed.
    HeadFor {
        /// The direction, degrees counter-clockwise from +x.
        heading: f64,
        /// Elevation of the direction, degrees. Without it, level. Limit: -90 to 90.
        pitch: Option<f64>,
        /// Difference of the two directions, 0 to 2, from which on it uses all of the force. Without it, 0.2. Limit: >=
        /// 0.
        full: Option<f64>,
    }
    /// Moves away from near events (`World::notify`); the effect falls off with their age and distance.
    Fear {
        /// Reach of events, metres. Limit: > 0.
        range: f64,
        /// Seconds until an event is forgotten. Limit: > 0, at most 600.
        fades: f64,
    }
    /// Moves with a flow.
    FollowFlow {
        /// The flow.
        flow: Flow,
        /// How far ahead its position is predicted, seconds. Without it, 0. Limit: >= 0.
        prediction: Option<f64>,
    }
    /// Applies a part of its force straight ahead.
    MoveForward {
        /// Part of the greatest force. Limit: 0 to 1.
        part: f64,
    }
    /// Reaches a speed, whatever its direction.
    TargetSpeed {
        /// The speed, m/s. Limit: >= 0.
        speed: f64,
    }
    /// Returns when it is too far from something.
    Tether {
        /// The target that it stays near.
        to: Target,
        /// Greatest distance, metres. Limit: >= 0.
        length: f64,
    }
    /// A time in proportion to the distance.
    ByDistance {
        /// Seconds a metre. Limit: >= 0.
        per_metre: f64,
        /// Greatest time, seconds. Limit: >= 0.
        most: f64,
    }
    /// A time by OpenSteer's nine cases.
    #[derive(Default)]
    Cases {
        /// Greatest time, seconds. Without it, 10. Limit: >= 0.
        most: Option<f64>,
    }
    /// Perlin noise: a value that changes randomly over time.
    #[derive(Default)]
    Noise {
        /// Seconds from one random slope to the next, of the slowest octave. Without it, 2. Limit: > 0.
        period: Option<f64>,
        /// Number of octaves. Without it, 3. Limit: 1 to 8.
        octaves: Option<u32>,
        /// Amplitude of each octave relative to the one before. Without it, 0.5. Limit: 0 to 1.
        gain: Option<f64>,
        /// Whether the noise is turbulence, with creases where it turns. Without it, `false`.
        turbulent: Option<bool>,
    }
}

/// Applies a constant force, newtons.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ConstantForce(pub Position);

/// How far ahead the position of another agent is predicted.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Prediction {
    /// A constant number of seconds. Limit: >= 0.
    Constant(f64),
    /// A time in proportion to the distance.
    Distance(ByDistance),
    /// The time in which the agent covers the distance, times a factor by the position (ahead, aside or behind) and the
    /// heading of the other agent.
    Cases(Cases),
}
