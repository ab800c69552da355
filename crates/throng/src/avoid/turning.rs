//! Turning rather than braking, or the other way round: Curtis, Manocha, Pedestrian simulation using geometric
//! reasoning in velocity space, Pedestrian and Evacuation Dynamics 2012 (2014), section 3.
//!
//! The optimum is sought where the axis across the preferred velocity is shrunk by the bias: what is aside of the
//! preferred velocity lies nearer there. Half-planes stay half-planes; the disc of speeds becomes an ellipse, of which
//! a polygon within it is taken.

use super::{Line, orca};
use glam::Vec2;

/// Corners of the polygon: it is within 0.5 % of the disc.
const CORNERS: usize = 32;

/// As [`orca::optimum`], where going aside costs `bias` times less than changing speed.
pub(super) fn optimum(
    lines: &[Line],
    hard: usize,
    speed: f32,
    preferred: Vec2,
    bias: f32,
    fallback: &mut Vec<Line>,
) -> Vec2 {
    let Some(ahead) = preferred.try_normalize() else {
        return orca::optimum(lines, hard, speed, preferred, fallback);
    };
    // into the frame of the preferred velocity, and back
    let shrink = |v: Vec2| Vec2::new(v.dot(ahead), ahead.perp_dot(v) / bias);
    let shrunk = |line: &Line| Line { point: shrink(line.point), direction: shrink(line.direction).normalize() };
    let corner = |i: usize| {
        let (sin, cos) = libm::sincosf(i as f32 * (std::f32::consts::TAU / CORNERS as f32));
        Vec2::new(cos, sin / bias) * speed
    };
    let sides = (0..CORNERS).map(|i| {
        let (point, next) = (corner(i), corner(i + 1));
        Line { point, direction: (next - point).normalize() }
    });
    let all: Vec<Line> = sides.chain(lines.iter().map(shrunk)).collect();
    let preferred = shrink(preferred.clamp_length_max(speed));
    let best = orca::optimum(&all, CORNERS + hard, speed * (1.0 / bias).max(1.0) * 1.01, preferred, fallback);
    ahead * best.x + ahead.perp() * (best.y * bias)
}
