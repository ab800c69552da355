//! Oracles: point in polygon by crossings, visibility by cutting a segment at every edge, shortest paths by Dijkstra on
//! the complete visibility graph.

use glam::DVec2;
pub use throng::random::SplitMix64 as Dice;
use throng::{Obstacle, Walkable};

/// A rotated and moved room with obstacles of all kinds.
pub struct Scene {
    pub walkable: Vec<Walkable>,
    pub obstacles: Vec<Obstacle>,
    low: DVec2,
    high: DVec2,
    origin: DVec2,
    angle: f64,
}

impl Scene {
    pub fn random(seed: u64) -> Self {
        let mut rng = Dice(seed * 7919 + 13);
        let size = DVec2::new(rng.between(6.0, 14.0), rng.between(5.0, 10.0));
        let (origin, angle) = match seed % 3 {
            0 => (DVec2::ZERO, 0.0),
            1 => (DVec2::new(-1800.0, -90.0), rng.between(0.0, 6.0)),
            _ => (DVec2::new(3.0, 1800.5), 0.25),
        };
        let mut scene = Self { walkable: vec![], obstacles: vec![], low: DVec2::ZERO, high: size, origin, angle };
        let corners = [DVec2::ZERO, DVec2::new(size.x, 0.0), size, DVec2::new(0.0, size.y)].map(|p| scene.place(p));
        scene.walkable.push(Walkable { outer: corners.to_vec(), holes: vec![] });
        for _ in 0..3 + (seed % 5) {
            let at = rng.point(DVec2::ZERO, size);
            let obstacle = match (rng.unit() * 4.0) as u32 {
                0 => Obstacle::Circle { center: scene.place(at), radius: rng.between(0.1, 0.8) },
                1 => {
                    let sides = DVec2::new(rng.between(0.2, 2.5), rng.between(0.2, 2.5));
                    let turned = if seed.is_multiple_of(2) { 0.0 } else { rng.between(0.0, 3.0) };
                    Obstacle::rectangle(scene.place(at), sides, turned)
                }
                2 => {
                    let to = rng.point(DVec2::ZERO, size);
                    let on = rng.point(DVec2::ZERO, size);
                    Obstacle::Wall {
                        points: vec![scene.place(at), scene.place(at.lerp(to, 0.5)), scene.place(at.lerp(on, 0.3))],
                    }
                }
                _ => {
                    let star = (0..7).map(|k| {
                        let reach = if k % 2 == 0 { rng.between(0.5, 1.3) } else { rng.between(0.2, 0.5) };
                        scene.place(at + DVec2::from_angle(k as f64 * std::f64::consts::TAU / 7.0) * reach)
                    });
                    Obstacle::Polygon { corners: star.collect() }
                }
            };
            scene.obstacles.push(obstacle);
        }
        scene
    }

    pub fn place(&self, at: DVec2) -> DVec2 {
        self.origin + DVec2::from_angle(self.angle).rotate(at)
    }

    pub fn point(&self, rng: &mut Dice) -> DVec2 {
        self.place(rng.point(self.low, self.high))
    }
}

/// Distance from a point to the nearest wall of the input; negative inside an obstacle or off the ground.
pub fn clearance(walkable: &[Walkable], obstacles: &[Obstacle], at: DVec2) -> f64 {
    let mut least = f64::INFINITY;
    for ground in walkable {
        let rings: Vec<_> = std::iter::once(&ground.outer).chain(&ground.holes).cloned().collect();
        let distance = to_edges(&rings, at);
        least = least.min(if inside(&rings, at) { distance } else { -distance });
    }
    for obstacle in obstacles {
        least = least.min(match obstacle {
            Obstacle::Circle { center, radius } => at.distance(*center) - radius,
            Obstacle::Polygon { corners } => {
                let ring = [corners.clone()];
                let distance = to_edges(&ring, at);
                if inside(&ring, at) { -distance } else { distance }
            }
            Obstacle::Wall { points } => {
                points.windows(2).map(|ends| to_segment(ends[0], ends[1], at)).fold(f64::INFINITY, f64::min)
            }
        });
    }
    least
}

fn to_segment(a: DVec2, b: DVec2, at: DVec2) -> f64 {
    let along = b - a;
    let part = ((at - a).dot(along) / along.length_squared().max(1e-300)).clamp(0.0, 1.0);
    at.distance(a + along * part)
}

fn edges(rings: &[Vec<DVec2>]) -> impl Iterator<Item = (DVec2, DVec2)> + '_ {
    rings.iter().flat_map(|ring| (0..ring.len()).map(move |k| (ring[k], ring[(k + 1) % ring.len()])))
}

pub fn to_edges(rings: &[Vec<DVec2>], at: DVec2) -> f64 {
    edges(rings).map(|(a, b)| to_segment(a, b, at)).fold(f64::INFINITY, f64::min)
}

/// Even-odd point in polygon.
pub fn inside(rings: &[Vec<DVec2>], at: DVec2) -> bool {
    edges(rings)
        .filter(|(a, b)| (a.y > at.y) != (b.y > at.y) && at.x < a.x + (b.x - a.x) * (at.y - a.y) / (b.y - a.y))
        .count()
        % 2
        == 1
}

/// The farthest distance of a segment's points outside of the polygon, at the midpoints between all its intersections
/// with edges.
pub fn leaves_by(rings: &[Vec<DVec2>], a: DVec2, b: DVec2) -> f64 {
    let along = b - a;
    let mut cuts = vec![0.0, 1.0];
    for (c, d) in edges(rings) {
        let (one, other) = (along.perp_dot(c - a), along.perp_dot(d - a));
        if (one > 0.0) != (other > 0.0) {
            let at = c + (d - c) * (one / (one - other));
            cuts.push((at - a).dot(along) / along.length_squared());
        }
        for end in [c, d] {
            if along.perp_dot(end - a).abs() < 1e-6 * along.length() {
                cuts.push((end - a).dot(along) / along.length_squared());
            }
        }
    }
    cuts.retain(|cut| (0.0..=1.0).contains(cut));
    cuts.sort_by(f64::total_cmp);
    let mut worst = 0.0_f64;
    for pair in cuts.windows(2) {
        let middle = a + along * ((pair[0] + pair[1]) * 0.5);
        if !inside(rings, middle) {
            worst = worst.max(to_edges(rings, middle));
        }
    }
    worst
}

/// The complete visibility graph, with Dijkstra's algorithm.
pub struct VisibilityGraph<'a> {
    rings: &'a [Vec<DVec2>],
    nodes: Vec<DVec2>,
    links: Vec<Vec<(usize, f64)>>,
}

impl<'a> VisibilityGraph<'a> {
    pub fn new(rings: &'a [Vec<DVec2>]) -> Self {
        let mut nodes = Vec::new();
        for ring in rings {
            for k in 0..ring.len() {
                let (u, v, w) = (ring[(k + ring.len() - 1) % ring.len()], ring[k], ring[(k + 1) % ring.len()]);
                if (v - u).perp_dot(w - v) <= 0.0 {
                    nodes.push(v);
                }
            }
        }
        let mut links = vec![Vec::new(); nodes.len()];
        for one in 0..nodes.len() {
            for other in 0..one {
                if leaves_by(rings, nodes[one], nodes[other]) < 1e-8 {
                    let length = nodes[one].distance(nodes[other]);
                    links[one].push((other, length));
                    links[other].push((one, length));
                }
            }
        }
        Self { rings, nodes, links }
    }

    /// Length of the shortest path.
    pub fn distance(&self, from: DVec2, to: DVec2) -> f64 {
        let sees = |a: DVec2, b: DVec2| leaves_by(self.rings, a, b) < 1e-8;
        if sees(from, to) {
            return from.distance(to);
        }
        let reach = |point: DVec2| -> Vec<f64> {
            self.nodes.iter().map(|&n| if sees(point, n) { n.distance(point) } else { f64::INFINITY }).collect()
        };
        let (mut best, last) = (reach(from), reach(to));
        let mut done = vec![false; self.nodes.len()];
        loop {
            let next = (0..done.len()).filter(|&n| !done[n]).min_by(|&a, &b| best[a].total_cmp(&best[b]));
            let Some(next) = next.filter(|&n| best[n].is_finite()) else { break };
            done[next] = true;
            for &(other, length) in &self.links[next] {
                best[other] = best[other].min(best[next] + length);
            }
        }
        best.iter().zip(last).map(|(one, other)| one + other).fold(f64::INFINITY, f64::min)
    }
}
