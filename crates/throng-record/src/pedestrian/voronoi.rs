//! Voronoi densities: every pedestrian has the ground that is nearer to it than to any other pedestrian.
//!
//! B. Steffen, A. Seyfried, *Methods for measuring pedestrian density, flow, speed and direction with minimal scatter*,
//! Physica A 389, 2010. As in PedPy, a cell is clipped to the walkable area and, with a cut-off, to a polygon around
//! the pedestrian. If the cell falls apart, the part with the pedestrian counts.

use super::area::{Area, signed_area, winds};
use super::people::{People, PeopleMoment, PersonRow};
use glam::DVec2;
use i_overlay::core::{fill_rule::FillRule, overlay_rule::OverlayRule};
use i_overlay::float::single::SingleFloatOverlay;
use std::f64::consts::TAU;
use std::slice;
use throng::Walkable;

/// The extent of Voronoi cells.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ground {
    /// Walkable areas, which do not overlap; empty: a box around all pedestrians.
    pub walkable: Vec<Walkable>,
    /// Greatest extent of cells, metres: the radius of a polygon of [`CORNERS`] corners around each pedestrian.
    pub cut_off: Option<f64>,
}

/// Greatest extent of cells where the walkable ground is unknown, metres.
const CUT_OFF: f64 = 1.0;

impl Ground {
    /// Returns the ground of these walkable areas. Without areas, cells extend at most 1 m unless `cut_off` says
    /// otherwise.
    ///
    /// ```
    /// use throng_record::pedestrian::Ground;
    /// assert_eq!(Ground::new(vec![], None).cut_off, Some(1.0));
    /// assert_eq!(Ground::new(vec![], Some(2.0)).cut_off, Some(2.0));
    /// ```
    pub fn new(walkable: Vec<Walkable>, cut_off: Option<f64>) -> Self {
        Self { cut_off: cut_off.or(walkable.is_empty().then_some(CUT_OFF)), walkable }
    }
}

/// Corners of the cut-off polygon, as in PedPy.
pub const CORNERS: u32 = 12;

/// A polygon with holes: its rings, the outer one first.
type Shape = Vec<Vec<[f64; 2]>>;

/// A cell that overlaps a measurement area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// Its pedestrian.
    pub here: PersonRow,
    /// Its area, m².
    pub size: f64,
    /// The area of its overlap with the measurement area, m².
    pub inside: f64,
}

/// Returns the cells at a time that overlap an area, by number.
pub fn cells(people: &People, moment: &PeopleMoment, ground: &Ground, area: &Area) -> Vec<Cell> {
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
        // a pedestrian outside the walkable area has the largest part
        let largest = || walked.iter().max_by(|a, b| size(a).total_cmp(&size(b)));
        let part = walked.iter().find(on).or_else(largest)?;
        let inside = common(slice::from_ref(part), slice::from_ref(&region)).iter().map(size).sum();
        Some(Cell { here: moment.here[order[at]], size: size(part), inside })
    };
    let mut cells: Vec<Cell> = (0..order.len()).filter_map(own).filter(|cell| cell.inside > 0.0).collect();
    cells.sort_by_key(|cell| cell.here.walk);
    cells
}

/// Returns the Voronoi density of an area: the sum of the overlapping fractions of its cells over its size, 1/m².
pub fn density(cells: &[Cell], area: &Area) -> f64 {
    cells.iter().map(|cell| cell.inside / cell.size).sum::<f64>() / area.size()
}

/// Returns the Voronoi speed of an area: speeds weighted by their cells' overlaps over the size of the area, m/s. Parts
/// without a cell count as speed 0.
pub fn speed(cells: &[Cell], area: &Area, velocity: impl Fn(PersonRow) -> Option<DVec2>) -> f64 {
    let part = |cell: &Cell| velocity(cell.here).map_or(0.0, DVec2::length) * cell.inside;
    cells.iter().map(part).sum::<f64>() / area.size()
}

/// Returns a box that contains all cells: lower left and upper right corner.
fn room(places: &[DVec2], ground: &Ground, area: &Area) -> [DVec2; 2] {
    let corners = ground.walkable.iter().flat_map(|walkable| &walkable.outer).chain(area.corners());
    let start = [DVec2::INFINITY, DVec2::NEG_INFINITY];
    let [low, high] = places.iter().chain(corners).fold(start, |[low, high], &p| [low.min(p), high.max(p)]);
    [low - 1.0, high + 1.0]
}

/// Returns the cell of the pedestrian at index `at` in `order`, by x: the points nearer to it than to any other
/// pedestrian, within the room and the cut-off.
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
        // pedestrians at the same position share a cell
        if other != place && other.distance(place) <= 2.0 * reach {
            cell = halved(&cell, 0.5 * (place + other), other - place);
        }
    }
}

/// Returns the part of a convex polygon behind a line through a point, on the side opposite to the normal.
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

/// Whether the bounding boxes of two polygons overlap.
fn meet(a: &[DVec2], b: &[DVec2]) -> bool {
    let bounds = |polygon: &[DVec2]| {
        let start = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        polygon.iter().fold(start, |(low, high), &p| (low.min(p), high.max(p)))
    };
    let ((low, high), (from, to)) = (bounds(a), bounds(b));
    low.cmple(to).all() && from.cmple(high).all()
}

/// Returns the intersection of two sets of shapes.
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

/// Returns the area of a shape: its outer ring less its holes.
fn size(shape: &Shape) -> f64 {
    let ring = |ring: &Vec<[f64; 2]>| signed_area(&corners(ring)).abs();
    shape.first().map_or(0.0, ring) - shape.iter().skip(1).map(ring).sum::<f64>()
}
