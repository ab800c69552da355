//! Tangents: pairs of corners of walls that are visible from each other and around both of which a taut path can bend.
//! All edges of shortest paths except the first and the last are tangents. The tangents of a corner are found by a
//! sweep when first needed.

use super::mesh::NavMesh;
use super::sweep::ViewSweep;
use std::sync::OnceLock;

/// The tangents of a mesh.
#[derive(Clone, Debug)]
pub(super) struct Tangents {
    /// For each vertex: the vertices that its tangents lead to, the nearest first.
    of: Vec<OnceLock<Box<[u32]>>>,
}

impl Tangents {
    /// Creates the tangents of this number of vertices, none of them computed yet.
    pub fn new(vertices: usize) -> Self {
        Self { of: vec![OnceLock::new(); vertices] }
    }
}

impl NavMesh {
    /// Returns the vertices that the tangents of a vertex lead to, the nearest first.
    pub(super) fn tangents(&self, vertex: u32, sweep: &mut ViewSweep) -> &[u32] {
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
                    corner.visible().into_iter().for_each(&mut see);
                    true
                });
            }
            let distance = |other: u32| self.vertices[other as usize].distance_squared(at);
            found.sort_unstable_by(|&a, &b| distance(a).total_cmp(&distance(b)).then(a.cmp(&b)));
            found.dedup();
            found.into()
        })
    }
}
