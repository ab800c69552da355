//! The names in a scene, for behaviours and rules of plug-ins.

use glam::{DVec2, Vec2, Vec3};
use std::ops::Range;
use std::sync::Arc;
use throng::space::Pathway;
use throng::space::surface::{Capsule, Prism, SeenFrom, Sphere};
use throng::steer::{Barriers, GroupFilter, Target};
use throng::{Error, Obstacle};

/// Extent of obstacles up and down, metres: beyond the greatest altitude of an agent.
const TALL: f32 = 20_000.0;
/// Half the thickness of walls, metres.
const THIN: f32 = 0.005;

/// The names of groups, movers and paths in a scene, for behaviours and rules made for it.
#[derive(Debug)]
pub struct SceneNames<'a> {
    /// World coordinates of the origin of the behaviours' coordinates ([`throng::Settings::origin`]).
    pub origin: DVec2,
    /// The obstacles, in the scene's order, world coordinates.
    pub obstacles: &'a [Obstacle],
    /// The groups, then the movers: their names and the numbers of their agents.
    pub(crate) named: &'a [(&'a str, Range<u32>)],
    pub(crate) paths: &'a [(&'a str, Arc<Pathway>)],
}

impl SceneNames<'_> {
    /// Returns a place of the scene in the behaviours' coordinates.
    pub fn place(&self, x: f64, y: f64) -> Vec3 {
        (DVec2::new(x, y) - self.origin).as_vec2().extend(0.0)
    }

    /// Returns the obstacles as surfaces that behaviours avoid.
    ///
    /// # Errors
    /// An obstacle encloses no area.
    pub fn barriers(&self) -> Result<Barriers, Error> {
        let place = |p: &DVec2| self.place(p.x, p.y);
        let mut barriers = Barriers::default();
        for obstacle in self.obstacles {
            match obstacle {
                Obstacle::Circle { center, radius } => {
                    barriers = barriers.with(Sphere::new(place(center), *radius as f32)?, SeenFrom::Outside);
                }
                Obstacle::Polygon { corners } => {
                    let corners: Vec<Vec2> = corners.iter().map(|corner| place(corner).truncate()).collect();
                    barriers = barriers.with(Prism::new(&corners, -TALL, TALL)?, SeenFrom::Outside);
                }
                Obstacle::Wall { points } => {
                    for ends in points.windows(2).filter(|ends| ends[0] != ends[1]) {
                        let wall = Capsule::new(place(&ends[0]), place(&ends[1]), THIN)?;
                        barriers = barriers.with(wall, SeenFrom::Outside);
                    }
                }
            }
        }
        Ok(barriers)
    }

    /// Returns the filter for all agents of a group.
    ///
    /// # Errors
    /// [`Error::NoGroup`] if no group has this name.
    pub fn group(&self, name: &str) -> Result<GroupFilter, Error> {
        // the world's default group comes first
        self.find(name).map(|(index, _)| GroupFilter::Group(index + 1))
    }

    /// Returns the `k`-th agent of a group, from 0.
    ///
    /// # Errors
    /// [`Error::NoGroup`] if no group has this name, [`Error::Unknown`] if the group is smaller.
    pub fn agent(&self, name: &str, k: usize) -> Result<Target, Error> {
        let (_, numbers) = self.find(name)?;
        numbers.clone().nth(k).map(Target::Agent).ok_or(Error::Unknown { what: "agent of the group", index: k })
    }

    /// Returns a path of the scene in the behaviours' coordinates; `None` if no path has this name.
    pub fn path(&self, name: &str) -> Option<Arc<Pathway>> {
        self.paths.iter().find(|(known, _)| *known == name).map(|(_, path)| path.clone())
    }

    /// Returns the group or mover with this name: its position, and the numbers of its agents.
    pub(crate) fn find(&self, name: &str) -> Result<(usize, &Range<u32>), Error> {
        let found = self.named.iter().enumerate().find(|(_, (known, _))| *known == name);
        found.map(|(index, (_, numbers))| (index, numbers)).ok_or_else(|| Error::NoGroup { name: name.to_owned() })
    }
}
