//! Voronoi densities: everybody has the ground that is nearer to them than to anybody else.
//!
//! B. Steffen, A. Seyfried, *Methods for measuring pedestrian density, flow, speed and direction with minimal scatter*,
//! Physica A 389, 2010. As PedPy has it: a cell is clipped to the walkable area, of which the part counts that its owner
//! stands on, and to a polygon round its owner where there is a cut-off.

use super::area::{Area, signed_area, winds};
use super::people::{Here, Moment, People};
use glam::DVec2;
use i_overlay::core::{fill_rule::FillRule, overlay_rule::OverlayRule};
use i_overlay::float::single::SingleFloatOverlay;
use std::f64::consts::TAU;
use std::slice;
use throng::Walkable;

/// How far cells reach.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ground {
    /// The ground that can be walked on, apart from each other; empty: all round those who are there.
    pub walkable: Vec<Walkable>,
    /// Cells reach no farther than this, metres: the radius of a polygon of [`CORNERS`] corners round everybody.
    pub cut_off: Option<f64>,
}

/// Corners of the polygon of a cut-off, as PedPy has them.
pub const CORNERS: u32 = 12;

/// A polygon with holes: its rings, the outer one first.
type Shape = Vec<Vec<[f64; 2]>>;

/// A cell that reaches into a measurement area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// Whose it is.
    pub here: Here,
    /// How large it is, m².
    pub size: f64,
    /// How much of it is in the measurement area, m².
    pub inside: f64,
}

/// The cells of a moment that reach into an area, by number.
pub fn cells(people: &People, moment: &Moment, ground: &Ground, area: &Area) -> Vec<Cell> {
    let places: Vec<DVec2> = moment.here.iter().map(|&here| people.place(here)).collect();
    let room = room(&places, ground, area);
    let walkable: Vec<Shape> = ground.walkable.iter().map(rings).collect();
    let region = vec![area.corners().iter().map(|corner| corner.to_array()).collect::<Vec<_>>()];
    let mut order: Vec<usize> = (0..places.len()).collect();
    order.sort_by(|&a, &b| places[a].x.total_cmp(&places[b].x));
    let own = |at: usize| {
        let place = places[order[at]];
        let cell = around(&places, &order, at, ground.cut_off, room);
        if !meet(&cell, area.corners()) {
            return None;
        }
        let cell = vec![cell.iter().map(|corner| corner.to_array()).collect::<Vec<_>>()];
        let walked = if walkable.is_empty() { vec![cell] } else { common(&walkable, &[cell]) };
        let on = |shape: &&Shape| winds(&corners(&shape[0]), place);
        // who stands beside the ground has the largest part
        let largest = || walked.iter().max_by(|a, b| size(a).total_cmp(&size(b)));
        let part = walked.iter().find(on).or_else(largest)?;
        let inside = common(slice::from_ref(part), slice::from_ref(&region)).iter().map(size).sum();
        Some(Cell { here: moment.here[order[at]], size: size(part), inside })
    };
    let mut cells: Vec<Cell> = (0..order.len()).filter_map(own).filter(|cell| cell.inside > 0.0).collect();
    cells.sort_by_key(|cell| cell.here.walk);
    cells
}

/// Voronoi density of an area: of every cell that reaches into it the part that does, over the size of the area, 1/m².
pub fn density(cells: &[Cell], area: &Area) -> f64 {
    cells.iter().map(|cell| cell.inside / cell.size).sum::<f64>() / area.size()
}

/// Voronoi speed of an area: speeds by how much of it is theirs, m/s. What nobody has counts as speed 0.
pub fn speed(cells: &[Cell], area: &Area, velocity: impl Fn(Here) -> Option<DVec2>) -> f64 {
    let part = |cell: &Cell| velocity(cell.here).map_or(0.0, DVec2::length) * cell.inside;
    cells.iter().map(part).sum::<f64>() / area.size()
}

/// A box that holds all cells: lower left and upper right corner.
fn room(places: &[DVec2], ground: &Ground, area: &Area) -> [DVec2; 2] {
    let corners = ground.walkable.iter().flat_map(|walkable| &walkable.outer).chain(area.corners());
    let start = [DVec2::INFINITY, DVec2::NEG_INFINITY];
    let [low, high] = places.iter().chain(corners).fold(start, |[low, high], &p| [low.min(p), high.max(p)]);
    [low - 1.0, high + 1.0]
}

/// The cell of one of those in `order`, by x: what is nearer to it than to anybody else, within the room and the cut-off.
fn around(places: &[DVec2], order: &[usize], at: usize, cut_off: Option<f64>, [low, high]: [DVec2; 2]) -> Vec<DVec2> {
    let place = places[order[at]];
    let mut cell = vec![low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
    if let Some(radius) = cut_off {
        let step = TAU / f64::from(CORNERS);
        let corner = |k: u32| place + radius * DVec2::from_angle(f64::from(k) * step);
        for k in 0..CORNERS {
            let (a, b) = (corner(k), corner(k + 1));
            cell = halved(&cell, a, (a - b).perp());
        }
    }
    let (mut left, mut right) = (at, at + 1);
    let aside = |at: usize| (places[order[at]].x - place.x).abs();
    loop {
        let reach = cell.iter().map(|corner| corner.distance(place)).fold(0.0, f64::max);
        let before = left.checked_sub(1).filter(|&k| aside(k) <= 2.0 * reach);
        let after = Some(right).filter(|&k| k < order.len() && aside(k) <= 2.0 * reach);
        let other = match (before, after) {
            (Some(before), Some(after)) if aside(before) > aside(after) => after,
            (Some(before), _) => before,
            (None, Some(after)) => after,
            (None, None) => return cell,
        };
        if other < at {
            left = other;
        } else {
            right = other + 1;
        }
        let other = places[order[other]];
        // two at one place share a cell
        if other != place && other.distance(place) <= 2.0 * reach {
            cell = halved(&cell, 0.5 * (place + other), other - place);
        }
    }
}

/// The part of a convex polygon that is not beyond a line through a point, against its normal.
fn halved(polygon: &[DVec2], point: DVec2, normal: DVec2) -> Vec<DVec2> {
    let beyond = |corner: DVec2| (corner - point).dot(normal);
    let mut out = Vec::with_capacity(polygon.len() + 1);
    for (&a, &b) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
        let (from, to) = (beyond(a), beyond(b));
        if from <= 0.0 {
            out.push(a);
        }
        if (from < 0.0 && to > 0.0) || (from > 0.0 && to < 0.0) {
            out.push(a.lerp(b, from / (from - to)));
        }
    }
    out
}

/// Whether the boxes round two polygons meet.
fn meet(a: &[DVec2], b: &[DVec2]) -> bool {
    let bounds = |polygon: &[DVec2]| {
        let start = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        polygon.iter().fold(start, |(low, high), &p| (low.min(p), high.max(p)))
    };
    let ((low, high), (from, to)) = (bounds(a), bounds(b));
    low.cmple(to).all() && from.cmple(high).all()
}

/// What two lots of shapes have in common.
fn common(a: &[Shape], b: &[Shape]) -> Vec<Shape> {
    a.overlay(&b, OverlayRule::Intersect, FillRule::EvenOdd)
}

fn rings(walkable: &Walkable) -> Shape {
    std::iter::once(&walkable.outer)
        .chain(&walkable.holes)
        .map(|ring| ring.iter().map(|p| p.to_array()).collect())
        .collect()
}

fn corners(ring: &[[f64; 2]]) -> Vec<DVec2> {
    ring.iter().copied().map(DVec2::from_array).collect()
}

/// The size of a shape: its outer ring less its holes.
fn size(shape: &Shape) -> f64 {
    let ring = |ring: &Vec<[f64; 2]>| signed_area(&corners(ring)).abs();
    shape.first().map_or(0.0, ring) - shape.iter().skip(1).map(ring).sum::<f64>()
}
