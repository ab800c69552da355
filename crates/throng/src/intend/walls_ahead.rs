//! The walls that an agent takes into account when it looks ahead.

use crate::space::{VisitedWalls, Wall, Walls, is_between, time_to_disc, time_to_segment};
use glam::{DVec2, Vec2};

/// Distance by which an agent may come nearer to a wall than it is, where it has less space than it prefers, metres.
const NEARER: f32 = 0.01;

/// The walls near an agent: scratch memory of a thread.
#[derive(Clone, Debug, Default)]
pub(super) struct WallsAhead {
    met: VisitedWalls,
    /// Whether the walls near the present agent have been found; and the distance of the nearest wall from its centre.
    found: bool,
    nearest: f32,
    /// Distances of the edges from the agent's centre, and their ends relative to it.
    edges: Vec<(f32, Vec2, Vec2)>,
    /// Centres of the discs relative to the agent's centre, and their radii.
    discs: Vec<(Vec2, f32)>,
    /// Distance that the agent's centre keeps from walls, metres.
    clearance: f32,
}

impl WallsAhead {
    /// Finds the walls within a range of `at`, unless they were found since the last `forget`.
    #[inline]
    pub fn find(&mut self, walls: &Walls, at: DVec2, range: impl FnOnce() -> f32) {
        if !self.found {
            self.found = true;
            self.find_within(walls, at, range());
        }
    }

    fn find_within(&mut self, walls: &Walls, at: DVec2, range: f32) {
        let Self { met, nearest, edges, discs, .. } = self;
        *nearest = range;
        edges.clear();
        discs.clear();
        walls.visit_once(at, f64::from(range), met, |wall| match wall {
            Wall::Edge(edge) => {
                let start = (edge.start - at).as_vec2();
                // an edge seen from behind is hidden by the solid it bounds
                if edge.direction.perp_dot(start) < 0.0 {
                    return;
                }
                let distance = edge.nearest(at).distance(at) as f32;
                if distance <= range {
                    *nearest = nearest.min(distance);
                    edges.push((distance, start, (edge.end - at).as_vec2()));
                }
            }
            Wall::Disc(disc) => {
                let (center, radius) = ((disc.center - at).as_vec2(), disc.radius as f32);
                let distance = center.length() - radius;
                if distance <= range {
                    *nearest = nearest.min(distance);
                    discs.push((center, radius));
                }
            }
        });
    }

    /// Forgets the walls near the previous agent.
    pub fn forget(&mut self) {
        self.found = false;
    }

    /// Sets the distance that the agent's centre keeps from walls, limited to its present distance.
    pub fn keep(&mut self, clearance: f32) {
        self.clearance = clearance.min(self.nearest - NEARER).max(0.0);
    }

    /// Whether an edge lies between the agent and the point at `offset`.
    pub fn hide(&self, offset: Vec2) -> bool {
        if self.edges.is_empty() {
            return false;
        }
        let reach = offset.length();
        self.edges.iter().any(|&(distance, start, end)| distance < reach && is_between(start, end, offset))
    }

    /// Returns the seconds until an agent with this velocity meets a wall, at most `most`.
    pub fn time(&self, velocity: Vec2, most: f32) -> f32 {
        let (clearance, speed) = (self.clearance, velocity.length());
        let discs = self.discs.iter().map(|&(center, radius)| time_to_disc(center, velocity, radius + clearance));
        let mut time = discs.fold(most, f32::min);
        for &(distance, start, end) in &self.edges {
            if distance - clearance < speed * time {
                time = time.min(time_to_segment(start, end, velocity, clearance));
            }
        }
        time
    }
}
