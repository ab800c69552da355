//! Growing what is solid by a radius: outlines of the set of points nearer than the radius.
//!
//! The outline of a ring is one closed chain: its edges moved outwards, joined at convex corners by arcs and at
//! concave ones by way of the corner itself. As a chain it is the sum of the solid, a rectangle for every edge and a
//! wedge for every convex corner, all the same way round, so its winding number is positive exactly on their union.
//! Arcs are polygons whose sides touch the true arc from outside: the result never comes nearer than the radius.

use super::lattice::{LatticePoint, PER_METRE, round, steps};
use glam::DVec2;
use std::f64::consts::{PI, TAU};

/// How far a corner of a polygonal arc may lie outside the true arc, metres. Gaps that are wider than two radii by
/// more than twice this stay open.
const OVERSHOOT: f64 = 0.004;

/// Added to every radius, in steps: rounding to the lattice and the snapping in boolean operations move lines by a
/// few steps at most.
const MARGIN: f64 = 8.0;

/// By how much to grow.
#[derive(Clone, Copy, Debug)]
pub(super) struct Brush {
    /// In steps.
    radius: f64,
    /// Largest angle of one side of an arc.
    side: f64,
}

impl Brush {
    /// A brush of `radius` metres.
    pub fn new(radius: f64) -> Self {
        Self { radius: radius * PER_METRE + MARGIN, side: side_angle(radius) }
    }

    /// The outline round a closed ring, solid to its left.
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

    /// The outline round a chain of thin walls.
    pub fn chain(&self, chain: &[LatticePoint]) -> Vec<LatticePoint> {
        let mut there_and_back = chain.to_vec();
        there_and_back.extend(chain.iter().rev().skip(1).take(chain.len().saturating_sub(2)));
        self.ring(&there_and_back)
    }

    /// What the outline does at one corner between the directions `enter` and `leave`.
    fn corner(&self, corner: DVec2, enter: DVec2, leave: DVec2, out: &mut Vec<LatticePoint>) {
        let right = |direction: DVec2| DVec2::new(direction.y, -direction.x);
        let (sine, cosine) = (enter.perp_dot(leave), enter.dot(leave));
        if sine < 0.0 && (cosine > 0.0 || sine < -1e-12) {
            out.push(round(corner + right(enter) * self.radius));
            out.push(round(corner));
            out.push(round(corner + right(leave) * self.radius));
            return;
        }
        // `max` may take either of two zeros, and the angle of -0.0 is half a turn to the right
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

/// A polygon round the disc of `radius` metres that touches it from outside, counter-clockwise.
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

/// The largest angle of one side of a polygonal arc of this radius (metres).
fn side_angle(radius: f64) -> f64 {
    (2.0 * libm::acos(radius / (radius + OVERSHOOT))).clamp(TAU / 256.0, PI / 4.0)
}
