//! Velocity obstacles in the world, at true scale: a velocity is the motion in one second.

use super::pen::AnnotationPen;
use crate::figure::forbidden;
use glam::{DVec3, Vec2};
use std::f64::consts::TAU;
use throng::Explanation;
use throng::avoid::AvoidanceReason;

/// The number of corners of a circle.
const ROUND: usize = 64;
/// Forbidden velocities are drawn up to this multiple of the top speed.
const REACH: f32 = 1.6;

/// Draws what the local model permits and forbids an agent at a place: the forbidden velocities of each neighbour and
/// wall, the disc of the top speed, the velocities that were tried, and the chosen velocity. Around each neighbour, the
/// disc that the centre of the agent must not enter.
pub(super) fn draw(why: &Explanation, at: DVec3, pen: &mut AnnotationPen<'_>) {
    let place = |velocity: Vec2| at + velocity.as_dvec2().extend(0.0);
    let circle = |center: DVec3, radius: f64| {
        (0..=ROUND).map(move |k| {
            let (sin, cos) = (TAU * k as f64 / ROUND as f64).sin_cos();
            center + DVec3::new(cos, sin, 0.0) * radius
        })
    };
    for reason in &why.reasons {
        if let Some((_, polygon)) = forbidden(reason, REACH * why.max_speed) {
            let polygon: Vec<DVec3> = polygon.into_iter().map(place).collect();
            pen.area(&polygon);
            pen.line(polygon.iter().chain(&polygon[..1]).copied());
        }
        if let AvoidanceReason::Candidate { velocity, cost } = *reason {
            if cost.is_finite() { pen.dot(place(velocity), 0.8) } else { pen.ring(place(velocity), 0.8) }
        }
    }
    for other in &why.neighbours {
        pen.line(circle(place(other.seen.offset), f64::from(other.seen.radii)));
    }
    pen.line(circle(at, f64::from(why.max_speed)));
    pen.arrow(at, why.chosen.as_dvec2().extend(0.0));
    pen.dot(place(why.chosen), 2.0);
}
