//! The outlines of elements.

use super::super::curve::{arc, cubic};
use super::super::drawing::PlanShape;
use super::super::overlay::{FARTHEST, enclosed};
use super::elements::{Elements, Todo};
use crate::error::Error;
use crate::geometry::{DVec2, points, signed_area};
use crate::import::short;
use std::f64::consts::TAU;
use svgtypes::{PathParser, PathSegment, PointsParser, SimplePathSegment as Segment, SimplifyingPathParser};

/// Returns the shapes of an element, in its own units; `None` if it draws nothing.
pub(super) fn of(elements: &Elements, item: &Todo, tolerance: f64) -> Result<Option<Vec<PlanShape>>, Error> {
    let node = item.node;
    let length = |name: &str| elements.length(node, name, item.view).map(Option::unwrap_or_default);
    Ok(Some(match node.tag_name().name() {
        "rect" => {
            let (low, size) = (DVec2::new(length("x")?, length("y")?), DVec2::new(length("width")?, length("height")?));
            // a radius that is not given equals the other
            let round = |name: &str| elements.length(node, name, item.view);
            let (rx, ry) = (round("rx")?, round("ry")?);
            let radii = DVec2::new(rx.or(ry).unwrap_or_default(), ry.or(rx).unwrap_or_default());
            vec![PlanShape::Area(rounded(low, size, radii, tolerance), vec![])]
        }
        "circle" => vec![ellipse(DVec2::new(length("cx")?, length("cy")?), DVec2::splat(length("r")?), tolerance)],
        "ellipse" => {
            vec![ellipse(DVec2::new(length("cx")?, length("cy")?), DVec2::new(length("rx")?, length("ry")?), tolerance)]
        }
        "line" => {
            vec![PlanShape::Line(vec![
                DVec2::new(length("x1")?, length("y1")?),
                DVec2::new(length("x2")?, length("y2")?),
            ])]
        }
        "polyline" | "polygon" => {
            let said = node.attribute("points").unwrap_or_default();
            let points = PointsParser::from(said).map(DVec2::from).collect();
            vec![PlanShape::of_line(points, node.tag_name().name() == "polygon")]
        }
        "path" => path(elements, item, tolerance)?,
        _ => return Ok(None),
    }))
}

/// Returns a rectangle with corners that are quarters of ellipses.
fn rounded(low: DVec2, size: DVec2, radii: DVec2, tolerance: f64) -> Vec<DVec2> {
    let high = low + size;
    let radii = radii.min(size * 0.5);
    if radii.min_element() <= 0.0 {
        return vec![low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
    }
    let (near, far) = (low + radii, high - radii);
    let middles = [far, DVec2::new(near.x, far.y), near, DVec2::new(far.x, near.y)];
    let axes = [DVec2::X * radii.x, DVec2::Y * radii.y];
    let quarter = |(k, middle): (usize, DVec2)| arc(middle, axes, [k, k + 1].map(|k| k as f64 * TAU / 4.0), tolerance);
    middles.into_iter().enumerate().flat_map(quarter).collect()
}

fn ellipse(center: DVec2, radii: DVec2, tolerance: f64) -> PlanShape {
    let axes = [DVec2::X * radii.x, DVec2::Y * radii.y];
    if radii.min_element() <= 0.0 {
        return PlanShape::Line(vec![]);
    }
    let mut outline = arc(center, axes, [0.0, TAU], tolerance);
    outline.pop();
    PlanShape::Area(outline, vec![])
}

/// Returns the shapes of a path: open parts are lines; closed parts are areas, with their holes.
fn path(elements: &Elements, item: &Todo, tolerance: f64) -> Result<Vec<PlanShape>, Error> {
    let node = item.node;
    let said = node.attribute("d").unwrap_or_default();
    let (mut lines, mut rings) = (vec![], vec![]);
    let mut run: Vec<DVec2> = vec![];
    // a larger arc would become more curves than fit into memory
    if PathParser::from(said).flatten().any(|segment| reach(&segment) > FARTHEST) {
        let message = format!("its path goes farther than {FARTHEST} units, in `{}`", short(said));
        return Err(elements.wrong(node, message));
    }
    for segment in SimplifyingPathParser::from(said) {
        let segment = segment
            .map_err(|error| elements.wrong(node, format!("its path is wrong: {error}, in `{}`", short(said))))?;
        match segment {
            Segment::MoveTo { x, y } => lines.push(std::mem::replace(&mut run, vec![DVec2::new(x, y)])),
            Segment::LineTo { x, y } => run.push(DVec2::new(x, y)),
            Segment::CurveTo { x1, y1, x2, y2, x, y } => {
                let from = run.last().copied().unwrap_or_default();
                run.extend(cubic([from, DVec2::new(x1, y1), DVec2::new(x2, y2), DVec2::new(x, y)], tolerance));
            }
            Segment::Quadratic { x1, y1, x, y } => {
                let (from, by, to) = (run.last().copied().unwrap_or_default(), DVec2::new(x1, y1), DVec2::new(x, y));
                run.extend(cubic([from, from.lerp(by, 2.0 / 3.0), to.lerp(by, 2.0 / 3.0), to], tolerance));
            }
            Segment::ClosePath => {
                let start = run.first().copied();
                rings.push(std::mem::take(&mut run));
                run.extend(start);
            }
        }
    }
    lines.push(run);
    let mut forms = vec![];
    for line in lines.into_iter().filter(|line| line.len() > 1) {
        match PlanShape::of_line(line, false) {
            PlanShape::Area(ring, _) => rings.push(ring),
            line => forms.push(line),
        }
    }
    let rings: Vec<Vec<DVec2>> = rings.into_iter().filter(|ring| ring.len() > 2).collect();
    match rings.as_slice() {
        [] => {}
        [one] if signed_area(one) != 0.0 => forms.push(PlanShape::Area(one.clone(), vec![])),
        several if several.iter().flatten().all(|p| p.abs().max_element() < FARTHEST) => {
            let areas = enclosed(several, item.look.is("fill-rule", "evenodd"));
            let holes = |area: &crate::scene::Area| area.holes.iter().map(|hole| points(hole)).collect();
            forms.extend(areas.iter().map(|area| PlanShape::Area(points(&area.outer), holes(area))));
        }
        // an error that the drawing's check reports
        [first, ..] => forms.push(PlanShape::Area(first.clone(), vec![])),
    }
    Ok(forms)
}

/// Returns the largest coordinate of the end of a part of a path, or the largest radius of an arc.
fn reach(segment: &PathSegment) -> f64 {
    let numbers = match *segment {
        PathSegment::EllipticalArc { rx, ry, x, y, .. } => [rx, ry, x, y],
        PathSegment::MoveTo { x, y, .. }
        | PathSegment::LineTo { x, y, .. }
        | PathSegment::CurveTo { x, y, .. }
        | PathSegment::SmoothCurveTo { x, y, .. }
        | PathSegment::Quadratic { x, y, .. }
        | PathSegment::SmoothQuadratic { x, y, .. } => [x, y, 0.0, 0.0],
        PathSegment::HorizontalLineTo { x, .. } => [x, 0.0, 0.0, 0.0],
        PathSegment::VerticalLineTo { y, .. } => [y, 0.0, 0.0, 0.0],
        PathSegment::ClosePath { .. } => [0.0; 4],
    };
    numbers.into_iter().map(f64::abs).fold(0.0, f64::max)
}
