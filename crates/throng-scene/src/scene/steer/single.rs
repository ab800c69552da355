//! Behaviours of a single agent, or of an agent towards a target.

use super::{Position, parameters};

parameters! {
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
