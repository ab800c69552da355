//! Exact Euclidean shortest paths on the mesh: Polyanya (Cui, Harabor, Grastien, *Compromise-free pathfinding on a
//! navigation mesh*, IJCAI 2017).
//!
//! A node of the search is an interval on an edge, seen from a root, the last bend of the path. Expanding a node
//! projects the view through the triangle ahead onto its two other edges. At an end of the interval that is a convex
//! corner of a wall, the path can bend into the area out of view, with that corner as a new root. A* on intervals, with
//! the exact distance through the interval as its bound, gives the exact shortest path.

use super::area::SearchTarget;
use super::error::Unreachable;
use super::interval::{GRAZE, IntervalCrossing, IntervalView, SNAP};
use super::locate::TOUCH;
use super::mesh::{NavMesh, rotated};
use super::path::Path;
use super::triangulate::NONE;
use glam::DVec2;
use std::cmp::Ordering;
use std::collections::{BinaryHeap, HashMap};
use std::hash::{BuildHasherDefault, Hasher};

/// Scratch memory of path queries. If it is reused, queries allocate nothing but their results. Results do not depend
/// on earlier queries, nor on their meshes.
#[derive(Clone, Debug, Default)]
pub struct PathSearch {
    nodes: Vec<SearchNode>,
    finals: Vec<Final>,
    open: BinaryHeap<Entry>,
    /// The number of this query: entries of the tables below with another number are out of date.
    query: u32,
    /// For each vertex: the query, and the length of the shortest known path to it.
    roots: Vec<(u32, f64)>,
    /// For each edge of a triangle and root: the latest node that enters through that edge with that root.
    latest: HashMap<u64, u32, BuildHasherDefault<KeyHasher>>,
    start_triangles: Vec<u32>,
    /// Triangles of a goal point, and their positions in the order of the bridges.
    pub(super) goal: (Vec<u32>, Vec<u32>),
    scratch: [Vec<DVec2>; 2],
    expanded: u32,
}

#[derive(Clone, Copy, Debug)]
struct SearchNode {
    view: IntervalView,
    /// The vertex at the root; [`NONE`] for the start.
    root: u32,
    /// Length of the path to the root.
    length: f64,
    parent: u32,
    /// The triangle ahead, and its edge that contains the interval.
    triangle: u32,
    edge: u8,
    /// The previous node that entered through the same edge with the same root.
    sibling: u32,
}

#[derive(Clone, Copy, Debug)]
struct Final {
    parent: u32,
    way: IntervalCrossing,
}

/// A fast hash of a key, the same on every platform.
#[derive(Clone, Copy, Debug, Default)]
struct KeyHasher(u64);

impl Hasher for KeyHasher {
    fn write(&mut self, bytes: &[u8]) {
        bytes.iter().for_each(|&byte| self.write_u64(byte.into()));
    }

    fn write_u64(&mut self, key: u64) {
        let product = u128::from(self.0 ^ key) * 0x9e37_79b9_7f4a_7c15;
        self.0 = (product >> 64) as u64 ^ product as u64;
    }

    fn finish(&self) -> u64 {
        self.0
    }
}

/// An entry of the queue, ordered by the bound, then by age.
#[derive(Clone, Copy, Debug)]
struct Entry {
    bound: f64,
    age: u32,
    index: u32,
    is_final: bool,
}

impl Ord for Entry {
    fn cmp(&self, other: &Self) -> Ordering {
        other.bound.total_cmp(&self.bound).then(other.age.cmp(&self.age))
    }
}
impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl PartialEq for Entry {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for Entry {}

impl PathSearch {
    /// Creates scratch memory.
    pub fn new() -> Self {
        Self::default()
    }

    /// Returns the number of nodes that the latest query expanded.
    pub fn expanded(&self) -> u32 {
        self.expanded
    }

    fn reset(&mut self, mesh: &NavMesh) {
        self.nodes.clear();
        self.finals.clear();
        self.open.clear();
        self.expanded = 0;
        self.latest.clear();
        let vertices = mesh.vertices.len();
        if self.query == u32::MAX || self.roots.len() < vertices {
            self.query = 0;
            self.roots.clear();
            self.roots.resize(vertices, (0, 0.0));
        }
        self.query += 1;
    }

    /// Returns the shortest path from a point of the mesh to the target.
    pub(super) fn run(&mut self, mesh: &NavMesh, start: DVec2, target: &SearchTarget<'_>) -> Result<Path, Unreachable> {
        self.reset(mesh);
        let mut around = std::mem::take(&mut self.start_triangles);
        mesh.touching(start, TOUCH, &mut around);
        if let Err(why) = target.check_island(mesh, &around) {
            self.start_triangles = around;
            return Err(why);
        }
        for &triangle in &around {
            if let Some(way) = target.straight(triangle, start) {
                self.finish(NONE, 0.0, way);
            }
            let corners = mesh.corners(triangle);
            for edge in 0..3 {
                let next = mesh.neighbours[triangle as usize][edge];
                if next != NONE && around.binary_search(&next).is_err() {
                    let view = IntervalView { root: start, left: corners[edge], right: corners[(edge + 1) % 3] };
                    // looking out of the triangle, the beginning of its edge is on the right
                    let view = IntervalView { left: view.right, right: view.left, ..view };
                    self.push(mesh, target, NONE, (NONE, 0.0), (triangle, edge), view);
                }
            }
        }
        self.start_triangles = around;
        while let Some(entry) = self.open.pop() {
            if entry.is_final {
                return Ok(self.path(start, entry));
            }
            let node = self.nodes[entry.index as usize];
            if !self.is_longer(mesh, node.triangle, node.edge as usize, node.root, node.length, &node.view) {
                self.expanded += 1;
                self.expand(mesh, target, entry.index, &node);
            }
        }
        // on one island there is a path; only rounding at a needle-thin triangle can hide it
        Err(Unreachable::NoWay { from: target.first_island(mesh), to: target.first_island(mesh) })
    }

    fn expand(&mut self, mesh: &NavMesh, target: &SearchTarget<'_>, index: u32, node: &SearchNode) {
        let triangle = node.triangle;
        if let Some(way) = target.way(triangle, &node.view, &mut self.scratch) {
            self.finish(index, node.length, way);
        }
        if target.ends_in(triangle) {
            return;
        }
        let edge = node.edge as usize;
        let [ia, ib, ic] = rotated(mesh.triangles[triangle as usize], edge);
        let [a, b, c] = rotated(mesh.corners(triangle), edge);
        let (right_edge, left_edge) = ((triangle, (edge + 1) % 3), (triangle, (edge + 2) % 3));
        let view = node.view;
        let (at_left, at_right) = (view.left == a, view.right == b);
        let ahead = view.ahead([a, b, c]);
        let (left, right) = ahead.sides;

        // the same root sees the part between the ends of the interval
        if ahead.sees_corner {
            self.reached(ic, node.length + view.root.distance(c));
        }
        for (edge, seen) in [left_edge, right_edge].into_iter().zip(ahead.through) {
            if let Some(view) = seen {
                self.push(mesh, target, index, (node.root, node.length), edge, view);
            }
        }
        // the part out of view is seen from a corner that the path bends around
        if left > -GRAZE && at_left && mesh.bends[ia as usize].is_some() && node.root != ia {
            let bend = (ia, node.length + view.root.distance(a));
            self.push(mesh, target, index, bend, left_edge, IntervalView { root: a, left: a, right: c });
            let end = if left > GRAZE { view.hit(a, c, b) } else { c };
            self.push(mesh, target, index, bend, right_edge, IntervalView { root: a, left: c, right: end });
        }
        if right < GRAZE && at_right && mesh.bends[ib as usize].is_some() && node.root != ib {
            let bend = (ib, node.length + view.root.distance(b));
            self.push(mesh, target, index, bend, right_edge, IntervalView { root: b, left: c, right: b });
            let end = if right < -GRAZE { view.hit(b, a, c) } else { c };
            self.push(mesh, target, index, bend, left_edge, IntervalView { root: b, left: end, right: c });
        }
    }

    /// Adds a node that looks out of `from` (a triangle and its edge), unless it cannot be part of a shortest path.
    fn push(
        &mut self,
        mesh: &NavMesh,
        target: &SearchTarget<'_>,
        parent: u32,
        (root, length): (u32, f64),
        (triangle, edge): (u32, usize),
        view: IntervalView,
    ) {
        let next = mesh.neighbours[triangle as usize][edge];
        if next == NONE || !mesh.bridges.leads_to(target.places(), triangle, edge, next) {
            return;
        }
        if view.left.distance_squared(view.right) < SNAP * SNAP {
            return;
        }
        let back = mesh.edge_to(next, triangle);
        if root != NONE {
            self.reached(root, length);
        }
        if self.is_longer(mesh, next, back, root, length, &view) {
            return;
        }
        let latest = self.latest.entry(u64::from(next * 3 + back as u32) << 32 | u64::from(root)).or_insert(NONE);
        let mut sibling = *latest;
        while sibling != NONE {
            let other = &self.nodes[sibling as usize];
            if other.length <= length + GRAZE && covers(&other.view, &view) {
                return;
            }
            sibling = other.sibling;
        }
        let index = self.nodes.len() as u32;
        let node = SearchNode { view, root, length, parent, triangle: next, edge: back as u8, sibling: *latest };
        *latest = index;
        self.nodes.push(node);
        self.enter(length + target.bound(&view), index, false);
    }

    /// Records that there is a path of this length to a vertex.
    fn reached(&mut self, vertex: u32, length: f64) {
        let best = &mut self.roots[vertex as usize];
        if best.0 != self.query || length < best.1 {
            *best = (self.query, length);
        }
    }

    /// Returns the length of the shortest known path to a vertex.
    fn best(&self, vertex: u32) -> f64 {
        let best = self.roots[vertex as usize];
        if best.0 == self.query { best.1 } else { f64::INFINITY }
    }

    /// Whether every path through an interval is longer than another known path: to its root, or through an end of its
    /// edge. For a path through an end, the advantage is smallest at the far end of the interval.
    fn is_longer(
        &self,
        mesh: &NavMesh,
        triangle: u32,
        edge: usize,
        root: u32,
        length: f64,
        view: &IntervalView,
    ) -> bool {
        let corners = mesh.triangles[triangle as usize];
        let (a, b) = (corners[edge], corners[(edge + 1) % 3]);
        let by = |vertex: u32, far: DVec2| {
            vertex != root
                && self.best(vertex) + mesh.vertices[vertex as usize].distance(far) + GRAZE
                    < length + view.root.distance(far)
        };
        root != NONE && length > self.best(root) + GRAZE || by(a, view.right) || by(b, view.left)
    }

    fn finish(&mut self, parent: u32, length: f64, way: IntervalCrossing) {
        let index = self.finals.len() as u32;
        self.finals.push(Final { parent, way });
        self.enter(length + way.length, index, true);
    }

    fn enter(&mut self, bound: f64, index: u32, is_final: bool) {
        let age = (self.nodes.len() + self.finals.len()) as u32;
        self.open.push(Entry { bound, age, index, is_final });
    }

    /// Returns the path that ends in a final entry.
    fn path(&self, start: DVec2, entry: Entry) -> Path {
        let Final { parent, way } = self.finals[entry.index as usize];
        let mut corners = vec![way.end];
        corners.extend(way.via);
        let (mut at, mut root) = (parent, NONE);
        while at != NONE {
            let node = &self.nodes[at as usize];
            if node.root != NONE && node.root != root {
                root = node.root;
                corners.push(node.view.root);
            }
            at = node.parent;
        }
        corners.reverse();
        Path::through(start, corners, entry.bound)
    }
}

/// Whether `outer` sees everything that `inner` sees, from the same root on the same edge.
fn covers(outer: &IntervalView, inner: &IntervalView) -> bool {
    let along = outer.right - outer.left;
    let length = along.length();
    (inner.left - outer.left).dot(along) >= -SNAP * length && (inner.right - outer.right).dot(along) <= SNAP * length
}
