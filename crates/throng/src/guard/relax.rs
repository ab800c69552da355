//! Parts pairs that would collide, before the guard certifies: symmetric, position-based, a few rounds.

use super::Pose;
use super::solid::Solid;
use super::sweep::Sweep;
use crate::parallel;
use glam::DVec2;

const ITERATIONS: usize = 4;
/// Part of the sum of radii that relaxed pairs keep between them.
const SKIN: f64 = 0.01;
/// Two who are closer by this part of the sum of radii overlap; less is rounding.
const OVERLAP: f64 = 1e-4;
/// Part of what two can move in a step by which those who overlap are parted in it: a bad start ends without a shove.
const PART: f64 = 0.125;

/// Moves `targets` apart; nobody's motion becomes longer than its reach.
pub(super) fn relax(solid: Solid<'_>, targets: &mut Vec<Pose>, next: &mut Vec<Pose>) {
    for _ in 0..ITERATIONS {
        next.clone_from(targets);
        parallel::rows(
            next,
            1,
            || (),
            |(), row, target| {
                if !solid.contacts.is_alone(row) {
                    target[0] = relaxed(row, solid, targets);
                }
            },
        );
        let settled = next == targets;
        std::mem::swap(targets, next);
        if settled {
            break;
        }
    }
}

fn relaxed(row: usize, solid: Solid<'_>, targets: &[Pose]) -> Pose {
    let bodies = solid.bodies;
    let from = bodies.positions[row].as_dvec2();
    let radius = f64::from(bodies.radii[row]);
    let motion = targets[row].position.as_dvec2() - from;
    let is_disc = solid.is_disc(row);
    let mut push = DVec2::ZERO;
    for other in solid.others(row) {
        let radii = radius + f64::from(bodies.radii[other]);
        let reach = f64::from(bodies.reach[row]) + f64::from(bodies.reach[other]);
        push += 0.5
            * if is_disc && solid.is_disc(other) {
                let offset = from - bodies.positions[other].as_dvec2();
                let relative = motion - (targets[other].position.as_dvec2() - bodies.positions[other].as_dvec2());
                parting(offset, relative, clearance(offset.length(), radii, reach))
            } else {
                let (own, theirs) = (solid.sweep(row, targets[row]), solid.sweep(other, targets[other]));
                parting_cores(&own, &theirs, radii, reach)
            };
    }
    let reach = f64::from(bodies.reach[row]);
    if is_disc {
        for edge in solid.edges(row) {
            let offset = from - edge.nearest(from);
            push += parting(offset, motion, clearance(offset.length(), radius, reach));
        }
        for disc in solid.discs(row) {
            push += parting(from - disc.center, motion, radius * (1.0 + SKIN) + disc.radius);
        }
    } else {
        let own = solid.sweep(row, targets[row]);
        for (core, size) in solid.standing(row) {
            push += parting_cores(&own, &Sweep::still(core), radius + size, reach);
        }
    }
    if push == DVec2::ZERO {
        return targets[row];
    }
    let position = bodies.positions[row] + (motion + push).clamp_length_max(reach).as_vec2();
    Pose { position, ..targets[row] }
}

/// The distance to keep from what is at `distance` now and touches at `radii`.
fn clearance(distance: f64, radii: f64, reach: f64) -> f64 {
    let overlaps = distance < radii * (1.0 - OVERLAP);
    (radii * (1.0 + SKIN)).min(if overlaps { distance + PART * reach } else { f64::INFINITY })
}

/// How the motion of a core must change so that at the end it is not nearer to another than its clearance, along the
/// line between their nearest points.
fn parting_cores(own: &Sweep, other: &Sweep, radii: f64, reach: f64) -> DVec2 {
    let apart = own.start.separation(&other.start);
    if apart.distance - own.closing(other) >= radii * (1.0 + SKIN) {
        return DVec2::ZERO;
    }
    let end = own.at(1.0).gap_along(&other.at(1.0), apart.normal);
    let clearance = clearance(apart.distance, radii, reach);
    apart.normal * (end - clearance).clamp(-2.0 * clearance.max(0.0), 0.0)
}

/// How a relative motion must change so that `offset + t * motion` comes no nearer than `clearance` on its way: a
/// push at the nearest approach. A pair that starts nearer is pushed back to its clearance as far as it moves away
/// less than that.
fn parting(offset: DVec2, motion: DVec2, clearance: f64) -> DVec2 {
    let length_squared = motion.length_squared();
    let t = if length_squared > 0.0 { (-offset.dot(motion) / length_squared).clamp(0.0, 1.0) } else { 1.0 };
    let starts_near = offset.length_squared() < clearance * clearance;
    // from inside the skin only the end of the motion can be put right
    let t = if starts_near { 1.0 } else { t };
    let nearest = offset + motion * t;
    let distance = nearest.length();
    let deficit = clearance - distance;
    if deficit <= 0.0 {
        return DVec2::ZERO;
    }
    // through each other: part along the line they began on
    let normal = if nearest.dot(offset) > 0.0 { nearest / distance } else { offset.normalize_or_zero() };
    normal * (deficit / t.max(0.25)).min(deficit * 2.0)
}
