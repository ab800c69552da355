//! The time of closest approach and the time of contact of two bodies at constant velocities.

use glam::Vec3;

/// Returns the seconds until the closest approach, negative if it is past. `offset` leads from the first body to the
/// second, `velocity` is the velocity of the second less that of the first. 0 if the distance never changes (Reynolds
/// 1999, "Unaligned collision avoidance").
pub(crate) fn nearest_time(offset: Vec3, velocity: Vec3) -> f32 {
    let speed_squared = velocity.length_squared();
    if speed_squared > 0.0 { -offset.dot(velocity) / speed_squared } else { 0.0 }
}

/// Returns the seconds until two spheres with this sum of radii touch: 0 if they overlap now, infinite if they never
/// touch.
pub(crate) fn time_to_touch(offset: Vec3, velocity: Vec3, radii: f32) -> f32 {
    let gap = offset.length_squared() - radii * radii;
    let nearing = -offset.dot(velocity);
    if gap <= 0.0 {
        return 0.0;
    }
    // the discriminant without cancellation, from the distance at which the second body passes
    let across = offset.cross(velocity).length_squared();
    let square = radii * radii * velocity.length_squared() - across;
    if nearing <= 0.0 || square < 0.0 { f32::INFINITY } else { gap / (nearing + square.sqrt()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vector(range: f32) -> impl Strategy<Value = Vec3> {
        (-range..range, -range..range, -range..range).prop_map(Vec3::from)
    }

    proptest! {
        /// Compares both times with a search in small steps.
        #[test]
        fn nothing_is_nearer_and_nothing_touches_before(offset in vector(5.0), velocity in vector(2.0), radii in 0.1f32..1.5) {
            prop_assume!(velocity.length() > 0.05);
            let distance = |time: f32| (offset + velocity * time).length();
            let nearest = nearest_time(offset, velocity);
            prop_assert!((-400..400).all(|i| distance(i as f32 * 0.1) >= distance(nearest) - 1e-3));
            let touch = time_to_touch(offset, velocity, radii);
            if touch.is_finite() {
                prop_assert!(touch == 0.0 && offset.length() <= radii || (distance(touch) - radii).abs() < 1e-3);
                prop_assert!((0..100).all(|i| distance(touch * i as f32 * 0.01) >= radii - 1e-3 || touch == 0.0));
            } else {
                prop_assert!((0..4000).all(|i| distance(i as f32 * 0.02) > radii - 1e-3));
            }
        }
    }
}
