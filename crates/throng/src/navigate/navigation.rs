//! Stage 2a, navigation: the paths of all agents, and their arrivals.

use super::arrivals::Arrivals;
use super::fill::Lattices;
use super::{NeighbourData, RouteProgress};
use crate::agent::Status;
use crate::halo::Halo;
use crate::perceive::{Perceived, SubStep};
use crate::sleep::SleepBlocks;
use crate::world::State;

/// 2a. Navigation: keeps the agents on their paths, and publishes what their neighbours know of these.
#[derive(Clone, Debug, Default)]
pub(crate) struct Navigate {
    pub(super) shown: Vec<NeighbourData>,
    pub(super) arrivals: Arrivals,
    /// Whether the status of any agent may change in this sub-step.
    pub(super) any_may_change: bool,
    /// Standing places in goal areas.
    pub(super) lattices: Lattices,
    /// Rows with a status that may change, with their next status.
    pub(super) changes: Vec<(usize, Status)>,
    /// Rows of agents that leave the world at an exit.
    pub(super) gone: Vec<usize>,
}

impl Navigate {
    /// Updates the paths of all agents, after [arrivals](Self::count_arrivals) are counted, in the sub-step that ends at `now`. In the first sub-step of a step the agents that
    /// are due choose among goals. Returns what its neighbours know of each agent, by row.
    pub fn run(
        &mut self,
        state: &mut State,
        seen: Perceived<'_>,
        sleep: &SleepBlocks,
        halo: &mut dyn Halo,
        of: SubStep,
    ) -> &mut [NeighbourData] {
        self.plan(state, seen.near, sleep, halo, of);
        if of.first {
            self.choose(state, seen.near, of.seconds);
        }
        &mut self.shown
    }

    /// Returns what its neighbours know of each agent, by row, as of the last sub-step.
    pub fn shown(&self) -> &[NeighbourData] {
        &self.shown
    }

    /// Forgets what depends on obstacles and walkable areas.
    pub fn place_changed(&mut self) {
        self.lattices.clear();
    }
}

impl State {
    /// Lends the progress of all journeys to be changed, while all else is read.
    pub(crate) fn with_travel<R>(&mut self, work: impl FnOnce(&Self, &mut Vec<RouteProgress>) -> R) -> R {
        let mut travels = std::mem::take(&mut self.agents.travel);
        let result = work(self, &mut travels);
        self.agents.travel = travels;
        result
    }
}
