//! The vertices from which an area is visible, the nearest first.
//!
//! A large mesh has many vertices, of which few are near an area and fewer see it. So the triangles around the area are
//! visited in the order of their distance, as far as needed, and their corners are looked at. A straight line from the area
//! crosses edges that are no farther from the area than its end: no vertex in sight is missed.

use super::area::SearchTarget;
use super::interval::segment_to_box;
use super::mesh::NavMesh;
use super::triangulate::NONE;
use glam::DVec2;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// The triangles around an area that have been visited.
#[derive(Clone, Debug, Default)]
pub(super) struct Outlook {
    low: DVec2,
    high: DVec2,
    /// Bits of a distance from the area, and a triangle that may be entered at that distance.
    open: BinaryHeap<Reverse<(u64, u32)>>,
    triangles: Marks,
    vertices: Marks,
}

/// Numbers that are marked, one bit each.
#[derive(Clone, Debug, Default)]
struct Marks(Vec<u64>);

impl Marks {
    fn none(count: usize) -> Self {
        Self(vec![0; count.div_ceil(64)])
    }

    /// Marks a number. Returns whether it was not marked before.
    fn mark(&mut self, number: u32) -> bool {
        let (word, bit) = (&mut self.0[number as usize / 64], 1 << (number % 64));
        let is_new = *word & bit == 0;
        *word |= bit;
        is_new
    }

    fn has(&self, number: u32) -> bool {
        self.0[number as usize / 64] >> (number % 64) & 1 == 1
    }
}

impl Outlook {
    /// Returns the outlook of a target, with nothing visited yet. Of a point it is empty: one sweep finds all vertices that
    /// see a point.
    pub fn of(mesh: &NavMesh, target: &SearchTarget<'_>) -> Self {
        let SearchTarget::Area(area) = target else { return Self::default() };
        let (low, high) = target.bounds();
        let open = area.triangles().map(|triangle| Reverse((0.0f64.to_bits(), triangle))).collect();
        let (triangles, vertices) = (Marks::none(mesh.triangles.len()), Marks::none(mesh.vertices.len()));
        Self { low, high, open, triangles, vertices }
    }

    /// Returns the bits of the distance beyond which vertices that see the area may be missing. Distances are never negative,
    /// so their bits are in the order of their values.
    pub fn reached(&self) -> Option<u64> {
        self.open.peek().map(|&Reverse((bits, _))| bits)
    }

    /// Visits the next triangle. Calls `found` for its corners that have not been looked at.
    pub fn go_on(&mut self, mesh: &NavMesh, mut found: impl FnMut(u32)) {
        let Some(Reverse((bits, triangle))) = self.open.pop() else { return };
        if !self.triangles.mark(triangle) {
            return;
        }
        let at = triangle as usize;
        for vertex in mesh.triangles[at] {
            if self.vertices.mark(vertex) {
                found(vertex);
            }
        }
        let corners = mesh.corners(triangle);
        for (edge, &next) in mesh.neighbours[at].iter().enumerate() {
            if next != NONE && !self.triangles.has(next) {
                let distance = segment_to_box(corners[edge], corners[(edge + 1) % 3], self.low, self.high);
                self.open.push(Reverse((distance.max(f64::from_bits(bits)).to_bits(), next)));
            }
        }
    }

    /// Returns the size of the memory, bytes.
    pub fn bytes(&self) -> usize {
        16 * self.open.len() + 8 * (self.triangles.0.len() + self.vertices.0.len())
    }
}
