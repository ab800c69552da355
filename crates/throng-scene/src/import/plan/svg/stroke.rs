//! Walls with the width of their strokes.

use super::super::drawing::PlanShape;
use super::super::overlay::{FARTHEST, difference, stroked};
use super::style::Look;
use crate::geometry::{DVec2, points};
use crate::scene::Area;
use i_overlay::mesh::float::style::{LineCap, LineJoin, StrokeStyle};

/// The default miter limit.
const MITER: f64 = 4.0;

/// Returns the painted areas of shapes with strokes of a width: fill and stroke of filled shapes, the stroke of others.
pub(super) fn painted(forms: Vec<PlanShape>, look: &Look, width: f64, tolerance: f64) -> Vec<PlanShape> {
    let near = |form: &PlanShape| form.points().iter().all(|p| p.abs().max_element() < FARTHEST);
    if !forms.iter().all(near) {
        // an error that the drawing's check reports
        return forms;
    }
    let style = style(look, width, tolerance);
    let form = |area: Area| PlanShape::Area(points(&area.outer), area.holes.iter().map(|hole| points(hole)).collect());
    forms
        .into_iter()
        .flat_map(|shape| match shape {
            PlanShape::Line(line) => stroked(&line, false, style.clone()).into_iter().map(form).collect(),
            PlanShape::Area(outer, holes) => {
                let plain = |ring: &Vec<DVec2>| ring.iter().map(DVec2::to_array).collect();
                let mut areas = stroked(&outer, true, style.clone());
                areas.extend(holes.iter().flat_map(|hole| stroked(hole, true, style.clone())));
                if !look.is("fill", "none") {
                    areas.push(Area { outer: plain(&outer), holes: holes.iter().map(plain).collect() });
                }
                difference(&areas, &[]).into_iter().map(form).collect()
            }
            other => vec![other],
        })
        .collect()
}

fn style(look: &Look, width: f64, tolerance: f64) -> StrokeStyle<[f64; 2]> {
    let limit = look.of("stroke-miterlimit").and_then(|said| said.parse().ok()).filter(|limit: &f64| *limit >= 1.0);
    // a chord over this angle deviates from the circle by the tolerance
    let step = 2.0 * libm::acos((1.0 - 2.0 * tolerance / width).clamp(-1.0, 1.0));
    let cap = || match look.of("stroke-linecap") {
        Some("round") => LineCap::Round(step),
        Some("square") => LineCap::Square,
        _ => LineCap::Butt,
    };
    let join = match look.of("stroke-linejoin") {
        Some("round") => LineJoin::Round(step),
        Some("bevel") => LineJoin::Bevel,
        _ => LineJoin::Miter(2.0 * libm::asin(1.0 / limit.unwrap_or(MITER))),
    };
    StrokeStyle::new(width).start_cap(cap()).end_cap(cap()).line_join(join)
}
