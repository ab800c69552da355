//! Relaxation: pushes apart pairs that would collide, before the guard certifies. Symmetric and position-based, in a
//! few iterations.

use super::BodyPose;
use super::safe::passes;
use super::solid::GuardedObjects;
use super::sweep::CoreSweep;
use glam::{DVec2, DVec3};

/// Number of iterations in which every row that may need it is moved.
pub(super) const ITERATIONS: usize = 4;
/// Fraction of the sum of radii that relaxed pairs keep between them.
pub(crate) const SKIN: f64 = 0.01;
/// Two bodies overlap if they are closer than the sum of radii by more than this fraction of it. Less is rounding.
const OVERLAP: f64 = 1e-4;
/// Fraction of what two bodies can move in a step by which overlapping bodies are moved apart per step. A bad start is
/// resolved gradually.
const PART: f64 = 0.125;

/// Whether a cheap test shows that `row` is relaxed and safe. The test covers only bodies away from walls and solids.
pub(super) fn is_clear(row: usize, solid: GuardedObjects<'_>, targets: &[BodyPose]) -> bool {
    let radius = f64::from(solid.bodies.radii[row]);
    let motion = solid.motion(row, targets[row]);
    let is_disc = solid.is_disc(row);
    !solid.bodies.solids.is_near(row)
        && solid.contacts.is_off_walls(row)
        && solid.others(row).all(|other| {
            let kept = (radius + f64::from(solid.bodies.radii[other])) * (1.0 + SKIN);
            if is_disc && solid.is_disc(other) {
                let (offset, relative) = solid.relative(row, motion, other, targets);
                return passes(offset, relative, kept);
            }
            solid.sweep(row, targets[row]).passes(&solid.sweep(other, targets[other]), kept)
        })
}

/// Returns the target of `row` after one relaxation: away from neighbours and walls that it would come too close to,
/// and out of solids. The motion is limited to the row's reach.
pub(super) fn relaxed(row: usize, solid: GuardedObjects<'_>, targets: &[BodyPose]) -> BodyPose {
    let bodies = solid.bodies;
    let motion = solid.motion(row, targets[row]);
    let radius = f64::from(bodies.radii[row]);
    let is_disc = solid.is_disc(row);
    let mut push = DVec3::ZERO;
    for other in solid.others(row) {
        let radii = radius + f64::from(bodies.radii[other]);
        let reach = || f64::from(bodies.reach[row]) + f64::from(bodies.reach[other]);
        if is_disc && solid.is_disc(other) {
            let (offset, relative) = solid.relative(row, motion, other, targets);
            if !passes(offset, relative, radii * (1.0 + SKIN)) {
                push += 0.5 * parting(offset, relative, clearance(offset.length(), radii, reach()));
            }
        } else {
            let (own, theirs) = (solid.sweep(row, targets[row]), solid.sweep(other, targets[other]));
            push += 0.5 * parting_cores(&own, &theirs, radii, reach()).extend(0.0);
        }
    }
    let reach = f64::from(bodies.reach[row]);
    if is_disc {
        let (plan, along) = (bodies.positions[row].as_dvec2(), motion.with_z(0.0));
        for edge in solid.edges(row) {
            let offset = plan - edge.nearest(plan);
            push += parting(offset.extend(0.0), along, clearance(offset.length(), radius, reach));
        }
        for disc in solid.discs(row) {
            let offset = plan - disc.center;
            push += parting(offset.extend(0.0), along, radius * (1.0 + SKIN) + disc.radius);
        }
    } else {
        let own = solid.sweep(row, targets[row]);
        for (core, size) in solid.standing(row) {
            push += parting_cores(&own, &CoreSweep::still(core), radius + size, reach).extend(0.0);
        }
    }
    if solid.is_grounded(row, targets[row]) {
        push.z = 0.0;
    }
    let target = if push == DVec3::ZERO {
        targets[row]
    } else {
        targets[row].with_place(bodies.place(row) + (motion + push).clamp_length_max(reach).as_vec3())
    };
    bodies.solids.lead(row, bodies, target)
}

/// Returns the distance to keep from an object that is at `distance` now and in contact at `radii`.
pub(super) fn clearance(distance: f64, radii: f64, reach: f64) -> f64 {
    let overlaps = distance < radii * (1.0 - OVERLAP);
    (radii * (1.0 + SKIN)).min(if overlaps { distance + PART * reach } else { f64::INFINITY })
}

/// Returns the change of a core's motion after which the core ends no nearer to another core than its clearance, along
/// the line between their nearest points.
fn parting_cores(own: &CoreSweep, other: &CoreSweep, radii: f64, reach: f64) -> DVec2 {
    if own.passes(other, radii * (1.0 + SKIN)) {
        return DVec2::ZERO;
    }
    let apart = own.start.separation(&other.start);
    if apart.distance - own.closing(other) >= radii * (1.0 + SKIN) {
        return DVec2::ZERO;
    }
    let end = own.at(1.0).gap_along(&other.at(1.0), apart.normal);
    let clearance = clearance(apart.distance, radii, reach);
    apart.normal * (end - clearance).clamp(-2.0 * clearance.max(0.0), 0.0)
}

/// Returns the change of a relative motion after which `offset + t * motion` comes no nearer than `clearance`: a push
/// at the nearest approach. A pair that starts nearer is pushed back to its clearance, less what its motion already
/// moves it apart.
#[inline(always)]
fn parting(offset: DVec3, motion: DVec3, clearance: f64) -> DVec3 {
    let length_squared = motion.length_squared();
    let t = if length_squared > 0.0 { (-offset.dot(motion) / length_squared).clamp(0.0, 1.0) } else { 1.0 };
    let starts_near = offset.length_squared() < clearance * clearance;
    // inside the skin only the end of the motion can be corrected
    let t = if starts_near { 1.0 } else { t };
    let nearest = offset + motion * t;
    let distance = nearest.length();
    let deficit = clearance - distance;
    if deficit <= 0.0 {
        return DVec3::ZERO;
    }
    // the bodies would pass through each other: push along the line between their start positions
    let normal = if nearest.dot(offset) > 0.0 { nearest / distance } else { offset.normalize_or_zero() };
    normal * (deficit / t.max(0.25)).min(deficit * 2.0)
}

#[cfg(test)]
mod tests {
    use super::super::safe::{nearest_approach, needed};
    use super::*;
    use proptest::prelude::*;

    fn vector(size: f32) -> impl Strategy<Value = DVec3> {
        let altitude = prop_oneof![Just(0.0f32), -size..size];
        (-size..size, -size..size, altitude).prop_map(|(x, y, z)| DVec3::new(x.into(), y.into(), z.into()))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        /// Pairs that pass the test are neither pushed nor unsafe. Pairs that fail it come near, or nearly so.
        #[test]
        fn the_quick_test_finds_safe_pairs(offset in vector(2.0), motion in vector(3.0), radii in 0.05f32..1.0, haste in 0.0f32..1.0) {
            let (radii, motion) = (f64::from(radii), motion * f64::from(haste));
            let clear = radii * (1.0 + SKIN);
            let least = nearest_approach(offset, motion);
            if passes(offset, motion, clear) {
                prop_assert_eq!(parting(offset, motion, clearance(offset.length(), radii, 1.0)), DVec3::ZERO);
                prop_assert!(least >= clear && least >= needed(radii, offset.length()));
            } else {
                // the test also covers the line beyond the end of the motion
                let line = nearest_approach(offset, motion * 1e9);
                prop_assert!(line <= clear * (1.0 + 1e-6) + 1e-6, "{line} of {clear}");
            }
        }
    }
}
