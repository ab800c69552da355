//! A world as one of a division.

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

    /// Returns a hash of everything that the world has been built with, but its agents.
    pub(crate) fn built_around_agents(&mut self) -> u64 {
        let agents = (std::mem::take(&mut self.state.agents), std::mem::take(&mut self.state.slots));
        let hash = self.built();
        (self.state.agents, self.state.slots) = agents;
        hash
    }

    /// Returns the number of the next agent without a number of its own.
    pub(crate) fn next_number(&self) -> u64 {
        self.state.slots.next_number.into()
    }

    /// Makes the world one of a division, with all its agents. The next agent has this number.
    pub(crate) fn be_part(&mut self, next_number: u64) {
        self.state.others.are_there = true;
        self.state.slots.next_number = next_number as u32;
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
