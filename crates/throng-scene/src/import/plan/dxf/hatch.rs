//! Hatches: filled areas, by their boundary paths.

use super::super::curve::{arc, bulged};
use super::super::drawing::PlanShape;
use super::super::overlay::{FARTHEST, difference, enclosed};
use super::pairs::Entity;
use super::spline;
use crate::error::Error;
use crate::geometry::{DVec2, contains, points};
use crate::scene::Area;
use std::f64::consts::TAU;

/// With more paths than this, nesting is not tested.
const MANY: usize = 1000;

/// Returns the areas that a hatch fills. By its style, it fills the points within an odd number of its paths, the outer
/// paths without those inside, or all of the paths.
pub(super) fn forms(hatch: &Entity, tolerance: f64) -> Result<Vec<PlanShape>, Error> {
    let from = hatch.pairs.iter().position(|pair| pair.code == 91).unwrap_or_default();
    let to = hatch.pairs[from..].iter().position(|pair| pair.code == 75).map_or(hatch.pairs.len(), |to| from + to);
    let mut rings = vec![];
    for path in parts(hatch, from..to, 92) {
        let ring =
            if path.flags(92) & 2 != 0 { bulged(&path.corners()?, true, tolerance) } else { joined(&path, tolerance)? };
        rings.extend(Some(ring).filter(|ring| ring.len() > 2));
    }
    if let Some(far) = rings.iter().find(|ring| ring.iter().any(|p| p.abs().max_element() > FARTHEST)) {
        // an error that the drawing's check reports
        return Ok(vec![PlanShape::Area(far.clone(), vec![])]);
    }
    let areas = match hatch.flags(75) {
        1 if rings.len() <= MANY => {
            let inner = |ring: &Vec<DVec2>| rings.iter().any(|other| other != ring && contains(other, ring[0]));
            let (inner, outer): (Vec<_>, Vec<_>) = rings.iter().cloned().partition(inner);
            difference(&enclosed(&outer, false), &inner)
        }
        style => enclosed(&rings, style != 2),
    };
    let holes = |area: &Area| area.holes.iter().map(|hole| points(hole)).collect();
    Ok(areas.iter().map(|area| PlanShape::Area(points(&area.outer), holes(area))).collect())
}

/// Splits pairs into parts, each from a pair with a code to before the next.
fn parts<'p, 't>(of: &Entity<'p, 't>, within: std::ops::Range<usize>, code: i32) -> Vec<Entity<'p, 't>> {
    let starts: Vec<usize> = within.clone().filter(|i| of.pairs[*i].code == code).collect();
    let ends = starts.iter().skip(1).copied().chain([within.end]);
    starts.iter().zip(ends).map(|(from, to)| Entity { pairs: &of.pairs[*from..to], ..*of }).collect()
}

/// Joins the edges of a path in order. Edges in the opposite direction are reversed.
fn joined(path: &Entity, tolerance: f64) -> Result<Vec<DVec2>, Error> {
    let edges = parts(path, 0..path.pairs.len(), 72);
    let edges: Vec<Vec<DVec2>> = edges.iter().map(|edge| lines(edge, tolerance)).collect::<Result<_, _>>()?;
    let mut edges = edges.into_iter().filter(|edge| edge.len() > 1).peekable();
    let ends = |edge: &Vec<DVec2>| [edge[0], edge[edge.len() - 1]];
    let near = |p: DVec2, edge: &Vec<DVec2>| ends(edge).map(|end| end.distance(p));
    let mut ring = edges.next().unwrap_or_default();
    if let Some(next) = edges.peek() {
        let [start, end] = ends(&ring).map(|p| near(p, next).into_iter().fold(f64::INFINITY, f64::min));
        if start < end {
            ring.reverse();
        }
    }
    for mut edge in edges {
        let [start, end] = near(ring[ring.len() - 1], &edge);
        if end < start {
            edge.reverse();
        }
        ring.extend(edge);
    }
    Ok(ring)
}

/// Returns the points of an edge: a line, an arc of a circle or of an ellipse, or a spline.
fn lines(edge: &Entity, tolerance: f64) -> Result<Vec<DVec2>, Error> {
    // the angles of a clockwise arc are measured clockwise
    let way = if edge.number(73, 1.0)? == 0.0 { -1.0 } else { 1.0 };
    let turn = |ratio: f64| -> Result<[f64; 2], Error> {
        let [from, to] = [edge.number(50, 0.0)?, edge.number(51, 360.0)?].map(f64::to_radians);
        let whole = (to - from).abs() >= TAU - 1e-9;
        // the parameter at which a ray at an angle meets an ellipse
        let [from, to] = [from, to].map(|angle| libm::atan2(libm::sin(angle) / ratio, libm::cos(angle)));
        let turn = (to - from).rem_euclid(TAU);
        let turn = if whole || turn < 1e-9 { TAU } else { turn };
        Ok([way * from, way * (from + turn)])
    };
    Ok(match edge.flags(72) {
        1 => vec![edge.point(10)?, edge.point(11)?],
        2 => {
            let radius = edge.number(40, 0.0)?.max(0.0);
            arc(edge.point(10)?, [DVec2::X * radius, DVec2::Y * radius], turn(1.0)?, tolerance)
        }
        3 => {
            let (a, ratio) = (edge.point(11)?, edge.number(40, 1.0)?.clamp(1e-6, 1e6));
            arc(edge.point(10)?, [a, a.perp() * ratio], turn(ratio)?, tolerance)
        }
        4 => spline::lines(edge, 94, 42, tolerance)?,
        _ => vec![],
    })
}
