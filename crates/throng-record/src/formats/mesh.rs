//! The place as triangles.

use super::place::corners;
use crate::Setting;
use earcut::Earcut;
use glam::{DVec2, Vec3};
use throng::Obstacle;

/// Height at which obstacles are shown, metres.
const HEIGHT: f32 = 1.0;
/// Margin of the ground around the agents where the walkable area is unbounded, metres.
const ROUND: f64 = 1.0;

/// Triangles over points, counter-clockwise seen from outside, metres from the origin of the setting.
#[derive(Debug, Default)]
pub(super) struct Mesh {
    pub(super) points: Vec<Vec3>,
    pub(super) triangles: Vec<[u32; 3]>,
}

/// Returns the walkable areas; if there are none, a rectangle around the agents.
pub(super) fn ground(setting: &Setting, seen: [DVec2; 2]) -> Mesh {
    let mut mesh = Mesh::default();
    for area in &setting.walkable {
        let rings: Vec<&[DVec2]> = std::iter::once(&area.outer).chain(&area.holes).map(Vec::as_slice).collect();
        mesh.flat(&rings, 0.0, setting.origin);
    }
    if setting.walkable.is_empty() && seen[0].is_finite() {
        let [low, high] = [seen[0] - ROUND, seen[1] + ROUND];
        mesh.flat(&[&[low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)]], 0.0, setting.origin);
    }
    mesh
}

/// Returns the obstacles, 1 m high; walls are thin.
pub(super) fn solids(setting: &Setting) -> Mesh {
    let mut mesh = Mesh::default();
    for obstacle in &setting.obstacles {
        let mut corners = corners(obstacle);
        let closed = !matches!(obstacle, Obstacle::Wall { .. });
        if closed {
            if area(&corners) < 0.0 {
                corners.reverse();
            }
            mesh.flat(&[&corners], HEIGHT, setting.origin);
            corners.extend(corners.first().copied());
        }
        corners.windows(2).for_each(|ends| mesh.upright(ends, setting.origin));
    }
    mesh
}

/// Returns twice the area of a polygon; negative for clockwise corners.
fn area(corners: &[DVec2]) -> f64 {
    corners.iter().zip(corners.iter().cycle().skip(1)).map(|(a, b)| a.perp_dot(*b)).sum()
}

impl Mesh {
    /// Adds a polygon with holes, seen from above.
    fn flat(&mut self, rings: &[&[DVec2]], height: f32, origin: DVec2) {
        let first = self.points.len() as u32;
        let places: Vec<[f64; 2]> = rings.iter().flat_map(|ring| *ring).map(|p| (p - origin).to_array()).collect();
        let holes = rings[..rings.len() - 1].iter().scan(0u32, |at, ring| {
            *at += ring.len() as u32;
            Some(*at)
        });
        let holes: Vec<u32> = holes.collect();
        let mut triangles: Vec<u32> = Vec::new();
        Earcut::new().earcut(places.iter().copied(), &holes, &mut triangles);
        self.points.extend(places.iter().map(|&[x, y]| Vec3::new(x as f32, y as f32, height)));
        let corner = |at: u32| DVec2::from(places[at as usize]);
        for three in triangles.chunks_exact(3) {
            let [a, b, c] = [three[0], three[1], three[2]];
            let up = (corner(b) - corner(a)).perp_dot(corner(c) - corner(a)) >= 0.0;
            self.triangles.push(if up { [a, b, c] } else { [a, c, b] }.map(|at| first + at));
        }
    }

    /// Adds a wall between two points; the solid side lies to its left.
    fn upright(&mut self, ends: &[DVec2], origin: DVec2) {
        let first = self.points.len() as u32;
        let [from, to] = [ends[0], ends[1]].map(|p| (p - origin).as_vec2());
        self.points.extend([from.extend(0.0), to.extend(0.0), to.extend(HEIGHT), from.extend(HEIGHT)]);
        self.triangles.extend([[0, 1, 2], [0, 2, 3]].map(|three| three.map(|at| first + at)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use throng::Walkable;

    fn square(low: f64, high: f64) -> Vec<DVec2> {
        [(low, low), (low, high), (high, high), (high, low)].map(DVec2::from).to_vec()
    }

    fn covered(mesh: &Mesh) -> Vec3 {
        let corner = |at: u32| mesh.points[at as usize];
        let half = |&[a, b, c]: &[u32; 3]| (corner(b) - corner(a)).cross(corner(c) - corner(a)) * 0.5;
        mesh.triangles.iter().map(half).sum()
    }

    #[test]
    fn the_ground_looks_up_and_has_its_holes() {
        let walkable = vec![Walkable { outer: square(5.0, 15.0), holes: vec![square(6.0, 8.0)] }];
        let setting = Setting { walkable, origin: DVec2::splat(5.0), ..Setting::default() };
        let mesh = ground(&setting, [DVec2::ZERO; 2]);
        assert!((covered(&mesh) - Vec3::Z * 96.0).length() < 1e-3);
        let mesh = ground(&Setting::default(), [DVec2::ZERO, DVec2::ONE]);
        assert_eq!(covered(&mesh), Vec3::Z * 9.0);
        assert!(ground(&Setting::default(), [DVec2::INFINITY, DVec2::NEG_INFINITY]).points.is_empty());
    }

    #[test]
    fn solids_have_a_top_and_sides() {
        let points = vec![DVec2::ZERO, DVec2::X];
        let obstacles = vec![Obstacle::Polygon { corners: square(1.0, 3.0) }, Obstacle::Wall { points }];
        let mesh = solids(&Setting { obstacles, ..Setting::default() });
        // the sides of a closed solid sum to zero
        assert!((covered(&mesh) - Vec3::Z * 4.0 + Vec3::Y).length() < 1e-5, "{}", covered(&mesh));
        assert_eq!((mesh.points.len(), mesh.triangles.len()), (4 + 5 * 4, 2 + 5 * 2));
    }
}
