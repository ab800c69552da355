//! Batches of agents, and what all agents share while velocities are chosen.

use super::avoidance::{AvoidScratch, Avoiding};
use super::{AvoidanceInput, MOST_SIMD_NEIGHBOURS, SimdInput, Workspace, margin};
use crate::agent::Group;
use crate::intend::{Rows, Velocities, set};
use crate::navigate::Turn;
use crate::parallel::Parts;
use crate::simd::{LANES, ones};
use crate::world::State;
use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};
use glam::Vec2;
use std::ops::Range;
use std::sync::Arc;

/// What all agents share while their velocities are chosen, in a sub-step.
#[derive(Clone, Debug, Default)]
pub(crate) struct AvoidanceShared {
    /// The SIMD level, if batches can be gathered.
    pub level: Option<Level>,
    /// For each group the first group with the same model.
    models: Vec<u32>,
    /// Whether all agents have and need the same model.
    pub alike: bool,
    /// By row, whether a batch leaves the agent and all agents that see it to the scalar path; empty if it leaves none.
    irregular: Vec<bool>,
    /// Whether there are no walls.
    pub open: bool,
    /// The radius, if it is the same for all agents.
    pub radius: Option<f32>,
    /// Whether all agents have the same priority.
    pub equals: bool,
    /// Whether the agents of some groups squeeze past others, and whether those of all groups do.
    pub squeeze: bool,
    pub all_squeeze: bool,
    pub margin: f32,
    pub step: f32,
}

impl AvoidanceShared {
    /// Finds what all agents share.
    pub fn find(&mut self, state: &State, preferred: &Velocities, seconds: f32) {
        let agents = &state.agents;
        let groups = || state.groups_in_use();
        self.find_models(state);
        let all_avoid = self.find_irregular(state, preferred);
        self.level = state.instructions.level().filter(|_| all_avoid);
        self.open = state.walls.is_empty();
        self.radius = agents.radius.uniform();
        self.equals = agents.priority.uniform().is_some();
        self.squeeze = groups().any(Group::squeezes);
        self.all_squeeze = groups().all(Group::squeezes);
        self.margin = margin(seconds);
        self.step = seconds;
    }

    fn find_models(&mut self, state: &State) {
        let Self { models, alike, .. } = self;
        let groups = &state.local_groups;
        models.clear();
        for (index, group) in groups.iter().enumerate() {
            let is_same = |&other: &usize| {
                let other = &groups[other];
                Arc::ptr_eq(&other.model, &group.model) || group.model.is_same(&*other.model)
            };
            models.push((0..index).find(is_same).unwrap_or(index) as u32);
        }
        let mut used =
            models.iter().zip(&state.groups_with_agents).filter(|&(_, &in_use)| in_use).map(|(&model, _)| model);
        let first = used.next();
        *alike = first.is_some() && used.all(|model| Some(model) == first) && state.all_need_model();
    }

    /// Finds the irregular agents: all that are not discs on the ground. Returns whether all others avoid each other.
    fn find_irregular(&mut self, state: &State, preferred: &Velocities) -> bool {
        let State { agents, local_groups: groups, standoffs, .. } = state;
        let is_regular = |row: usize| {
            agents.core[row] == Vec2::ZERO
                && agents.script[row].is_none()
                && agents.spin[row] == 0.0
                && agents.tracking_error[row] == 0.0
                && agents.max_turn_rate[row] == f32::INFINITY
                && agents.altitude[row] == 0.0
                && agents.vertical_velocity[row] == 0.0
                && preferred.vertical_velocity(row) == 0.0
                && agents.travel[row].turn == Turn::Free
                && groups[agents.group[row].index()].neighbours <= MOST_SIMD_NEIGHBOURS
        };
        self.irregular.clear();
        let are_alike = agents.core.uniform().is_some()
            && agents.script.uniform().is_some()
            && agents.spin.uniform().is_some()
            && agents.tracking_error.uniform().is_some()
            && agents.max_turn_rate.uniform().is_some()
            && !state.in_space_now()
            && standoffs.is_empty()
            && state.groups_in_use().all(|group| group.neighbours <= MOST_SIMD_NEIGHBOURS);
        if are_alike && (agents.is_empty() || is_regular(0)) {
            return agents.all_avoid();
        }
        self.irregular.extend((0..agents.len()).map(|row| !is_regular(row)));
        let regular = (0..agents.len()).filter(|&row| !self.irregular[row]);
        let common = |(layers, avoids), row: usize| (layers & agents.layers[row], avoids & agents.avoids[row]);
        let (layers, avoids) = regular.fold((u32::MAX, u32::MAX), common);
        layers & avoids != 0
    }

    /// Whether any agent is irregular.
    pub fn any_irregular(&self) -> bool {
        !self.irregular.is_empty()
    }

    /// Whether an agent is irregular.
    pub fn is_irregular(&self, row: u32) -> bool {
        self.irregular.get(row as usize) == Some(&true)
    }

    /// Returns the number of agents in a batch.
    fn width(&self) -> usize {
        self.level.map_or(LANES, |level| dispatch!(level, simd => width(simd)))
    }
}

fn width<S: Simd>(_: S) -> usize {
    S::f32s::LEN
}

/// At most 16 agents with the same local model, near each other. Their velocities are chosen together.
pub struct AvoidanceBatch<'a> {
    pub(super) avoiding: &'a Avoiding<'a>,
    /// The index of the first row in the order of the grid.
    pub(super) start: usize,
    pub(super) rows: &'a [u32],
    /// The agents that have no velocity yet, one bit for each row.
    pub(super) left: u64,
    pub(super) scratch: &'a mut AvoidScratch,
    pub(super) chosen: &'a mut [Vec2],
}

impl std::fmt::Debug for AvoidanceBatch<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("AvoidanceBatch").field("agents", &self.left.count_ones()).finish_non_exhaustive()
    }
}

impl AvoidanceBatch<'_> {
    /// Chooses velocities with SIMD, one agent in each element of arrays: `choose` gets the gathered data and sets
    /// [`SimdInput::chosen`]. An agent that sees walls is added only if `walls` returns true for its index in the arrays
    /// and the input of the model, which has no neighbours yet.
    ///
    /// Some agents are never gathered, such as agents that fly or are not discs. These, and agents that `walls` or
    /// `choose` leave out, get the velocity of [`velocity_in_space`](super::LocalModel::velocity_in_space): both ways
    /// must give the same bits. `choose` leaves agents out by removing their bits from [`SimdInput::agents`].
    ///
    /// ```
    /// use glam::Vec2;
    /// use throng::avoid::{AvoidanceBatch, AvoidanceInput, LocalModel, Workspace};
    ///
    /// /// Takes the preferred velocity, at half of the speed.
    /// #[derive(Debug)]
    /// struct Half;
    ///
    /// impl LocalModel for Half {
    ///     fn velocity(&self, view: &AvoidanceInput<'_>, _: &mut Workspace) -> Vec2 {
    ///         view.preferred * 0.5
    ///     }
    ///
    ///     fn velocities(&self, batch: &mut AvoidanceBatch<'_>) {
    ///         let ignores_walls = |_: &mut _, _, _: &AvoidanceInput<'_>, _: &mut _| true;
    ///         batch.with_simd(ignores_walls, |input, _| {
    ///             input.chosen = input.preferred.map(|all| all.map(|component| component * 0.5));
    ///         });
    ///     }
    ///
    ///     fn wall_range(&self, radius: f32, _: f32) -> f32 {
    ///         radius
    ///     }
    /// }
    /// ```
    pub fn with_simd(
        &mut self,
        walls: impl FnMut(&mut SimdInput, usize, &AvoidanceInput<'_>, &mut Workspace) -> bool,
        choose: impl FnOnce(&mut SimdInput, &mut Workspace),
    ) {
        let Some(level) = self.avoiding.shared.level else { return };
        let mut agents = self.left;
        if self.avoiding.shared.any_irregular() {
            agents &= !rows_where(self.rows, |row| self.avoiding.shared.is_irregular(row));
        }
        // for few agents the scalar path is cheaper
        if 2 * agents.count_ones() as usize >= self.rows.len() {
            self.scratch.input.level = level;
            dispatch!(level, simd => self.gather(simd, agents));
            self.see_walls(walls);
            let given = self.scratch.input.agents;
            choose(&mut self.scratch.input, &mut self.scratch.workspace);
            self.scratch.input.agents &= given;
            dispatch!(level, simd => self.limit(simd));
        }
    }
}

impl Avoiding<'_> {
    /// Computes the chosen velocities of the agents in a range of the grid's order.
    pub(super) fn choose_many(&self, places: Range<usize>, scratch: &mut AvoidScratch, chosen: Rows<'_>) {
        let Self { state, shared, .. } = *self;
        if let Some(radius) = shared.radius {
            scratch.input.set_radii((radius + radius) * shared.margin);
        }
        let width = shared.width();
        let mut rest = chosen;
        for (start, rows) in places.clone().step_by(width).zip(self.grid.order()[places].chunks(width)) {
            let (mut chosen, later) = rest.split(rows.len());
            rest = later;
            // only agents on the ground are gathered
            chosen.1.all.fill(0.0);
            let all = u64::MAX >> (u64::BITS as usize - rows.len());
            let mut waiting = all;
            let mut left = 0;
            while waiting != 0 {
                let first = rows[waiting.trailing_zeros() as usize];
                let model = self.model_of(first);
                let same =
                    if shared.alike { all } else { rows_where(rows, |row| self.model_of(row) == model) & waiting };
                waiting &= !same;
                let of_first = state.model(first as usize);
                left |= if model.is_none() {
                    same
                } else if of_first.together().is_some() {
                    0
                } else {
                    let mut batch =
                        AvoidanceBatch { avoiding: self, start, rows, left: same, scratch, chosen: chosen.0 };
                    of_first.velocities(&mut batch);
                    batch.left
                };
            }
            for lane in ones(left) {
                let AvoidScratch { sight, workspace, .. } = scratch;
                set(&mut chosen, lane, self.choose_velocity(rows[lane] as usize, shared.step, sight, workspace));
            }
        }
    }

    /// Returns the first group with the model of an agent; `None` if the agent needs no model.
    pub(super) fn model_of(&self, row: u32) -> Option<u32> {
        let row = row as usize;
        self.state.needs_model(row).then(|| self.shared.models[self.state.agents.group[row].index()])
    }
}

/// Returns the rows for which a condition holds, one bit for each row.
fn rows_where(rows: &[u32], holds: impl Fn(u32) -> bool) -> u64 {
    rows.iter().rev().fold(0, |bits, &row| bits << 1 | u64::from(holds(row)))
}
