//! The outlines of elements.

use super::super::curve::{arc, cubic};
use super::super::drawing::Form;
use super::super::overlay::enclosed;
use super::elements::Elements;
use crate::error::Error;
use crate::geometry::{DVec2, points, signed_area};
use crate::import::short;
use roxmltree::Node;
use std::f64::consts::TAU;
use svgtypes::{PointsParser, SimplePathSegment as Segment, SimplifyingPathParser};

/// Coordinates beyond this are not worked with.
const FARTHEST: f64 = 1e9;

/// The shapes of an element, in its own units; `None` if it draws none.
pub(super) fn of(elements: &Elements, node: Node, tolerance: f64) -> Result<Option<Vec<Form>>, Error> {
    let length = |name: &str| elements.length(node, name);
    Ok(Some(match node.tag_name().name() {
        "rect" => {
            let (low, size) = (DVec2::new(length("x")?, length("y")?), DVec2::new(length("width")?, length("height")?));
            let high = low + size;
            vec![Form::Area(vec![low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)], vec![])]
        }
        "circle" => vec![ellipse(DVec2::new(length("cx")?, length("cy")?), DVec2::splat(length("r")?), tolerance)],
        "ellipse" => {
            vec![ellipse(DVec2::new(length("cx")?, length("cy")?), DVec2::new(length("rx")?, length("ry")?), tolerance)]
        }
        "line" => {
            vec![Form::Line(vec![DVec2::new(length("x1")?, length("y1")?), DVec2::new(length("x2")?, length("y2")?)])]
        }
        "polyline" | "polygon" => {
            let said = node.attribute("points").unwrap_or_default();
            let points = PointsParser::from(said).map(DVec2::from).collect();
            vec![Form::of_line(points, node.tag_name().name() == "polygon")]
        }
        "path" => path(elements, node, tolerance)?,
        _ => return Ok(None),
    }))
}

fn ellipse(center: DVec2, radii: DVec2, tolerance: f64) -> Form {
    let axes = [DVec2::X * radii.x, DVec2::Y * radii.y];
    if radii.min_element() <= 0.0 {
        return Form::Line(vec![]);
    }
    let mut outline = arc(center, axes, [0.0, TAU], tolerance);
    outline.pop();
    Form::Area(outline, vec![])
}

/// A path: what is not closed is a line; what is, with the holes in it, an area.
fn path(elements: &Elements, node: Node, tolerance: f64) -> Result<Vec<Form>, Error> {
    let said = node.attribute("d").unwrap_or_default();
    let (mut lines, mut rings) = (vec![], vec![]);
    let mut run: Vec<DVec2> = vec![];
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
        match Form::of_line(line, false) {
            Form::Area(ring, _) => rings.push(ring),
            line => forms.push(line),
        }
    }
    let rings: Vec<Vec<DVec2>> = rings.into_iter().filter(|ring| ring.len() > 2).collect();
    match rings.as_slice() {
        [] => {}
        [one] if signed_area(one) != 0.0 => forms.push(Form::Area(one.clone(), vec![])),
        several if several.iter().flatten().all(|p| p.abs().max_element() < FARTHEST) => {
            let areas = enclosed(several, node.attribute("fill-rule") == Some("evenodd"));
            let holes = |area: &crate::scene::Area| area.holes.iter().map(|hole| points(hole)).collect();
            forms.extend(areas.iter().map(|area| Form::Area(points(&area.outer), holes(area))));
        }
        // which is an error of the drawing
        [first, ..] => forms.push(Form::Area(first.clone(), vec![])),
    }
    Ok(forms)
}
