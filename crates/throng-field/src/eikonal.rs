//! The eikonal equation |grad T| = c on lattices of two or three dimensions, by fast marching.
//!
//! Sethian, *A fast marching level set method for monotonically advancing fronts*, PNAS 93(4), 1996: nodes get their
//! times in the order in which a front reaches them, each from the nodes before it, by Godunov's upwind differences.
//! The differences are of second order where the cost varies little (Sethian, *Fast marching methods*, SIAM Review
//! 41(2), 1999, section 4.4). Ties are broken by index, so the order is always the same.

use super::slope::slope;
use std::f64::consts::SQRT_2;

/// A lattice of nodes, in rows and layers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct NodeLattice<const D: usize> {
    /// Nodes along each axis.
    pub counts: [usize; D],
    /// Distance between neighbouring nodes, metres.
    pub cell: f64,
}

impl<const D: usize> NodeLattice<D> {
    /// Returns the number of nodes.
    pub fn len(&self) -> usize {
        self.counts.iter().product()
    }

    /// Returns the index differences between neighbours along each axis.
    pub fn strides(&self) -> [usize; D] {
        let mut strides = [1; D];
        for axis in 1..D {
            strides[axis] = strides[axis - 1] * self.counts[axis - 1];
        }
        strides
    }

    /// Returns the coordinates of a node, in nodes along each axis.
    pub fn coordinates(&self, node: usize) -> [usize; D] {
        let strides = self.strides();
        std::array::from_fn(|axis| node / strides[axis] % self.counts[axis])
    }
}

/// The neighbours that a node is linked to, one bit each: along the first axis the neighbour before, then the neighbour
/// after the node; then along the second axis. In the plane follow the four diagonal neighbours. They count close to
/// walls: along a wall with a stepped outline, differences along the axes are too inexact.
pub(super) type Links = u8;

/// The bits of all neighbours along the axes, in the plane.
pub(super) const SIDES: Links = 0b1111;

/// Returns the bit of a neighbour along an axis; `after`: 1 for the neighbour with the greater index, else 0.
pub(super) fn bit(axis: usize, after: usize) -> Links {
    1 << (2 * axis + after)
}

/// Returns the bit of a diagonal neighbour, in the plane; `after`: 1 for the greater index along each axis, else 0.
pub(super) fn corner_bit(after: [usize; 2]) -> Links {
    1 << (4 + after[0] + 2 * after[1])
}

/// Relative difference of neighbouring costs above which the front bends and the second order would overshoot.
const SMOOTH: f32 = 0.35;

/// The buffers of a march, kept for the next one.
#[derive(Clone, Debug, Default)]
pub(super) struct Front {
    /// A heap of the nodes that the front reaches next, earliest first.
    heap: Vec<u64>,
    /// One bit for each node: whether the front starts there.
    starts: Vec<u64>,
}

/// Computes the time at which a front reaches each node. The front starts from `starts`, in any order; these nodes have
/// times already and keep them, because the given times are more exact than differences close to a point. The times of
/// other nodes must be infinite or later than the front. Costs are metres of front for a metre of way and greater than
/// 0.
pub(super) fn march<const D: usize>(
    lattice: &NodeLattice<D>,
    (links, cost): (&[Links], &[f32]),
    starts: impl Iterator<Item = u32>,
    times: &mut [f32],
    Front { heap, starts: fixed }: &mut Front,
) {
    let strides = lattice.strides();
    heap.clear();
    fixed.clear();
    fixed.resize(lattice.len().div_ceil(64), 0);
    for node in starts {
        fixed[node as usize / 64] |= 1 << (node % 64);
        push(heap, key(times[node as usize], node as usize));
    }
    while let Some(now) = pop(heap) {
        let (time, node) = (f32::from_bits((now >> 32) as u32), now as u32 as usize);
        // an entry for a later time than the node's is out of date
        if time > times[node] {
            continue;
        }
        let mut reach = |next: usize| {
            if key(times[next], next) > now && fixed[next / 64] >> (next % 64) & 1 == 0 {
                let update = Update { strides, links, cost, times, now, length: lattice.cell };
                let arrival = update.arrival(next).max(time);
                if arrival < times[next] {
                    times[next] = arrival;
                    push(heap, key(arrival, next));
                }
            }
        };
        let links = links[node];
        for (axis, stride) in strides.into_iter().enumerate() {
            for after in 0..2 {
                if links & bit(axis, after) != 0 {
                    reach(beside(node, stride, after));
                }
            }
        }
        if D == 2 && links > SIDES {
            for after in CORNERS {
                if links & corner_bit(after) != 0 {
                    reach(beside(beside(node, strides[0], after[0]), strides[1], after[1]));
                }
            }
        }
    }
}

/// The directions from a node to its four diagonal neighbours, in the plane.
const CORNERS: [[usize; 2]; 4] = [[0, 0], [1, 0], [0, 1], [1, 1]];

/// Returns the neighbour of a node with the smaller or the greater index.
pub(super) fn beside(node: usize, stride: usize, after: usize) -> usize {
    if after == 1 { node + stride } else { node - stride }
}

/// What the time of a node is computed from.
struct Update<'a, const D: usize> {
    strides: [usize; D],
    links: &'a [Links],
    cost: &'a [f32],
    times: &'a [f32],
    /// The key of the node that the front has just reached: the times of nodes before it are final.
    now: u64,
    length: f64,
}

impl<const D: usize> Update<'_, D> {
    /// Returns when the front reaches a node, from the neighbours that it has reached.
    fn arrival(&self, node: usize) -> f32 {
        let along = self.along_axes(node);
        if D == 2 && self.links[node] > SIDES { along.min(self.across_triangles(node).0) } else { along }
    }

    /// Returns the earliest time at which a straight ray arrives from a point between two adjacent neighbours, and its
    /// direction: Tsitsiklis, *Efficient algorithms for globally optimal trajectories*, IEEE Transactions on Automatic
    /// Control 40(9), 1995. In the plane.
    fn across_triangles(&self, node: usize) -> (f32, [f32; 2]) {
        let links = self.links[node];
        let step = self.length * f64::from(self.cost[node]);
        let reached = |node: usize| (key(self.times[node], node) <= self.now).then(|| f64::from(self.times[node]));
        let mut best = (f64::INFINITY, [0.0; 2]);
        let mut offer = |time: f64, way: [f64; 2]| {
            if time < best.0 {
                best = (time, way);
            }
        };
        for after in CORNERS {
            let sign = after.map(|after| if after == 1 { 1.0 } else { -1.0 });
            let sides = [0, 1].map(|axis| {
                let linked = links & bit(axis, after[axis]) != 0;
                linked.then(|| reached(beside(node, self.strides[axis], after[axis]))).flatten()
            });
            let across = || reached(beside(beside(node, self.strides[0], after[0]), self.strides[1], after[1]));
            let corner = (links & corner_bit(after) != 0).then(across).flatten();
            for (axis, side) in sides.into_iter().enumerate() {
                let Some(side) = side else { continue };
                // the slope of the front between the two neighbours, as the sine of an angle
                let sine = corner.map_or(0.0, |corner| ((side - corner) / step).max(0.0));
                if sine * sine < 0.5 {
                    let cosine = (1.0 - sine * sine).sqrt();
                    let mut way = [sign[0] * sine, sign[1] * sine];
                    way[axis] = sign[axis] * cosine;
                    offer(side + step * cosine, way);
                }
            }
            if let Some(corner) = corner {
                offer(corner + step * SQRT_2, sign.map(|sign| sign / SQRT_2));
            }
        }
        (best.0 as f32, best.1.map(|way| way as f32))
    }

    /// As [`arrival`](Self::arrival), by differences along the axes.
    fn along_axes(&self, node: usize) -> f32 {
        // for each axis: the neighbour's time, then the value that the difference is taken from, and its weight
        let mut terms = [(0.0f64, 0.0f64, 0.0f64); D];
        let mut count = 0;
        for axis in 0..D {
            if let Some(term) = self.term(node, axis) {
                terms[count] = term;
                count += 1;
            }
        }
        let terms = &mut terms[..count];
        // latest first: it is the first to be left out; terms with the same time stay in the order of their axes
        terms.sort_by(|a, b| b.0.total_cmp(&a.0));
        let step = self.length * f64::from(self.cost[node]);
        for from in 0..count {
            let (latest, base) = (terms[from].0, terms[count - 1].0);
            let (mut a, mut b, mut c) = (0.0, 0.0, -step * step);
            for &(_, value, weight) in &terms[from..] {
                let above = value - base;
                a += weight;
                b += weight * above;
                c += weight * above * above;
            }
            let root = b * b - a * c;
            if root >= 0.0 {
                let arrival = base + (b + root.sqrt()) / a;
                if arrival >= latest {
                    return arrival as f32;
                }
            }
        }
        f32::INFINITY
    }

    /// Returns the term of an axis, if the front has reached a neighbour along it.
    fn term(&self, node: usize, axis: usize) -> Option<(f64, f64, f64)> {
        let stride = self.strides[axis];
        let mut nearest: Option<(f32, usize, usize)> = None;
        for after in 0..2 {
            if self.links[node] & bit(axis, after) == 0 {
                continue;
            }
            let next = beside(node, stride, after);
            let time = self.times[next];
            if key(time, next) <= self.now && nearest.is_none_or(|nearest| time < nearest.0) {
                nearest = Some((time, next, after));
            }
        }
        let (time, next, after) = nearest?;
        let first = f64::from(time);
        let (cost, beside_cost) = (self.cost[node], self.cost[next]);
        if self.links[next] & bit(axis, after) != 0 && (beside_cost - cost).abs() <= SMOOTH * cost {
            let second = f64::from(self.times[beside(next, stride, after)]);
            if second <= first {
                return Some((first, (4.0 * first - second) / 3.0, 2.25));
            }
        }
        Some((first, first, 1.0))
    }
}

/// Returns the sort key of a node: earlier times first, then lower indices. Times are not negative, so their bits are
/// in the order of their values.
fn key(time: f32, node: usize) -> u64 {
    u64::from(time.to_bits()) << 32 | node as u64
}

/// Children of an entry of the heap.
const CHILDREN: usize = 4;

fn push(heap: &mut Vec<u64>, key: u64) {
    let mut at = heap.len();
    heap.push(key);
    while at > 0 {
        let parent = (at - 1) / CHILDREN;
        if heap[parent] <= key {
            break;
        }
        heap[at] = heap[parent];
        at = parent;
    }
    heap[at] = key;
}

fn pop(heap: &mut Vec<u64>) -> Option<u64> {
    let last = heap.pop()?;
    let Some(&least) = heap.first() else { return Some(last) };
    let mut at = 0;
    loop {
        let first = CHILDREN * at + 1;
        let end = (first + CHILDREN).min(heap.len());
        let Some(child) = (first..end).min_by_key(|&child| heap[child]) else { break };
        if heap[child] >= last {
            break;
        }
        heap[at] = heap[child];
        at = child;
    }
    heap[at] = last;
    Some(least)
}

/// Returns the direction, backwards, in which the front came to a node of the plane. Where a straight ray from between
/// two neighbours arrived first, as close to walls, that is the direction of the ray; elsewhere it is down the slope.
/// Zero where no front came.
pub(super) fn backwards(
    lattice: &NodeLattice<2>,
    (links, cost): (&[Links], &[f32]),
    times: &[f32],
    node: usize,
) -> [f32; 2] {
    if times[node].is_infinite() {
        return [0.0; 2];
    }
    let straight = || {
        let now = key(times[node], node) - 1;
        Update { strides: lattice.strides(), links, cost, times, now, length: lattice.cell }.across_triangles(node)
    };
    if links[node] > SIDES
        && let (time, way) = straight()
        && time <= times[node] * (1.0 + 1e-6)
    {
        return way;
    }
    let (slope, whole) = slope(lattice, (links, cost), times, node);
    if whole { slope.map(|slope| -slope) } else { straight().1 }
}
