//! What a behaviour that a program brings along is made for.

use glam::{DVec2, Vec2, Vec3};
use std::ops::Range;
use std::sync::Arc;
use throng::space::Pathway;
use throng::space::surface::{Capsule, Prism, SeenFrom, Sphere};
use throng::steer::{Barriers, Target, Who};
use throng::{Error, Obstacle};

/// How far up and down solids reach, metres: farther than anybody flies.
const TALL: f32 = 20_000.0;
/// Half the thickness of walls, metres.
const THIN: f32 = 0.005;

/// Who and what is in the scene that a behaviour is made for, by name.
#[derive(Debug)]
pub struct Cast<'a> {
    /// World coordinates of what behaviours see places relative to ([`throng::Settings::origin`]).
    pub origin: DVec2,
    /// What is solid, in the scene's order, world coordinates.
    pub obstacles: &'a [Obstacle],
    /// The groups, then the movers: their names and the numbers of their agents.
    pub(crate) named: &'a [(&'a str, Range<u32>)],
    pub(crate) paths: &'a [(&'a str, Arc<Pathway>)],
}

impl Cast<'_> {
    /// A place of the scene, as behaviours see it.
    pub fn place(&self, x: f64, y: f64) -> Vec3 {
        (DVec2::new(x, y) - self.origin).as_vec2().extend(0.0)
    }

    /// What is solid, as behaviours avoid it.
    ///
    /// # Errors
    /// A shape that encloses nothing.
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

    /// All of a group.
    ///
    /// # Errors
    /// [`Error::NoGroup`] if there is none of this name.
    pub fn group(&self, name: &str) -> Result<Who, Error> {
        // behind the group that every world has
        self.find(name).map(|(index, _)| Who::Group(index + 1))
    }

    /// The `k`-th agent of a group, from 0.
    ///
    /// # Errors
    /// [`Error::NoGroup`] if there is no such group, [`Error::Unknown`] if it is smaller.
    pub fn agent(&self, name: &str, k: usize) -> Result<Target, Error> {
        let (_, numbers) = self.find(name)?;
        numbers.clone().nth(k).map(Target::Agent).ok_or(Error::Unknown { what: "agent of the group", index: k })
    }

    /// A path of the scene, as behaviours see it; `None` if there is none of this name.
    pub fn path(&self, name: &str) -> Option<Arc<Pathway>> {
        self.paths.iter().find(|(known, _)| *known == name).map(|(_, path)| path.clone())
    }

    /// The group or mover of a name: its position, and the numbers of its agents.
    pub(crate) fn find(&self, name: &str) -> Result<(usize, &Range<u32>), Error> {
        let found = self.named.iter().enumerate().find(|(_, (known, _))| *known == name);
        found.map(|(index, (_, numbers))| (index, numbers)).ok_or_else(|| Error::NoGroup { name: name.to_owned() })
    }
}
