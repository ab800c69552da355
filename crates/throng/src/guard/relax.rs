//! Parts pairs that would collide, before the guard certifies: symmetric, position-based, a few rounds.

use super::{Bodies, Contacts};
use crate::parallel;
use crate::space::Walls;
use glam::{DVec2, Vec2};

const ITERATIONS: usize = 4;
/// Part of the sum of radii that relaxed pairs keep between them.
const SKIN: f64 = 0.01;
/// Two who are closer by this part of the sum of radii overlap; less is rounding.
const OVERLAP: f64 = 1e-4;
/// Part of what two can move in a step by which those who overlap are parted in it: a bad start ends without a shove.
const PART: f64 = 0.125;

/// Moves `targets` apart; nobody's motion becomes longer than its reach.
pub(super) fn relax(
    bodies: &Bodies<'_>,
    contacts: &Contacts,
    walls: &Walls,
    targets: &mut Vec<Vec2>,
    next: &mut Vec<Vec2>,
) {
    for _ in 0..ITERATIONS {
        next.clone_from(targets);
        parallel::rows(
            next,
            1,
            || (),
            |(), row, target| {
                if !contacts.is_alone(row) {
                    target[0] = relaxed(row, bodies, contacts, walls, targets);
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

fn relaxed(row: usize, bodies: &Bodies<'_>, contacts: &Contacts, walls: &Walls, targets: &[Vec2]) -> Vec2 {
    let from = bodies.positions[row].as_dvec2();
    let radius = f64::from(bodies.radii[row]);
    let motion = targets[row].as_dvec2() - from;
    let mut push = DVec2::ZERO;
    for &other in contacts.of(row) {
        let other = other as usize;
        let offset = from - bodies.positions[other].as_dvec2();
        let radii = radius + f64::from(bodies.radii[other]);
        let relative = motion - (targets[other].as_dvec2() - bodies.positions[other].as_dvec2());
        let reach = f64::from(bodies.reach[row]) + f64::from(bodies.reach[other]);
        push += parting(offset, relative, clearance(offset, radii, reach)) * 0.5;
    }
    for &index in contacts.edges_of(row) {
        let offset = from - walls.edges()[index as usize].nearest(from);
        push += parting(offset, motion, clearance(offset, radius, f64::from(bodies.reach[row])));
    }
    for &index in contacts.discs_of(row) {
        let disc = &walls.discs()[index as usize];
        push += parting(from - disc.center, motion, radius * (1.0 + SKIN) + disc.radius);
    }
    if push == DVec2::ZERO {
        return targets[row];
    }
    bodies.positions[row] + (motion + push).clamp_length_max(f64::from(bodies.reach[row])).as_vec2()
}

/// The distance to keep from what is at `offset` now and touches at `radii`.
fn clearance(offset: DVec2, radii: f64, reach: f64) -> f64 {
    let distance = offset.length();
    let overlaps = distance < radii * (1.0 - OVERLAP);
    (radii * (1.0 + SKIN)).min(if overlaps { distance + PART * reach } else { f64::INFINITY })
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
