//! Curves of the trunk and the arms over the phase. Angles in rad, lengths in m for a leg of 0.86 m.

use crate::math::floor;
use libm::{cos, sin};
use std::f64::consts::{PI, TAU};

const DEGREE: f64 = PI / 180.0;

/// Returns the height of the pelvis against standing, walking. It falls 0.6 as far as in the source: the reach of the
/// legs does the rest.
pub(crate) fn vertical(relative_speed: f64, phase: f64) -> f64 {
    let size = 0.009 * relative_speed;
    -size + size * sin(TAU * (2.0 * phase - 0.35))
}

/// Returns the height of the pelvis against standing, running: lowest in the middle of the support, source: own
/// estimate.
pub(crate) fn running_vertical(duty: f64, phase: f64) -> f64 {
    -0.035 - 0.03 * cos(TAU * (2.0 * phase - duty))
}

/// Returns how far the pelvis is to the left of the path, walking: towards the foot on the ground.
pub(crate) fn lateral(relative_speed: f64, phase: f64) -> f64 {
    let size = if relative_speed < 0.5 { 0.128 * (relative_speed - relative_speed * relative_speed) } else { 0.032 };
    size * sin(TAU * (phase - 0.1 + 0.02))
}

/// Returns the forward tilt of the pelvis.
pub(crate) fn pelvis_tilt(relative_speed: f64, phase: f64) -> f64 {
    let size = if relative_speed < 0.5 { 8.0 * (relative_speed - relative_speed * relative_speed) } else { 2.0 };
    DEGREE * size * (1.0 - sin(TAU * (2.0 * phase - 0.1)))
}

/// Returns the turn of the pelvis to the left: the hip of the foot that strikes is in front.
pub(crate) fn pelvis_yaw(relative_speed: f64, phase: f64) -> f64 {
    -4.0 * DEGREE * relative_speed * cos(TAU * phase)
}

/// Returns by how much the left hip is higher than the right hip, as an angle: the hip of the swinging leg drops.
pub(crate) fn pelvis_list(relative_speed: f64, phase: f64) -> f64 {
    let size = 1.66 * DEGREE * relative_speed;
    let t = phase - floor(phase);
    let left_drop = if t < 0.15 {
        -size + size * cos(TAU * 10.0 * t / 3.0)
    } else if t < 0.5 {
        -size - size * cos(TAU * 10.0 * (t - 0.15) / 7.0)
    } else if t < 0.65 {
        size - size * cos(TAU * 10.0 * (t - 0.5) / 3.0)
    } else {
        size + size * cos(TAU * 10.0 * (t - 0.65) / 7.0)
    };
    -0.5 * left_drop
}

/// Returns the turn of the thorax to the left, against the pelvis.
pub(crate) fn thorax_yaw(relative_speed: f64, phase: f64) -> f64 {
    let r = relative_speed * DEGREE;
    periodic([(0.1, 4.0 / 3.0 * r), (0.4, -1.5 * r), (0.6, -4.0 / 3.0 * r), (0.9, 1.5 * r)], phase)
}

/// Returns the forward swing of an arm; `phase` is that of the leg of the same side. It is half as far behind the body
/// as in the source.
pub(crate) fn shoulder(relative_speed: f64, phase: f64) -> f64 {
    let size = 9.88 * relative_speed.min(2.2);
    DEGREE * (3.0 - size / 4.0 - size * cos(TAU * phase))
}

/// Returns the flexion of an elbow; `phase` is that of the leg of the same side. It is 0.7 of that of the source.
pub(crate) fn elbow(relative_speed: f64, phase: f64) -> f64 {
    let rv = relative_speed;
    let angle = if rv < 0.5 {
        periodic([(0.05, 6.0 * rv + 3.0), (0.5, 34.0 * rv + 3.0), (0.9, 10.0 * rv + 3.0)], phase)
    } else if rv < 1.3 {
        let j = (rv - 0.5) / 0.8;
        periodic([(0.05, 8.0 * j + 6.0), (0.5 + 0.01 * j, 24.0 * j + 20.0), (0.9, 9.0 * j + 8.0)], phase)
    } else {
        let k = ((rv - 1.3) / 1.7).min(1.0);
        periodic([(0.05, 14.0 - 6.0 * k), (0.51 + 0.04 * k, 44.0 + 26.0 * k), (0.9 - 0.1 * k, 17.0 - 6.0 * k)], phase)
    };
    0.7 * DEGREE * angle
}

/// Returns a periodic curve through points, in the order of their phases, by cubics with the slopes of the chords.
fn periodic<const N: usize>(points: [(f64, f64); N], phase: f64) -> f64 {
    let t = phase - floor(phase);
    let next = points.iter().position(|&(at, _)| at > t).unwrap_or(0);
    let point = |offset: usize| {
        // offset 1 is the point before `t`
        let index = next + N + offset - 2;
        let (at, value) = points[index % N];
        (at, value)
    };
    let after = |from: f64, to: f64| if to > from { to - from } else { to - from + 1.0 };
    let (p0, p1, p2, p3) = (point(0), point(1), point(2), point(3));
    let span = after(p1.0, p2.0);
    let slope1 = (p2.1 - p0.1) / (after(p0.0, p1.0) + span) * span;
    let slope2 = (p3.1 - p1.1) / (span + after(p2.0, p3.0)) * span;
    let s = (if t >= p1.0 { t - p1.0 } else { t - p1.0 + 1.0 }) / span;
    let (s2, s3) = (s * s, s * s * s);
    (2.0 * s3 - 3.0 * s2 + 1.0) * p1.1
        + (s3 - 2.0 * s2 + s) * slope1
        + (3.0 * s2 - 2.0 * s3) * p2.1
        + (s3 - s2) * slope2
}
