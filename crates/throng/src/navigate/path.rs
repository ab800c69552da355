//! Path queries: moving start and goal onto the mesh, and the resulting path.

use super::area::{Area, SearchTarget};
use super::error::Unreachable;
use super::interval::{GRAZE, SNAP};
use super::locate::TOUCH;
use super::mesh::NavMesh;
use super::polyanya::PathSearch;
use super::tree::{self, Growth, TreeScratch};
use glam::DVec2;
use serde::{Deserialize, Serialize};

/// A shortest path.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Path {
    /// The start: the point of the mesh nearest to the requested start.
    pub start: DVec2,
    /// The points where the path bends, in order, then its end. Without `start`.
    pub corners: Vec<DVec2>,
    /// Its length from `start`, metres.
    pub length: f64,
}

impl Path {
    /// Returns the path through these points, without the points where it does not bend.
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
    /// Returns the shortest path between two points. A start off the mesh is moved to the nearest point of the mesh if
    /// that is within two radii and 1 m. A goal off the mesh is moved if that is within a radius and 1 cm, so a path to
    /// a goal close to a wall ends before the wall.
    ///
    /// # Errors
    /// The reason why there is no path.
    pub fn path(&self, search: &mut PathSearch, from: DVec2, to: DVec2) -> Result<Path, Unreachable> {
        let start = self.start_point(from)?;
        let (mut triangles, mut places) = std::mem::take(&mut search.goal);
        let target = self.point_target(to, &mut triangles, &mut places);
        let found = target.and_then(|target| search.run(self, start, &target));
        search.goal = (triangles, places);
        found
    }

    /// Returns the shortest path to an area. It ends at the point of the area that is nearest along the path.
    ///
    /// # Errors
    /// The reason why there is no path.
    pub fn path_to(&self, search: &mut PathSearch, from: DVec2, area: &Area) -> Result<Path, Unreachable> {
        let start = self.start_point(from)?;
        search.run(self, start, &self.area_target(area)?)
    }

    /// Returns the shortest paths from many points to one. The lengths are those of [`path`](Self::path), but the
    /// searches share common work. Where several paths are equally short, the result can be another of them.
    pub fn paths(&self, from: &[DVec2], to: DVec2) -> Vec<Result<Path, Unreachable>> {
        let (mut triangles, mut places) = Default::default();
        self.all_paths(from, self.point_target(to, &mut triangles, &mut places))
    }

    /// Returns the shortest paths from many points to an area, as [`path_to`](Self::path_to).
    pub fn paths_to(&self, from: &[DVec2], area: &Area) -> Vec<Result<Path, Unreachable>> {
        self.all_paths(from, self.area_target(area))
    }

    fn all_paths(
        &self,
        from: &[DVec2],
        target: Result<SearchTarget<'_>, Unreachable>,
    ) -> Vec<Result<Path, Unreachable>> {
        let (mut tree, mut scratch) = (None, TreeScratch::default());
        let growth = Growth::of(from.len());
        from.iter().map(|&from| tree::path(&mut tree, self, &target, (from, growth), &mut scratch)).collect()
    }

    /// Returns a point as the target of a search; the lists are buffers.
    pub(super) fn point_target<'a>(
        &self,
        to: DVec2,
        triangles: &'a mut Vec<u32>,
        places: &'a mut Vec<u32>,
    ) -> Result<SearchTarget<'a>, Unreachable> {
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
        Ok(SearchTarget::Point { at, triangles, places })
    }

    /// Returns an area as the target of a search.
    pub(super) fn area_target<'a>(&self, area: &'a Area) -> Result<SearchTarget<'a>, Unreachable> {
        if area.is_empty() {
            return Err(Unreachable::GoalInWall { at: area.corner(), distance: f64::INFINITY });
        }
        Ok(SearchTarget::Area(area))
    }

    /// Returns the start of a path: the nearest point of the mesh.
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
