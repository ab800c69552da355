//! Curl noise: random eddies without sources and sinks, along walls and around moving bodies.

mod amplitude;
mod curl;
mod description;
mod octave;
mod simplex;
mod wall;

pub use amplitude::{Amplitude, FadeOut};
pub use curl::{CurlNoise, Potential};
pub use description::Noise;
pub use octave::Octave;
pub use wall::{NoiseWall, Rigid, RigidMotion};

/// Returns the ramp `15/8 r - 10/8 r^3 + 3/8 r^5` and its slope. It goes from -1 to 1 as `r` does, with zero slope and
/// curvature at both ends, and is constant beyond them (Bridson et al. 2007).
fn ramp(r: f32) -> (f32, f32) {
    if r.abs() >= 1.0 {
        return (1.0_f32.copysign(r), 0.0);
    }
    let square = r * r;
    let left = 1.0 - square;
    (r * (1.875 + square * (0.375 * square - 1.25)), 1.875 * left * left)
}
