//! Preference for turning over braking, or the reverse: Curtis, Manocha, Pedestrian simulation using geometric
//! reasoning in velocity space, Pedestrian and Evacuation Dynamics 2012 (2014), section 3.
//!
//! The optimisation runs in a space where the axis across the preferred velocity is shrunk by the bias. Velocities
//! beside the preferred one are nearer there. Half-planes stay half-planes. The disc of speeds becomes an ellipse,
//! which is approximated by an inscribed polygon.

use super::{HalfPlane, orca};
use glam::Vec2;

/// Number of corners of the polygon, which is within 0.5 % of the disc.
const CORNERS: usize = 32;

/// [`orca::optimum`], with lateral changes `bias` times cheaper than changes of speed.
pub(super) fn optimum(
    lines: &[HalfPlane],
    hard: usize,
    speed: f32,
    preferred: Vec2,
    bias: f32,
    fallback: &mut Vec<HalfPlane>,
) -> Vec2 {
    let Some(ahead) = preferred.try_normalize() else {
        return orca::optimum(lines, hard, speed, preferred, fallback);
    };
    // into the frame of the preferred velocity, and back
    let shrink = |v: Vec2| Vec2::new(v.dot(ahead), ahead.perp_dot(v) / bias);
    let shrunk =
        |line: &HalfPlane| HalfPlane { point: shrink(line.point), direction: shrink(line.direction).normalize() };
    let corner = |i: usize| {
        let (sin, cos) = libm::sincosf(i as f32 * (std::f32::consts::TAU / CORNERS as f32));
        Vec2::new(cos, sin / bias) * speed
    };
    let sides = (0..CORNERS).map(|i| {
        let (point, next) = (corner(i), corner(i + 1));
        HalfPlane { point, direction: (next - point).normalize() }
    });
    let all: Vec<HalfPlane> = sides.chain(lines.iter().map(shrunk)).collect();
    let preferred = shrink(preferred.clamp_length_max(speed));
    let best = orca::optimum(&all, CORNERS + hard, speed * (1.0 / bias).max(1.0) * 1.01, preferred, fallback);
    ahead * best.x + ahead.perp() * (best.y * bias)
}
