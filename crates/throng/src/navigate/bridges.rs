//! Bridges: edges of the mesh that are the only connection between two parts of an island. A search crosses a bridge
//! only towards its goal.
//!
//! They are found by one depth-first search over the triangles (Tarjan, *A note on finding the bridges of a graph*,
//! Information Processing Letters 2, 1974). A room with one door is behind a bridge, and so is every dead-end corner.

use super::triangulate::NONE;

/// The bridges of a mesh.
#[derive(Clone, Debug)]
pub(super) struct Bridges {
    /// The position of each triangle in the order of the search.
    order: Vec<u32>,
    /// The last position among the triangles that the search found from each triangle on.
    last: Vec<u32>,
    /// Bit k is set if edge k is a bridge.
    edges: Vec<u8>,
}

impl Bridges {
    /// Finds the bridges between triangles with these neighbours.
    pub fn new(neighbours: &[[u32; 3]]) -> Self {
        let count = neighbours.len();
        let mut found = Self { order: vec![NONE; count], last: vec![0; count], edges: vec![0; count] };
        let mut low = vec![NONE; count];
        let mut next = 0;
        // triangle, the edge it was entered by, the edge to try next
        let mut stack: Vec<(usize, usize, usize)> = Vec::new();
        for first in 0..count {
            if found.order[first] != NONE {
                continue;
            }
            stack.push((first, 3, 0));
            while let Some(&mut (triangle, entered, ref mut edge)) = stack.last_mut() {
                if found.order[triangle] == NONE {
                    found.order[triangle] = next;
                    low[triangle] = next;
                    next += 1;
                }
                if *edge < 3 {
                    let tried = *edge;
                    *edge += 1;
                    let other = neighbours[triangle][tried];
                    if tried == entered || other == NONE {
                        continue;
                    }
                    let other = other as usize;
                    if found.order[other] == NONE {
                        let back = (0..2).find(|&k| neighbours[other][k] as usize == triangle).unwrap_or(2);
                        stack.push((other, back, 0));
                    } else {
                        low[triangle] = low[triangle].min(found.order[other]);
                    }
                    continue;
                }
                found.last[triangle] = next - 1;
                stack.pop();
                if entered < 3 {
                    let parent = neighbours[triangle][entered] as usize;
                    low[parent] = low[parent].min(low[triangle]);
                    if low[triangle] == found.order[triangle] {
                        found.edges[triangle] |= 1 << entered;
                        let there = (0..2).find(|&k| neighbours[parent][k] as usize == triangle).unwrap_or(2);
                        found.edges[parent] |= 1 << there;
                    }
                }
            }
        }
        found
    }

    /// Returns the position of a triangle in the order that [`Bridges::leads_to`] uses.
    pub fn place(&self, triangle: u32) -> u32 {
        self.order[triangle as usize]
    }

    /// Whether crossing `edge` of `triangle` to `next` can lead to one of the `goals` (sorted positions).
    pub fn leads_to(&self, goals: &[u32], triangle: u32, edge: usize, next: u32) -> bool {
        if self.edges[triangle as usize] & (1 << edge) == 0 {
            return true;
        }
        let (from, to) = (self.order[triangle as usize], self.order[next as usize]);
        if to > from {
            let first = goals.partition_point(|&goal| goal < to);
            first < goals.len() && goals[first] <= self.last[next as usize]
        } else {
            let last = self.last[triangle as usize];
            goals.first().is_some_and(|&goal| goal < from) || goals.last().is_some_and(|&goal| goal > last)
        }
    }
}
