//! Agents that choose velocities, and their surroundings, with one agent in each element of arrays.

use super::HalfPlane;
use crate::simd::{LANES, set};
use fearless_simd::Level;

/// Maximum number of neighbours of an agent that SIMD takes.
pub const MOST_SIMD_NEIGHBOURS: usize = crate::perceive::FEW_NEIGHBOURS;
/// Maximum number of half-planes of walls of an agent that SIMD takes.
pub(super) const MOST_WALLS: usize = 8;

/// The agents of a batch and their surroundings; see [`AvoidanceInput`](super::AvoidanceInput). All are discs on the
/// ground. Each array has an element for each agent.
#[derive(Clone, Debug)]
pub struct SimdInput {
    /// The agents to choose for, one bit for each. The other elements are meaningless.
    pub agents: u64,
    /// Positions, x and y, metres.
    pub position: [[f32; LANES]; 2],
    /// Velocities, m/s.
    pub velocity: [[f32; LANES]; 2],
    /// Preferred velocities, m/s.
    pub preferred: [[f32; LANES]; 2],
    /// Top speeds, m/s.
    pub max_speed: [f32; LANES],
    /// Seconds until the agents choose again.
    pub step: f32,
    /// The greatest number of neighbours of an agent.
    pub most: usize,
    /// The agents that have a first neighbour, a second, ..., one bit for each.
    pub there: [u64; MOST_SIMD_NEIGHBOURS],
    /// The first neighbour of each agent, the second, ...
    pub neighbours: [SimdNeighbour; MOST_SIMD_NEIGHBOURS],
    /// The chosen velocities, m/s.
    pub chosen: [[f32; LANES]; 2],
    /// The first half-plane of walls of each agent, the second, ...; at most [`MOST_WALLS`].
    pub(super) walls: Vec<Permitted>,
    pub(super) level: Level,
}

/// One half-plane of walls per agent.
#[derive(Clone, Debug)]
pub(super) struct Permitted {
    pub point: [[f32; LANES]; 2],
    pub direction: [[f32; LANES]; 2],
    /// The agents that have it, one bit for each.
    pub there: u64,
}

/// One neighbour per agent; see [`AvoidanceNeighbour`](super::AvoidanceNeighbour).
#[derive(Clone, Copy, Debug)]
pub struct SimdNeighbour {
    /// Position and velocity of the neighbour: x, y, vx, vy.
    pub motion: [[f32; 4]; LANES],
    /// Sum of the two radii, with the margin that the model keeps, metres.
    pub radii: [f32; LANES],
    /// The agent's share of the avoidance, 0 to 1. Its fraction of the free room is 1 less this.
    pub share: [f32; LANES],
    /// Direction of the neighbour's path, where the interaction rules need it.
    pub(super) way: [[f32; LANES]; 2],
}

impl Default for SimdInput {
    fn default() -> Self {
        let none = [[0.0; LANES]; 2];
        let neighbour =
            SimdNeighbour { motion: [[0.0; 4]; LANES], radii: [0.0; LANES], share: [0.5; LANES], way: none };
        Self {
            agents: 0,
            position: none,
            velocity: none,
            preferred: none,
            max_speed: [0.0; LANES],
            step: 0.0,
            most: 0,
            there: [0; MOST_SIMD_NEIGHBOURS],
            neighbours: [neighbour; MOST_SIMD_NEIGHBOURS],
            chosen: none,
            walls: Vec::with_capacity(MOST_WALLS),
            level: Level::baseline(),
        }
    }
}

impl SimdInput {
    /// Sets the sums of radii of all pairs.
    pub(super) fn set_radii(&mut self, radii: f32) {
        self.neighbours.iter_mut().for_each(|neighbour| neighbour.radii = [radii; LANES]);
    }

    /// Adds the half-planes of walls of one agent. Returns false if they are too many.
    pub(super) fn permit(&mut self, lane: usize, lines: &[HalfPlane]) -> bool {
        if lines.len() > MOST_WALLS {
            return false;
        }
        for (index, line) in lines.iter().enumerate() {
            if index == self.walls.len() {
                self.walls.push(Permitted { point: [[0.0; LANES]; 2], direction: [[0.0; LANES]; 2], there: 0 });
            }
            let all = &mut self.walls[index];
            set(&mut all.point, lane, line.point);
            set(&mut all.direction, lane, line.direction);
            all.there |= 1 << lane;
        }
        true
    }
}
