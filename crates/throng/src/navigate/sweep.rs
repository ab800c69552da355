//! Visibility from a point: a sweep over the visible triangles, from neighbour to neighbour.

use super::interval::{IntervalView, SNAP};
use super::mesh::{NavMesh, rotated};
use super::triangulate::NONE;
use glam::DVec2;

/// A view into a triangle.
#[derive(Clone, Copy, Debug)]
struct Beam {
    view: IntervalView,
    /// The triangle behind the interval, and its edge that contains the interval.
    triangle: u32,
    edge: usize,
}

/// The vertex of a triangle opposite to the interval through which the triangle is seen.
#[derive(Clone, Copy, Debug)]
pub(super) struct VertexAhead {
    pub vertex: u32,
    /// Its distance from the edges of the view, metres; negative beside the view.
    pub inside: f64,
    /// Whether it is visible. At the very edges of the view it is.
    is_visible: bool,
}

impl VertexAhead {
    /// Returns the vertex if it is visible.
    pub fn visible(&self) -> Option<u32> {
        self.is_visible.then_some(self.vertex)
    }
}

/// The views that a sweep has still to follow; the memory is reused.
#[derive(Clone, Debug, Default)]
pub(super) struct ViewSweep {
    beams: Vec<Beam>,
}

impl ViewSweep {
    /// Starts views in all directions from a point of the mesh that touches the triangles `around`.
    pub fn look_from(&mut self, mesh: &NavMesh, root: DVec2, around: &[u32]) {
        for &triangle in around {
            let corners = mesh.corners(triangle);
            for edge in 0..3 {
                if around.binary_search(&mesh.neighbours[triangle as usize][edge]).is_err() {
                    // looking out of the triangle, the beginning of its edge is on the right
                    let view = IntervalView { root, left: corners[(edge + 1) % 3], right: corners[edge] };
                    self.push(mesh, triangle, edge, view);
                }
            }
        }
    }

    /// Starts views from a vertex through the triangles around it. `narrow` returns the part of each view to follow.
    pub fn look_out(&mut self, mesh: &NavMesh, vertex: u32, narrow: impl Fn(IntervalView) -> Option<IntervalView>) {
        let root = mesh.vertices[vertex as usize];
        for &triangle in mesh.fans.round(vertex) {
            let corners = mesh.triangles[triangle as usize];
            let at = (0..2).find(|&at| corners[at] == vertex).unwrap_or(2);
            let [_, right, left] = rotated(mesh.corners(triangle), at);
            if let Some(view) = narrow(IntervalView { root, left, right }) {
                self.push(mesh, triangle, (at + 1) % 3, view);
            }
        }
    }

    /// Follows all views. `visit` gets each triangle with the view into it, and the vertex ahead; it returns whether to
    /// continue behind the triangle.
    pub fn follow(&mut self, mesh: &NavMesh, mut visit: impl FnMut(u32, &IntervalView, VertexAhead) -> bool) {
        while let Some(Beam { view, triangle, edge }) = self.beams.pop() {
            let ahead = view.ahead(rotated(mesh.corners(triangle), edge));
            let corner = VertexAhead {
                vertex: mesh.triangles[triangle as usize][(edge + 2) % 3],
                inside: ahead.sides.1.min(-ahead.sides.0),
                is_visible: ahead.sees_corner,
            };
            if visit(triangle, &view, corner) {
                for (edge, view) in [(edge + 2) % 3, (edge + 1) % 3].into_iter().zip(ahead.through) {
                    if let Some(view) = view {
                        self.push(mesh, triangle, edge, view);
                    }
                }
            }
        }
    }

    /// Adds the view out of a triangle through an edge.
    fn push(&mut self, mesh: &NavMesh, triangle: u32, edge: usize, view: IntervalView) {
        let next = mesh.neighbours[triangle as usize][edge];
        if next != NONE && view.left.distance_squared(view.right) >= SNAP * SNAP {
            self.beams.push(Beam { view, triangle: next, edge: mesh.edge_to(next, triangle) });
        }
    }
}
