//! Safety of a motion, as defined in section 1 of `guard/mod.rs`.

use super::BodyPose;
use super::solid::GuardedObjects;
use super::sweep::CoreSweep;
use crate::space::{crossing, nearest_on_segment};
use glam::{DVec2, DVec3};

/// Fraction of the sum of radii by which a checked pair may be closer than touching.
pub const SLACK: f64 = 1e-6;

/// Whether the motion of `row` is safe with all other bodies, walls and solids.
pub(super) fn is_safe(row: usize, solid: GuardedObjects<'_>, targets: &[BodyPose]) -> bool {
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
            solid.standing(row).all(|(core, size)| keeps(&own, &CoreSweep::still(core), radius + size))
        }
}

/// Returns the least permitted distance of two bodies that touch at `radii` and are at `distance` now.
pub(super) fn needed(radii: f64, distance: f64) -> f64 {
    radii.min(distance) - SLACK * radii
}

/// Whether the motion of two cores is safe.
fn keeps(own: &CoreSweep, other: &CoreSweep, radii: f64) -> bool {
    own.passes(other, radii) || own.keeps(other, |distance| needed(radii, distance))
}

fn walls_are_safe(row: usize, solid: GuardedObjects<'_>, from: DVec2, motion: DVec2) -> bool {
    let radius = f64::from(solid.bodies.radii[row]);
    solid.edges(row).all(|edge| {
        // two segments, the edge and the path of the centre: unless they cross, their distance is that of an end of one
        // of them
        let at_start = edge.nearest(from).distance(from);
        let to = from + motion;
        let swept = edge
            .nearest(to)
            .distance(to)
            .min(nearest_on_segment(from, to, edge.start).distance(edge.start))
            .min(nearest_on_segment(from, to, edge.end).distance(edge.end))
            .min(at_start);
        swept >= needed(radius, at_start) && crossing(from, to, edge.start, edge.end).is_none()
    }) && solid.discs(row).all(|disc| {
        let offset = disc.center - from;
        nearest_approach(offset.extend(0.0), -motion.extend(0.0)) - disc.radius
            >= needed(radius, offset.length() - disc.radius)
    })
}

/// Whether `offset + t * motion` certainly comes no nearer than `clearance` for t in [0, 1], rounding included. The
/// test needs neither a root nor a quotient.
#[inline]
pub(super) fn passes(offset: DVec3, motion: DVec3, clearance: f64) -> bool {
    let room = offset.length_squared() * (1.0 - 1e-9) - clearance * clearance;
    let along = offset.dot(motion);
    // without branches, because they would be unpredictable
    (room >= 0.0) & ((along >= 0.0) | (room * motion.length_squared() >= along * along))
}

/// Returns the least length of `offset + t * motion` for t in [0, 1].
pub fn nearest_approach(offset: DVec3, motion: DVec3) -> f64 {
    let along = -offset.dot(motion);
    if along <= 0.0 {
        return offset.length();
    }
    let t = (along / motion.length_squared()).min(1.0);
    (offset + motion * t).length()
}
