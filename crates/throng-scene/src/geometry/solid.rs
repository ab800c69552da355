//! The solid parts of a scene: the edge of the walkable ground, obstacles, walls. Tests whether a body has room.

use super::polygon::{crosses_ray, distance_to_segment, edges};
use glam::DVec2;
use std::collections::HashMap;

/// What a body touches or overlaps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Touch {
    /// Its centre is off the walkable ground.
    OffGround,
    /// Its centre is inside this obstacle.
    Inside(usize),
    /// It reaches over the edge of the walkable ground, at this distance from its centre.
    Edge(f64),
    /// It reaches into this obstacle, at this distance from its centre.
    Obstacle(usize, f64),
}

/// The solid parts of a scene, indexed for fast tests.
#[derive(Debug, Default)]
pub(crate) struct Solid {
    areas: Vec<SolidArea>,
    obstacles: Vec<Outline>,
    circles: Vec<(usize, DVec2, f64)>,
    /// Every edge: its ends, and the obstacle it belongs to (`None`: ground).
    segments: Vec<(DVec2, DVec2, Option<usize>)>,
    cells: HashMap<(i64, i64), Vec<u32>>,
    cell: f64,
    /// The greatest radius that `touch` accepts.
    reach: f64,
}

/// An area of ground: inside its boundary and outside its holes, which may overlap.
#[derive(Debug)]
struct SolidArea {
    outer: Outline,
    holes: Vec<Outline>,
}

impl SolidArea {
    fn contains(&self, p: DVec2) -> bool {
        self.outer.contains(p) && !self.holes.iter().any(|hole| hole.contains(p))
    }
}

/// A closed polygon.
#[derive(Debug, Default)]
struct Outline {
    index: usize,
    edges: Vec<(DVec2, DVec2)>,
    low: DVec2,
    high: DVec2,
    /// Edges by strips of y, for polygons with many edges.
    strips: Vec<Vec<u32>>,
}

impl Outline {
    fn new(index: usize, corners: &[DVec2]) -> Self {
        let all: Vec<_> = edges(corners).collect();
        let low = all.iter().fold(DVec2::INFINITY, |low, (a, _)| low.min(*a));
        let high = all.iter().fold(DVec2::NEG_INFINITY, |high, (a, _)| high.max(*a));
        let mut out = Self { index, edges: all, low, high, strips: vec![vec![]; 1] };
        let count = (out.edges.len() / 4).clamp(1, 4096);
        out.strips = vec![vec![]; count];
        for (i, (a, b)) in out.edges.iter().enumerate() {
            for strip in out.strip(a.y.min(b.y))..=out.strip(a.y.max(b.y)) {
                out.strips[strip].push(i as u32);
            }
        }
        out
    }

    fn strip(&self, y: f64) -> usize {
        let height = (self.high.y - self.low.y).max(f64::MIN_POSITIVE);
        let strip = (y - self.low.y) / height * self.strips.len() as f64;
        (strip.max(0.0) as usize).min(self.strips.len() - 1)
    }

    fn contains(&self, p: DVec2) -> bool {
        if p.cmplt(self.low).any() || p.cmpgt(self.high).any() {
            return false;
        }
        let crossed = self.strips[self.strip(p.y)].iter().filter(|i| {
            let (a, b) = self.edges[**i as usize];
            crosses_ray(a, b, p)
        });
        crossed.count() % 2 == 1
    }
}

impl Solid {
    /// Makes the index from areas (outer boundary first, then holes) and obstacles. `reach` is the greatest body
    /// radius.
    pub fn new(areas: &[throng::Walkable], obstacles: &[throng::Obstacle], reach: f64) -> Self {
        let mut solid = Self { reach, ..Self::default() };
        for (i, area) in areas.iter().enumerate() {
            for ring in std::iter::once(&area.outer).chain(&area.holes) {
                solid.segments.extend(edges(ring).map(|(a, b)| (a, b, None)));
            }
            let holes = area.holes.iter().map(|hole| Outline::new(i, hole)).collect();
            solid.areas.push(SolidArea { outer: Outline::new(i, &area.outer), holes });
        }
        for (i, obstacle) in obstacles.iter().enumerate() {
            match obstacle {
                throng::Obstacle::Circle { center, radius } => solid.circles.push((i, *center, *radius)),
                throng::Obstacle::Polygon { corners } => {
                    solid.segments.extend(edges(corners).map(|(a, b)| (a, b, Some(i))));
                    solid.obstacles.push(Outline::new(i, corners));
                }
                throng::Obstacle::Wall { points } => {
                    solid.segments.extend(points.windows(2).map(|pair| (pair[0], pair[1], Some(i))));
                }
            }
        }
        solid.index();
        solid
    }

    /// Puts the edges into square cells: each piece of an edge into every cell within reach of its bounding box.
    fn index(&mut self) {
        let total: f64 = self.segments.iter().map(|(a, b, _)| a.distance(*b)).sum();
        let mean = if self.segments.is_empty() { 1.0 } else { total / self.segments.len() as f64 };
        self.cell = mean.max(2.0 * self.reach).max(total / 1e5).max(1e-6);
        for (i, (a, b, _)) in self.segments.iter().enumerate() {
            // Walk along the edge in pieces of a cell.
            let pieces = (a.distance(*b) / self.cell).ceil().max(1.0);
            for piece in 0..pieces as u64 {
                let (p, q) = (a.lerp(*b, piece as f64 / pieces), a.lerp(*b, (piece + 1) as f64 / pieces));
                let low = self.cell_of(p.min(q) - self.reach);
                let high = self.cell_of(p.max(q) + self.reach);
                for x in low.0..=high.0 {
                    for y in low.1..=high.1 {
                        let cell = self.cells.entry((x, y)).or_default();
                        if cell.last() != Some(&(i as u32)) {
                            cell.push(i as u32);
                        }
                    }
                }
            }
        }
    }

    fn cell_of(&self, p: DVec2) -> (i64, i64) {
        ((p.x / self.cell).floor() as i64, (p.y / self.cell).floor() as i64)
    }

    /// Returns the first thing that a body with this centre and radius touches, if any. Limit: radius <= reach.
    pub fn touch(&self, p: DVec2, radius: f64) -> Option<Touch> {
        if !self.areas.is_empty() && !self.on_ground(p) {
            return Some(Touch::OffGround);
        }
        if let Some(inside) = self.obstacles.iter().find(|outline| outline.contains(p)) {
            return Some(Touch::Inside(inside.index));
        }
        for (i, center, r) in &self.circles {
            let distance = p.distance(*center) - r;
            if distance < 0.0 {
                return Some(Touch::Inside(*i));
            }
            if distance < radius {
                return Some(Touch::Obstacle(*i, distance));
            }
        }
        let near = self.cells.get(&self.cell_of(p))?;
        let mut nearest: Option<(f64, Option<usize>)> = None;
        for i in near {
            let (a, b, owner) = self.segments[*i as usize];
            let distance = distance_to_segment(p, a, b);
            if distance < radius
                && nearest.is_none_or(|(least, _)| distance < least)
                && (owner.is_some() || !self.inner_edge(p, a, b))
            {
                nearest = Some((distance, owner));
            }
        }
        nearest.map(|(distance, owner)| match owner {
            Some(i) => Touch::Obstacle(i, distance),
            None => Touch::Edge(distance),
        })
    }

    fn on_ground(&self, p: DVec2) -> bool {
        self.areas.iter().any(|area| area.contains(p))
    }

    /// Whether the nearest point of an edge of the ground lies inside the ground, where another area covers it: that
    /// edge is no wall there.
    fn inner_edge(&self, p: DVec2, a: DVec2, b: DVec2) -> bool {
        if self.areas.len() < 2 {
            return false;
        }
        let along = b - a;
        let t = ((p - a).dot(along) / along.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        let at = a + t * along;
        // The points on both sides of the edge must be ground.
        let side = along.normalize_or_zero().perp() * 1e-6 * (1.0 + at.abs().max_element());
        self.on_ground(at + side) && self.on_ground(at - side)
    }

    /// Whether a body fits here.
    pub fn fits(&self, p: DVec2, radius: f64) -> bool {
        self.touch(p, radius).is_none()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use throng::{Obstacle, Walkable};

    fn room(x: f64) -> Walkable {
        let corners = [[x, 0.0], [x + 10.0, 0.0], [x + 10.0, 10.0], [x, 10.0]];
        Walkable { outer: corners.map(DVec2::from_array).into(), holes: vec![] }
    }

    #[test]
    fn a_body_needs_its_radius_from_every_wall() {
        let wall = Obstacle::Wall { points: vec![DVec2::new(5.0, 0.0), DVec2::new(5.0, 5.0)] };
        let pillar = Obstacle::Circle { center: DVec2::new(8.0, 8.0), radius: 1.0 };
        let table = Obstacle::rectangle(DVec2::new(2.0, 8.0), DVec2::splat(2.0), 0.0);
        let solid = Solid::new(&[room(0.0)], &[wall, pillar, table], 0.5);
        assert_eq!(solid.touch(DVec2::new(2.0, 2.0), 0.5), None);
        assert_eq!(solid.touch(DVec2::new(-1.0, 2.0), 0.5), Some(Touch::OffGround));
        assert_eq!(solid.touch(DVec2::new(0.25, 2.0), 0.5), Some(Touch::Edge(0.25)));
        assert_eq!(solid.touch(DVec2::new(5.25, 2.0), 0.5), Some(Touch::Obstacle(0, 0.25)));
        assert_eq!(solid.touch(DVec2::new(8.0, 8.5), 0.5), Some(Touch::Inside(1)));
        assert_eq!(solid.touch(DVec2::new(2.0, 8.0), 0.5), Some(Touch::Inside(2)));
        assert_eq!(solid.touch(DVec2::new(3.25, 8.0), 0.5), Some(Touch::Obstacle(2, 0.25)));
    }

    #[test]
    fn holes_may_overlap() {
        let square = |x: f64| [[x, 2.0], [x + 4.0, 2.0], [x + 4.0, 6.0], [x, 6.0]].map(DVec2::from_array).to_vec();
        let solid = Solid::new(&[Walkable { holes: vec![square(2.0), square(4.0)], ..room(0.0) }], &[], 0.5);
        assert_eq!(solid.touch(DVec2::new(5.0, 4.0), 0.5), Some(Touch::OffGround));
    }

    #[test]
    fn where_two_areas_meet_is_no_wall() {
        let solid = Solid::new(&[room(0.0), room(10.0)], &[], 0.5);
        assert_eq!(solid.touch(DVec2::new(10.1, 5.0), 0.5), None);
        assert_eq!(solid.touch(DVec2::new(10.1, 0.25), 0.5), Some(Touch::Edge(0.25)));
    }
}
