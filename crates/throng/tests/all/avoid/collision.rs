//! Times to collision, compared with small steps of time.

use crate::avoid::common::vector;
use glam::Vec2;
use proptest::prelude::*;
use throng::avoid::{time_to_disc, time_to_segment};

const STEP: f32 = 1e-3;
const LONG: usize = 8000;

/// The first of the sampled times at which `distance` is within `radius`; infinite if there is none.
fn first_touch(radius: f32, distance: impl Fn(Vec2) -> f32, velocity: Vec2) -> f32 {
    let touches = (0..LONG).find(|&i| distance(velocity * (i as f32 * STEP)) <= radius);
    touches.map_or(f32::INFINITY, |i| i as f32 * STEP)
}

/// Equal to within a few steps; either method may miss glancing touches.
fn agree(exact: f32, stepped: f32) -> bool {
    if exact > 7.0 { stepped > 6.9 } else { (exact - stepped).abs() <= 3.0 * STEP }
}

fn to_segment(a: Vec2, b: Vec2, p: Vec2) -> f32 {
    let along = b - a;
    (a + along * ((p - a).dot(along) / along.length_squared()).clamp(0.0, 1.0)).distance(p)
}

proptest! {
    #[test]
    fn the_time_to_a_disc_is_when_they_touch(offset in vector(4.0), velocity in vector(2.0), radii in 0.2f32..1.5) {
        prop_assume!(offset.length() > radii + 0.01);
        let closest = (offset - velocity * (offset.dot(velocity) / velocity.length_squared())).length();
        prop_assume!((closest - radii).abs() > 1e-3 && velocity.length() > 0.05);
        let exact = time_to_disc(offset, velocity, radii);
        prop_assert!(agree(exact, first_touch(radii, |p| p.distance(offset), velocity)), "{exact}");
    }

    #[test]
    fn the_time_to_a_segment_is_when_they_touch(
        a in vector(4.0), b in vector(4.0), velocity in vector(2.0), radius in 0.1f32..0.6,
    ) {
        prop_assume!(a.distance(b) > 0.1 && to_segment(a, b, Vec2::ZERO) > radius + 0.01 && velocity.length() > 0.05);
        let nearest = (0..LONG).map(|i| to_segment(a, b, velocity * (i as f32 * STEP))).fold(f32::INFINITY, f32::min);
        prop_assume!((nearest - radius).abs() > 1e-3);
        let exact = time_to_segment(a, b, velocity, radius);
        prop_assert!(agree(exact, first_touch(radius, |p| to_segment(a, b, p), velocity)), "{exact}");
    }
}
