//! The vertices at which shortest paths bend: convex corners of walls, which a taut string touches.

use super::lattice::turn;
use super::mesh::NavMesh;
use super::triangulate::{NONE, Triangles};
use glam::DVec2;

/// Directions count as parallel if the sine of the angle between them is less.
const FLAT: f64 = 1e-9;

/// How a shortest path can bend at a vertex.
#[derive(Clone, Copy, Debug)]
pub(super) enum VertexBend {
    /// Around the corner of a wall. Seen from the corner, the wall begins towards the vertex `right` and,
    /// counter-clockwise by more than a half turn, ends towards the vertex `left`.
    Round { right: u32, left: u32 },
    /// Where the boundary touches itself: in any direction.
    Pinched,
}

/// Returns the vertices where a shortest path can bend: those where the boundary turns right, and those where it
/// touches itself.
pub(super) fn bends(parts: &Triangles) -> Vec<Option<VertexBend>> {
    let count = parts.points.len();
    let (mut into, mut out_of, mut walls) = (vec![NONE; count], vec![NONE; count], vec![0_u32; count]);
    for (corners, neighbours) in parts.corners.iter().zip(&parts.neighbours) {
        for edge in (0..3).filter(|&edge| neighbours[edge] == NONE) {
            let (from, to) = (corners[edge], corners[(edge + 1) % 3]);
            out_of[from as usize] = to;
            into[to as usize] = from;
            walls[from as usize] += 1;
        }
    }
    let point = |vertex: u32| parts.points[vertex as usize];
    let bend = |at: usize| match (out_of[at], into[at], walls[at]) {
        (.., 0) => None,
        (right, left, 1) => {
            (turn(point(left), parts.points[at], point(right)) < 0).then_some(VertexBend::Round { right, left })
        }
        _ => Some(VertexBend::Pinched),
    };
    (0..count).map(bend).collect()
}

impl NavMesh {
    /// Whether a path that comes to a vertex in this direction can bend there: at a corner that sticks out, not in the
    /// face of a wall.
    pub(super) fn bends_along(&self, vertex: u32, along: DVec2) -> bool {
        match self.bends[vertex as usize] {
            None => false,
            Some(VertexBend::Pinched) => true,
            Some(VertexBend::Round { right, left }) => {
                let [right, left] = self.directions(vertex, [right, left]);
                !(is_left(along, left) && is_left(right, along))
            }
        }
    }

    /// Returns the directions of paths that bend at a vertex: pairs of limits, the right limit first, at most a half
    /// turn apart.
    pub(super) fn taut(&self, vertex: u32) -> [Option<[DVec2; 2]>; 2] {
        match self.bends[vertex as usize] {
            None => [None; 2],
            Some(VertexBend::Pinched) => [Some([DVec2::X, -DVec2::X]), Some([-DVec2::X, DVec2::X])],
            Some(VertexBend::Round { right, left }) => {
                let [right, left] = self.directions(vertex, [right, left]);
                [Some([right, -left]), Some([-right, left])]
            }
        }
    }

    /// Whether a path that comes to a vertex in direction `along` can continue in direction `on`: only by turning
    /// around the wall. Going straight on does not count.
    pub(super) fn bends_to(&self, vertex: u32, along: DVec2, on: DVec2) -> bool {
        match self.bends[vertex as usize] {
            None => false,
            Some(VertexBend::Pinched) => true,
            Some(VertexBend::Round { right, left }) => {
                let [right, left] = self.directions(vertex, [right, left]);
                is_left(left, along) && !is_left(along, on) || is_left(along, right) && !is_left(on, along)
            }
        }
    }

    fn directions(&self, vertex: u32, to: [u32; 2]) -> [DVec2; 2] {
        to.map(|to| self.vertices[to as usize] - self.vertices[vertex as usize])
    }
}

/// Whether a direction is clearly to the left of another.
fn is_left(a: DVec2, of: DVec2) -> bool {
    let side = of.perp_dot(a);
    // a vector is no longer than the sum of its components: mostly no root is needed
    let most = |v: DVec2| v.x.abs() + v.y.abs();
    side > 0.0 && (side > 10.0 * FLAT * most(of) * most(a) || side > FLAT * of.length() * a.length())
}
