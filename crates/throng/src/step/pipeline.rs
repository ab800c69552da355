//! The pipeline: the only file that knows all stages.
//!
//! A stage owns its memory. It reads the state and the results of earlier stages, and returns its own result. Data flows
//! forward only.

use super::Stage;
use super::measure::Measure;
use crate::avoid::Avoid;
use crate::guard::{KeepApart, PASSES};
use crate::halo::{Alone, Border, Halo, Link};
use crate::intend::{Intend, ProgressCheck};
use crate::moving::Move;
use crate::navigate::Navigate;
use crate::perceive::{Perceive, SubStep};
use crate::sleep::SleepBlocks;
use crate::world::State;

/// All stages of a step.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pipeline {
    pub sleep: SleepBlocks,
    pub perceive: Perceive,
    pub navigate: Navigate,
    pub intend: Intend,
    pub avoid: Avoid,
    pub guard: KeepApart,
    progress: ProgressCheck,
    motion: Move,
    measure: Measure,
    border: Border,
}

impl Pipeline {
    /// Advances the state by one step, beside the worlds of a halo. Calls `ended` at the end of each stage of each
    /// sub-step.
    pub fn run(&mut self, state: &mut State, halo: &mut dyn Halo, mut ended: impl FnMut(Stage)) {
        state.events.clear();
        let parts = self.begin(state, halo);
        state.adapt(halo);
        for part in 0..parts {
            self.sub_step(state, halo, SubStep::new(state, part, parts), true, &mut ended);
        }
        state.sort_events();
        state.steps += 1;
    }

    /// Runs the first sub-step of the next step, without its motion.
    pub fn decide(&mut self, state: &mut State) -> SubStep {
        let parts = self.begin(state, &mut Alone);
        let of = SubStep::new(state, 0, parts);
        self.sleep.end();
        self.sub_step(state, &mut Alone, of, false, |_| ());
        of
    }

    /// Lets agents change their world, and scheduled agents enter. Returns the number of sub-steps of the next step.
    fn begin(&mut self, state: &mut State, halo: &mut dyn Halo) -> u32 {
        let Self { sleep, perceive, border, .. } = self;
        border.migrate(state, halo);
        state.enter(halo);
        perceive.sort_rows_of_part(state, sleep);
        border.sub_steps(state, halo)
    }

    /// Runs a sub-step; without its motion unless `moves`.
    fn sub_step(
        &mut self,
        state: &mut State,
        halo: &mut dyn Halo,
        of: SubStep,
        moves: bool,
        mut ended: impl FnMut(Stage),
    ) {
        let Self { sleep, perceive, navigate, intend, avoid, guard, progress, motion, measure, border } = self;
        border.begin(state, navigate.count_arrivals(state), halo, of.seconds);
        state.note_groups();
        sleep.fall_asleep(state, of.seconds, PASSES, |block| measure.no_overlap(block));

        let seen = perceive.run(state, sleep, of);
        ended(Stage::Perceive);

        let shown = navigate.run(state, seen, sleep, halo, of);
        border.exchange_ways(state, shown, halo);
        let shown = &*shown;
        let intended = intend.run(state, (seen, shown), sleep, of, &mut Link { border: &*border, halo: &mut *halo });
        border.exchange_velocities(state, intended.preferred, halo);
        border.exchange_plans(state, intended.planned, halo);
        ended(Stage::Intend);

        let chosen = avoid.run(state, (seen, shown), intended.preferred, sleep, of);
        border.exchange_velocities(state, chosen, halo);
        ended(Stage::Avoid);

        sleep.include_ghosts();
        let link = &mut Link { border, halo };
        let safe = guard.run(state, seen, (intended.facing(), chosen), sleep, of, link);
        ended(Stage::Guard);
        if !moves {
            return;
        }

        progress.run(state, (seen, shown), of);
        let close_pairs = intended.close_pairs;
        motion.run(state, shown, intended, (chosen, safe), sleep, of);
        measure.run(state, seen, safe, close_pairs, sleep);
        let gone = navigate.arrive(state, seen, sleep, of);
        border.drop_ghosts(state);
        for &row in gone {
            state.end_trip(row);
            intend.remove(row);
            remove(state, sleep, row);
        }
        ended(Stage::Move);
    }

    /// Sorts the rows by their position on the ground.
    pub fn sort_rows(&mut self, state: &mut State) {
        self.perceive.sort_rows(state, &mut self.sleep);
    }

    /// Records that something has changed that agents which sleep depend on.
    pub fn wake(&mut self) {
        self.sleep.end();
    }

    /// Removes an agent between two steps.
    pub fn remove(&mut self, state: &mut State, row: usize) {
        remove(state, &mut self.sleep, row);
    }

    /// Forgets what depends on obstacles and walkable areas.
    pub fn place_changed(&mut self) {
        self.navigate.place_changed();
        self.sleep.end();
    }
}

fn remove(state: &mut State, sleep: &mut SleepBlocks, row: usize) {
    sleep.remove(row, state.agents.len() - 1, state.agents.position[row]);
    state.remove_row(row);
}
