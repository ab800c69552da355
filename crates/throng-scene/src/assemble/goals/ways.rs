//! The lengths of the paths to goals, for agents that choose the nearest.

use super::GoalPlace;
use super::key::GoalKey;
use crate::geometry::{DVec2, DVec3, bounds};
use std::collections::HashMap;
use throng::Goal;
use throng::navigate::{Area, NavMesh, PathSearch};

/// Shortest paths of bodies of one size.
pub(super) struct Ways {
    mesh: NavMesh,
    search: PathSearch,
    /// The areas of goals on the mesh.
    areas: HashMap<GoalKey, Option<Area>>,
}

impl Ways {
    /// Returns `None` if nothing is in the way, or if no ground is left to walk on.
    pub fn new((walkable, obstacles): GoalPlace, radius: f64, starts: &[DVec3], goals: &[Goal]) -> Option<Self> {
        if walkable.is_empty() && obstacles.is_empty() {
            return None;
        }
        let [low, high] = bounds(starts.iter().map(|start| start.truncate()).chain(goals.iter().map(Goal::middle)))?;
        // as the world does: a millimetre wider than the body
        let mesh = NavMesh::build(walkable, obstacles, radius + 0.001, (low, high)).ok()?;
        Some(Self { mesh, search: PathSearch::new(), areas: HashMap::new() })
    }

    pub fn length_to_point(&mut self, from: DVec2, to: DVec2) -> f64 {
        self.mesh.path(&mut self.search, from, to).map_or(f64::INFINITY, |path| path.length)
    }

    pub fn length_to_area(&mut self, from: DVec2, goal: &Goal, corners: &[DVec2]) -> f64 {
        let Self { mesh, search, areas } = self;
        let area = areas.entry(GoalKey::of(goal)).or_insert_with(|| mesh.area(corners).ok());
        let path = area.as_ref().and_then(|area| mesh.path_to(search, from, area).ok());
        path.map_or(f64::INFINITY, |path| path.length)
    }
}
