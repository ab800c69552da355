//! Searching the velocities that a body can have for the cheapest, without random numbers: a pattern over all of
//! them, aligned with the preferred velocity, that is refined about the best found so far (adaptive sampling as in Recast's Detour crowd; MODELS 1.2.1).

use glam::Vec2;

/// Points of the pattern: on each of two rings.
const ANGLES: usize = 16;
/// How often the pattern is refined; it is halved each time.
const DEPTH: usize = 6;

/// The velocity of least cost within `max_speed` that the pattern finds. The preferred velocity, the present one and
/// standing still are always among the candidates, in this order; of equal costs the first wins.
pub(super) fn cheapest(preferred: Vec2, velocity: Vec2, max_speed: f32, cost: impl Fn(Vec2) -> f32) -> Vec2 {
    let mut best = (Vec2::ZERO, f32::INFINITY);
    let mut candidate = |v: Vec2| {
        let v = v.clamp_length_max(max_speed);
        let cost = cost(v);
        if cost < best.1 {
            best = (v, cost);
        }
        best.0
    };
    candidate(preferred);
    candidate(velocity);
    let mut center = candidate(Vec2::ZERO);
    let ahead = preferred.try_normalize().unwrap_or(Vec2::X);
    // the inner ring is turned by half a step
    let rings = [0.0, 0.5].map(|turn| {
        std::array::from_fn::<Vec2, ANGLES, _>(|i| {
            let (sin, cos) = libm::sincosf((i as f32 + turn) * (std::f32::consts::TAU / ANGLES as f32));
            Vec2::new(cos, sin).rotate(ahead)
        })
    });
    let mut radius = max_speed;
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
