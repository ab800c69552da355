//! The walls: every solid edge and disc of the place, in local coordinates, ready for queries.
//!
//! Edges are directed: what is solid lies on the left, free ground on the right. A thin wall is two opposite edges.

use super::{Cells, Obstacle, Walkable};
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
    /// Whether what is solid bulges out at the start.
    pub convex_start: bool,
    /// Whether what is solid bulges out at the end.
    pub convex_end: bool,
    /// Direction of the edge that ends where this one starts.
    pub previous: Vec2,
    /// Direction of the edge that starts where this one ends.
    pub next: Vec2,
}

impl Edge {
    /// The point of the edge nearest to `p`.
    pub fn nearest(&self, p: DVec2) -> DVec2 {
        nearest_on_segment(self.start, self.end, p)
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

/// The point of the segment from `a` to `b` nearest to `p`.
pub fn nearest_on_segment(a: DVec2, b: DVec2, p: DVec2) -> DVec2 {
    let along = b - a;
    let t = (p - a).dot(along) / along.length_squared();
    // a segment without length has t NaN: its start is as near as any
    if t > 0.0 { a + along * t.min(1.0) } else { a }
}

/// All walls of a place.
#[derive(Clone, Debug, Default)]
pub struct Walls {
    edges: Vec<Edge>,
    discs: Vec<Disc>,
    /// Edges, then discs (numbered on).
    cells: Cells,
}

/// Width of the cells that walls are sorted into, metres.
const CELL: f64 = 2.0;
/// Cells at most; beyond that they are wider.
const MOST_CELLS: f64 = 4e6;

impl Walls {
    /// Collects the walls of areas and obstacles, given in world coordinates, round a local origin. The areas must
    /// not overlap.
    pub fn new<'a>(areas: &[Walkable], obstacles: impl IntoIterator<Item = &'a Obstacle>, origin: DVec2) -> Self {
        let mut walls = Self::default();
        for area in areas {
            walls.add_ring(&area.outer, false, origin);
            for hole in &area.holes {
                walls.add_ring(hole, true, origin);
            }
        }
        for obstacle in obstacles {
            match obstacle {
                Obstacle::Circle { center, radius } => {
                    walls.discs.push(Disc { center: *center - origin, radius: *radius });
                }
                Obstacle::Polygon { corners } => walls.add_ring(corners, true, origin),
                Obstacle::Wall { points } => {
                    let back = points.iter().rev().skip(1).take(points.len().saturating_sub(2));
                    let round: Vec<DVec2> = points.iter().chain(back).map(|&p| p - origin).collect();
                    walls.add_loop(&round);
                }
            }
        }
        walls.sort();
        walls
    }

    /// The edges.
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// The discs.
    pub fn discs(&self) -> &[Disc] {
        &self.discs
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.edges.is_empty() && self.discs.is_empty()
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
        // a turn to the left or none at all bulges out; so does turning back at the end of a thin wall
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

    fn bounds(&self, item: usize) -> (DVec2, DVec2) {
        match self.edges.get(item) {
            Some(edge) => (edge.start.min(edge.end), edge.start.max(edge.end)),
            None => {
                let disc = self.discs[item - self.edges.len()];
                (disc.center - disc.radius, disc.center + disc.radius)
            }
        }
    }

    fn sort(&mut self) {
        let count = self.edges.len() + self.discs.len();
        if count == 0 {
            return;
        }
        let all = (0..count).map(|i| self.bounds(i));
        let (low, high) = all.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1))).unwrap_or((DVec2::ZERO, DVec2::ZERO));
        let size = high - low;
        let mut cell = CELL;
        while (size.x / cell + 1.0) * (size.y / cell + 1.0) > MOST_CELLS {
            cell *= 2.0;
        }
        let mut cells = Cells::new(low, high, cell);
        let touched = |item: usize| {
            let (low, high) = self.bounds(item);
            cells.touched(low, high).map(move |cell| (cell as u32, item as u32))
        };
        let pairs = (0..count).flat_map(touched).collect();
        cells.fill(pairs);
        self.cells = cells;
    }

    /// Finds the walls within `range` of `from`: nearest first, ties by index. `near` is emptied first.
    pub fn near(&self, from: DVec2, range: f64, near: &mut NearWalls) {
        near.edges.clear();
        near.discs.clear();
        if self.is_empty() {
            return;
        }
        for cell in self.cells.touched(from - range, from + range) {
            for &item in self.cells.items(cell) {
                let item = item as usize;
                if let Some(edge) = self.edges.get(item) {
                    let d = edge.nearest(from).distance(from);
                    if d <= range {
                        near.edges.push((d, item as u32));
                    }
                } else {
                    let index = item - self.edges.len();
                    let d = self.discs[index].center.distance(from) - self.discs[index].radius;
                    if d <= range {
                        near.discs.push((d, index as u32));
                    }
                }
            }
        }
        for list in [&mut near.edges, &mut near.discs] {
            list.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            list.dedup();
        }
    }

    /// Distance from `p` to the nearest wall, at most `range`; infinite if there is none within it.
    pub fn distance(&self, p: DVec2, range: f64, scratch: &mut NearWalls) -> f64 {
        self.near(p, range, scratch);
        let first = |list: &[(f64, u32)]| list.first().map_or(f64::INFINITY, |near| near.0);
        first(&scratch.edges).min(first(&scratch.discs))
    }
}

/// What [`Walls::near`] found: (distance in metres, index) of edges and of discs.
#[derive(Clone, Debug, Default)]
pub struct NearWalls {
    /// Edges.
    pub edges: Vec<(f64, u32)>,
    /// Discs; the distance is to their rim, negative inside.
    pub discs: Vec<(f64, u32)>,
}
