//! 1. Who is near: how finely to divide the step, and the nearest neighbours of everybody.

use super::World;
use crate::agent::Columns;
use crate::perceive::{Grid, Near};
use crate::{SubSteps, parallel};

/// Part of the smallest radius (half of the narrower side of who is no disc) that anybody moves in a sub-step at most, where nobody is near, and in a crowd.
const FREE_MOVE: f32 = 0.25;
const CROWD_MOVE: f32 = 0.125;

impl World {
    /// Into how many sub-steps the next step is divided.
    pub(super) fn sub_steps(&mut self) -> u32 {
        let parts = match self.settings.sub_steps {
            SubSteps::Fixed(parts) => return parts,
            SubSteps::Auto => {
                let agents = &self.agents;
                let smallest = (0..agents.len()).map(|row| agents.body(row).girth()).fold(f32::INFINITY, f32::min);
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
        let widest = (0..agents.len()).map(|row| agents.body(row).bound()).fold(0.0, f32::max) * 2.0;
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
        step.long.rebuild(agents, widest * 5.0);
        step.most_neighbours = groups.iter().map(|group| group.neighbours).max().unwrap_or(1);
        step.neighbours.resize(agents.len() * step.most_neighbours, Near::default());
        let (grid, long) = (&step.grid, &step.long);
        parallel::rows(&mut step.neighbours, step.most_neighbours, Vec::new, |found, row, places| {
            let group = &groups[agents.group[row].index()];
            let accept = |near: &Near| near.row as usize != row && agents.avoids(row, near.row as usize);
            let at = agents.position[row];
            grid.nearest(at, group.neighbours, group.neighbour_distance, accept, found);
            if !long.rows.is_empty() {
                long.add(agents, grid, row, (group.neighbours, group.neighbour_distance), accept, found);
            }
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

/// Bodies that are no discs: they may be near with their centres far.
#[derive(Debug, Default)]
pub(super) struct Long {
    rows: Vec<usize>,
    grid: Grid,
    /// Greatest distance of a point of a core from its centre.
    reach: f32,
}

impl Long {
    fn rebuild(&mut self, agents: &Columns, cell: f32) {
        self.rows.clear();
        self.rows.extend((0..agents.len()).filter(|&row| !agents.is_disc(row)));
        self.reach = self.rows.iter().map(|&row| agents.core[row].length()).fold(0.0, f32::max);
        let points: Vec<_> = self.rows.iter().map(|&row| agents.position[row]).collect();
        let numbers: Vec<_> = self.rows.iter().map(|&row| agents.number[row]).collect();
        self.grid.rebuild(&points, &numbers, cell);
    }

    /// Puts bodies into `found`, the discs nearest to `row` by their centres, where their cores are nearer: the `k`
    /// nearest within `range` by the distance of cores.
    fn add(
        &self,
        agents: &Columns,
        grid: &Grid,
        row: usize,
        (k, range): (usize, f32),
        accept: impl Fn(&Near) -> bool,
        found: &mut Vec<Near>,
    ) {
        let at = agents.position[row];
        if agents.is_disc(row) {
            found.retain(|near| agents.is_disc(near.row as usize));
            self.grid.within(at, range + self.reach, |near| {
                found.push(Near { row: self.rows[near.row as usize] as u32, ..near });
            });
        } else {
            found.clear();
            grid.within(at, range + self.reach + agents.core[row].length(), |near| found.push(near));
        }
        found.retain(accept);
        for near in &mut *found {
            near.distance_squared = agents.offset(row, near.row as usize).length_squared();
        }
        found.retain(|near| near.distance_squared <= range * range);
        found.sort_unstable_by(|a, b| a.distance_squared.total_cmp(&b.distance_squared).then(a.number.cmp(&b.number)));
        found.truncate(k);
    }
}
