//! Bodies that cannot move in every direction at once: Alonso-Mora, Breitenmoser, Rufli, Beardsley, Siegwart, Optimal
//! reciprocal collision avoidance for multiple non-holonomic robots, DARS 2010.
//!
//! A robot with two driven wheels that is to move with a velocity beside its heading turns while it drives, so it
//! leaves the straight line for a while. It chooses only velocities that it can follow with at most its tracking error.
//! Its radius is enlarged by that error, in its own plan and in those of its neighbours.

use super::angle::angle;
use glam::Vec2;
use std::f32::consts::{FRAC_PI_3, PI};

/// Returns the polygon of velocities that a body can follow with a deviation of at most `error` metres from the
/// straight line: its corners, counter-clockwise from straight ahead. The polygon is open between the last corner and
/// the first: straight ahead only the top speed limits a velocity.
///
/// A body that turns at a constant rate by an angle in a time, at the best speed, deviates by
/// `speed * time * sin(angle / 2)` (section 3.2 gives the square). It turns as fast as it can. The region of these
/// velocities is convex, so the polygon lies within it.
pub(crate) fn followable(error: f32, heading: f32, max_speed: f32, max_turn_rate: f32) -> [Vec2; 9] {
    let speed = |angle: f32| error * max_turn_rate / (angle * libm::sinf(0.5 * angle));
    // the angle at which the top speed can just be followed; the faster the body turns, the larger the angle
    let (mut low, mut first) = (0.0, FRAC_PI_3);
    for _ in 0..12 {
        let middle = 0.5 * (low + first);
        if speed(middle) > max_speed {
            low = middle;
        } else {
            first = middle;
        }
    }
    let [a, b, c] = [FRAC_PI_3, 1.5 * FRAC_PI_3, 2.0 * FRAC_PI_3];
    [first, a, b, c, PI, -c, -b, -a, -first].map(|angle| {
        let (sin, cos) = libm::sincosf(heading + angle);
        Vec2::new(cos, sin) * speed(angle.abs())
    })
}

/// Returns the fraction of the chosen speed at which a body drives while it turns by `angle` into the chosen direction:
/// the fraction with the least error at the end of the turn.
fn part(angle: f32) -> f32 {
    // angle * sin(angle) / (2 - 2 cos(angle)), without the cancellation
    let (sin, cos) = libm::sincosf(0.5 * angle);
    if sin == 0.0 { 1.0 } else { 0.5 * angle * cos / sin }
}

/// Returns the velocity of the next `step` seconds with which a body of this heading follows its chosen velocity:
/// forwards, while it turns as fast as it can.
pub(crate) fn follow(chosen: Vec2, heading: f32, max_turn_rate: f32, step: f32) -> Vec2 {
    let forward = Vec2::new(libm::cosf(heading), libm::sinf(heading));
    let aside = angle(Vec2::new(forward.dot(chosen), forward.perp_dot(chosen)));
    let most = max_turn_rate * step;
    let (sin, cos) = libm::sincosf(heading + aside.clamp(-most, most));
    Vec2::new(cos, sin) * (chosen.length() * part(aside).max(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Every velocity within the polygon is followed with at most the error; the motion is integrated in small time
        /// steps.
        #[test]
        fn velocities_within_the_polygon_can_be_followed(
            error in 0.01f32..0.2, heading in -PI..PI, turn_rate in 1.0f32..12.0, speed in 0.01f32..1.5, angle in -PI..PI,
        ) {
            let corners = followable(error, heading, 1.5, turn_rate);
            let chosen = Vec2::from_angle(heading + angle) * speed;
            prop_assume!(corners.windows(2).all(|side| (side[1] - side[0]).perp_dot(chosen - side[0]) >= 0.0));
            let time = angle.abs() / turn_rate;
            const PARTS: usize = 1000;
            let step = time / PARTS as f32;
            let mut at = glam::DVec2::ZERO;
            for i in 0..PARTS {
                let towards = heading + angle * (i as f32 + 0.5) / PARTS as f32;
                at += (Vec2::from_angle(towards) * (speed * part(angle) * step)).as_dvec2();
            }
            let off = at.distance((chosen * time).as_dvec2());
            prop_assert!(off <= f64::from(error) * 1.001 + 1e-5, "{off} off the straight line");
        }

        #[test]
        fn a_body_that_follows_turns_no_faster_than_it_can(
            heading in -PI..PI, turn_rate in 0.5f32..12.0, speed in 0.1f32..1.5, angle in -PI..PI, step in 0.001f32..0.1,
        ) {
            let chosen = Vec2::from_angle(heading + angle) * speed;
            let velocity = follow(chosen, heading, turn_rate, step);
            prop_assert!(velocity.length() <= speed * 1.001);
            prop_assume!(velocity.length() > 0.05 * speed);
            let forward = Vec2::from_angle(heading);
            let turned = forward.perp_dot(velocity).atan2(forward.dot(velocity)).abs();
            prop_assert!(turned <= turn_rate * step + 1e-5, "{turned}");
        }
    }
}
