//! The shortest paths from everywhere to one target: a tree over the corners of walls, for all who go there.
//!
//! A shortest path is straight but where it bends round corners. So the shortest path from a corner is known from those
//! of the corners that its tangents lead to, and Dijkstra's algorithm finds them all, the nearest first (Rohnert: Shortest
//! paths in the plane with convex polygonal obstacles, Inf. Process. Lett. 23, 1986). A path from anywhere else leads by
//! one of the corners in its own sight.
//!
//! The tree grows as far as it is asked for. What it tells does not depend on what it was asked before: lengths are
//! sums from the target on, the same in any order, and of equal ones the vertex with the lower number is taken; from a point
//! all ways on are compared.

use super::area::Target;
use super::error::Unreachable;
use super::interval::{GRAZE, Way};
use super::locate::TOUCH;
use super::mesh::NavMesh;
use super::path::Path;
use super::sweep::Sweep;
use super::triangulate::NONE;
use glam::DVec2;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// The shortest paths to one target on one mesh.
#[derive(Clone, Debug)]
pub(super) struct Tree {
    /// Of each vertex: the length of the shortest path from it that is known.
    lengths: Vec<f64>,
    /// The vertex that the path goes on to; [`NONE`] for the target.
    next: Vec<u32>,
    /// Bits of lengths, and vertices, whose paths may still become shorter. Lengths are never negative: their bits are
    /// in order.
    open: BinaryHeap<Reverse<(u64, u32)>>,
}

/// Memory of questions.
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch {
    sweep: Sweep,
    around: Vec<u32>,
    seen: Vec<(u32, f64)>,
    polygons: [Vec<DVec2>; 2],
}

/// The shortest way to go on from a point.
#[derive(Clone, Copy, Debug, PartialEq)]
enum On {
    /// To a vertex.
    By(u32),
    /// Straight to this point of the target.
    Straight(DVec2),
}

/// The shortest path from somewhere to the target, by a tree that is planted when it is first needed.
pub(super) fn path(
    tree: &mut Option<Tree>,
    mesh: &NavMesh,
    target: &Result<Target<'_>, Unreachable>,
    from: DVec2,
    scratch: &mut Scratch,
) -> Result<Path, Unreachable> {
    let start = mesh.start_point(from)?;
    let target = target.as_ref().map_err(|&why| why)?;
    tree.get_or_insert_with(|| Tree::new(mesh, target, scratch)).path(mesh, target, start, scratch)
}

impl Tree {
    /// A tree that has only begun to grow: those who see the target are known.
    fn new(mesh: &NavMesh, target: &Target<'_>, scratch: &mut Scratch) -> Self {
        let count = mesh.vertices.len();
        let mut tree = Self { lengths: vec![f64::INFINITY; count], next: vec![NONE; count], open: BinaryHeap::new() };
        for vertex in 0..count as u32 {
            if let Some(way) = straight(mesh, target, vertex, scratch) {
                tree.offer(vertex, way.length, NONE);
            }
        }
        tree
    }

    /// Vertices that it has room for.
    pub fn size(&self) -> usize {
        self.lengths.len()
    }

    /// The shortest path from a point of the mesh.
    fn path(
        &mut self,
        mesh: &NavMesh,
        target: &Target<'_>,
        start: DVec2,
        scratch: &mut Scratch,
    ) -> Result<Path, Unreachable> {
        let mut around = std::mem::take(&mut scratch.around);
        mesh.touching(start, TOUCH, &mut around);
        let reached = target.check_island(mesh, &around);
        let found = reached.map(|()| self.go_on(mesh, target, (start, &around), scratch));
        scratch.around = around;
        let Some((length, on)) = found? else {
            // on one island there is a way; only rounding at a needle-thin triangle could hide it
            return Err(Unreachable::NoWay { from: target.first_island(mesh), to: target.first_island(mesh) });
        };
        let mut points = Vec::new();
        let mut on = on;
        while let On::By(vertex) = on {
            points.push(mesh.vertices[vertex as usize]);
            on = match self.next[vertex as usize] {
                NONE => straight(mesh, target, vertex, scratch)
                    .map_or(On::Straight(mesh.vertices[vertex as usize]), |way| On::Straight(way.end)),
                next => On::By(next),
            };
        }
        if let On::Straight(end) = on {
            points.push(end);
        }
        Ok(Path::through(start, points, length))
    }

    /// How to go on from a point, and how long that is. Of ways as long as each other the one is taken that goes straight
    /// for the longest, of those the left one.
    fn go_on(
        &mut self,
        mesh: &NavMesh,
        target: &Target<'_>,
        (start, around): (DVec2, &[u32]),
        scratch: &mut Scratch,
    ) -> Option<(f64, On)> {
        let Scratch { sweep, seen, polygons, .. } = scratch;
        let offset = |vertex: u32| mesh.vertices[vertex as usize] - start;
        let mut straight: Option<Way> = None;
        let mut shortest = f64::INFINITY;
        let mut offer = |shortest: &mut f64, way: Option<Way>| {
            straight = shorter(straight, way);
            *shortest = straight.map_or(*shortest, |way| shortest.min(way.length));
        };
        seen.clear();
        let mut see = |shortest: &mut f64, vertex: u32| {
            let offset = offset(vertex);
            if mesh.bends_along(vertex, offset) {
                seen.push((vertex, offset.length()));
                if self.is_done(vertex) {
                    *shortest = shortest.min(offset.length() + self.lengths[vertex as usize]);
                }
            }
        };
        for &triangle in around {
            offer(&mut shortest, target.straight(triangle, start));
            mesh.triangles[triangle as usize].into_iter().for_each(|corner| see(&mut shortest, corner));
        }
        sweep.look_from(mesh, start, around);
        sweep.follow(mesh, |triangle, view, corner| {
            offer(&mut shortest, target.straight_through(triangle, view, polygons));
            corner.into_iter().for_each(|corner| see(&mut shortest, corner));
            target.bound(view) <= shortest + GRAZE
        });
        seen.sort_unstable_by_key(|&(vertex, _)| vertex);
        seen.dedup_by_key(|&mut (vertex, _)| vertex);

        let open = seen.iter().filter(|&&(vertex, _)| !self.is_done(vertex));
        let nearest = open.fold(f64::INFINITY, |least, &(_, distance)| least.min(distance));
        // the paths of those seen that are not done are at least as long as the first that is open
        while let Some(&Reverse((bits, _))) = self.open.peek()
            && nearest + f64::from_bits(bits) <= shortest + GRAZE
        {
            if let Some(grown) = self.grow(mesh, target, scratch)
                && let Ok(place) = scratch.seen.binary_search_by_key(&grown, |&(vertex, _)| vertex)
            {
                shortest = shortest.min(scratch.seen[place].1 + self.lengths[grown as usize]);
            }
        }
        if let Some(Way { length, end, .. }) = straight.filter(|way| way.length <= shortest + GRAZE) {
            return Some((length, On::Straight(end)));
        }
        let by =
            scratch.seen.iter().map(|&(vertex, distance)| (distance + self.lengths[vertex as usize], distance, vertex));
        by.filter(|&(length, ..)| length <= shortest + GRAZE)
            .reduce(|one, other| {
                let is_left = offset(one.2).perp_dot(offset(other.2)) > 0.0;
                let comes_first = other.1 > one.1 + GRAZE || other.1 >= one.1 - GRAZE && is_left;
                if comes_first { other } else { one }
            })
            .map(|(length, _, vertex)| (length, On::By(vertex)))
    }

    /// Whether the path from a vertex is known and cannot become shorter.
    fn is_done(&self, vertex: u32) -> bool {
        let length = self.lengths[vertex as usize];
        length.is_finite() && self.open.peek().is_none_or(|&Reverse(first)| (length.to_bits(), vertex) < first)
    }

    /// Finishes the path from one more vertex, the one that has the shortest, and tells which; `None` where another path
    /// was shorter.
    fn grow(&mut self, mesh: &NavMesh, target: &Target<'_>, scratch: &mut Scratch) -> Option<u32> {
        let Reverse((bits, vertex)) = self.open.pop()?;
        let length = self.lengths[vertex as usize];
        if bits != length.to_bits() {
            return None;
        }
        let at = mesh.vertices[vertex as usize];
        let on = match self.next[vertex as usize] {
            NONE => straight(mesh, target, vertex, scratch)?.end,
            next => mesh.vertices[next as usize],
        };
        for &other in mesh.tangents(vertex, &mut scratch.sweep) {
            let offset = at - mesh.vertices[other as usize];
            if mesh.bends_to(vertex, offset, on - at) {
                self.offer(other, length + offset.length(), vertex);
            }
        }
        Some(vertex)
    }

    /// Notes a path from a vertex.
    fn offer(&mut self, vertex: u32, length: f64, next: u32) {
        let known = &mut self.lengths[vertex as usize];
        if length < *known {
            *known = length;
            self.next[vertex as usize] = next;
            self.open.push(Reverse((length.to_bits(), vertex)));
        } else if length == *known {
            self.next[vertex as usize] = self.next[vertex as usize].min(next);
        }
    }
}

/// The shorter of two ways, or the first.
fn shorter(one: Option<Way>, other: Option<Way>) -> Option<Way> {
    one.into_iter().chain(other).min_by(|one, other| one.length.total_cmp(&other.length))
}

/// The straight way from a vertex where paths bend to the target, if it is in sight.
fn straight(mesh: &NavMesh, target: &Target<'_>, vertex: u32, scratch: &mut Scratch) -> Option<Way> {
    let Scratch { sweep, polygons, .. } = scratch;
    let root = mesh.vertices[vertex as usize];
    let (low, high) = target.bounds();
    let box_corners = [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
    if !box_corners.into_iter().any(|corner| mesh.bends_along(vertex, root - corner)) {
        return None;
    }
    let mut best: Option<Way> = None;
    let mut offer = |way: Option<Way>| {
        best = shorter(best, way);
        best.map_or(f64::INFINITY, |best| best.length)
    };
    for &triangle in mesh.fans.round(vertex) {
        offer(target.straight(triangle, root));
    }
    sweep.look_out(mesh, vertex, |view| (!view.misses((low, high))).then_some(view));
    sweep.follow(mesh, |triangle, view, _| {
        !view.misses((low, high)) && target.bound(view) < offer(target.straight_through(triangle, view, polygons))
    });
    best.filter(|best| mesh.bends_along(vertex, root - best.end))
}
