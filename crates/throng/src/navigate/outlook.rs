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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::navigate::tree::{TreeScratch, straight};
    use crate::random::SplitMix64;
    use crate::space::{Obstacle, Walkable};
    use std::collections::BTreeSet;

    fn rectangle(low: DVec2, size: DVec2) -> Vec<DVec2> {
        [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| low + size * DVec2::new(x, y)).to_vec()
    }

    #[test]
    fn no_vertex_in_sight_is_missed() {
        let mut seen = 0;
        for seed in 0..30 {
            let mut dice = SplitMix64(seed);
            let mut draw = |low: f64, high: f64| dice.between(low, high);
            let mut blocks = Vec::new();
            for cell in 0..36 {
                let corner = DVec2::new(f64::from(cell % 6), f64::from(cell / 6)) * 10.0;
                let (at, size) =
                    (DVec2::new(draw(1.0, 4.0), draw(1.0, 4.0)), DVec2::new(draw(1.0, 5.0), draw(1.0, 5.0)));
                blocks.push(Obstacle::Polygon { corners: rectangle(corner + at, size) });
            }
            let ground = Walkable { outer: rectangle(DVec2::ZERO, DVec2::splat(60.0)), holes: vec![] };
            let mesh = NavMesh::build(&[ground], &blocks, 0.2, (DVec2::ZERO, DVec2::ZERO)).unwrap();
            let (at, size) = (DVec2::new(draw(2.0, 50.0), draw(2.0, 50.0)), DVec2::new(draw(0.5, 8.0), draw(0.5, 8.0)));
            let area = mesh.area(&rectangle(at, size)).unwrap();
            let (target, mut scratch) = (SearchTarget::Area(&area), TreeScratch::default());
            let mut length = |vertex| Some((vertex, straight(&mesh, &target, vertex, &mut scratch)?.length));
            let in_sight: Vec<(u32, f64)> = (0..mesh.vertices.len() as u32).filter_map(&mut length).collect();
            seen += in_sight.len();
            let (mut outlook, mut found) = (Outlook::of(&mesh, &target), BTreeSet::new());
            while let Some(reached) = outlook.reached().map(f64::from_bits) {
                let missed = in_sight.iter().find(|(vertex, length)| *length < reached && !found.contains(vertex));
                assert_eq!(missed, None, "seed {seed}, at {reached} m");
                outlook.go_on(&mesh, |vertex| assert!(found.insert(vertex), "each vertex is found once"));
            }
            assert!(area.is_empty() || in_sight.iter().all(|(vertex, _)| found.contains(vertex)), "seed {seed}");
        }
        assert!(seen > 500, "{seen}");
    }
}
