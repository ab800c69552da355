//! Behaviours that use the world's geometry: obstacles, containers, walls, paths.

use super::super::limits::{Limit, check, check_some};
use super::{BehaviourContext, BuildBehaviour, angle, or, refused};
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::scene::steer::*;
use glam::{Vec2, Vec3};
use std::sync::Arc;
use throng::space::{PathDirection, Pathway, Raster};
use throng::steer::{Barriers, BoxedBehaviour};

/// Default whiskers: length of the middle one, length of the outer ones, metres, and their angle to the sides, radians.
const FAN: (f32, f32, f32) = (2.0, 1.0, 0.61);
/// Default look-ahead of `stay_on_path`, seconds.
const STAYS: f32 = 1.0;

impl BehaviourContext<'_> {
    /// Returns the obstacles of a behaviour; everything by default.
    pub(super) fn barriers(&self, what: &Option<ObstacleNames>, at: &Path) -> Result<Barriers, Problem> {
        let what = what.clone().unwrap_or_default();
        self.around.sides(&what, &at.key("obstacles"), "leave out `obstacles` for everything")
    }

    /// Returns what is solid to the group.
    pub fn solid(&self) -> Result<Barriers, Problem> {
        let at = Path::of("group").index(self.group).key("solid");
        let what = self.scene.groups[self.group].solid.as_ref();
        what.map_or(Ok(Barriers::default()), |what| self.around.sides(what, &at, "leave out `solid` for nothing"))
    }

    pub(super) fn path(&self, name: &str, at: &Path) -> Result<Arc<Pathway>, Problem> {
        let found = self.around.paths.iter().find(|(known, _)| *known == name);
        found.map(|(_, path)| path.clone()).ok_or_else(|| {
            let known: Vec<&str> = self.around.paths.iter().map(|(name, _)| *name).collect();
            unknown(&at.key("path"), "path", name, &known)
        })
    }

    fn follow(
        &self,
        path: &str,
        direction: Option<Direction>,
        horizon: Option<f64>,
        at: &Path,
    ) -> Result<throng_steer::FollowPath, Problem> {
        let standard = throng_steer::FollowPath::from(self.path(path, at)?);
        let direction = direction.map_or(standard.direction, |direction| match direction {
            Direction::Forward => PathDirection::Forward,
            Direction::Backward => PathDirection::Backward,
        });
        Ok(throng_steer::FollowPath { direction, seconds: or(horizon, standard.seconds), ..standard })
    }
}

/// Returns the error for an unknown name.
pub(super) fn unknown(at: &Path, what: &str, name: &str, known: &[&str]) -> Problem {
    let problem = Problem::new(at, Kind::UnknownKey, format!("there is no {what} `{name}`"));
    match known {
        [] => problem.hint(format!("add one with this name: [[{}]]", what.split(' ').next().unwrap_or(what))),
        known => problem.hint(format!("there is: {}", known.join(", "))),
    }
}

impl BuildBehaviour for AvoidObstacles {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        check_some(&at.key("keeps"), self.keeps, Limit::NotNegative)?;
        let standard = throng_steer::AvoidObstacles::from(making.barriers(&self.obstacles, at)?);
        let towards = self.towards.as_ref().map(|target| making.target(target, &at.key("towards"))).transpose()?;
        Ok(throng_steer::AvoidObstacles {
            towards: towards.unwrap_or(standard.towards),
            seconds: or(self.horizon, standard.seconds),
            gap: or(self.gap, standard.gap),
            keeps: or(self.keeps, standard.keeps),
            ..standard
        }
        .into())
    }
}

/// Default width of the cells of a map, metres.
const CELL: f64 = 1.0;
/// The most cells of a map.
const MOST_CELLS: f64 = 1e6;

impl BuildBehaviour for AvoidMap {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let cell = self.cell.unwrap_or(CELL);
        check(&at.key("cell"), cell, Limit::Positive)?;
        let [low, high] = [("min", self.min), ("max", self.max)]
            .map(|(key, corner)| making.place(corner.into(), &at.key(key)).map(Vec3::truncate));
        let (low, high) = (low?, high?);
        let cells = ((high - low).as_dvec2() / cell).ceil();
        if !(cells.min_element() >= 1.0 && cells.element_product() <= MOST_CELLS) {
            let message = format!("a map of {} by {} cells; there must be 1 to {MOST_CELLS} in all", cells.x, cells.y);
            return Err(Problem::new(at, Kind::Count, message).hint("set min and max, corners, or a greater cell"));
        }
        let (barriers, near) = (making.barriers(&self.obstacles, at)?, 0.5 * cell as f32);
        let solid = |place: Vec2| barriers.ahead(place.extend(0.0), Vec3::ZERO, near, 0.0).is_some();
        let map = Raster::of(low, high, cell as f32, solid).map_err(|error| refused(at, &error))?;
        let standard = throng_steer::AvoidMap::new(Arc::new(map), making.branch(&self.of, &at.key("of"))?);
        Ok(throng_steer::AvoidMap {
            seconds: or(self.horizon, standard.seconds),
            margin: or(self.margin, standard.margin),
            curved: self.curved.unwrap_or(standard.curved),
            ..standard
        }
        .into())
    }
}

impl BuildBehaviour for Whiskers {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let standard = throng_steer::Whiskers::fan(making.barriers(&self.obstacles, at)?, FAN.0, FAN.1, FAN.2);
        let ray = |(i, ray): (usize, &Ray)| {
            let at = at.key("rays").index(i);
            check_some(&at.key("length"), Some(ray.length), Limit::Positive)?;
            check_some(&at.key("angle"), ray.angle, Limit::Between(-180.0, 180.0))?;
            Ok(throng_steer::Whisker {
                beside: or(ray.beside, 0.0),
                angle: angle(ray.angle, 0.0),
                length: ray.length as f32,
            })
        };
        let rays = self.rays.as_ref().map(|rays| rays.iter().enumerate().map(ray).collect::<Result<_, Problem>>());
        Ok(throng_steer::Whiskers {
            whiskers: rays.transpose()?.unwrap_or(standard.whiskers),
            clearance: or(self.clearance, standard.clearance),
            ..standard
        }
        .into())
    }
}

impl BuildBehaviour for Contain {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        check_some(&at.key("angle"), self.angle, Limit::Between(0.0, 180.0))?;
        let found = making.around.surfaces.iter().find(|(known, _)| *known == self.surface);
        let (_, barrier) = found.ok_or_else(|| {
            let known: Vec<&str> = making.around.surfaces.iter().map(|(name, _)| *name).collect();
            unknown(&at.key("surface"), "surface", &self.surface, &known)
        })?;
        let standard = throng_steer::Contain::on_side(barrier.surface.clone(), barrier.seen_from);
        Ok(throng_steer::Contain {
            seconds: or(self.horizon, standard.seconds),
            angle: angle(self.angle, standard.angle),
            gap: or(self.gap, standard.gap),
            ..standard
        }
        .into())
    }
}

impl BuildBehaviour for FollowPath {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let follow = making.follow(&self.path, self.direction, self.horizon, at)?;
        check_some(&at.key("inner"), self.inner, Limit::Between(0.0, 1.0))?;
        let (slowing_distance, inner) =
            (or(self.slowing_distance, follow.slowing_distance), or(self.inner, follow.inner));
        Ok(throng_steer::FollowPath { slowing_distance, inner, ..follow }.into())
    }
}

impl BuildBehaviour for StayOnPath {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        Ok(throng_steer::StayOnPath { path: making.path(&self.path, at)?, seconds: or(self.horizon, STAYS) }.into())
    }
}

impl BuildBehaviour for FollowWall {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let standard = throng_steer::FollowWall::from(making.barriers(&self.obstacles, at)?);
        check_some(&at.key("offset"), self.offset, Limit::Positive)?;
        Ok(throng_steer::FollowWall {
            offset: or(self.offset, standard.offset),
            seconds: or(self.horizon, standard.seconds),
            range: or(self.range, standard.range),
            ..standard
        }
        .into())
    }
}

impl BuildBehaviour for Hide {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let from = making.target(&self.from, &at.key("from"))?;
        let standard = throng_steer::Hide::new(from, making.barriers(&self.obstacles, at)?);
        Ok(throng_steer::Hide {
            gap: or(self.gap, standard.gap),
            range: or(self.range, standard.range),
            slowing_distance: or(self.slowing_distance, standard.slowing_distance),
            ..standard
        }
        .into())
    }
}

impl BuildBehaviour for CrowdPath {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        check_some(&at.key("horizon"), self.horizon, Limit::Positive)?;
        Ok(throng_steer::crowd_path(making.follow(&self.path, self.direction, self.horizon, at)?))
    }
}

impl BuildBehaviour for QueueAtDoor {
    fn make(&self, making: &BehaviourContext, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let goal = self.goal.as_ref().map(|goal| making.target(goal, &at.key("goal"))).transpose()?;
        let door = making.target(&self.door, &at.key("door"))?;
        let walls = making.barriers(&self.obstacles, at)?;
        Ok(throng_steer::queue_at_door(goal.unwrap_or(throng::steer::Target::Goal), door, walls))
    }
}
