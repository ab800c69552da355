//! Whether a motion is safe: the pairs of `guard/mod.rs`, 1.

use super::Pose;
use super::solid::Solid;
use super::sweep::Sweep;
use crate::space::nearest_on_segment;
use glam::{DVec2, DVec3};

/// Part of the sum of radii by which a checked pair may be closer than touching.
pub const SLACK: f64 = 1e-6;

/// Whether the motion of `row` is safe with everybody and every wall.
pub(super) fn is_safe(row: usize, solid: Solid<'_>, targets: &[Pose]) -> bool {
    let bodies = solid.bodies;
    let motion = solid.motion(row, targets[row]);
    bodies.solids.is_safe(row, bodies, targets[row])
        && solid.others(row).all(|other| {
            let radii = f64::from(bodies.radii[row]) + f64::from(bodies.radii[other]);
            if solid.is_disc(row) && solid.is_disc(other) {
                let (offset, relative) = solid.relative(row, motion, other, targets);
                return passes(offset, relative, radii)
                    || nearest_approach(offset, relative) >= needed(radii, offset.length());
            }
            keeps(&solid.sweep(row, targets[row]), &solid.sweep(other, targets[other]), radii)
        })
        && if solid.is_disc(row) {
            walls_are_safe(row, solid, bodies.positions[row].as_dvec2(), motion.truncate())
        } else {
            let radius = f64::from(bodies.radii[row]);
            let own = solid.sweep(row, targets[row]);
            solid.standing(row).all(|(core, size)| keeps(&own, &Sweep::still(core), radius + size))
        }
}

/// The least distance that two may have who touch at `radii` and are at `distance` now.
pub(super) fn needed(radii: f64, distance: f64) -> f64 {
    radii.min(distance) - SLACK * radii
}

/// Whether the motion of two cores is safe.
fn keeps(own: &Sweep, other: &Sweep, radii: f64) -> bool {
    own.keeps(other, needed(radii, own.start.separation(&other.start).distance))
}

fn walls_are_safe(row: usize, solid: Solid<'_>, from: DVec2, motion: DVec2) -> bool {
    let radius = f64::from(solid.bodies.radii[row]);
    solid.edges(row).all(|edge| {
        // a segment and the swept centre: apart at an end of one of them, unless they cross
        let at_start = edge.nearest(from).distance(from);
        let to = from + motion;
        let swept = edge
            .nearest(to)
            .distance(to)
            .min(nearest_on_segment(from, to, edge.start).distance(edge.start))
            .min(nearest_on_segment(from, to, edge.end).distance(edge.end))
            .min(at_start);
        swept >= needed(radius, at_start) && !cross(from, to, edge.start, edge.end)
    }) && solid.discs(row).all(|disc| {
        let offset = disc.center - from;
        nearest_approach(offset.extend(0.0), -motion.extend(0.0)) - disc.radius
            >= needed(radius, offset.length() - disc.radius)
    })
}

/// Whether `offset + t * motion` surely comes no nearer than `clearance` for t in [0, 1], nor anything within rounding of
/// it: the nearest approach without a root or a quotient.
#[inline]
pub(super) fn passes(offset: DVec3, motion: DVec3, clearance: f64) -> bool {
    let room = offset.length_squared() * (1.0 - 1e-9) - clearance * clearance;
    let along = offset.dot(motion);
    // no branches: nobody could foretell them
    (room >= 0.0) & ((along >= 0.0) | (room * motion.length_squared() >= along * along))
}

/// The least length of `offset + t * motion` for t in [0, 1].
pub fn nearest_approach(offset: DVec3, motion: DVec3) -> f64 {
    let along = -offset.dot(motion);
    if along <= 0.0 {
        return offset.length();
    }
    let t = (along / motion.length_squared()).min(1.0);
    (offset + motion * t).length()
}

/// Whether segments `a b` and `c d` cross.
fn cross(a: DVec2, b: DVec2, c: DVec2, d: DVec2) -> bool {
    let side = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - p);
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}
