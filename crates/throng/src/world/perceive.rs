//! 1. Who is near: how finely to divide the step, and the nearest neighbours of everybody.

use super::World;
use crate::perceive::Near;
use crate::{SubSteps, parallel};

/// Part of the smallest radius that anybody moves in a sub-step at most, where nobody is near, and in a crowd.
const FREE_MOVE: f32 = 0.25;
const CROWD_MOVE: f32 = 0.125;

impl World {
    /// Into how many sub-steps the next step is divided.
    pub(super) fn sub_steps(&mut self) -> u32 {
        let parts = match self.settings.sub_steps {
            SubSteps::Fixed(parts) => return parts,
            SubSteps::Auto => {
                let agents = &self.agents;
                let smallest = agents.radius.iter().copied().fold(f32::INFINITY, f32::min);
                let fastest = agents.max_speed.iter().copied().fold(0.0, f32::max);
                let part = if self.is_crowded() { CROWD_MOVE } else { FREE_MOVE };
                // an empty or motionless world: 0 / inf or 0 / x
                (self.settings.step as f32 * fastest / (part * smallest) - 1e-3).ceil()
            }
        };
        (parts as u32).clamp(1, 10_000)
    }

    /// Whether any two bodies are within a body's width of each other.
    fn is_crowded(&mut self) -> bool {
        let agents = &self.agents;
        let widest = agents.radius.iter().copied().fold(0.0, f32::max) * 2.0;
        self.step.grid.rebuild(&agents.position, &agents.number, widest.max(0.1) * 2.0);
        let grid = &self.step.grid;
        (0..agents.len()).any(|row| {
            let mut near = 0;
            grid.within(agents.position[row], widest * 2.0, |_| near += 1);
            near > 1
        })
    }

    /// 1. Who is near: the nearest neighbours of everybody.
    pub(super) fn perceive(&mut self) {
        let Self { agents, groups, step, .. } = self;
        let widest = agents.radius.iter().copied().fold(0.1, f32::max);
        step.grid.rebuild(&agents.position, &agents.number, widest * 5.0);
        step.most_neighbours = groups.iter().map(|group| group.neighbours).max().unwrap_or(1);
        step.neighbours.resize(agents.len() * step.most_neighbours, Near::default());
        let grid = &step.grid;
        parallel::rows(&mut step.neighbours, step.most_neighbours, Vec::new, |found, row, places| {
            let group = &groups[agents.group[row].index()];
            let accept = |near: &Near| near.row as usize != row && agents.avoids(row, near.row as usize);
            let at = agents.position[row];
            grid.nearest(at, group.neighbours, group.neighbour_distance, accept, found);
            places[..found.len()].copy_from_slice(found);
            if let Some(end) = places.get_mut(found.len()) {
                // marks the end: nobody is their own neighbour
                *end = Near { row: row as u32, ..Near::default() };
            }
        });
    }

    pub(super) fn neighbours(&self, row: usize) -> &[Near] {
        let most = self.step.most_neighbours;
        let places = &self.step.neighbours[row * most..(row + 1) * most];
        let count = places.iter().position(|near| near.row as usize == row).unwrap_or(most);
        &places[..count]
    }
}
