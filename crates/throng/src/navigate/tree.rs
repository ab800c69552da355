//! The shortest paths from everywhere to one target: a tree over the corners of walls, shared by all agents with that
//! target.
//!
//! A shortest path is straight except where it bends around corners. So the shortest path from a corner follows from
//! those of the corners that its tangents lead to, and Dijkstra's algorithm finds them all, the nearest first (Rohnert,
//! *Shortest paths in the plane with convex polygonal obstacles*, Information Processing Letters 23, 1986). A path from
//! any other point leads through a corner that is visible from the point.
//!
//! The tree grows as far as needed. For many starts it grows to all sides, the nearest corners first. For few starts it
//! grows towards each start (A*: Hart, Nilsson, Raphael, *A formal basis for the heuristic determination of minimum
//! cost paths*, IEEE Transactions on Systems Science and Cybernetics 4, 1968), which leaves out most of the ground.
//! Results do not depend on the kind of growth or on earlier queries: lengths are sums from the target on, the same in
//! any order; of equal lengths the vertex with the lower number is taken; and all continuations from a point are
//! compared.

use super::area::SearchTarget;
use super::error::Unreachable;
use super::interval::{GRAZE, IntervalCrossing};
use super::locate::TOUCH;
use super::mesh::NavMesh;
use super::outlook::Outlook;
use super::path::Path;
use super::reached::{Reached, ReachedVertices};
use super::sweep::{VertexAhead, ViewSweep};
use super::triangulate::NONE;
use glam::DVec2;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// The shortest paths to one target on one mesh.
#[derive(Clone, Debug)]
pub(super) struct Tree {
    reached: ReachedVertices,
    /// Bits of lengths, and vertices that are not final yet. Lengths are never negative, so their bits are in the order
    /// of their values.
    open: BinaryHeap<Reverse<(u64, u32)>>,
    /// The vertices that see the target are open as far as this has been visited.
    outlook: Outlook,
    /// Length up to which paths are offered, metres: in a long street a vertex has many far tangents. And the vertices with
    /// longer paths to offer, with the first tangent that has one.
    horizon: f64,
    beyond: Vec<(u32, u32)>,
}

/// The first horizon of a tree, relative to the distance of the first start.
const FAR: f64 = 1.5;

/// Distance inside the view from a point, metres, at which a vertex certainly sees the point.
const CLEARLY: f64 = 1e-6;

/// How a tree grows when the path from a start is not known yet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Growth {
    /// To all sides.
    Around,
    /// Towards the start.
    Toward,
}

impl Growth {
    /// Returns the faster growth for this number of starts.
    pub fn of(starts: usize) -> Self {
        if starts > FEW { Self::Around } else { Self::Toward }
    }
}

/// Maximum number of starts for which a tree grows towards each start: growing towards a start visits all open
/// vertices.
const FEW: usize = 4;

/// Scratch memory of queries.
#[derive(Clone, Debug, Default)]
pub(super) struct TreeScratch {
    sweep: ViewSweep,
    around: Vec<u32>,
    seen: Vec<(u32, f64)>,
    polygons: [Vec<DVec2>; 2],
    /// Bits of a lower bound of the length of a path from the start through an open vertex, bits of the length from
    /// that vertex, and the vertex.
    front: BinaryHeap<Reverse<(u64, u64, u32)>>,
}

/// The first part of the shortest path from a point.
#[derive(Clone, Copy, Debug, PartialEq)]
enum On {
    /// To a vertex.
    By(u32),
    /// Straight to this point of the target.
    Straight(DVec2),
}

/// Returns the shortest path from a point to the target, by a tree that is created when first needed.
pub(super) fn path(
    tree: &mut Option<Tree>,
    mesh: &NavMesh,
    target: &Result<SearchTarget<'_>, Unreachable>,
    (from, growth): (DVec2, Growth),
    scratch: &mut TreeScratch,
) -> Result<Path, Unreachable> {
    let start = mesh.start_point(from)?;
    let target = target.as_ref().map_err(|&why| why)?;
    tree.get_or_insert_with(|| Tree::new(mesh, target, scratch)).path(mesh, target, (start, growth), scratch)
}

impl Tree {
    /// Creates a tree. If the target is a point, all vertices that see it are open.
    fn new(mesh: &NavMesh, target: &SearchTarget<'_>, scratch: &mut TreeScratch) -> Self {
        let (reached, outlook) = (ReachedVertices::new(mesh.vertices.len()), Outlook::of(mesh, target));
        let mut tree = Self { reached, open: BinaryHeap::new(), outlook, horizon: 0.0, beyond: Vec::new() };
        if let SearchTarget::Point { at, triangles, .. } = target {
            for (vertex, length) in in_sight(mesh, target, (*at, triangles), scratch) {
                tree.offer(vertex, length, NONE);
            }
        }
        tree
    }

    /// Returns the bits of the length beyond which paths are missing; `None`: none is missing.
    fn complete_to(&self) -> Option<u64> {
        let horizon = (!self.beyond.is_empty()).then_some(self.horizon.to_bits());
        self.outlook.reached().into_iter().chain(horizon).min()
    }

    /// Returns the first vertex that is not final, after the bits of its length; or, before all vertices of this length, the
    /// length beyond which paths are missing, if that is less.
    fn first_open(&self) -> Option<(u64, u32)> {
        let open = self.open.peek().map(|&Reverse(first)| first);
        open.into_iter().chain(self.complete_to().map(|bits| (bits, 0))).min()
    }

    /// Offers some of the missing paths: it visits the next triangle of the outlook, or doubles the horizon.
    fn look_out(&mut self, mesh: &NavMesh, target: &SearchTarget<'_>, scratch: &mut TreeScratch) {
        if self.outlook.reached().is_none_or(|bits| bits > self.horizon.to_bits() && !self.beyond.is_empty()) {
            self.horizon *= 2.0;
            for (vertex, from) in std::mem::take(&mut self.beyond) {
                self.expand(mesh, target, (vertex, from), scratch);
            }
            return;
        }
        let mut outlook = std::mem::take(&mut self.outlook);
        outlook.go_on(mesh, |vertex| {
            if let Some(way) = straight(mesh, target, vertex, scratch) {
                self.offer(vertex, way.length, NONE);
            }
        });
        self.outlook = outlook;
    }

    /// Whether missing paths may be shorter than an open one with these bits of a length, or than none.
    fn looks_out_before(&self, bits: Option<u64>) -> bool {
        self.complete_to().is_some_and(|complete| bits.is_none_or(|bits| complete <= bits))
    }

    /// Returns the size of the tree's memory, bytes.
    pub fn bytes(&self) -> usize {
        let open = self.open.len() * size_of::<Reverse<(u64, u32)>>();
        self.reached.bytes() + open + self.outlook.bytes() + self.beyond.len() * size_of::<(u32, u32)>()
    }

    /// Returns the shortest path from a point of the mesh.
    fn path(
        &mut self,
        mesh: &NavMesh,
        target: &SearchTarget<'_>,
        (start, growth): (DVec2, Growth),
        scratch: &mut TreeScratch,
    ) -> Result<Path, Unreachable> {
        if self.horizon == 0.0 {
            let (low, high) = target.bounds();
            self.horizon = FAR * start.distance(start.clamp(low, high)) + 1.0;
        }
        let mut around = std::mem::take(&mut scratch.around);
        mesh.touching(start, TOUCH, &mut around);
        let reached = target.check_island(mesh, &around);
        let found = reached.map(|()| self.go_on(mesh, target, (start, &around, growth), scratch));
        scratch.around = around;
        let Some((length, on)) = found? else {
            // on one island there is a path; only rounding at a needle-thin triangle can hide it
            return Err(Unreachable::NoWay { from: target.first_island(mesh), to: target.first_island(mesh) });
        };
        let mut points = Vec::new();
        let mut on = on;
        while let On::By(vertex) = on {
            points.push(mesh.vertices[vertex as usize]);
            on = match self.reached.of(vertex).next {
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

    /// Returns the length of the shortest path from a point, and its first part. Of paths with the same length, the
    /// path with the longest first part is taken; of those, the leftmost.
    fn go_on(
        &mut self,
        mesh: &NavMesh,
        target: &SearchTarget<'_>,
        (start, around, growth): (DVec2, &[u32], Growth),
        scratch: &mut TreeScratch,
    ) -> Option<(f64, On)> {
        let TreeScratch { sweep, seen, polygons, .. } = scratch;
        let offset = |vertex: u32| mesh.vertices[vertex as usize] - start;
        let mut straight: Option<IntervalCrossing> = None;
        let mut shortest = f64::INFINITY;
        let mut offer = |shortest: &mut f64, way: Option<IntervalCrossing>| {
            straight = shorter(straight, way);
            *shortest = straight.map_or(*shortest, |way| shortest.min(way.length));
        };
        seen.clear();
        let mut see = |shortest: &mut f64, vertex: u32| {
            let offset = offset(vertex);
            if mesh.bends_along(vertex, offset) {
                seen.push((vertex, offset.length()));
                *shortest = shortest.min(offset.length() + self.reached.of(vertex).length);
            }
        };
        for &triangle in around {
            offer(&mut shortest, target.straight(triangle, start));
            mesh.triangles[triangle as usize].into_iter().for_each(|corner| see(&mut shortest, corner));
        }
        sweep.look_from(mesh, start, around);
        sweep.follow(mesh, |triangle, view, corner| {
            offer(&mut shortest, target.straight_through(triangle, view, polygons));
            corner.visible().into_iter().for_each(|corner| see(&mut shortest, corner));
            target.bound(view) <= shortest + GRAZE
        });
        seen.sort_unstable_by_key(|&(vertex, _)| vertex);
        seen.dedup_by_key(|&mut (vertex, _)| vertex);

        let open = seen.iter().filter(|&&(vertex, _)| !self.is_done(vertex));
        let nearest = open.fold(f64::INFINITY, |least, &(_, distance)| least.min(distance));
        // the paths through seen vertices that are not final are at least as long as through the first open vertex
        let lacks = |tree: &Self, shortest: f64| {
            tree.first_open().is_some_and(|(bits, _)| nearest + f64::from_bits(bits) <= shortest + GRAZE)
        };
        if growth == Growth::Toward && lacks(self, shortest) {
            self.grow_toward(mesh, target, (start, shortest), scratch);
        } else {
            while lacks(self, shortest) {
                if let Some(grown) = self.grow(mesh, target, scratch)
                    && let Some(length) = self.by_way_of(grown, &scratch.seen)
                {
                    shortest = shortest.min(length);
                }
            }
        }
        let seen = scratch.seen.iter().map(|&(vertex, distance)| distance + self.reached.of(vertex).length);
        shortest = seen.fold(shortest, f64::min);
        if let Some(IntervalCrossing { length, end, .. }) = straight.filter(|way| way.length <= shortest + GRAZE) {
            return Some((length, On::Straight(end)));
        }
        let by = scratch
            .seen
            .iter()
            .map(|&(vertex, distance)| (distance + self.reached.of(vertex).length, distance, vertex));
        by.filter(|&(length, ..)| length <= shortest + GRAZE)
            .reduce(|one, other| {
                let is_left = offset(one.2).perp_dot(offset(other.2)) > 0.0;
                let comes_first = other.1 > one.1 + GRAZE || other.1 >= one.1 - GRAZE && is_left;
                if comes_first { other } else { one }
            })
            .map(|(length, _, vertex)| (length, On::By(vertex)))
    }

    /// Whether the path from a vertex is known and final.
    fn is_done(&self, vertex: u32) -> bool {
        let length = self.reached.of(vertex).length;
        length.is_finite() && self.first_open().is_none_or(|first| (length.to_bits(), vertex) < first)
    }

    /// Returns the length of the path through a vertex, if the vertex is among those seen, which are given with their
    /// distances.
    fn by_way_of(&self, vertex: u32, seen: &[(u32, f64)]) -> Option<f64> {
        let place = seen.binary_search_by_key(&vertex, |&(vertex, _)| vertex).ok()?;
        Some(seen[place].1 + self.reached.of(vertex).length)
    }

    /// Finalises the path from the open vertex with the shortest path, and returns that vertex; `None` for an entry
    /// that is out of date, and after a look at vertices that may come before.
    fn grow(&mut self, mesh: &NavMesh, target: &SearchTarget<'_>, scratch: &mut TreeScratch) -> Option<u32> {
        if self.looks_out_before(self.open.peek().map(|&Reverse((bits, _))| bits)) {
            self.look_out(mesh, target, scratch);
            return None;
        }
        let Reverse((bits, vertex)) = self.open.pop()?;
        if bits != self.reached.of(vertex).length.to_bits() {
            return None;
        }
        self.expand(mesh, target, (vertex, 0), scratch);
        Some(vertex)
    }

    /// Expands all open vertices through which a path from `start` can be no longer than `shortest` or than a path
    /// found meanwhile. The lower bound of such a path is the vertex's length plus its straight distance from the
    /// start.
    fn grow_toward(
        &mut self,
        mesh: &NavMesh,
        target: &SearchTarget<'_>,
        (start, mut shortest): (DVec2, f64),
        scratch: &mut TreeScratch,
    ) {
        let mut front = std::mem::take(&mut scratch.front);
        let through = |length: f64, vertex: u32| length + mesh.vertices[vertex as usize].distance(start);
        let enter = |tree: &mut Self, front: &mut BinaryHeap<Reverse<(u64, u64, u32)>>| {
            front.extend(tree.open.drain().map(|Reverse((bits, vertex))| {
                Reverse((through(f64::from_bits(bits), vertex).to_bits(), bits, vertex))
            }));
        };
        enter(self, &mut front);
        // twice the tolerance, so that all vertices of the paths compared below have all their continuations
        let matters = |bits: u64, shortest: f64| f64::from_bits(bits) <= shortest + 2.0 * GRAZE;
        loop {
            let least = front.peek().map(|&Reverse((least, ..))| least);
            if self.looks_out_before(least) && self.complete_to().is_some_and(|bits| matters(bits, shortest)) {
                self.look_out(mesh, target, scratch);
                enter(self, &mut front);
                continue;
            }
            let Some(Reverse((_, bits, vertex))) =
                least.filter(|&least| matters(least, shortest)).and_then(|_| front.pop())
            else {
                break;
            };
            if bits != self.reached.of(vertex).length.to_bits() {
                continue;
            }
            if let Some(length) = self.by_way_of(vertex, &scratch.seen) {
                shortest = shortest.min(length);
            }
            self.expand(mesh, target, (vertex, 0), scratch);
            enter(self, &mut front);
        }
        self.open.extend(front.drain().map(|Reverse((_, bits, vertex))| Reverse((bits, vertex))));
        scratch.front = front;
    }

    /// Offers the path from a vertex to the vertices that its tangents lead to, from this one on, as far as the horizon.
    fn expand(
        &mut self,
        mesh: &NavMesh,
        target: &SearchTarget<'_>,
        (vertex, from): (u32, u32),
        scratch: &mut TreeScratch,
    ) {
        let (Reached { length, next }, at) = (self.reached.of(vertex), mesh.vertices[vertex as usize]);
        let on = match next {
            NONE => match straight(mesh, target, vertex, scratch) {
                Some(way) => way.end,
                None => return,
            },
            next => mesh.vertices[next as usize],
        };
        for (index, &other) in (from..).zip(&mesh.tangents(vertex, &mut scratch.sweep)[from as usize..]) {
            let offset = at - mesh.vertices[other as usize];
            let longer = length + offset.length();
            if longer > self.horizon {
                self.beyond.push((vertex, index));
                return;
            }
            if mesh.bends_to(vertex, offset, on - at) {
                self.offer(other, longer, vertex);
            }
        }
    }

    /// Records a path from a vertex, if it is the shortest known.
    fn offer(&mut self, vertex: u32, length: f64, next: u32) {
        let known = self.reached.of_mut(vertex);
        if length < known.length {
            *known = Reached { length, next };
            self.open.push(Reverse((length.to_bits(), vertex)));
        } else if length == known.length {
            known.next = known.next.min(next);
        }
    }
}

/// Returns the vertices where paths bend and from which a target, a point in these triangles, is visible, in order, with the
/// lengths of the straight ways.
fn in_sight(
    mesh: &NavMesh,
    target: &SearchTarget<'_>,
    (at, triangles): (DVec2, &[u32]),
    scratch: &mut TreeScratch,
) -> Vec<(u32, f64)> {
    // vertices that may be visible, and whether they are certainly hidden by nothing
    let mut near: Vec<(u32, bool)> = Vec::new();
    near.extend(triangles.iter().flat_map(|&triangle| mesh.triangles[triangle as usize]).map(|vertex| (vertex, true)));
    scratch.sweep.look_from(mesh, at, triangles);
    scratch.sweep.follow(mesh, |_, _, VertexAhead { vertex, inside, .. }| {
        if inside >= -CLEARLY {
            near.push((vertex, inside > CLEARLY));
        }
        true
    });
    near.sort_unstable_by_key(|&(vertex, is_clear)| (vertex, !is_clear));
    near.dedup_by_key(|&mut (vertex, _)| vertex);
    let seen = near.into_iter().filter_map(|(vertex, is_clear)| {
        let offset = mesh.vertices[vertex as usize] - at;
        if is_clear {
            mesh.bends_along(vertex, offset).then(|| (vertex, offset.length()))
        } else {
            straight(mesh, target, vertex, scratch).map(|way| (vertex, way.length))
        }
    });
    seen.collect()
}

/// Returns the shorter of two ways, or the first if they are equally long.
fn shorter(one: Option<IntervalCrossing>, other: Option<IntervalCrossing>) -> Option<IntervalCrossing> {
    one.into_iter().chain(other).min_by(|one, other| one.length.total_cmp(&other.length))
}

/// Returns the straight way to the target from a vertex where paths bend, if the target is visible from it.
pub(super) fn straight(
    mesh: &NavMesh,
    target: &SearchTarget<'_>,
    vertex: u32,
    scratch: &mut TreeScratch,
) -> Option<IntervalCrossing> {
    let TreeScratch { sweep, polygons, .. } = scratch;
    let root = mesh.vertices[vertex as usize];
    let (low, high) = target.bounds();
    let box_corners = [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
    if !box_corners.into_iter().any(|corner| mesh.bends_along(vertex, root - corner)) {
        return None;
    }
    let mut best: Option<IntervalCrossing> = None;
    let mut offer = |way: Option<IntervalCrossing>| {
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
