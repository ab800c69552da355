//! Meshes of random rooms.

pub use crate::area::shoelace;
pub use crate::oracle::{Dice, Scene, VisibilityGraph, clearance, inside, leaves_by, to_edges};
use glam::DVec2;
use throng::navigate::NavMesh;

impl Scene {
    pub fn mesh(&self, radius: f64) -> NavMesh {
        NavMesh::build(&self.walkable, &self.obstacles, radius, (DVec2::ZERO, DVec2::ZERO)).expect("a valid scene")
    }

    pub fn free_point(&self, mesh: &NavMesh, rng: &mut Dice) -> DVec2 {
        loop {
            let at = self.point(rng);
            if mesh.locate(at).is_some() {
                return at;
            }
        }
    }
}
