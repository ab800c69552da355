//! Hatches: what is filled, by the paths round it.

use super::super::curve::{arc, bulged};
use super::super::drawing::Form;
use super::super::overlay::{FARTHEST, difference, enclosed};
use super::pairs::Entity;
use super::spline;
use crate::error::Error;
use crate::geometry::{DVec2, contains, points};
use crate::scene::Area;
use std::f64::consts::TAU;

/// Of more paths than this it is not asked which lie within others.
const MANY: usize = 1000;

/// What a hatch fills: what lies within an odd number of its paths; or, if it says so, not what is within an inner one; or all of it.
pub(super) fn forms(hatch: &Entity, tolerance: f64) -> Result<Vec<Form>, Error> {
    let from = hatch.pairs.iter().position(|pair| pair.code == 91).unwrap_or_default();
    let to = hatch.pairs[from..].iter().position(|pair| pair.code == 75).map_or(hatch.pairs.len(), |to| from + to);
    let mut rings = vec![];
    for path in parts(hatch, from..to, 92) {
        let ring =
            if path.flags(92) & 2 != 0 { bulged(&path.corners()?, true, tolerance) } else { joined(&path, tolerance)? };
        rings.extend(Some(ring).filter(|ring| ring.len() > 2));
    }
    if let Some(far) = rings.iter().find(|ring| ring.iter().any(|p| p.abs().max_element() > FARTHEST)) {
        // which is an error of the drawing
        return Ok(vec![Form::Area(far.clone(), vec![])]);
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
    Ok(areas.iter().map(|area| Form::Area(points(&area.outer), holes(area))).collect())
}

/// The parts of some pairs, each from a code to before the next.
fn parts<'p, 't>(of: &Entity<'p, 't>, within: std::ops::Range<usize>, code: i32) -> Vec<Entity<'p, 't>> {
    let starts: Vec<usize> = within.clone().filter(|i| of.pairs[*i].code == code).collect();
    let ends = starts.iter().skip(1).copied().chain([within.end]);
    starts.iter().zip(ends).map(|(from, to)| Entity { pairs: &of.pairs[*from..to], ..*of }).collect()
}

/// The edges of a path, one after the other; those that were written the other way round are turned.
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

/// An edge: a line, an arc of a circle or of an ellipse, or a spline.
fn lines(edge: &Entity, tolerance: f64) -> Result<Vec<DVec2>, Error> {
    // angles of what goes clockwise are clockwise too
    let way = if edge.number(73, 1.0)? == 0.0 { -1.0 } else { 1.0 };
    let turn = |ratio: f64| -> Result<[f64; 2], Error> {
        let [from, to] = [edge.number(50, 0.0)?, edge.number(51, 360.0)?].map(f64::to_radians);
        let whole = (to - from).abs() >= TAU - 1e-9;
        // where a ray at an angle meets an ellipse
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
