//! Places as numbers: walls, and the nearest points of goals.

use glam::DVec2;
use std::f64::consts::TAU;
use throng::space::{Place, is_inside, nearest_on_outline};
use throng::{Goal, Obstacle};

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
        match obstacle {
            Obstacle::Polygon { corners } => closed(corners).for_each(&mut add),
            Obstacle::Wall { points } => points.windows(2).for_each(|ends| add([ends[0], ends[1]])),
            Obstacle::Circle { center, radius } => {
                let corner = |k: u32| *center + *radius * DVec2::from_angle(f64::from(k) * TAU / f64::from(SIDES));
                closed(&(0..SIDES).map(corner).collect::<Vec<_>>()).for_each(&mut add);
            }
        }
    }
    walls
}

/// Returns the sides of a polygon.
fn closed(corners: &[DVec2]) -> impl Iterator<Item = [DVec2; 2]> + '_ {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(&a, &b)| [a, b])
}
