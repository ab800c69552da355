//! Which corners of walls see each other so that a taut string may bend round both: the edges of all shortest paths but for
//! their ends. Those of a corner are found by a sweep when they are first asked for.

use super::mesh::NavMesh;
use super::sweep::Sweep;
use std::sync::OnceLock;

/// The tangents of a mesh.
#[derive(Clone, Debug)]
pub(super) struct Tangents {
    /// Of each vertex: the vertices that its tangents lead to, in order.
    of: Vec<OnceLock<Box<[u32]>>>,
}

impl Tangents {
    /// Those of so many vertices, still to be found.
    pub fn new(vertices: usize) -> Self {
        Self { of: vec![OnceLock::new(); vertices] }
    }
}

impl NavMesh {
    /// The vertices that the tangents of a vertex lead to, in order.
    pub(super) fn tangents(&self, vertex: u32, sweep: &mut Sweep) -> &[u32] {
        self.tangents.of[vertex as usize].get_or_init(|| {
            let at = self.vertices[vertex as usize];
            let mut found = Vec::new();
            let mut see = |other: u32| {
                let along = self.vertices[other as usize] - at;
                if other != vertex && self.bends_along(other, along) && self.bends_along(vertex, -along) {
                    found.push(other);
                }
            };
            for &triangle in self.fans.round(vertex) {
                self.triangles[triangle as usize].into_iter().for_each(&mut see);
            }
            for between in self.taut(vertex).into_iter().flatten() {
                sweep.look_out(self, vertex, |view| view.between(between));
                sweep.follow(self, |_, _, corner| {
                    corner.into_iter().for_each(&mut see);
                    true
                });
            }
            found.sort_unstable();
            found.dedup();
            found.into()
        })
    }
}
