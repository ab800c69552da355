//! Inflation of solids by a radius: outlines of the set of points nearer than the radius.
//!
//! The outline of a ring is one closed chain: its edges moved outwards, joined at convex corners by arcs and at concave
//! corners through the corner itself. As a chain it is the sum of the solid, a rectangle for every edge and a wedge for
//! every convex corner, all with the same orientation. So its winding number is positive exactly on the union of these.
//! Arcs are polygons with sides that touch the true arc from outside: the result is never nearer than the radius.

use super::lattice::{LatticePoint, PER_METRE, round, steps};
use glam::DVec2;
use std::f64::consts::{PI, TAU};

/// Maximum distance of a corner of a polygonal arc outside the true arc, metres. Gaps wider than two radii by more than
/// twice this stay open.
const OVERSHOOT: f64 = 0.004;

/// Added to every radius, in steps: rounding to the lattice and snapping in boolean operations move lines by a few
/// steps at most.
const MARGIN: f64 = 8.0;

/// The inflation by a radius.
#[derive(Clone, Copy, Debug)]
pub(super) struct Inflation {
    /// The radius in steps of the lattice.
    radius: f64,
    /// Maximum angle of a side of an arc.
    side: f64,
}

impl Inflation {
    /// Creates an inflation by `radius` metres.
    pub fn new(radius: f64) -> Self {
        Self { radius: radius * PER_METRE + MARGIN, side: side_angle(radius) }
    }

    /// Returns the outline around a closed ring with the solid to its left.
    pub fn ring(&self, ring: &[LatticePoint]) -> Vec<LatticePoint> {
        let points: Vec<DVec2> = ring.iter().map(|&point| steps(point)).collect();
        let mut out = Vec::with_capacity(points.len() * 3);
        let count = points.len();
        for at in 0..count {
            let (before, corner, after) = (points[(at + count - 1) % count], points[at], points[(at + 1) % count]);
            self.corner(corner, (corner - before).normalize(), (after - corner).normalize(), &mut out);
        }
        out
    }

    /// Returns the outline around a chain of thin walls.
    pub fn chain(&self, chain: &[LatticePoint]) -> Vec<LatticePoint> {
        let mut there_and_back = chain.to_vec();
        there_and_back.extend(chain.iter().rev().skip(1).take(chain.len().saturating_sub(2)));
        self.ring(&there_and_back)
    }

    /// Adds the points of the outline at a corner between the directions `enter` and `leave`.
    fn corner(&self, corner: DVec2, enter: DVec2, leave: DVec2, out: &mut Vec<LatticePoint>) {
        let right = |direction: DVec2| DVec2::new(direction.y, -direction.x);
        let (sine, cosine) = (enter.perp_dot(leave), enter.dot(leave));
        if sine < 0.0 && (cosine > 0.0 || sine < -1e-12) {
            out.push(round(corner + right(enter) * self.radius));
            out.push(round(corner));
            out.push(round(corner + right(leave) * self.radius));
            return;
        }
        // `max` can return either of two zeros, and `atan2` of -0.0 can be a half turn to the right
        let sine = if sine > 0.0 { sine } else { 0.0 };
        let angle = libm::atan2(sine, cosine);
        let sides = (angle / self.side).ceil().max(1.0);
        let half = angle / (2.0 * sides);
        let reach = right(enter) * (self.radius / libm::cos(half));
        for side in 0..sides as usize {
            let (sin, cos) = libm::sincos((2 * side + 1) as f64 * half);
            let turned = DVec2::new(cos * reach.x - sin * reach.y, sin * reach.x + cos * reach.y);
            out.push(round(corner + turned));
        }
    }
}

/// Returns a counter-clockwise polygon around the disc of `radius` metres; its sides touch the disc from outside.
pub(super) fn disc(centre: LatticePoint, radius: f64) -> Vec<LatticePoint> {
    let sides = (TAU / side_angle(radius)).ceil();
    let reach = (radius * PER_METRE + MARGIN) / libm::cos(PI / sides);
    (0..sides as usize)
        .map(|side| {
            let (sin, cos) = libm::sincos(side as f64 * (TAU / sides));
            round(steps(centre) + DVec2::new(cos, sin) * reach)
        })
        .collect()
}

/// Returns the maximum angle of a side of a polygonal arc of this radius (metres).
fn side_angle(radius: f64) -> f64 {
    (2.0 * libm::acos(radius / (radius + OVERSHOOT))).clamp(TAU / 256.0, PI / 4.0)
}
