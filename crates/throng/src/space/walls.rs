//! Walls: the solid edges and discs of a place in local coordinates, indexed for queries.
//!
//! Edges are directed: the solid side is on the left, free ground on the right. A thin wall consists of two opposite
//! edges.

use super::cells::{Cells, Squares, around};
use super::wall_cells::{REACH, WallCells};
use super::{Core, Obstacle, Walkable};
use glam::{DVec2, Vec2};

/// A solid edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// Start, metres from the local origin.
    pub start: DVec2,
    /// End, metres from the local origin.
    pub end: DVec2,
    /// Unit vector from start to end.
    pub direction: Vec2,
    /// Whether the solid is convex at the start.
    pub convex_start: bool,
    /// Whether the solid is convex at the end.
    pub convex_end: bool,
    /// Direction of the edge that ends where this one starts.
    pub previous: Vec2,
    /// Direction of the edge that starts where this one ends.
    pub next: Vec2,
}

impl Edge {
    /// Returns the point of the edge nearest to `p`.
    pub fn nearest(&self, p: DVec2) -> DVec2 {
        nearest_on_segment(self.start, self.end, p)
    }

    /// Returns the range along x of the part of the edge between two values of y.
    fn span(&self, (bottom, top): (f64, f64)) -> (f64, f64) {
        let along = self.end - self.start;
        let at = |y: f64| self.start.x + along.x * ((y - self.start.y) / along.y).clamp(0.0, 1.0);
        let (a, b) = if along.y == 0.0 { (self.start.x, self.end.x) } else { (at(bottom), at(top)) };
        (a.min(b), a.max(b))
    }
}

/// A solid disc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disc {
    /// Centre, metres from the local origin.
    pub center: DVec2,
    /// Radius.
    pub radius: f64,
}

/// Returns the point of the segment from `a` to `b` nearest to `p`.
pub fn nearest_on_segment(a: DVec2, b: DVec2, p: DVec2) -> DVec2 {
    let along = b - a;
    let t = (p - a).dot(along) / along.length_squared();
    // for a segment of length 0, t is NaN: its start is as near as any point
    if t > 0.0 { a + along * t.min(1.0) } else { a }
}

/// Returns the point on the outline of a polygon that is nearest to `p`; `p` itself if there are no corners.
pub fn nearest_on_outline(corners: &[DVec2], p: DVec2) -> DVec2 {
    let ends = corners.iter().zip(corners.iter().cycle().skip(1));
    let nearest = ends.map(|(&a, &b)| nearest_on_segment(a, b, p));
    nearest.min_by(|a, b| a.distance_squared(p).total_cmp(&b.distance_squared(p))).unwrap_or(p)
}

/// A reference to a wall.
#[derive(Clone, Copy, Debug)]
pub enum Wall<'a> {
    /// An edge.
    Edge(&'a Edge),
    /// A disc.
    Disc(&'a Disc),
}

impl Wall<'_> {
    /// Returns the distance of a point from the wall, metres, and the unit vector from the wall to the point. The
    /// vector is `None` for a point on an edge or at the centre of a disc.
    pub fn off(&self, p: DVec2) -> (f64, Option<DVec2>) {
        match self {
            Self::Edge(edge) => {
                let off = p - edge.nearest(p);
                (off.length(), off.try_normalize())
            }
            Self::Disc(disc) => {
                let off = p - disc.center;
                (off.length() - disc.radius, off.try_normalize())
            }
        }
    }
}

/// The walls of a place.
#[derive(Clone, Debug, Default)]
pub struct Walls {
    shapes: WallShapes,
    cells: WallCells,
    solids: Solids,
}

/// The edges and discs of a place. Their numbers: edges, then discs.
#[derive(Clone, Debug, Default)]
pub(super) struct WallShapes {
    edges: Vec<Edge>,
    discs: Vec<Disc>,
}

/// The obstacles that enclose an area, relative to the local origin.
#[derive(Clone, Debug, Default)]
struct Solids {
    all: Vec<Obstacle>,
    /// The solids with a bounding box that touches each cell.
    cells: Cells,
}

impl WallShapes {
    /// Returns the number of walls.
    pub fn count(&self) -> usize {
        self.edges.len() + self.discs.len()
    }

    fn add_ring(&mut self, corners: &[DVec2], solid_inside: bool, origin: DVec2) {
        let mut ring: Vec<DVec2> = corners.iter().map(|&p| p - origin).collect();
        let area: f64 = (0..ring.len()).map(|i| ring[i].perp_dot(ring[(i + 1) % ring.len()])).sum();
        if (area > 0.0) != solid_inside {
            ring.reverse();
        }
        self.add_loop(&ring);
    }

    fn add_loop(&mut self, points: &[DVec2]) {
        let mut ring = points.to_vec();
        ring.dedup();
        while ring.len() > 1 && ring.first() == ring.last() {
            ring.pop();
        }
        let n = ring.len();
        if n < 2 {
            return;
        }
        let direction = |i: usize| (ring[(i + 1) % n] - ring[i % n]).normalize().as_vec2();
        // a left turn or no turn is convex; so is the reversal at the end of a thin wall
        let convex = |i: usize| {
            let (before, at, after) = (ring[(i + n - 1) % n], ring[i % n], ring[(i + 1) % n]);
            let turn = (at - before).perp_dot(after - at);
            turn > 0.0 || turn == 0.0 && ((at - before).dot(after - at) < 0.0 || n == 2)
        };
        for i in 0..n {
            self.edges.push(Edge {
                start: ring[i],
                end: ring[(i + 1) % n],
                direction: direction(i),
                convex_start: convex(i),
                convex_end: convex(i + 1),
                previous: direction(i + n - 1),
                next: direction(i + 1),
            });
        }
    }

    /// Returns the box around a wall.
    pub fn bounds(&self, wall: usize) -> (DVec2, DVec2) {
        match self.edges.get(wall) {
            Some(edge) => (edge.start.min(edge.end), edge.start.max(edge.end)),
            None => {
                let disc = self.discs[wall - self.edges.len()];
                (disc.center - disc.radius, disc.center + disc.radius)
            }
        }
    }

    /// Returns the range along x of the part of a wall between two values of y; of a disc, its whole range.
    pub fn span(&self, wall: usize, band: (f64, f64)) -> (f64, f64) {
        let Some(edge) = self.edges.get(wall) else {
            let (low, high) = self.bounds(wall);
            return (low.x, high.x);
        };
        edge.span(band)
    }

    /// Returns the distance of a wall from a square; 0 or less if it reaches into the square.
    pub fn gap(&self, (low, high): (DVec2, DVec2), wall: usize) -> f64 {
        let to_square = |p: DVec2| p.distance(p.clamp(low, high));
        let Some(edge) = self.edges.get(wall) else {
            let disc = &self.discs[wall - self.edges.len()];
            return to_square(disc.center) - disc.radius;
        };
        let (bottom, top) = (edge.start.y.min(edge.end.y), edge.start.y.max(edge.end.y));
        let (left, right) = edge.span((low.y, high.y));
        if bottom <= high.y && top >= low.y && left <= high.x && right >= low.x {
            return 0.0;
        }
        // if they are apart, an end of one of them is nearest
        let corners = [low, high, DVec2::new(low.x, high.y), DVec2::new(high.x, low.y)];
        let of_corners = corners.map(|corner| edge.nearest(corner).distance(corner));
        of_corners.into_iter().fold(to_square(edge.start).min(to_square(edge.end)), f64::min)
    }

    fn wall(&self, number: u32) -> Wall<'_> {
        match self.edges.get(number as usize) {
            Some(edge) => Wall::Edge(edge),
            None => Wall::Disc(&self.discs[number as usize - self.edges.len()]),
        }
    }

    /// Whether the bounding box of a wall is within `range`: cheaper than the distance of the wall.
    fn may_be_near(&self, wall: u32, from: DVec2, range: f64) -> bool {
        let (low, high) = self.bounds(wall as usize);
        let reach = range * (1.0 + 1e-9);
        (from - from.clamp(low, high)).length_squared() <= reach * reach
    }

    /// Returns the distance of a wall; for a disc to its circumference, negative inside.
    fn distance_to(&self, wall: u32, from: DVec2) -> f64 {
        let wall = wall as usize;
        if let Some(edge) = self.edges.get(wall) {
            return edge.nearest(from).distance(from);
        }
        let disc = &self.discs[wall - self.edges.len()];
        disc.center.distance(from) - disc.radius
    }
}

impl Walls {
    /// Collects the walls of areas and obstacles, given in world coordinates, relative to a local origin. The areas
    /// must not overlap.
    pub fn new<'a>(areas: &[Walkable], obstacles: impl IntoIterator<Item = &'a Obstacle>, origin: DVec2) -> Self {
        let mut shapes = WallShapes::default();
        let mut solids = Vec::new();
        for area in areas {
            shapes.add_ring(&area.outer, false, origin);
            for hole in &area.holes {
                shapes.add_ring(hole, true, origin);
            }
        }
        for obstacle in obstacles {
            if !matches!(obstacle, Obstacle::Wall { .. }) {
                solids.push(obstacle.clone().moved(-origin));
            }
            match obstacle {
                Obstacle::Circle { center, radius } => {
                    shapes.discs.push(Disc { center: *center - origin, radius: *radius });
                }
                Obstacle::Polygon { corners } => shapes.add_ring(corners, true, origin),
                Obstacle::Wall { points } => {
                    let back = points.iter().rev().skip(1).take(points.len().saturating_sub(2));
                    let round: Vec<DVec2> = points.iter().chain(back).map(|&p| p - origin).collect();
                    shapes.add_loop(&round);
                }
            }
        }
        Self { cells: WallCells::new(&shapes), shapes, solids: Solids::new(solids) }
    }

    /// Whether a point is inside an obstacle. A thin wall has no inside.
    pub fn cover(&self, p: DVec2) -> bool {
        self.solids.cover(p)
    }

    /// Returns the edges.
    #[inline]
    pub fn edges(&self) -> &[Edge] {
        &self.shapes.edges
    }

    /// Returns the discs.
    #[inline]
    pub fn discs(&self) -> &[Disc] {
        &self.shapes.discs
    }

    /// Whether there are no walls.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.shapes.edges.is_empty() && self.shapes.discs.is_empty()
    }

    /// Finds the walls within `range` of `from`: nearest first, ties by index. Clears `near` first.
    pub fn near(&self, from: DVec2, range: f64, near: &mut NearWalls) {
        let NearWalls { edges, discs, met } = near;
        edges.clear();
        discs.clear();
        let first_disc = self.shapes.edges.len() as u32;
        self.each_once(from, range, met, |item| {
            if !self.shapes.may_be_near(item, from, range) {
                return;
            }
            let distance = self.shapes.distance_to(item, from);
            if distance <= range {
                match item.checked_sub(first_disc) {
                    None => edges.push((distance, item)),
                    Some(disc) => discs.push((distance, disc)),
                }
            }
        });
        for list in [edges, discs].into_iter().filter(|list| list.len() > 1) {
            list.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        }
    }

    /// Calls `see` once for every wall within `range` of `from`, and for some that are farther, always in the same
    /// order.
    pub(crate) fn visit_once<'a>(
        &'a self,
        from: DVec2,
        range: f64,
        met: &mut VisitedWalls,
        mut see: impl FnMut(Wall<'a>),
    ) {
        self.each_once(from, range, met, |item| {
            if self.shapes.may_be_near(item, from, range) {
                see(self.shapes.wall(item));
            }
        });
    }

    /// As [`visit_once`](Self::visit_once), with the numbers of walls: edges, then discs.
    fn each_once(&self, from: DVec2, range: f64, met: &mut VisitedWalls, mut see: impl FnMut(u32)) {
        if self.is_empty() || self.are_far(from, range) {
            return;
        }
        // each wall is listed by a cell on the line to it, at the distance `REACH` before it
        let away = range - REACH;
        if away <= 0.0 {
            self.cells.at(&self.shapes, from).walls().iter().for_each(|&item| see(item));
        } else {
            met.begin(self.shapes.count());
            self.cells.each_touched(&self.shapes, (from - away, from + away), |cell| {
                cell.walls().iter().filter(|&&item| met.is_new(item)).for_each(|&item| see(item));
            });
        }
    }

    /// Calls `see` for every wall within `range` of `from`, and perhaps for some that are farther or for the same wall
    /// twice, always in the same order.
    pub fn visit(&self, from: DVec2, range: f64, mut see: impl FnMut(Wall<'_>)) {
        if self.is_empty() || self.are_far(from, range) {
            return;
        }
        let away = (range - REACH).max(0.0);
        self.cells.each_touched(&self.shapes, (from - away, from + away), |cell| {
            for &item in cell.walls().iter().filter(|&&item| self.shapes.may_be_near(item, from, range)) {
                see(self.shapes.wall(item));
            }
        });
    }

    /// Whether the segment between two points stays farther than `gap` metres from all walls. With 0: whether it
    /// touches none.
    pub fn keep_off(&self, (a, b): (DVec2, DVec2), gap: f64) -> bool {
        let way = Core::segment(a, b);
        let mut clear = true;
        self.visit(way.center, way.half.x + gap, |wall| {
            clear &= match wall {
                Wall::Edge(edge) => way.separation(&Core::segment(edge.start, edge.end)).distance > gap,
                Wall::Disc(disc) => nearest_on_segment(a, b, disc.center).distance(disc.center) - disc.radius > gap,
            };
        });
        clear
    }

    /// Whether a cheap test shows that no wall is within `range` of `from`.
    pub fn are_far(&self, from: DVec2, range: f64) -> bool {
        range <= REACH && (self.is_empty() || self.cells.at(&self.shapes, from).clearance() > range)
    }

    /// Returns the distance from `p` to the nearest wall, at most `range`; infinite if there is none within it.
    pub fn distance(&self, p: DVec2, range: f64, scratch: &mut NearWalls) -> f64 {
        self.near(p, range, scratch);
        let first = |list: &[(f64, u32)]| list.first().map_or(f64::INFINITY, |near| near.0);
        first(&scratch.edges).min(first(&scratch.discs))
    }
}

/// Least width of the cells that solids are sorted into, metres.
const SOLID_CELL: f64 = 2.0;

impl Solids {
    fn new(all: Vec<Obstacle>) -> Self {
        let boxes: Vec<(DVec2, DVec2)> = all.iter().map(Obstacle::bounds).collect();
        let Some((low, high)) = around(boxes.iter().copied()) else { return Self::default() };
        let squares = Squares::at_most(4.0 * all.len() as f64, low, high, SOLID_CELL);
        let mut pairs = Vec::new();
        for (&(low, high), item) in boxes.iter().zip(0..) {
            pairs.extend(squares.touched(low, high).map(|cell| (cell as u32, item)));
        }
        Self { all, cells: Cells::new(squares, pairs) }
    }

    fn cover(&self, p: DVec2) -> bool {
        !self.all.is_empty() && self.cells.items_at(p).iter().any(|&item| self.all[item as usize].covers(p))
    }
}

/// The result of [`Walls::near`]: (distance in metres, index) of edges and of discs.
#[derive(Clone, Debug, Default)]
pub struct NearWalls {
    /// Edges.
    pub edges: Vec<(f64, u32)>,
    /// Discs; the distance is to the circumference, negative inside.
    pub discs: Vec<(f64, u32)>,
    met: VisitedWalls,
}

/// The walls that a search has visited. Adjacent cells list the same walls.
#[derive(Clone, Debug, Default)]
pub(crate) struct VisitedWalls {
    /// The last search that visited each wall.
    by: Vec<u32>,
    search: u32,
}

impl VisitedWalls {
    /// Begins a search among `walls` walls.
    fn begin(&mut self, walls: usize) {
        self.search = self.search.wrapping_add(1);
        if self.by.len() != walls || self.search == 0 {
            (self.by, self.search) = (vec![0; walls], 1);
        }
    }

    fn is_new(&mut self, wall: u32) -> bool {
        std::mem::replace(&mut self.by[wall as usize], self.search) != self.search
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point(reach: f64) -> impl Strategy<Value = DVec2> {
        (-reach..reach, -reach..reach).prop_map(DVec2::from)
    }

    /// Short and long walls, parallel to the axes and slanting, and pillars.
    fn obstacle() -> impl Strategy<Value = Obstacle> {
        let long = (point(30.0), point(30.0)).prop_map(|(a, b)| Obstacle::Wall { points: vec![a, b] });
        let short = (point(30.0), point(1.5)).prop_map(|(a, d)| Obstacle::Wall { points: vec![a, a + d] });
        let straight = (point(30.0), -20.0f64..20.0, any::<bool>()).prop_map(|(a, length, flat)| {
            let d = if flat { DVec2::new(length, 0.0) } else { DVec2::new(0.0, length) };
            Obstacle::Wall { points: vec![a, a + d] }
        });
        let pillar = (point(30.0), 0.1f64..4.0).prop_map(|(center, radius)| Obstacle::Circle { center, radius });
        let block = (point(30.0), point(20.0), -3.0f64..3.0)
            .prop_map(|(center, size, angle)| Obstacle::rectangle(center, size.abs() + 0.1, angle));
        prop_oneof![long, short, straight, pillar, block]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(300))]

        #[test]
        fn near_walls_are_those_of_a_search_through_all(
            obstacles in prop::collection::vec(obstacle(), 0..12),
            eyes in prop::collection::vec((point(40.0), prop_oneof![0.0f64..REACH, REACH..12.0]), 1..40),
            // obstacles near each other, or far apart, with empty blocks of cells between them
            far: bool,
        ) {
            let shift = |k: usize| if far { DVec2::new(k as f64, -((k % 3) as f64)) * 150.0 } else { DVec2::ZERO };
            let obstacles: Vec<Obstacle> =
                obstacles.into_iter().enumerate().map(|(k, obstacle)| obstacle.moved(shift(k))).collect();
            let eyes = eyes.into_iter().enumerate().map(|(k, (eye, range))| (eye + shift(k % 12), range));
            let walls = Walls::new(&[], &obstacles, DVec2::ZERO);
            let mut near = NearWalls::default();
            for (eye, range) in eyes {
                walls.near(eye, range, &mut near);
                let sorted = |distances: Vec<f64>| {
                    let mut all: Vec<(f64, u32)> = distances.into_iter().zip(0..).filter(|wall| wall.0 <= range).collect();
                    all.sort_by(|a, b| a.partial_cmp(b).unwrap());
                    all
                };
                let edges = walls.edges().iter().map(|edge| edge.nearest(eye).distance(eye)).collect();
                prop_assert_eq!(&near.edges, &sorted(edges));
                let discs = walls.discs().iter().map(|disc| disc.center.distance(eye) - disc.radius).collect();
                prop_assert_eq!(&near.discs, &sorted(discs));
                let is_clear = near.edges.is_empty() && near.discs.is_empty();
                prop_assert!(is_clear || !walls.are_far(eye, range));
                let has_inside = |obstacle: &&Obstacle| !matches!(obstacle, Obstacle::Wall { .. });
                let covered = obstacles.iter().filter(has_inside).any(|obstacle| obstacle.covers(eye));
                prop_assert_eq!(walls.cover(eye), covered);
            }
        }
    }
}
