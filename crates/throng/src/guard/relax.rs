//! Parts pairs that would collide, before the guard certifies: symmetric, position-based, a few rounds.

use super::Pose;
use super::safe::passes;
use super::solid::Solid;
use super::sweep::Sweep;
use glam::{DVec2, DVec3};

/// How often everybody who may have to is moved.
pub(super) const ITERATIONS: usize = 4;
/// Part of the sum of radii that relaxed pairs keep between them.
pub(super) const SKIN: f64 = 0.01;
/// Two who are closer by this part of the sum of radii overlap; less is rounding.
const OVERLAP: f64 = 1e-4;
/// Part of what two can move in a step by which those who overlap are parted in it: a bad start ends without a shove.
const PART: f64 = 0.125;

/// Whether a quick look shows that `row` is relaxed and safe. It looks at discs away from walls and solids only.
pub(super) fn is_clear(row: usize, solid: Solid<'_>, targets: &[Pose]) -> bool {
    let radius = f64::from(solid.bodies.radii[row]);
    let motion = solid.motion(row, targets[row]);
    solid.is_disc(row)
        && !solid.bodies.solids.is_near(row)
        && solid.contacts.is_off_walls(row)
        && solid.others(row).all(|other| {
            let (offset, relative) = solid.relative(row, motion, other, targets);
            let radii = radius + f64::from(solid.bodies.radii[other]);
            solid.is_disc(other) && passes(offset, relative, radii * (1.0 + SKIN))
        })
}

/// Where `row` goes that the nearest to it come no closer than they may, and into no solid; its motion becomes no longer
/// than its reach.
pub(super) fn relaxed(row: usize, solid: Solid<'_>, targets: &[Pose]) -> Pose {
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
            push += parting_cores(&own, &Sweep::still(core), radius + size, reach).extend(0.0);
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

/// The distance to keep from what is at `distance` now and touches at `radii`.
pub(super) fn clearance(distance: f64, radii: f64, reach: f64) -> f64 {
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
#[inline(always)]
fn parting(offset: DVec3, motion: DVec3, clearance: f64) -> DVec3 {
    let length_squared = motion.length_squared();
    let t = if length_squared > 0.0 { (-offset.dot(motion) / length_squared).clamp(0.0, 1.0) } else { 1.0 };
    let starts_near = offset.length_squared() < clearance * clearance;
    // from inside the skin only the end of the motion can be put right
    let t = if starts_near { 1.0 } else { t };
    let nearest = offset + motion * t;
    let distance = nearest.length();
    let deficit = clearance - distance;
    if deficit <= 0.0 {
        return DVec3::ZERO;
    }
    // through each other: part along the line they began on
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

        /// Those who pass are neither pushed nor unsafe, and those who do not come near or nearly so.
        #[test]
        fn a_quick_look_tells_who_passes(offset in vector(2.0), motion in vector(3.0), radii in 0.05f32..1.0, haste in 0.0f32..1.0) {
            let (radii, motion) = (f64::from(radii), motion * f64::from(haste));
            let clear = radii * (1.0 + SKIN);
            let least = nearest_approach(offset, motion);
            if passes(offset, motion, clear) {
                prop_assert_eq!(parting(offset, motion, clearance(offset.length(), radii, 1.0)), DVec3::ZERO);
                prop_assert!(least >= clear && least >= needed(radii, offset.length()));
            } else {
                // it looks along the line beyond the end of the motion, too
                let line = nearest_approach(offset, motion * 1e9);
                prop_assert!(line <= clear * (1.0 + 1e-6) + 1e-6, "{line} of {clear}");
            }
        }
    }
}
