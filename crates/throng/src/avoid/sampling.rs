//! Search for the cheapest of the velocities that a body can have.

use super::AvoidanceInput;
use crate::random::Purpose;
use glam::Vec2;
use std::f32::consts::TAU;

/// Number of points of the pattern on each of its two rings.
const ANGLES: usize = 16;
/// Number of refinements of the pattern. Each halves it.
const DEPTH: usize = 6;

/// Returns the cheapest velocity of those tried. The preferred one is always the first; of equal costs the first wins.
///
/// Without `candidates`, the search tries the present velocity, zero, and a pattern over all velocities, aligned with the
/// preferred one, that is refined about the best so far (as in the DetourCrowd library of Recast Navigation). It needs no
/// random numbers, so agents tremble little. Otherwise it tries so many velocities, drawn uniformly from the disc of
/// speeds anew in every step, as the authors of RVO do. Agents tremble.
///
/// `cost` gets a candidate and the least cost so far. It returns
/// the nearest possible velocity and its cost, which need not be exact if it is not less than the least so far.
pub(super) fn cheapest(
    candidates: u32,
    view: &AvoidanceInput<'_>,
    mut cost: impl FnMut(Vec2, f32) -> (Vec2, f32),
) -> Vec2 {
    let mut best = (view.preferred, f32::INFINITY);
    let mut candidate = |v: Vec2| {
        let (v, cost) = cost(v, best.1);
        if cost < best.1 {
            best = (v, cost);
        }
        best.0
    };
    let center = candidate(view.preferred);
    match candidates {
        0 => adaptive(view, candidate),
        _ => (0..candidates).fold(center, |_, k| {
            let (sin, cos) = libm::sincosf(view.rng.nth(k, Purpose::CandidateAcross) * TAU);
            // uniform over the disc
            let speed = view.rng.nth(k, Purpose::CandidateAlong).sqrt() * view.max_speed;
            candidate(Vec2::new(cos, sin) * speed)
        }),
    }
}

fn adaptive(view: &AvoidanceInput<'_>, mut candidate: impl FnMut(Vec2) -> Vec2) -> Vec2 {
    candidate(view.velocity);
    let mut center = candidate(Vec2::ZERO);
    let ahead = view.preferred.try_normalize().unwrap_or(Vec2::X);
    // the inner ring is rotated by half a step
    let rings = [0.0, 0.5].map(|turn| {
        std::array::from_fn::<Vec2, ANGLES, _>(|i| {
            let (sin, cos) = libm::sincosf((i as f32 + turn) * (TAU / ANGLES as f32));
            Vec2::new(cos, sin).rotate(ahead)
        })
    });
    let mut radius = view.max_speed;
    for depth in 0..DEPTH {
        let origin = if depth == 0 { Vec2::ZERO } else { center };
        for (ring, reach) in rings.iter().zip([radius, radius * 0.5]) {
            for direction in ring {
                center = candidate(origin + *direction * reach);
            }
        }
        radius *= 0.5;
    }
    center
}
