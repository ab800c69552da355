//! A bounding volume hierarchy: finds the items near a point or on a path.
//!
//! It is split at the median of the longest side (Ericson, *Real-Time Collision Detection*, 2005, chapter 6). The
//! hierarchy stores boxes only. The caller provides the distance of each item.

use super::{Bounds, SurfaceHit, Sweep};

/// Maximum number of items in a leaf.
const LEAF: usize = 2;

/// A binary tree of boxes over numbered items.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Bvh {
    /// The nodes. The first is the root, which exists even if there are no items.
    nodes: Vec<BvhNode>,
    /// Numbers of the items. Those of a leaf are adjacent.
    items: Vec<u32>,
}

#[derive(Clone, Debug, PartialEq)]
struct BvhNode {
    bounds: Bounds,
    /// Index of the first item, or of the first of two adjacent child nodes.
    first: u32,
    /// Number of items; 0 for a node with children.
    count: u32,
}

impl Bvh {
    /// Returns a hierarchy over items with these boxes, numbered in order. There must be at least one.
    pub fn new(boxes: &[Bounds]) -> Self {
        let mut bvh = Self { nodes: Vec::new(), items: (0..boxes.len() as u32).collect() };
        bvh.nodes.push(BvhNode { bounds: Bounds::EMPTY, first: 0, count: boxes.len() as u32 });
        let mut open = vec![0];
        while let Some(at) = open.pop() {
            let BvhNode { first, count, .. } = bvh.nodes[at];
            let items = &mut bvh.items[first as usize..][..count as usize];
            bvh.nodes[at].bounds = items.iter().map(|&i| boxes[i as usize]).fold(Bounds::EMPTY, Bounds::union);
            if items.len() <= LEAF {
                continue;
            }
            let centers = Bounds::around(items.iter().map(|&i| boxes[i as usize].center()));
            let axis = (centers.high - centers.low).max_position();
            let key = |i: u32| boxes[i as usize].center()[axis];
            let half = items.len() / 2;
            items.select_nth_unstable_by(half, |&a, &b| key(a).total_cmp(&key(b)).then(a.cmp(&b)));
            // a fixed order within each half, whatever the selection did
            items[..half].sort_unstable();
            items[half..].sort_unstable();
            let children = bvh.nodes.len();
            for (first, count) in [(first, half as u32), (first + half as u32, count - half as u32)] {
                bvh.nodes.push(BvhNode { bounds: Bounds::EMPTY, first, count });
                open.push(bvh.nodes.len() - 1);
            }
            bvh.nodes[at] = BvhNode { first: children as u32, count: 0, ..bvh.nodes[at].clone() };
        }
        bvh
    }

    /// Returns the bounding box of all items.
    pub fn bounds(&self) -> Bounds {
        self.nodes[0].bounds
    }

    /// Returns the result of `look` for the item nearest to a point. `look` gets the number of an item and returns its
    /// distance, which must not be less than that of the item's box unless the point is in the box.
    pub fn nearest<T>(&self, point: glam::Vec3, mut look: impl FnMut(u32) -> (f32, T)) -> Option<(f32, T)> {
        let mut best = None;
        self.nearest_in(0, point, &mut look, &mut best);
        best
    }

    fn nearest_in<T>(
        &self,
        node: usize,
        point: glam::Vec3,
        look: &mut impl FnMut(u32) -> (f32, T),
        best: &mut Option<(f32, T)>,
    ) {
        let BvhNode { first, count, .. } = self.nodes[node];
        if count > 0 {
            for &item in &self.items[first as usize..][..count as usize] {
                let found = look(item);
                if best.as_ref().is_none_or(|best| found.0 < best.0) {
                    *best = Some(found);
                }
            }
            return;
        }
        let far = |child: usize| {
            let bounds = &self.nodes[child].bounds;
            // inside the box the distance of an item may be negative
            if bounds.contains(point) { f32::NEG_INFINITY } else { bounds.distance(point) }
        };
        let mut children = [first as usize, first as usize + 1].map(|child| (far(child), child));
        if children[1].0 < children[0].0 {
            children.swap(0, 1);
        }
        for (far, child) in children {
            if best.as_ref().is_none_or(|best| far <= best.0) {
                self.nearest_in(child, point, look, best);
            }
        }
    }

    /// Returns the first contact of a ball. `look` gets the number of an item, and the sweep with the reach that still
    /// matters.
    pub fn first_touched(
        &self,
        sweep: &Sweep,
        mut look: impl FnMut(u32, &Sweep) -> Option<SurfaceHit>,
    ) -> Option<SurfaceHit> {
        let mut best = None;
        let mut sweep = *sweep;
        self.touched_in(0, &mut sweep, &mut look, &mut best);
        best
    }

    fn touched_in(
        &self,
        node: usize,
        sweep: &mut Sweep,
        look: &mut impl FnMut(u32, &Sweep) -> Option<SurfaceHit>,
        best: &mut Option<SurfaceHit>,
    ) {
        let BvhNode { first, count, .. } = self.nodes[node];
        if count > 0 {
            for &item in &self.items[first as usize..][..count as usize] {
                if let Some(hit) = look(item, sweep).filter(|hit| best.is_none_or(|best| hit.distance < best.distance))
                {
                    sweep.reach = hit.distance;
                    *best = Some(hit);
                }
            }
            return;
        }
        let entry = |child: usize, sweep: &Sweep| self.nodes[child].bounds.entry(sweep);
        let mut children = [first as usize, first as usize + 1];
        if let [Some(a), Some(b)] = children.map(|child| entry(child, sweep))
            && b < a
        {
            children.swap(0, 1);
        }
        for child in children {
            if entry(child, sweep).is_some() {
                self.touched_in(child, sweep, look, best);
            }
        }
    }
}
