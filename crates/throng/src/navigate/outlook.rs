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
use std::collections::{BTreeSet, BinaryHeap};

/// The triangles around an area that have been visited.
#[derive(Clone, Debug, Default)]
pub(super) struct Outlook {
    low: DVec2,
    high: DVec2,
    /// Bits of a distance from the area, and a triangle that may be entered at that distance.
    open: BinaryHeap<Reverse<(u64, u32)>>,
    triangles: BTreeSet<u32>,
    vertices: BTreeSet<u32>,
}

impl Outlook {
    /// Returns the outlook of a target, with nothing visited yet. Of a point it is empty: one sweep finds all vertices that
    /// see a point.
    pub fn of(target: &SearchTarget<'_>) -> Self {
        let SearchTarget::Area(area) = target else { return Self::default() };
        let (low, high) = target.bounds();
        let open = area.triangles().map(|triangle| Reverse((0.0f64.to_bits(), triangle))).collect();
        Self { low, high, open, ..Self::default() }
    }

    /// Returns the bits of the distance beyond which vertices that see the area may be missing. Distances are never negative,
    /// so their bits are in the order of their values.
    pub fn reached(&self) -> Option<u64> {
        self.open.peek().map(|&Reverse((bits, _))| bits)
    }

    /// Visits the next triangle. Calls `found` for its corners that have not been looked at.
    pub fn go_on(&mut self, mesh: &NavMesh, mut found: impl FnMut(u32)) {
        let Some(Reverse((bits, triangle))) = self.open.pop() else { return };
        if !self.triangles.insert(triangle) {
            return;
        }
        let at = triangle as usize;
        for vertex in mesh.triangles[at] {
            if self.vertices.insert(vertex) {
                found(vertex);
            }
        }
        let corners = mesh.corners(triangle);
        for (edge, &next) in mesh.neighbours[at].iter().enumerate() {
            if next != NONE && !self.triangles.contains(&next) {
                let distance = segment_to_box(corners[edge], corners[(edge + 1) % 3], self.low, self.high);
                self.open.push(Reverse((distance.max(f64::from_bits(bits)).to_bits(), next)));
            }
        }
    }

    /// Returns the approximate size of the memory, bytes.
    pub fn bytes(&self) -> usize {
        16 * self.open.len() + 8 * (self.triangles.len() + self.vertices.len())
    }
}
