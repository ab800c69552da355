//! What is in sight of a point: a sweep over the triangles that it sees, from neighbour to neighbour.

use super::interval::{SNAP, View};
use super::mesh::{NavMesh, rotated};
use super::triangulate::NONE;
use glam::DVec2;

/// A view into a triangle.
#[derive(Clone, Copy, Debug)]
struct Beam {
    view: View,
    /// The triangle behind the interval, and its edge that holds the interval.
    triangle: u32,
    edge: usize,
}

/// The views that are still to be followed: memory of sweeps.
#[derive(Clone, Debug, Default)]
pub(super) struct Sweep {
    beams: Vec<Beam>,
}

impl Sweep {
    /// Looks from a point of the mesh, which touches the triangles `around`, to all sides.
    pub fn look_from(&mut self, mesh: &NavMesh, root: DVec2, around: &[u32]) {
        for &triangle in around {
            let corners = mesh.corners(triangle);
            for edge in 0..3 {
                if around.binary_search(&mesh.neighbours[triangle as usize][edge]).is_err() {
                    // looking out of the triangle, the beginning of its edge is on the right
                    let view = View { root, left: corners[(edge + 1) % 3], right: corners[edge] };
                    self.push(mesh, triangle, edge, view);
                }
            }
        }
    }

    /// Looks from a vertex through the triangles round it, by what is left of each view.
    pub fn look_out(&mut self, mesh: &NavMesh, vertex: u32, narrow: impl Fn(View) -> Option<View>) {
        let root = mesh.vertices[vertex as usize];
        for &triangle in mesh.fans.round(vertex) {
            let corners = mesh.triangles[triangle as usize];
            let at = (0..2).find(|&at| corners[at] == vertex).unwrap_or(2);
            let [_, right, left] = rotated(mesh.corners(triangle), at);
            if let Some(view) = narrow(View { root, left, right }) {
                self.push(mesh, triangle, (at + 1) % 3, view);
            }
        }
    }

    /// Follows all views. `visit` is told each triangle with the view into it, and the vertex ahead if it is in sight;
    /// what lies behind the triangle is left out unless it says so.
    pub fn follow(&mut self, mesh: &NavMesh, mut visit: impl FnMut(u32, &View, Option<u32>) -> bool) {
        while let Some(Beam { view, triangle, edge }) = self.beams.pop() {
            let ahead = view.ahead(rotated(mesh.corners(triangle), edge));
            let corner = mesh.triangles[triangle as usize][(edge + 2) % 3];
            if visit(triangle, &view, ahead.sees_corner.then_some(corner)) {
                for (edge, view) in [(edge + 2) % 3, (edge + 1) % 3].into_iter().zip(ahead.through) {
                    if let Some(view) = view {
                        self.push(mesh, triangle, edge, view);
                    }
                }
            }
        }
    }

    /// Looks out of a triangle by an edge.
    fn push(&mut self, mesh: &NavMesh, triangle: u32, edge: usize, view: View) {
        let next = mesh.neighbours[triangle as usize][edge];
        if next != NONE && view.left.distance_squared(view.right) >= SNAP * SNAP {
            self.beams.push(Beam { view, triangle: next, edge: mesh.edge_to(next, triangle) });
        }
    }
}
