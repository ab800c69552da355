//! Visibility along straight segments on the mesh.

use super::locate::{closest_convex, holds};
use super::mesh::NavMesh;
use super::triangulate::NONE;
use glam::DVec2;

/// Maximum distance by which a segment can leave the mesh and still count as on it, metres.
const SLACK: f64 = 1e-6;

/// Distance from a line, metres, above which a point is clearly off it.
const CLEARLY: f64 = 10.0 * SLACK;

/// An edge of a triangle with no triangle behind it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct BlockingEdge {
    triangle: u32,
    edge: u8,
}

/// The result of a visibility check.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum VisibleItem {
    /// The end of the segment is visible.
    Clear,
    /// A wall is in the way, if it is known which.
    Blocked(Option<BlockingEdge>),
}

/// Scratch memory of a cover of a segment.
#[derive(Clone, Debug, Default)]
pub(super) struct CoverScratch {
    /// Triangles that are still to be examined, and all that were found.
    open: Vec<u32>,
    seen: Vec<u32>,
    /// The parts of the segment that triangles cover.
    parts: Vec<(f64, f64)>,
}

impl NavMesh {
    /// Whether the straight segment from `a` to `b` stays on the mesh, within 1e-6 m. It can graze corners and run
    /// along walls.
    pub fn visible(&self, a: DVec2, b: DVec2) -> bool {
        self.visible_from(self.locate(a), a, b)
    }

    /// As [`visible`](Self::visible), with the triangle of `a` if it is known.
    pub(super) fn visible_from(&self, triangle: Option<u32>, a: DVec2, b: DVec2) -> bool {
        self.sight(triangle, a, b) == VisibleItem::Clear
    }

    /// As [`visible_from`](Self::visible_from), and returns the wall that is in the way.
    pub(super) fn sight(&self, triangle: Option<u32>, a: DVec2, b: DVec2) -> VisibleItem {
        triangle.and_then(|triangle| self.walk(triangle, a, b)).unwrap_or_else(|| {
            if self.visible_by_cover(a, b) { VisibleItem::Clear } else { VisibleItem::Blocked(None) }
        })
    }

    /// Returns how far the straight segment from `a` to `b` stays on the mesh, metres.
    pub(super) fn reach(&self, a: DVec2, b: DVec2, scratch: &mut CoverScratch) -> f64 {
        self.covered(a, b, scratch).unwrap_or(0.0).min(a.distance(b))
    }

    /// Whether a wall is clearly in the way from `a` to `b`: then [`sight`](Self::sight) returns a wall too. The wall
    /// may be from another mesh.
    pub(super) fn is_in_the_way(&self, BlockingEdge { triangle, edge }: BlockingEdge, a: DVec2, b: DVec2) -> bool {
        let Some(neighbours) = self.neighbours.get(triangle as usize) else { return false };
        let corners = self.corners(triangle);
        let (start, end) = (corners[edge as usize], corners[(edge as usize + 1) % 3]);
        let (across, along) = ((b - a).normalize_or_zero(), (end - start).normalize_or_zero());
        neighbours[edge as usize] == NONE
            && across.perp_dot(start - a) < -CLEARLY
            && across.perp_dot(end - a) > CLEARLY
            && along.perp_dot(a - start) > CLEARLY
            && along.perp_dot(b - start) < -CLEARLY
    }

    /// Walks along the segment from triangle to triangle; `None` if the segment passes so near to a vertex that the
    /// side of the vertex is uncertain.
    fn walk(&self, mut triangle: u32, a: DVec2, b: DVec2) -> Option<VisibleItem> {
        let along = (b - a).try_normalize()?;
        let side = |point: DVec2| along.perp_dot(point - a);
        let corners = self.corners(triangle);
        if holds(&corners, b) {
            return Some(VisibleItem::Clear);
        }
        let sides = corners.map(side);
        if sides.iter().any(|side| side.abs() < SLACK) {
            return None;
        }
        // the segment leaves through the edge that begins on its right and ends on its left
        let mut edge = (0..3).find(|&edge| sides[edge] < 0.0 && sides[(edge + 1) % 3] > 0.0)?;
        let (mut right, mut left) = (corners[edge], corners[(edge + 1) % 3]);
        // in each further triangle, the corner ahead is opposite the edge through which the segment entered
        for _ in 0..self.triangles.len() {
            let next = self.neighbours[triangle as usize][edge];
            if next == NONE {
                // just short of the end the wall can still be within the slack
                let short = closest_convex(&self.corners(triangle), b).distance_squared(b) <= SLACK * SLACK;
                let wall = BlockingEdge { triangle, edge: edge as u8 };
                return if short { None } else { Some(VisibleItem::Blocked(Some(wall))) };
            }
            let entered = self.edge_to(next, triangle);
            let corner = self.vertices[self.triangles[next as usize][(entered + 2) % 3] as usize];
            if (corner - right).perp_dot(b - right) >= 0.0 && (left - corner).perp_dot(b - corner) >= 0.0 {
                return Some(VisibleItem::Clear);
            }
            let side = side(corner);
            if side.abs() < SLACK {
                return None;
            }
            triangle = next;
            // in the next triangle, the edge of entry begins on the left
            if side > 0.0 {
                (edge, left) = ((entered + 1) % 3, corner);
            } else {
                (edge, right) = ((entered + 2) % 3, corner);
            }
        }
        None
    }

    /// Whether the triangles that the segment touches, from neighbour to neighbour, cover it.
    fn visible_by_cover(&self, a: DVec2, b: DVec2) -> bool {
        self.covered(a, b, &mut CoverScratch::default()).is_some_and(|covered| covered >= a.distance(b) - SLACK)
    }

    /// Returns the length of the segment, from its beginning, that those triangles cover, metres; none if it begins off
    /// the mesh.
    fn covered(&self, a: DVec2, b: DVec2, scratch: &mut CoverScratch) -> Option<f64> {
        let CoverScratch { open, seen, parts } = scratch;
        let length = a.distance(b);
        self.touching(a, SLACK, open);
        if open.is_empty() || length <= SLACK {
            return (!open.is_empty()).then_some(length);
        }
        let along = (b - a) / length;
        seen.clone_from(open);
        parts.clear();
        while let Some(triangle) = open.pop() {
            let Some(part) = self.overlap(triangle, a, along, length) else { continue };
            parts.push(part);
            for next in self.neighbours[triangle as usize] {
                if next != NONE && !seen.contains(&next) {
                    seen.push(next);
                    open.push(next);
                }
            }
        }
        parts.sort_unstable_by(|one, other| one.0.total_cmp(&other.0));
        let mut covered = 0.0_f64;
        for &(from, to) in &*parts {
            if from > covered + SLACK {
                break;
            }
            covered = covered.max(to);
        }
        Some(covered)
    }

    /// Returns the part of a segment that is in a triangle grown by the slack, as distances from `a`.
    fn overlap(&self, triangle: u32, a: DVec2, along: DVec2, length: f64) -> Option<(f64, f64)> {
        let corners = self.corners(triangle);
        let reach = corners.map(|corner| along.dot(corner - a));
        // the lines through the edges of a thin triangle meet far outside it: do not go beyond its corners
        let mut from = (reach[0].min(reach[1]).min(reach[2]) - SLACK).max(0.0);
        let mut to = (reach[0].max(reach[1]).max(reach[2]) + SLACK).min(length);
        for edge in 0..3 {
            let line = (corners[(edge + 1) % 3] - corners[edge]).normalize();
            let (inside, growth) = (line.perp_dot(a - corners[edge]) + SLACK, line.perp_dot(along));
            if growth > 0.0 {
                from = from.max(-inside / growth);
            } else if growth < 0.0 {
                to = to.min(-inside / growth);
            } else if inside < 0.0 {
                return None;
            }
        }
        (from <= to).then_some((from, to))
    }
}
