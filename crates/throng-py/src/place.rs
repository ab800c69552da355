//! Places as numbers: walls, and the nearest points of goals.

use crate::error::scene_error;
use glam::DVec2;
use pyo3::prelude::*;
use std::f64::consts::TAU;
use throng::space::{Place, is_inside, nearest_on_outline};
use throng::{Goal, Obstacle, Walkable};
use throng_scene::import::plan;

/// Corners of a polygon, or points of a line, metres.
pub type Corners = Vec<[f64; 2]>;

/// The number of walls of a disc.
const SIDES: u32 = 32;

/// Returns the point of a goal that is nearest to a place.
pub fn nearest(goal: &Goal, from: DVec2) -> DVec2 {
    let Some(corners) = goal.corners() else { return goal.middle() };
    if is_inside(corners, from) { from } else { nearest_on_outline(corners, from) }
}

/// Returns the ends of all walls of a place.
pub fn walls(place: &Place) -> Vec<[f64; 4]> {
    let mut walls = vec![];
    let mut add = |[a, b]: [DVec2; 2]| walls.push([a.x, a.y, b.x, b.y]);
    for area in &place.areas {
        std::iter::once(&area.outer).chain(&area.holes).flat_map(|ring| closed(ring)).for_each(&mut add);
    }
    for obstacle in place.obstacles() {
        match outline(obstacle) {
            (corners, true) => closed(&corners).for_each(&mut add),
            (points, false) => points.windows(2).for_each(|ends| add([ends[0], ends[1]])),
        }
    }
    walls
}

/// Returns the corners of an obstacle, and whether it is closed: a thin wall is not.
pub fn outline(obstacle: &Obstacle) -> (Vec<DVec2>, bool) {
    match obstacle {
        Obstacle::Polygon { corners } => (corners.clone(), true),
        Obstacle::Wall { points } => (points.clone(), false),
        Obstacle::Circle { center, radius } => {
            let corner = |k: u32| *center + *radius * DVec2::from_angle(f64::from(k) * TAU / f64::from(SIDES));
            ((0..SIDES).map(corner).collect(), true)
        }
    }
}

/// Returns the corners of walkable areas and of their holes, metres.
pub fn rings(areas: &[Walkable]) -> Vec<Vec<Corners>> {
    let area = |area: &Walkable| std::iter::once(&area.outer).chain(&area.holes).map(|ring| numbers(ring)).collect();
    areas.iter().map(area).collect()
}

/// Returns the ground that outlines make together, without solid outlines: corners of areas and of their holes.
#[pyfunction]
pub fn cut_ground(py: Python<'_>, ground: Vec<Corners>, solids: Vec<Corners>) -> PyResult<Vec<Vec<Corners>>> {
    let outlines = |given: Vec<Corners>| -> Vec<Vec<DVec2>> {
        given.into_iter().map(|corners| corners.into_iter().map(DVec2::from).collect()).collect()
    };
    let (ground, solids) = (outlines(ground), outlines(solids));
    let cut = py.detach(|| plan::cut_ground(&ground, &solids));
    Ok(rings(&cut.map_err(|error| scene_error(py, &error))?))
}

/// Returns points as numbers.
pub fn numbers(points: &[DVec2]) -> Corners {
    points.iter().map(DVec2::to_array).collect()
}

/// Returns the sides of a polygon.
fn closed(corners: &[DVec2]) -> impl Iterator<Item = [DVec2; 2]> + '_ {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(&a, &b)| [a, b])
}
