//! The surroundings of agents: surfaces and paths by name, ground and obstacles.

use super::refused;
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::geometry::DVec2;
use crate::scene::Scene;
use crate::scene::steer::ObstacleNames;
use std::sync::Arc;
use throng::space::Pathway;
use throng::space::surface::{Barrier, Surface};
use throng::steer::Barriers;

/// A surface with the side from which it is seen.
type Side = Barrier<Arc<dyn Surface>>;

/// The surroundings that behaviours use, relative to the world's origin.
pub(in super::super) struct Around<'a> {
    /// Surfaces by name.
    pub surfaces: Vec<(&'a str, Side)>,
    /// Paths by name.
    pub paths: Vec<(&'a str, Arc<Pathway>)>,
    /// Obstacles by name. The name may be empty.
    obstacles: Vec<(&'a str, Side)>,
    /// The edges of the walkable ground.
    edges: Vec<Side>,
}

impl<'a> Around<'a> {
    /// Collects the surroundings of a scene from its surfaces, paths, ground and obstacles.
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
        if !scene.fields.is_empty() || scene.groups.iter().any(|group| group.steer.is_some() || group.solid.is_some()) {
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

    /// Returns a surface by its name.
    pub fn surface(&self, name: &str, at: &Path) -> Result<Side, Problem> {
        let found = self.surfaces.iter().find(|(known, _)| *known == name);
        found.map(|(_, surface)| surface.clone()).ok_or_else(|| {
            let known: Vec<&str> = self.surfaces.iter().map(|(name, _)| *name).collect();
            unknown(at, "surface", name, &known)
        })
    }

    /// Returns a path by its name.
    pub fn path(&self, name: &str, at: &Path) -> Result<Arc<Pathway>, Problem> {
        let found = self.paths.iter().find(|(known, _)| *known == name);
        found.map(|(_, path)| path.clone()).ok_or_else(|| {
            let known: Vec<&str> = self.paths.iter().map(|(name, _)| *name).collect();
            unknown(at, "path", name, &known)
        })
    }

    /// Returns the surfaces and obstacles with a name; or else the names that exist.
    pub fn named(&self, name: &str) -> Result<Vec<Side>, Vec<&'a str>> {
        let solid = || self.edges.iter().chain(self.obstacles.iter().map(|(_, side)| side));
        let surfaces = || self.surfaces.iter().map(|(_, side)| side);
        match name {
            ObstacleNames::EVERYTHING => return Ok(solid().chain(surfaces()).cloned().collect()),
            ObstacleNames::OBSTACLES => return Ok(solid().cloned().collect()),
            _ => {}
        }
        let all = || self.surfaces.iter().chain(&self.obstacles).filter(|(known, _)| !known.is_empty());
        let found: Vec<Side> = all().filter(|(known, _)| *known == name).map(|(_, side)| side.clone()).collect();
        if found.is_empty() { Err(all().map(|(known, _)| *known).collect()) } else { Ok(found) }
    }

    /// Returns the surfaces and obstacles with these names. `hint` is the hint for an empty list.
    pub fn sides(&self, what: &ObstacleNames, at: &Path, hint: &str) -> Result<Barriers, Problem> {
        let named = what.0.iter().enumerate().map(|(i, name)| {
            self.named(name).map_err(|known| {
                let at = if what.0.len() == 1 { at.clone() } else { at.index(i) };
                unknown(&at, "surface or obstacle", name, &known)
            })
        });
        let named: Vec<_> = named.collect::<Result<_, _>>()?;
        if named.is_empty() {
            return Err(Problem::new(at, Kind::MissingKey, "this list of names is empty").hint(hint));
        }
        Ok(Barriers(named.concat()))
    }
}

/// Returns the error for an unknown name.
fn unknown(at: &Path, what: &str, name: &str, known: &[&str]) -> Problem {
    let list = what.split(' ').next().unwrap_or(what);
    Problem::no_such(at, what, name, known, || format!("add one with this name: [[{list}]]"))
}
