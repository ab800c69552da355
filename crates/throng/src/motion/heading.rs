//! Headings: a body faces its direction of motion, turns smoothly, and keeps its heading when it stands.

use super::angle::{angle, angles};
use crate::simd::Vec2s;
use fearless_simd::prelude::*;
use glam::Vec2;
use std::f32::consts::PI;

/// Time constant, seconds, with which a heading approaches the direction of motion (all but 1/e of the angle).
const TIME: f32 = 0.5;
/// Speed, m/s, below which the direction of motion is unreliable: the heading stays.
const REST: f32 = 0.1;
/// Speed, m/s, above which the heading follows fully. Between both speeds it follows in proportion.
const WALK: f32 = 0.8;

/// Returns the heading after `step` seconds of motion at `velocity`, with a turn rate of at most `max_turn_rate`.
pub fn turn(heading: f32, velocity: Vec2, step: f32, max_turn_rate: f32) -> f32 {
    let speed = velocity.length();
    if speed < REST {
        return heading;
    }
    let away = wrap(angle(velocity) - heading);
    if max_turn_rate.is_infinite() {
        let certainty = ((speed - REST) / (WALK - REST)).min(1.0);
        return wrap(heading + away * (certainty * part_of(step)));
    }
    // the motion already obeys a limited turn rate, so the heading can be the direction of motion
    let most = max_turn_rate * step;
    wrap(heading + away.clamp(-most, most))
}

/// Returns the fraction of the angle to the direction of motion that a heading turns in a step.
fn part_of(step: f32) -> f32 {
    1.0 - libm::expf(-step / TIME)
}

/// SIMD version of [`turn`] for bodies without a limit of the turn rate.
#[derive(Clone, Copy)]
pub(crate) struct Turning {
    part: f32,
}

impl Turning {
    /// Returns the turning of a step of `step` seconds.
    pub fn of(step: f32) -> Self {
        Self { part: part_of(step) }
    }

    /// Returns the headings after the step.
    #[inline(always)]
    pub fn turn<S: Simd>(self, simd: S, headings: S::f32s, velocity: Vec2s<S>) -> S::f32s {
        let splat = |value: f32| S::f32s::splat(simd, value);
        let speed = velocity.dot(velocity).sqrt();
        let certainty = ((speed - splat(REST)) / splat(WALK - REST)).min(splat(1.0));
        let away = wraps(simd, angles(simd, velocity) - headings);
        let turned = wraps(simd, headings + away * (certainty * splat(self.part)));
        speed.simd_lt(splat(REST)).select(headings, turned)
    }
}

/// Returns the direction that a body turns to: its velocity. A body with a limited turn rate that stands turns on the
/// spot to its preferred velocity, since it cannot set out in any other direction.
pub fn faces(velocity: Vec2, preferred: Vec2, max_turn_rate: f32) -> Vec2 {
    if max_turn_rate.is_finite() && velocity.length() < REST { preferred } else { velocity }
}

/// Returns an equivalent angle between -pi and pi, for angles between -3 pi and 3 pi.
pub(crate) fn wrap(angle: f32) -> f32 {
    if angle > PI {
        angle - 2.0 * PI
    } else if angle < -PI {
        angle + 2.0 * PI
    } else {
        angle
    }
}

/// SIMD version of [`wrap`].
#[inline(always)]
fn wraps<S: Simd>(simd: S, angle: S::f32s) -> S::f32s {
    let splat = |value: f32| S::f32s::splat(simd, value);
    let low = angle.simd_lt(splat(-PI)).select(angle + splat(2.0 * PI), angle);
    angle.simd_gt(splat(PI)).select(angle - splat(2.0 * PI), low)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn at_rest_the_heading_stays() {
        assert_eq!(turn(1.0, Vec2::new(-0.05, 0.0), 0.02, f32::INFINITY), 1.0);
    }

    #[test]
    fn a_body_that_turns_slowly_turns_before_it_sets_out() {
        assert_eq!(faces(Vec2::ZERO, Vec2::X, 1.0), Vec2::X);
        assert_eq!(faces(Vec2::Y, Vec2::X, 1.0), Vec2::Y);
        assert_eq!(faces(Vec2::ZERO, Vec2::X, f32::INFINITY), Vec2::ZERO);
    }

    #[test]
    fn turning_does_not_depend_on_the_step() {
        let mut fine = 0.0;
        for _ in 0..10 {
            fine = turn(fine, Vec2::Y, 0.01, f32::INFINITY);
        }
        let coarse = turn(0.0, Vec2::Y, 0.1, f32::INFINITY);
        assert!((fine - coarse).abs() < 1e-3, "{fine} {coarse}");
    }

    #[test]
    fn it_turns_the_short_way() {
        let heading = turn(3.0, Vec2::new(-1.0, -0.3), 0.1, f32::INFINITY);
        assert!(!(-3.2..=3.0).contains(&heading) || heading < -2.9, "{heading}");
    }
}
