//! What behaviours find around agents: surfaces and paths by name, and what is solid.

use super::refused;
use crate::file::{Path, Problem};
use crate::geometry::DVec2;
use crate::scene::Scene;
use crate::scene::steer::What;
use std::sync::Arc;
use throng::space::Pathway;
use throng::space::surface::{Barrier, Surface};

/// What has a side to stay on.
type Side = Barrier<Arc<dyn Surface>>;

/// What behaviours find around agents, relative to the world's origin.
pub(in super::super) struct Around<'a> {
    /// Surfaces by name.
    pub surfaces: Vec<(&'a str, Side)>,
    /// Paths by name.
    pub paths: Vec<(&'a str, Arc<Pathway>)>,
    /// Obstacles by name, which may be empty.
    obstacles: Vec<(&'a str, Side)>,
    /// The edges of the walkable ground.
    edges: Vec<Side>,
}

impl<'a> Around<'a> {
    /// Of a scene whose surfaces, paths and what is solid were made.
    pub fn new(
        scene: &'a Scene,
        origin: DVec2,
        (surfaces, paths): (&[Side], &[Arc<Pathway>]),
        (walkable, obstacles): (&[throng::Walkable], &[throng::Obstacle]),
    ) -> Result<Self, Problem> {
        let surfaces = scene.surfaces.iter().zip(surfaces).map(|(said, made)| (said.name.as_str(), made.clone()));
        let paths = scene.paths.iter().zip(paths).map(|(said, made)| (said.name.as_str(), made.clone()));
        let mut around =
            Self { surfaces: surfaces.collect(), paths: paths.collect(), obstacles: vec![], edges: vec![] };
        if scene.groups.iter().any(|group| group.steer.is_some() || group.solid.is_some()) {
            let edges = throng::Walkable::union(walkable.to_vec()).and_then(|areas| Barrier::of_ground(&areas, origin));
            around.edges = edges.map_err(|error| refused(&Path::of("walkable"), &error))?;
            for (i, (said, made)) in scene.obstacles.iter().zip(obstacles).enumerate() {
                let made = Barrier::of_obstacle(made, origin);
                let made = made.map_err(|error| refused(&Path::of("obstacle").index(i), &error))?;
                around.obstacles.push((&said.name, made));
            }
        }
        Ok(around)
    }

    /// What has a name; or else the names that there are.
    pub fn named(&self, name: &str) -> Result<Vec<Side>, Vec<&'a str>> {
        let solid = || self.edges.iter().chain(self.obstacles.iter().map(|(_, side)| side));
        let surfaces = || self.surfaces.iter().map(|(_, side)| side);
        match name {
            What::EVERYTHING => return Ok(solid().chain(surfaces()).cloned().collect()),
            What::OBSTACLES => return Ok(solid().cloned().collect()),
            _ => {}
        }
        let all = || self.surfaces.iter().chain(&self.obstacles).filter(|(known, _)| !known.is_empty());
        let found: Vec<Side> = all().filter(|(known, _)| *known == name).map(|(_, side)| side.clone()).collect();
        if found.is_empty() { Err(all().map(|(known, _)| *known).collect()) } else { Ok(found) }
    }
}
