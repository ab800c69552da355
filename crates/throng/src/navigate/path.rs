//! Asking for paths: what is asked, moved on to the mesh, and what comes back.

use super::area::{Area, Target};
use super::error::Unreachable;
use super::locate::TOUCH;
use super::mesh::NavMesh;
use super::polyanya::Search;
use glam::DVec2;
use serde::{Deserialize, Serialize};

/// A shortest path.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Path {
    /// Where it begins: the point of the mesh nearest to the start that was asked for.
    pub start: DVec2,
    /// The points where it bends, in order, then its end. Without `start`.
    pub corners: Vec<DVec2>,
    /// Its length from `start`, metres.
    pub length: f64,
}

impl NavMesh {
    /// The shortest path between two points. A start off the mesh is moved to the nearest point of it, within two
    /// radii and 1 m; a goal within a radius and 1 cm, so that the path to a goal close to a wall ends before the wall.
    ///
    /// # Errors
    /// Why there is none.
    pub fn path(&self, search: &mut Search, from: DVec2, to: DVec2) -> Result<Path, Unreachable> {
        let start = self.start_point(from)?;
        if !to.is_finite() {
            return Err(Unreachable::NotFinite);
        }
        let goal = self.nearest(to);
        let distance = goal.distance(to);
        if distance > self.radius + 0.01 {
            return Err(Unreachable::GoalInWall { at: to, distance });
        }
        let (mut triangles, mut places) = std::mem::take(&mut search.goal);
        self.touching(goal, TOUCH, &mut triangles);
        places.clear();
        places.extend(triangles.iter().map(|&triangle| self.bridges.place(triangle)));
        places.sort_unstable();
        let found = search.run(self, start, &Target::Point { at: goal, triangles: &triangles, places: &places });
        search.goal = (triangles, places);
        found
    }

    /// The shortest path to the nearest point of an area, nearest along the path.
    ///
    /// # Errors
    /// Why there is none.
    pub fn path_to(&self, search: &mut Search, from: DVec2, area: &Area) -> Result<Path, Unreachable> {
        let start = self.start_point(from)?;
        if area.is_empty() {
            return Err(Unreachable::GoalInWall { at: area.corner(), distance: f64::INFINITY });
        }
        search.run(self, start, &Target::Area(area))
    }

    fn start_point(&self, from: DVec2) -> Result<DVec2, Unreachable> {
        if !from.is_finite() {
            return Err(Unreachable::NotFinite);
        }
        let start = self.nearest(from);
        let distance = start.distance(from);
        if distance > 2.0 * self.radius + 1.0 {
            return Err(Unreachable::StartInWall { at: from, distance });
        }
        Ok(start)
    }
}
