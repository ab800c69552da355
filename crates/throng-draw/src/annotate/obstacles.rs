//! Velocity obstacles in the world, at true scale: a velocity is the motion in one second.

use super::pen::{AnnotationPen, ROUND};
use crate::figure::{clip, forbidden};
use glam::{DVec3, Vec2};
use std::f32::consts::TAU;
use throng::Explanation;
use throng::avoid::{AvoidanceReason, HalfPlane};

/// Forbidden velocities are drawn up to this multiple of the top speed.
const REACH: f32 = 1.6;
/// The opacity of all regions together, and the least and the greatest opacity of one, over that of lines.
const ALL: f32 = 0.6;
const LEAST: f32 = 0.03;
const MOST: f32 = 0.16;

/// Draws what the local model permits and forbids an agent at a place: the forbidden velocities of each neighbour and
/// wall, the disc of the top speed, the velocities that were tried, and the chosen velocity. Around each neighbour, the
/// disc that the centre of the agent must not enter.
pub(super) fn draw(why: &Explanation, at: DVec3, pen: &mut AnnotationPen<'_>) {
    let place = |velocity: Vec2| at + velocity.as_dvec2().extend(0.0);
    let regions: Vec<Vec<DVec3>> = (why.reasons.iter())
        .filter_map(|reason| forbidden(reason, REACH * why.max_speed))
        .map(|(_, polygon)| within(polygon, REACH * why.max_speed).into_iter().map(place).collect())
        .collect();
    // where many regions overlap, what is below stays visible
    let shade = (ALL / regions.len().max(1) as f32).clamp(LEAST, MOST);
    for region in &regions {
        pen.area(region, shade);
    }
    let (width, color) = (pen.width, pen.color);
    (pen.width, pen.color) = (0.5 * width, color.faded(0.6));
    for region in &regions {
        pen.outline(region);
    }
    (pen.width, pen.color) = (width, color);
    for reason in &why.reasons {
        if let AvoidanceReason::Candidate { velocity, cost } = *reason {
            if cost.is_finite() { pen.dot(place(velocity), 0.8) } else { pen.ring(place(velocity), 0.8) }
        }
    }
    for other in &why.neighbours {
        pen.circle(place(other.seen.offset), DVec3::Z, f64::from(other.seen.radii));
    }
    pen.circle(at, DVec3::Z, f64::from(why.max_speed));
    pen.arrow(at, why.chosen.as_dvec2().extend(0.0));
    pen.dot(place(why.chosen), 2.0);
}

/// Returns the part of a convex polygon within a speed.
fn within(polygon: Vec<Vec2>, speed: f32) -> Vec<Vec2> {
    let tangent = |k: usize| {
        let normal = Vec2::from_angle(TAU * k as f32 / ROUND as f32);
        HalfPlane { point: normal * speed, direction: normal.perp() }
    };
    (0..ROUND).map(tangent).fold(polygon, clip)
}
