//! Search for the triangle that contains a point, and for the nearest point of the mesh.

use super::mesh::NavMesh;
use crate::space::{Cells, Squares, nearest_on_segment};
use glam::DVec2;

/// A point this near to a triangle counts as in it, metres.
pub(super) const TOUCH: f64 = 1e-7;

/// Twice the area, m2, above which a triangle is not a product of rounding.
const CLEARLY: f64 = 1e-9;

/// Sorts triangles into cells, about sixteen cells a triangle: plans have many small triangles close together.
pub(super) fn sorted(vertices: &[DVec2], triangles: &[[u32; 3]]) -> Cells {
    let reach = DVec2::splat(1e-6);
    let low = vertices.iter().copied().fold(DVec2::INFINITY, DVec2::min) - reach;
    let high = vertices.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max) + reach;
    let size = high - low;
    let wanted = 16.0 * triangles.len() as f64 + 1.0;
    // the second bound limits the number of cells of a long thin plan
    let squares = Squares::new(low, high, (size.x * size.y / wanted).sqrt().max(size.max_element() / wanted));
    let mut pairs = Vec::new();
    for (index, triangle) in triangles.iter().enumerate() {
        let corners = triangle.map(|vertex| vertices[vertex as usize]);
        let from = corners[0].min(corners[1]).min(corners[2]) - reach;
        let to = corners[0].max(corners[1]).max(corners[2]) + reach;
        let touched = squares.places(from, to).filter(|&place| touches(&squares, place, &corners));
        pairs.extend(touched.map(|(column, row)| ((row * squares.columns + column) as u32, index as u32)));
    }
    Cells::new(squares, pairs)
}

/// Whether a triangle touches a cell, by separating axes along the triangle's edges.
fn touches(squares: &Squares, place: (usize, usize), corners: &[DVec2; 3]) -> bool {
    let half = DVec2::splat(squares.width * 0.5 + 1e-6);
    let centre = squares.square(place).0 + DVec2::splat(squares.width * 0.5);
    (0..3).all(|edge| {
        let along = corners[(edge + 1) % 3] - corners[edge];
        along.perp_dot(centre - corners[edge]) + along.x.abs() * half.y + along.y.abs() * half.x >= 0.0
    })
}

impl NavMesh {
    /// Returns the triangles of the cell of a point. They include all triangles within 1e-6 m of the point.
    fn around(&self, at: DVec2) -> &[u32] {
        self.grid.items_at(at)
    }

    /// Finds the triangles in the cells that touch a box, in order, each once.
    pub(super) fn in_box(&self, from: DVec2, to: DVec2, out: &mut Vec<u32>) {
        out.clear();
        out.extend(self.grid.squares.touched(from, to).flat_map(|cell| self.grid.items(cell)));
        out.sort_unstable();
        out.dedup();
    }

    /// Returns a triangle that contains a point or is within 1e-7 m of it. On an edge it is any of the triangles that
    /// share the edge.
    pub fn locate(&self, point: DVec2) -> Option<u32> {
        self.holding(point).or_else(|| {
            let touches =
                |corners: &[DVec2; 3]| closest_convex(corners, point).distance_squared(point) <= TOUCH * TOUCH;
            self.around(point).iter().copied().find(|&triangle| touches(&self.corners(triangle)))
        })
    }

    /// Returns the first triangle that contains a point.
    fn holding(&self, point: DVec2) -> Option<u32> {
        self.around(point).iter().copied().find(|&triangle| holds(&self.corners(triangle), point))
    }

    /// Returns the point of the mesh that is nearest to `point`, and its triangle.
    pub(super) fn stand(&self, point: DVec2) -> (DVec2, Option<u32>) {
        match self.holding(point) {
            None => {
                let nearest = self.nearest(point);
                (nearest, self.locate(nearest))
            }
            triangle => (point, triangle),
        }
    }

    /// As [`stand`](Self::stand), with a guess of the triangle, which may be from another mesh.
    pub(super) fn stand_near(&self, triangle: Option<u32>, point: DVec2) -> (DVec2, Option<u32>) {
        // clearly in that triangle and in no other
        let holds = |&triangle: &u32| {
            (triangle as usize) < self.triangles.len()
                && sides(&self.corners(triangle), point).all(|side| side > CLEARLY)
        };
        triangle.filter(holds).map_or_else(|| self.stand(point), |triangle| (point, Some(triangle)))
    }

    /// Finds all triangles within `reach` (at most 1e-6 m) of a point, in order.
    pub(super) fn touching(&self, point: DVec2, reach: f64, out: &mut Vec<u32>) {
        out.clear();
        out.extend(self.around(point).iter().copied().filter(|&triangle| {
            closest_convex(&self.corners(triangle), point).distance_squared(point) <= reach * reach
        }));
    }

    /// Returns the point of the mesh that is nearest to `point`: the point itself where it is on the mesh.
    pub fn nearest(&self, point: DVec2) -> DVec2 {
        if self.holding(point).is_some() {
            return point;
        }
        let (grid, squares) = (&self.grid, &self.grid.squares);
        let (column, row) = squares.place(point);
        let (mut best, mut nearest) = (f64::INFINITY, point);
        for ring in 0..squares.columns.max(squares.rows) {
            // cells of this ring are at least this far away, also for points outside the grid, because the grid is
            // convex
            let least = squares.width * (ring.max(1) - 1) as f64;
            if best < least * least {
                break;
            }
            let (left, right) = (column as isize - ring as isize, column + ring);
            let (bottom, top) = (row as isize - ring as isize, row + ring);
            for y in bottom.max(0) as usize..=top.min(squares.rows - 1) {
                let whole = y as isize == bottom || y == top;
                let step = if whole || ring == 0 { 1 } else { (2 * ring) as isize };
                let mut x = left;
                while x <= right as isize {
                    if x >= 0 && (x as usize) < squares.columns {
                        for &triangle in grid.items(y * squares.columns + x as usize) {
                            let candidate = closest_convex(&self.corners(triangle), point);
                            let distance = candidate.distance_squared(point);
                            if distance < best {
                                (best, nearest) = (distance, candidate);
                            }
                        }
                    }
                    x += step;
                }
            }
        }
        nearest
    }
}

/// Whether a triangle contains a point, its edges included.
pub(super) fn holds(corners: &[DVec2; 3], point: DVec2) -> bool {
    sides(corners, point).all(|side| side >= 0.0)
}

/// Returns the signed distance of a point from each edge of a triangle, positive to the left, times the length of the
/// edge.
fn sides(&[a, b, c]: &[DVec2; 3], point: DVec2) -> impl Iterator<Item = f64> {
    [(a, b), (b, c), (c, a)].into_iter().map(move |(a, b)| (b - a).perp_dot(point - a))
}

/// Returns the point of a convex counter-clockwise polygon that is nearest to `point`.
pub(super) fn closest_convex(corners: &[DVec2], point: DVec2) -> DVec2 {
    let mut inside = true;
    let (mut best, mut nearest) = (f64::INFINITY, point);
    for (at, &a) in corners.iter().enumerate() {
        let b = corners[(at + 1) % corners.len()];
        if (b - a).perp_dot(point - a) > 0.0 {
            continue;
        }
        inside = false;
        let candidate = nearest_on_segment(a, b, point);
        let distance = candidate.distance_squared(point);
        if distance < best {
            (best, nearest) = (distance, candidate);
        }
    }
    if inside { point } else { nearest }
}
