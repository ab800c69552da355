//! The targets of path searches: a point, or the part of an area that is on the mesh.

use super::error::{NavError, Unreachable};
use super::interval::{IntervalCrossing, IntervalView, clip};
use super::locate::closest_convex;
use super::mesh::NavMesh;
use super::outline::{Shapes, area_shapes, erode, grow};
use super::triangulate::{NONE, triangulate};
use crate::space::nearest_on_segment;
use glam::DVec2;
use std::ops::Range;

/// Distance inside the area at which paths end, metres, so that an agent that arrives is certainly inside.
const INSET: f64 = 0.05;

/// Pieces of an area smaller than this, square metres, are dropped.
const CRUMB: f64 = 1e-12;

/// A goal area, cut by the triangles of one mesh.
#[derive(Clone, Debug, Default)]
pub struct Area {
    corner: DVec2,
    low: DVec2,
    high: DVec2,
    /// Sorted by triangle.
    pieces: Vec<AreaPiece>,
    points: Vec<DVec2>,
    islands: Vec<u32>,
    /// Positions of the triangles in the order of the bridges, sorted.
    places: Vec<u32>,
    gap: f64,
}

#[derive(Clone, Copy, Debug)]
struct AreaPiece {
    triangle: u32,
    from: u32,
    to: u32,
}

impl NavMesh {
    /// Cuts a goal area, a polygon of any form, by the triangles of the mesh. Where possible, the area is shrunk by 5
    /// cm. An area that is off the mesh, but within a radius and 1 cm of it, counts as the nearest part of the mesh
    /// (within 5 mm); see [`Area::gap`]. The result is valid for this mesh only.
    ///
    /// # Errors
    /// Corners that are too few, or edges that cross. An area out of reach is not an error: see [`Area::is_empty`].
    pub fn area(&self, corners: &[DVec2]) -> Result<Area, NavError> {
        let shapes = area_shapes(&self.lattice, corners)?;
        let mut area = Area { corner: corners[0], ..Area::default() };
        let whole = self.cut(&shapes)?;
        let inner = self.cut(&erode(&shapes, INSET))?;
        let island = |piece: &(u32, Vec<DVec2>)| self.islands[piece.0 as usize];
        let has_inner: Vec<u32> = inner.iter().map(island).collect();
        area.take(whole.into_iter().filter(|piece| !has_inner.contains(&island(piece))).chain(inner), self);
        if area.is_empty() {
            let gap = self.gap_to(&shapes);
            if gap <= self.radius + 0.01 {
                area.gap = gap;
                area.take(self.cut(&grow(&shapes, gap + 0.005))?.into_iter(), self);
            }
        }
        Ok(area)
    }

    /// Returns the convex pieces of `shapes` on the mesh, each in one triangle.
    fn cut(&self, shapes: &Shapes) -> Result<Vec<(u32, Vec<DVec2>)>, NavError> {
        let parts = triangulate(shapes)?;
        let (mut near, mut first, mut second) = (Vec::new(), Vec::new(), Vec::new());
        let mut pieces = Vec::new();
        for corners in &parts.corners {
            let [a, b, c] = corners.map(|vertex| self.lattice.metres(parts.points[vertex as usize]));
            self.in_box(a.min(b).min(c), a.max(b).max(c), &mut near);
            for &triangle in &near {
                let [u, v, w] = self.corners(triangle);
                clip(&[a, b, c], u, v, &mut first);
                clip(&first, v, w, &mut second);
                clip(&second, w, u, &mut first);
                let size: f64 = (2..first.len()).map(|k| (first[k - 1] - first[0]).perp_dot(first[k] - first[0])).sum();
                if size > CRUMB {
                    pieces.push((triangle, first.clone()));
                }
            }
        }
        pieces.sort_by_key(|piece| piece.0);
        Ok(pieces)
    }

    /// Returns the distance between shapes and the mesh, as far as it is within reach.
    fn gap_to(&self, shapes: &Shapes) -> f64 {
        let reach = DVec2::splat(self.radius + 0.01);
        let mut near = Vec::new();
        let mut gap = f64::INFINITY;
        for contour in shapes.iter().flatten() {
            for (at, &point) in contour.iter().enumerate() {
                let (a, b) = (self.lattice.metres(point), self.lattice.metres(contour[(at + 1) % contour.len()]));
                self.in_box(a.min(b) - reach, a.max(b) + reach, &mut near);
                for &triangle in &near {
                    let corners = self.corners(triangle);
                    for end in [a, b] {
                        gap = gap.min(closest_convex(&corners, end).distance(end));
                    }
                    for corner in corners {
                        gap = gap.min(nearest_on_segment(a, b, corner).distance(corner));
                    }
                }
            }
        }
        gap
    }
}

impl Area {
    /// Whether no point of the area is on the mesh: the area is inside a wall.
    pub fn is_empty(&self) -> bool {
        self.pieces.is_empty()
    }

    /// Returns the distance between the area and the mesh, metres; zero where they overlap. Paths to an area with a gap
    /// end at this distance from it, within 5 mm.
    pub fn gap(&self) -> f64 {
        self.gap
    }

    /// Returns the islands that the area has parts on, in order.
    pub fn islands(&self) -> &[u32] {
        &self.islands
    }

    /// Returns the point of the area that is nearest in a straight line, regardless of walls; `None` if the area is
    /// empty.
    pub fn nearest(&self, point: DVec2) -> Option<DVec2> {
        let mut best: Option<DVec2> = None;
        for piece in &self.pieces {
            let candidate = closest_convex(self.polygon(*piece), point);
            if best.is_none_or(|best| candidate.distance_squared(point) < best.distance_squared(point)) {
                best = Some(candidate);
            }
        }
        best
    }

    /// Returns the triangles that the area has parts in, in order.
    pub(super) fn triangles(&self) -> impl Iterator<Item = u32> + '_ {
        self.pieces.iter().map(|piece| piece.triangle)
    }

    pub(super) fn corner(&self) -> DVec2 {
        self.corner
    }

    fn take(&mut self, pieces: impl Iterator<Item = (u32, Vec<DVec2>)>, mesh: &NavMesh) {
        let mut pieces: Vec<_> = pieces.collect();
        pieces.sort_by_key(|piece| piece.0);
        (self.low, self.high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for (triangle, polygon) in pieces {
            let from = self.points.len() as u32;
            for &point in &polygon {
                (self.low, self.high) = (self.low.min(point), self.high.max(point));
            }
            self.points.extend(polygon);
            self.pieces.push(AreaPiece { triangle, from, to: self.points.len() as u32 });
            self.places.push(mesh.bridges.place(triangle));
            self.islands.push(mesh.islands[triangle as usize]);
        }
        self.places.sort_unstable();
        self.islands.sort_unstable();
        self.islands.dedup();
    }

    fn in_triangle(&self, triangle: u32) -> Range<usize> {
        let from = self.pieces.partition_point(|piece| piece.triangle < triangle);
        let more = self.pieces[from..].iter().take_while(|piece| piece.triangle == triangle).count();
        from..from + more
    }

    fn polygon(&self, piece: AreaPiece) -> &[DVec2] {
        &self.points[piece.from as usize..piece.to as usize]
    }
}

/// The target of a search.
pub(super) enum SearchTarget<'a> {
    /// A point of the mesh, and the triangles it is in.
    Point {
        /// Position of the point.
        at: DVec2,
        /// The triangles, sorted.
        triangles: &'a [u32],
        /// Their positions in the order of the bridges, sorted.
        places: &'a [u32],
    },
    /// The nearest point of an area.
    Area(&'a Area),
}

impl SearchTarget<'_> {
    /// Returns the positions of the target's triangles in the order of the bridges, sorted.
    pub fn places(&self) -> &[u32] {
        match self {
            Self::Point { places, .. } => places,
            Self::Area(area) => &area.places,
        }
    }

    /// Whether a search that reaches this triangle does not need to continue behind it.
    pub fn ends_in(&self, triangle: u32) -> bool {
        matches!(self, Self::Point { triangles, .. } if triangles.contains(&triangle))
    }

    /// Checks that the target is on the island of one of these triangles.
    pub fn check_island(&self, mesh: &NavMesh, triangles: &[u32]) -> Result<(), Unreachable> {
        let home = triangles.iter().map(|&triangle| mesh.islands[triangle as usize]);
        if home.clone().any(|island| self.on_island(mesh, island)) {
            return Ok(());
        }
        Err(Unreachable::NoWay { from: home.min().unwrap_or(NONE), to: self.first_island(mesh) })
    }

    pub fn on_island(&self, mesh: &NavMesh, island: u32) -> bool {
        match self {
            Self::Point { triangles, .. } => triangles.iter().any(|&t| mesh.islands[t as usize] == island),
            Self::Area(area) => area.islands.contains(&island),
        }
    }

    pub fn first_island(&self, mesh: &NavMesh) -> u32 {
        match self {
            Self::Point { triangles, .. } => triangles.first().map_or(0, |&triangle| mesh.islands[triangle as usize]),
            Self::Area(area) => area.islands.first().copied().unwrap_or(0),
        }
    }

    /// Returns a lower bound of the lengths of paths through an interval to the target.
    pub fn bound(&self, view: &IntervalView) -> f64 {
        match self {
            Self::Point { at, .. } => view.bound(*at),
            Self::Area(area) => view.bound_to_box(area.low, area.high),
        }
    }

    /// Returns the bounding box of the target.
    pub fn bounds(&self) -> (DVec2, DVec2) {
        match self {
            Self::Point { at, .. } => (*at, *at),
            Self::Area(area) => (area.low, area.high),
        }
    }

    /// Returns the shortest way from a point of a triangle to the part of the target in the triangle.
    pub fn straight(&self, triangle: u32, from: DVec2) -> Option<IntervalCrossing> {
        let way = |end: DVec2| IntervalCrossing { length: end.distance(from), via: None, end };
        match self {
            Self::Point { at, triangles, .. } => triangles.contains(&triangle).then(|| way(*at)),
            Self::Area(area) => area.pieces[area.in_triangle(triangle)]
                .iter()
                .map(|&piece| way(closest_convex(area.polygon(piece), from)))
                .min_by(|one, other| one.length.total_cmp(&other.length)),
        }
    }

    /// Returns the shortest straight way through an interval to the part of the target in the triangle behind it.
    pub fn straight_through(
        &self,
        triangle: u32,
        view: &IntervalView,
        scratch: &mut [Vec<DVec2>; 2],
    ) -> Option<IntervalCrossing> {
        match self {
            Self::Point { at, triangles, .. } => triangles.contains(&triangle).then(|| view.straight(*at)).flatten(),
            Self::Area(area) => area.pieces[area.in_triangle(triangle)]
                .iter()
                .filter_map(|&piece| view.straight_to(area.polygon(piece), scratch))
                .min_by(|one, other| one.length.total_cmp(&other.length)),
        }
    }

    /// Returns the shortest way through an interval to the part of the target in the triangle behind it.
    pub fn way(&self, triangle: u32, view: &IntervalView, scratch: &mut [Vec<DVec2>; 2]) -> Option<IntervalCrossing> {
        match self {
            Self::Point { at, triangles, .. } => triangles.contains(&triangle).then(|| view.way(*at)),
            Self::Area(area) => area.pieces[area.in_triangle(triangle)]
                .iter()
                .filter_map(|&piece| view.way_to(area.polygon(piece), scratch))
                .min_by(|one, other| one.length.total_cmp(&other.length)),
        }
    }
}
