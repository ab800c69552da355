//! The checks: brute force in `f64` over all pairs and all walls, from positions and obstacles alone, without the
//! world's own figures.

use glam::{DVec2, Vec2};
use throng::{Obstacle, World};

/// Part of a radius by which bodies may penetrate each other.
const TOLERANCE: f64 = 1e-4;

/// Distance of a point to the segment from `a` to `b`, by the two end regions and the strip between them.
fn to_segment(p: DVec2, a: DVec2, b: DVec2) -> f64 {
    let (along, length) = ((b - a).normalize_or_zero(), a.distance(b));
    match (p - a).dot(along) {
        t if t <= 0.0 => p.distance(a),
        t if t >= length => p.distance(b),
        _ => (p - a).perp_dot(along).abs(),
    }
}

/// Sum of the angles under which a point sees the sides, in turns: 0 outside.
fn winding(p: DVec2, corners: &[DVec2]) -> f64 {
    let angle = |a: DVec2, b: DVec2| (a - p).perp_dot(b - p).atan2((a - p).dot(b - p));
    let sides = corners.iter().zip(corners.iter().cycle().skip(1));
    sides.map(|(&a, &b)| angle(a, b)).sum::<f64>() / std::f64::consts::TAU
}

/// Signed distance of a point to an obstacle; negative inside.
pub fn distance_to(obstacle: &Obstacle, p: DVec2) -> f64 {
    let least = |ring: &mut dyn Iterator<Item = (DVec2, DVec2)>| {
        ring.map(|(a, b)| to_segment(p, a, b)).fold(f64::INFINITY, f64::min)
    };
    match obstacle {
        Obstacle::Circle { center, radius } => center.distance(p) - radius,
        Obstacle::Polygon { corners } => {
            let edge = least(&mut corners.iter().copied().zip(corners.iter().copied().cycle().skip(1)));
            if winding(p, corners).abs() > 0.5 { -edge } else { edge }
        }
        Obstacle::Wall { points } => least(&mut points.windows(2).map(|pair| (pair[0], pair[1]))),
    }
}

/// The world's obstacles, in the order they were added.
pub fn obstacles(world: &World) -> Vec<Obstacle> {
    world.place().obstacles().cloned().collect()
}

/// Positions of all agents, with radii and layers.
pub struct Snapshot {
    pub positions: Vec<DVec2>,
    radii: Vec<f64>,
    layers: Vec<(u32, u32)>,
    pub numbers: Vec<u32>,
}

impl Snapshot {
    pub fn of(world: &World) -> Self {
        let agents = world.relative_columns();
        let origin = world.settings().origin;
        Self {
            positions: agents.position.iter().map(|p| p.as_dvec2() + origin).collect(),
            radii: agents.radius.iter().map(f64::from).collect(),
            layers: agents.layers.iter().zip(agents.avoids.iter()).collect(),
            numbers: agents.number.clone(),
        }
    }

    fn solid(&self, a: usize, b: usize) -> bool {
        self.layers[a].0 & self.layers[b].1 != 0 || self.layers[b].0 & self.layers[a].1 != 0
    }

    /// Returns a description of every overlapping pair and of every body in a wall; empty if there are none.
    pub fn overlaps(&self, obstacles: &[Obstacle]) -> Vec<String> {
        let mut found = Vec::new();
        for a in 0..self.positions.len() {
            for b in 0..a {
                let radii = self.radii[a] + self.radii[b];
                let tolerance = TOLERANCE * self.radii[a].min(self.radii[b]);
                let distance = self.positions[a].distance(self.positions[b]);
                if self.solid(a, b) && distance < radii - tolerance {
                    let (a, b) = (self.numbers[a], self.numbers[b]);
                    found.push(format!("agents {a} and {b}: centres {distance:.7} m apart, radii {radii:.7} m"));
                }
            }
            for (index, obstacle) in obstacles.iter().enumerate() {
                let distance = distance_to(obstacle, self.positions[a]);
                if distance < self.radii[a] * (1.0 - TOLERANCE) {
                    let (number, radius) = (self.numbers[a], self.radii[a]);
                    found.push(format!("agent {number} and obstacle {index}: {distance:.7} m, radius {radius:.7} m"));
                }
            }
        }
        found
    }

    /// The same agents on a straight line to `later`, at the part `t` of it. Agents that left or came in between are
    /// omitted.
    pub fn between(&self, later: &Self, t: f64) -> Self {
        let find = |number: u32| later.numbers.iter().position(|&n| n == number);
        let kept: Vec<(usize, usize)> =
            self.numbers.iter().enumerate().filter_map(|(row, &n)| Some((row, find(n)?))).collect();
        Self {
            positions: kept.iter().map(|&(row, then)| self.positions[row].lerp(later.positions[then], t)).collect(),
            radii: kept.iter().map(|&(row, _)| self.radii[row]).collect(),
            layers: kept.iter().map(|&(row, _)| self.layers[row]).collect(),
            numbers: kept.iter().map(|&(row, _)| self.numbers[row]).collect(),
        }
    }
}

/// Panics if an agent overlaps another agent or an obstacle.
pub fn assert_free(world: &World) {
    let found = Snapshot::of(world).overlaps(&obstacles(world));
    assert!(found.is_empty(), "at {:.3} s: {found:#?}", world.time());
}

/// Apparent speed from the rounding of positions in one sub-step of `seconds`.
pub fn rounding_speed(position: Vec2, seconds: f64) -> f64 {
    let largest = position.abs().max_element().max(1e-3);
    2.0 * f64::from(largest) * f64::from(f32::EPSILON) / seconds
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_oracle_itself_sees_what_overlaps() {
        let square =
            Obstacle::Polygon { corners: [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)].map(DVec2::from).into() };
        assert_eq!(distance_to(&square, DVec2::new(3.0, 1.0)), 1.0);
        assert_eq!(distance_to(&square, DVec2::new(0.5, 1.0)), -0.5);
        let wall = Obstacle::Wall { points: vec![DVec2::ZERO, DVec2::X] };
        assert_eq!(distance_to(&wall, DVec2::new(0.5, -0.25)), 0.25);
        let crowd = Snapshot {
            positions: vec![DVec2::ZERO, DVec2::new(0.39999, 0.0)],
            radii: vec![0.2; 2],
            layers: vec![(1, 1), (1, 0)],
            numbers: vec![0, 1],
        };
        assert!(crowd.overlaps(&[]).is_empty(), "a 1e-5 of 0.2 is within the tolerance");
        let closer = Snapshot { positions: vec![DVec2::ZERO, DVec2::new(0.39997, 0.0)], ..crowd };
        assert_eq!(closer.overlaps(&[]).len(), 1);
        assert_eq!(closer.overlaps(&[square]).len(), 3);
    }
}
