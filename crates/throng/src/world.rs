//! The world: its contents, and the step that advances it.

mod agents;
mod build;
mod control;
mod divide;
mod events;
mod explain;
mod local;
mod play;
mod replace;
mod schedule;
mod snapshot;
mod state;
mod status;
mod tune;

pub use agents::{AgentRef, Agents};
pub(crate) use build::FARTHEST;
pub use events::{Event, EventKind};
pub use explain::{ConsideredAgent, Explanation};
pub(crate) use state::State;

use crate::Position;
use crate::agent::{AgentId, Columns, GoalId, Group, GroupId, JourneyId, Status};
use crate::field::Field;
use crate::halo::Alone;
use crate::intend::TraceRequest;
use crate::navigate::{Goal, Journey, Script, Unreachable};
use crate::perceive::{Grid, SimdLevel};
use crate::space::Place;
use crate::step::{Pipeline, Stage};
use glam::{DVec2, DVec3, Vec3};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// How a step is divided into sub-steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum SubSteps {
    /// By a rule that depends only on the agents: their bodies, limits and groups. Within a sub-step no agent gets
    /// farther than a sixth of its clearance radius from where its velocity leads, by its maximum acceleration and
    /// maximum speed (by its vehicle's, if it steers). Nor does it move farther at its maximum speed than a part of its
    /// clearance radius: 1 if it looks ahead, 1/6 if not, 3/8 if it steers or a field governs it. The clearance radius
    /// is half of the narrower side of the body. Agents with a script do not count. The default agent needs sub-steps
    /// of at most 0.065 s.
    #[default]
    Auto,
    /// Always into this number. Limit: >= 1.
    Fixed(u32),
}

/// The settings of a world.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    /// Length of a step, seconds. Limit: > 0, at most 10.
    pub step: f64,
    /// How a step is divided into sub-steps.
    pub sub_steps: SubSteps,
    /// Seed of all random numbers.
    pub seed: u64,
    /// World coordinates of the local origin. Choose it near the middle of the scene: positions are kept relative to it
    /// in `f32`.
    pub origin: DVec2,
}

impl Settings {
    /// Converts a place in world coordinates to local coordinates: relative to [`origin`](Self::origin), in `f32`,
    /// as in [`World::relative_columns`].
    ///
    /// ```
    /// use glam::{DVec2, DVec3, Vec3};
    /// use throng::Settings;
    /// let settings = Settings { origin: DVec2::new(5000.0, -3000.0), ..Settings::default() };
    /// assert_eq!(settings.to_local([5001.0, -2998.0]), Vec3::new(1.0, 2.0, 0.0));
    /// assert_eq!(settings.to_world(Vec3::new(1.0, 2.0, 0.0)), DVec3::new(5001.0, -2998.0, 0.0));
    /// ```
    pub fn to_local(&self, place: impl Into<Position>) -> Vec3 {
        (place.into().0 - self.origin.extend(0.0)).as_vec3()
    }

    /// Converts a place in local coordinates to world coordinates: the inverse of [`to_local`](Self::to_local).
    pub fn to_world(&self, place: Vec3) -> DVec3 {
        place.as_dvec3() + self.origin.extend(0.0)
    }
}

impl Default for Settings {
    fn default() -> Self {
        Self { step: 1.0 / 60.0, sub_steps: SubSteps::Auto, seed: 1, origin: DVec2::ZERO }
    }
}

/// Agents, groups, goals, obstacles and walkable areas. See the [crate's page](crate) for an example. A clone continues
/// with the same bits.
#[derive(Clone, Debug)]
pub struct World {
    pub(crate) state: State,
    pub(crate) step: Pipeline,
}

impl World {
    /// Advances all agents by one time step. Then the [rules](crate::Rules) act, if there are any.
    ///
    /// The step takes no duration: [`Settings::step`] is the same for all steps, so that a run has the same bits at any frame
    /// rate. A program with frames of its own length makes as many steps as the time that has passed holds, and draws the
    /// agents between the last two positions.
    pub fn step(&mut self) {
        self.step_in_stages(|_| ());
    }

    /// As [`step`](Self::step), and calls `ended` at the end of each stage of each sub-step. The world has no clock: a
    /// caller that profiles the stages measures the time itself.
    pub fn step_in_stages(&mut self, ended: impl FnMut(Stage)) {
        self.step_beside(&mut Alone, ended);
    }

    /// Returns the seconds since the start.
    pub fn time(&self) -> f64 {
        self.state.time()
    }

    /// Returns the number of steps made so far.
    pub fn steps(&self) -> u64 {
        self.state.steps
    }

    /// Returns the settings of the world.
    pub fn settings(&self) -> &Settings {
        &self.state.settings
    }

    /// Whether no agent is scheduled to enter and every agent present is in place at the end of its journey or cannot
    /// get there. An agent that was pushed out of its place is not in place.
    pub fn finished(&self) -> bool {
        let done = |status: &Status| matches!(status, Status::Arrived | Status::Stranded);
        self.state.schedule.is_empty() && self.state.agents.status.iter().all(done)
    }

    /// Whether any agent flies or will fly: it has an altitude, will enter with one, or has a goal in the air.
    pub fn in_space(&self) -> bool {
        let goals = self.state.goals.iter().any(|goal| goal.altitude().is_some());
        goals || self.state.schedule.any_flies() || self.state.agents.any_flies()
    }

    /// Sets the SIMD level of all steps. All levels give the same bits.
    pub fn set_simd_level(&mut self, instructions: SimdLevel) {
        self.state.instructions = instructions;
    }

    /// Returns the state of the agents as columns. Positions are relative to [`Settings::origin`]. The order of rows
    /// may change in every step.
    pub fn relative_columns(&self) -> &Columns {
        &self.state.agents
    }

    /// Sorts the rows of [`relative_columns`](Self::relative_columns) by their position on the ground, strip by strip. Large
    /// crowds are sorted automatically from time to time. It changes speed only, not results.
    pub fn sort_rows(&mut self) {
        self.step.sort_rows(&mut self.state);
    }

    /// Returns the centre of an agent, world coordinates; `None` if it has been removed.
    pub fn position(&self, id: AgentId) -> Option<DVec3> {
        self.agent(id).map(|agent| agent.position())
    }

    /// Returns the id of the agent in a row of [`relative_columns`](Self::relative_columns).
    pub fn id(&self, row: usize) -> AgentId {
        self.state.id(row)
    }

    /// Returns the row of an agent in [`relative_columns`](Self::relative_columns), valid until the next step; `None` if
    /// it has been removed.
    pub fn row(&self, id: AgentId) -> Option<usize> {
        self.state.row(id)
    }

    /// Returns a group, as it was given.
    pub fn group(&self, id: GroupId) -> &Group {
        &self.state.groups[id.index()]
    }

    /// Returns all groups, by index, as they were given.
    pub fn groups(&self) -> &[Group] {
        &self.state.groups
    }

    /// Returns the present state of the field of a group, by index, if the field adapts to the positions of the agents
    /// ([`Adaptive`](crate::field::Adaptive)). Positions are relative to the world's origin. Returns `None` for other
    /// groups and before the first step.
    pub fn adapted_field(&self, group: usize) -> Option<&Arc<dyn Field>> {
        self.state.adapted.get(group)?.as_ref().map(|adapted| &adapted.field)
    }

    /// Returns all goals, by index.
    pub fn goals(&self) -> &[Goal] {
        &self.state.goals
    }

    /// Returns a journey.
    pub fn journey(&self, id: JourneyId) -> &Journey {
        &self.state.journeys[id.index()]
    }

    /// Returns all scripts, by index.
    pub fn scripts(&self) -> &[Script] {
        &self.state.scripts
    }

    /// Returns the obstacles and walkable areas.
    pub fn place(&self) -> &Place {
        &self.state.place
    }

    /// Returns the goal that an agent walks to; `None` if its journey has ended or has no stops.
    pub fn goal_of(&self, row: usize) -> Option<GoalId> {
        self.state.goal_of(row)
    }

    /// Returns the numbers of the agents that cannot reach their goals, with the reasons.
    pub fn stranded(&self) -> &[(u32, Unreachable)] {
        &self.state.stranded
    }

    /// Returns the pairs of agents that overlap, with the distance of their cores (of their centres, for discs) divided
    /// by the sum of their radii. Overlaps come from an overlapping start, or from groups without the guard.
    ///
    /// Pairs are sorted by number, and each pair occurs once.
    pub fn overlapping(&self) -> Vec<(u32, u32, f64)> {
        let mut grid = Grid::default();
        grid.rebuild(&self.state.agents.position, &self.state.agents.number, 1.0);
        let agents = &self.state.agents;
        let bound = |row: usize| agents.body(row).bounding_radius();
        let largest = agents.bodies().map(|body| body.bounding_radius()).fold(0.0, f32::max);
        let mut pairs = Vec::new();
        for row in 0..agents.len() {
            grid.within(agents.position[row], bound(row) + largest, |near| {
                let other = near.row as usize;
                if agents.number[row] < near.number && agents.meet(row, other) {
                    let separation = agents.separation(row, other);
                    if separation < 1.0 - 1e-4 {
                        pairs.push((agents.number[row], near.number, separation));
                    }
                }
            });
        }
        pairs.sort_by_key(|&(a, b, _)| (a, b));
        pairs
    }

    /// Returns a hash of the state of all agents and of the figures of the rules, 64 bits. Equal bits give equal hashes,
    /// in any order of rows.
    pub fn state_hash(&self) -> u64 {
        self.hash_with(self.state.hash_of_agents())
    }

    /// Returns the hash of a state from the hash of its agents.
    pub(crate) fn hash_with(&self, agents: u64) -> u64 {
        let figures = self.state.game.figures.iter().flat_map(|figure| figure.to_le_bytes());
        fnv_1a(agents.to_le_bytes().into_iter().chain(figures))
    }
}

impl State {
    /// Returns the sum of the hashes of all agents, modulo 2^64. The sums of the worlds of a division add up to that of the
    /// undivided world.
    pub(crate) fn hash_of_agents(&self) -> u64 {
        (0..self.agents.len()).map(|row| self.hash_of(row)).fold(0, u64::wrapping_add)
    }

    fn hash_of(&self, row: usize) -> u64 {
        let agents = &self.agents;
        let (p, v) = (agents.position[row], agents.velocity[row]);
        let travel = &agents.travel[row];
        let words = [
            agents.number[row],
            p.x.to_bits(),
            p.y.to_bits(),
            v.x.to_bits(),
            v.y.to_bits(),
            agents.heading[row].to_bits(),
            agents.status[row] as u32,
            travel.leg,
            travel.turn.rank() as u32,
        ];
        // walking agents have none
        let air = [agents.altitude[row], agents.vertical_velocity[row]].into_iter().filter(|&z| z != 0.0);
        fnv_1a(words.into_iter().chain(air.map(f32::to_bits)).flat_map(u32::to_le_bytes))
    }
}

/// Returns the FNV-1a hash of the bytes, 64 bits. Source: RFC 9923, section 2.
fn fnv_1a(bytes: impl Iterator<Item = u8>) -> u64 {
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3))
}
