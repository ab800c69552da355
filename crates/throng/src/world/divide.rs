//! A world as one of a division.

use super::snapshot::SavedWorld;
use super::{State, World, fnv_1a};
use crate::halo::Halo;
use crate::summary::Tally;
use crate::{Error, Obstacle, Stage};
use glam::Vec2;

impl World {
    /// As [`step_in_stages`](Self::step_in_stages), beside the other worlds of a division.
    pub(crate) fn step_beside(&mut self, halo: &mut dyn Halo, ended: impl FnMut(Stage)) {
        self.step.run(&mut self.state, halo, ended);
        self.play();
    }

    /// Returns a hash of everything that the world has been built with.
    pub(crate) fn built(&self) -> u64 {
        fnv_1a(self.save().into_iter())
    }

    /// Returns a hash of everything that the world has been built with, apart from the agents that are present.
    pub(crate) fn built_for_agents(&self) -> u64 {
        let state = self.saved_for_agents();
        // where a walkable area bounds the ground, any box will do
        let extent = state.extent.filter(|_| self.state.is_open_with_walls());
        fnv_1a(SavedWorld { extent, ..state }.bytes().into_iter())
    }

    /// Adds the agents of a saved world of the same division.
    ///
    /// # Errors
    /// [`Error::Snapshot`] if the bytes are not a saved state or are damaged, or if the state is of another step.
    pub(crate) fn load_agents(&mut self, bytes: &[u8]) -> Result<(), Error> {
        let part = SavedWorld::read(bytes)?;
        let state = &mut self.state;
        if (part.steps, &part.settings) != (state.steps, &state.settings) {
            let why = format!("it was saved after {} steps, the other parts after {}", part.steps, state.steps);
            return Err(Error::Snapshot { why });
        }
        state.reserve(part.agents.len());
        for row in 0..part.agents.len() {
            state.put_copy(part.agents.copy(row));
        }
        state.slots.next_number = state.slots.next_number.max(part.slots.next_number);
        state.tally.merge(&part.tally);
        state.stranded.extend(part.stranded);
        state.stranded.sort_by_key(|&(number, _)| number);
        state.prepare_all_meshes();
        Ok(())
    }

    /// Makes the world one of a division: keeps the agents on its own ground. Statistics of the run so far stay in the
    /// `first` world.
    pub(crate) fn keep_own(&mut self, owns: impl Fn(Vec2) -> bool, first: bool) {
        let Self { state, step } = self;
        state.others.are_there = true;
        for row in (0..state.agents.len()).rev() {
            if !owns(state.agents.position[row]) {
                step.remove(state, row);
            }
        }
        if !first {
            state.tally = Tally { sub_steps: state.tally.sub_steps, ..Tally::default() };
        }
    }

    /// Checks an obstacle that is added in all worlds of a division.
    pub(crate) fn check_shared_obstacle(&self, obstacle: &Obstacle) -> Result<(), Error> {
        self.state.check_obstacle(obstacle)
    }
}

impl State {
    /// Whether there are obstacles on ground that no walkable area bounds.
    pub(crate) fn is_open_with_walls(&self) -> bool {
        self.place.areas.is_empty() && self.place.obstacles().next().is_some()
    }

    /// Returns the greatest distance within which the agents of a group read other agents before they move, metres.
    pub(crate) fn range_of(&self, group: usize) -> f32 {
        let group = &self.local_groups[group];
        let around = group.guidance.field.iter().flat_map(|field| &field.around);
        around.map(|around| around.reach).fold(group.neighbour_distance, f32::max)
    }
}
