//! Asking for paths: what is asked, moved on to the mesh, and what comes back.

use super::area::{Area, Target};
use super::error::Unreachable;
use super::interval::{GRAZE, SNAP};
use super::locate::TOUCH;
use super::mesh::NavMesh;
use super::polyanya::Search;
use super::tree::{self, Growth, Scratch};
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

impl Path {
    /// The path through these points, those left out where it does not bend.
    pub(super) fn through(start: DVec2, points: Vec<DVec2>, length: f64) -> Self {
        let mut before = start;
        let mut corners = Vec::with_capacity(points.len());
        for (index, &point) in points.iter().enumerate() {
            let last = index + 1 == points.len();
            let straight =
                |next: DVec2| (point - before).perp_dot(next - before).abs() <= GRAZE * next.distance(before);
            if last || point.distance_squared(before) > SNAP * SNAP && !straight(points[index + 1]) {
                corners.push(point);
                before = point;
            }
        }
        Self { start, corners, length }
    }
}

impl NavMesh {
    /// The shortest path between two points. A start off the mesh is moved to the nearest point of it, within two
    /// radii and 1 m; a goal within a radius and 1 cm, so that the path to a goal close to a wall ends before the wall.
    ///
    /// # Errors
    /// Why there is none.
    pub fn path(&self, search: &mut Search, from: DVec2, to: DVec2) -> Result<Path, Unreachable> {
        let start = self.start_point(from)?;
        let (mut triangles, mut places) = std::mem::take(&mut search.goal);
        let target = self.point_target(to, &mut triangles, &mut places);
        let found = target.and_then(|target| search.run(self, start, &target));
        search.goal = (triangles, places);
        found
    }

    /// The shortest path to the nearest point of an area, nearest along the path.
    ///
    /// # Errors
    /// Why there is none.
    pub fn path_to(&self, search: &mut Search, from: DVec2, area: &Area) -> Result<Path, Unreachable> {
        let start = self.start_point(from)?;
        search.run(self, start, &self.area_target(area)?)
    }

    /// The shortest paths of many to one point, as [`path`](Self::path) finds them one by one: here they share what they
    /// have in common. Of several as short as each other it may be another.
    pub fn paths(&self, from: &[DVec2], to: DVec2) -> Vec<Result<Path, Unreachable>> {
        let (mut triangles, mut places) = Default::default();
        self.all_paths(from, self.point_target(to, &mut triangles, &mut places))
    }

    /// The shortest paths of many to the nearest point of an area, as [`path_to`](Self::path_to) finds them one by one.
    pub fn paths_to(&self, from: &[DVec2], area: &Area) -> Vec<Result<Path, Unreachable>> {
        self.all_paths(from, self.area_target(area))
    }

    fn all_paths(&self, from: &[DVec2], target: Result<Target<'_>, Unreachable>) -> Vec<Result<Path, Unreachable>> {
        let (mut tree, mut scratch) = (None, Scratch::default());
        let growth = Growth::of(from.len());
        from.iter().map(|&from| tree::path(&mut tree, self, &target, (from, growth), &mut scratch)).collect()
    }

    /// A point as what paths lead to; the lists are memory.
    pub(super) fn point_target<'a>(
        &self,
        to: DVec2,
        triangles: &'a mut Vec<u32>,
        places: &'a mut Vec<u32>,
    ) -> Result<Target<'a>, Unreachable> {
        if !to.is_finite() {
            return Err(Unreachable::NotFinite);
        }
        let at = self.nearest(to);
        let distance = at.distance(to);
        if distance > self.radius + 0.01 {
            return Err(Unreachable::GoalInWall { at: to, distance });
        }
        self.touching(at, TOUCH, triangles);
        places.clear();
        places.extend(triangles.iter().map(|&triangle| self.bridges.place(triangle)));
        places.sort_unstable();
        Ok(Target::Point { at, triangles, places })
    }

    /// An area as what paths lead to.
    pub(super) fn area_target<'a>(&self, area: &'a Area) -> Result<Target<'a>, Unreachable> {
        if area.is_empty() {
            return Err(Unreachable::GoalInWall { at: area.corner(), distance: f64::INFINITY });
        }
        Ok(Target::Area(area))
    }

    /// Where a path from somewhere begins: on the mesh.
    pub(super) fn start_point(&self, from: DVec2) -> Result<DVec2, Unreachable> {
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
