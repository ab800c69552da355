//! The constructions that textbooks draw: circles, cylinders, rectangles and sectors in the world.

use super::layers::Annotated;
use super::pen::{AnnotationPen, ROUND};
use glam::{DVec2, DVec3};
use std::f32::consts::PI;
use std::f64::consts::TAU;
use throng::motion::Basis;

/// The opacity of areas over that of lines.
const SHADE: f32 = 0.14;
/// The length of the normal at a touched surface, metres.
const NORMAL: f64 = 0.4;

/// Draws a circle on the ground, or the outline of a sphere about a flying agent.
pub(super) fn circle(agent: &Annotated<'_>, center: DVec3, radius: f64, pen: &mut AnnotationPen<'_>) {
    let axis = if agent.body.basis.is_some() { pen.projector.sight(center) } else { DVec3::Z };
    pen.circle(center, axis, radius);
}

/// Draws a polygon: a pale area and its outline.
pub(super) fn area(corners: &[DVec3], pen: &mut AnnotationPen<'_>) {
    pen.area(corners, SHADE);
    pen.outline(corners);
}

/// Draws the outline of a tube about a line through points, as seen from the viewpoint: the line, the sides of the tube,
/// and round ends. Two points make a cylinder.
pub(super) fn tube(points: &[DVec3], radius: f64, pen: &mut AnnotationPen<'_>) {
    let mut points = points.to_vec();
    points.dedup();
    let [first, .., last] = points[..] else { return };
    let frame = |from: DVec3, to: DVec3| {
        let along = (to - from).normalize_or_zero();
        let sight = pen.projector.sight(from.midpoint(to));
        (along, sight.cross(along).normalize_or(along.any_orthonormal_vector()))
    };
    // at a corner, the side is that of the mean of both directions
    let side = |k: usize| frame(points[k.saturating_sub(1)], points[(k + 1).min(points.len() - 1)]).1;
    let cap = |center: DVec3, (along, side): (DVec3, DVec3)| {
        (0..=ROUND / 2).map(move |k| {
            let (sin, cos) = (0.5 * TAU * k as f64 / (ROUND / 2) as f64).sin_cos();
            center + (side * cos + along * sin) * radius
        })
    };
    let inner = 1..points.len() - 1;
    let (start, end) = (frame(points[1], first), frame(points[points.len() - 2], last));
    // along the left side, round the far end, back along the right side, round the near end
    let left = inner.clone().map(|k| points[k] + side(k) * radius);
    let right = inner.rev().map(|k| points[k] - side(k) * radius);
    let outline: Vec<DVec3> = left.chain(cap(last, end)).chain(right).chain(cap(first, start)).collect();
    area(&outline, pen);
    pen.line(points.iter().copied());
}

/// Draws the touched point of a surface: a stretch of its tangent, and its normal.
pub(super) fn hit(point: DVec3, normal: DVec3, pen: &mut AnnotationPen<'_>) {
    let sight = pen.projector.sight(point);
    let tangent = sight.cross(normal).normalize_or(normal.any_orthonormal_vector()) * NORMAL;
    pen.line([point - tangent, point + tangent]);
    pen.arrow(point, normal * NORMAL);
    pen.dot(point, 2.2);
}

/// Draws what an agent sees: a disc, or a sector with its straight sides. For a flying agent, also the outline of the
/// sector in its upright plane.
pub(super) fn sector(agent: &Annotated<'_>, distance: f64, angle: f32, pen: &mut AnnotationPen<'_>) {
    let upright = || Basis::facing(DVec2::from_angle(f64::from(agent.body.heading)).as_vec2().extend(0.0));
    let basis = agent.body.basis.unwrap_or_else(upright);
    let outline = |aside: glam::Vec3| {
        let out = |k: usize| {
            let (sin, cos) = (angle * (2.0 * k as f32 / ROUND as f32 - 1.0)).sin_cos();
            agent.at + (basis.forward * cos + aside * sin).as_dvec3() * distance
        };
        let center = (angle < PI - 1e-3).then_some(agent.at);
        center.into_iter().chain((0..=ROUND).map(out)).collect::<Vec<DVec3>>()
    };
    area(&outline(basis.side), pen);
    if agent.body.basis.is_some() {
        pen.outline(&outline(basis.up));
    }
}
