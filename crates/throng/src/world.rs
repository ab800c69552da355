//! The world: its contents, and the step that advances it.

mod adapt;
mod advance;
mod advance_simd;
mod agents;
mod agree;
mod arrive;
mod avoid;
mod avoid_simd;
mod build;
mod choose;
mod control;
mod crowd_ahead;
mod events;
mod explain;
mod fill;
mod flock;
mod flock_simd;
mod govern;
mod hindrance;
mod intend;
mod intend_simd;
mod local;
mod look_ahead;
mod measure;
mod neighbour_data;
mod order;
mod perceive;
mod plan;
mod plan_simd;
mod play;
mod relax;
mod replace;
mod schedule;
mod sleep;
mod snapshot;
mod squeeze;
mod stage;
mod standoff;
mod status;
mod steer;
mod trace;
mod tune;
mod velocities;
mod walls_ahead;

pub use agents::{AgentRef, Agents};
pub use events::{Event, EventKind};
pub use explain::{ConsideredAgent, Explanation};
pub use stage::Stage;
pub use trace::{Trace, TraceRequest};

use crate::Position;
use crate::agent::{AgentId, Column, Columns, Cycles, GoalId, Group, GroupId, JourneyId, ProgressMark, Status};
use crate::guard::BodyPose;
use crate::guard::{Contacts, Guard, Solids};
use crate::navigate::{Goal, Journey, Legs, Meshes, Script, Unreachable};
use crate::perceive::{Grid, Near, SimdLevel, TileScratch};
use crate::space::{Place, Walls};
use crate::steer::{SteeringNeighbour, Stimulus};
use crate::summary::Tally;
use glam::{DVec2, DVec3, Vec2, Vec3};
use neighbour_data::NeighbourData;
use play::RulesState;
use schedule::Schedule;
use serde::{Deserialize, Serialize};
use standoff::Standoff;
use velocities::Velocities;

/// How a step is divided into sub-steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum SubSteps {
    /// By a rule that depends only on the world's state: no agent moves farther in a sub-step than a quarter of the
    /// smallest radius, or an eighth of it when two agents are within a body's width of each other.
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
    state: State,
    step: StepMemory,
}

/// The state of a world: all that a step reads, and all that it changes.
#[derive(Clone, Debug)]
pub(crate) struct State {
    pub settings: Settings,
    pub steps: u64,
    pub agents: Columns,
    pub slots: Slots,
    /// Groups as they were given, in local coordinates, and whether they have agents.
    pub groups: Vec<Group>,
    pub local_groups: Vec<Group>,
    pub groups_with_agents: Vec<bool>,
    pub goals: Vec<Goal>,
    pub journeys: Vec<Journey>,
    /// Journeys that are alternatives to each other.
    pub choices: Vec<Vec<JourneyId>>,
    pub scripts: Vec<Script>,
    pub place: Place,
    pub schedule: Schedule,
    pub tally: Tally,
    /// Agents that cannot reach their goals, by number, with the reasons.
    pub stranded: Vec<(u32, Unreachable)>,
    /// Standoffs that are being resolved.
    pub standoffs: Vec<Standoff>,
    /// Recent stimuli, read by steering behaviours.
    pub stimuli: Vec<Stimulus>,
    /// The events of the last step.
    pub events: Vec<Event>,
    pub own_journeys: control::OwnJourneys,
    pub game: RulesState,
    /// Fields that adapt to the positions of the agents, by group.
    pub adapted: Vec<Option<adapt::Adapted>>,
    /// Box of the ground on which paths are planned where no walkable area bounds it. It is kept, because meshes that
    /// are built later for another box would differ.
    pub extent: Option<(DVec2, DVec2)>,

    // derived from the fields above whenever needed
    pub walls: Walls,
    pub meshes: Meshes,
    pub legs: Legs,
    pub instructions: SimdLevel,
    pub traced: TraceRequest,
}

/// The row of each id.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Slots {
    /// The row of the agent in each slot; `u32::MAX` for an empty slot.
    pub rows: Vec<u32>,
    /// How many agents had the slot before.
    pub generations: Column<u32>,
    pub free: Vec<u32>,
    pub next_number: u32,
}

/// Memory that a step passes from stage to stage. It is kept so that a step allocates nothing.
#[derive(Clone, Debug, Default)]
struct StepMemory {
    rest: sleep::SleepBlocks,
    grid: Grid,
    long: perceive::LongBodies,
    /// Rows of the two agents that were last found within a body's width of each other: the first pair that the next
    /// search tests.
    close_pair: Option<(usize, usize)>,
    perceiving: Vec<(TileScratch, Vec<Near>)>,
    near: perceive::Neighbours,
    shown: Vec<NeighbourData>,
    traces: Vec<Trace>,
    flocks: flock::Flocks,
    index: steer::SteeringIndex,
    sources: govern::Sources,
    steering: Vec<Vec<SteeringNeighbour>>,
    planned: steer::Planned,
    stuck: Vec<usize>,
    /// The result of each agent's look ahead; empty if no agent looks ahead.
    ahead: Vec<look_ahead::LookAhead>,
    looking: Vec<look_ahead::LookAheadScratch>,
    interaction: Vec<intend::InteractionRules>,
    preferred: Velocities,
    avoiding: Vec<avoid::AvoidScratch>,
    irregular: avoid_simd::Irregular,
    /// Velocities that queueing agents expect of the agents ahead, by row; empty if few agents queue.
    relaxed: Vec<Vec2>,
    /// Rows that turn on the scalar path, with their headings and the sums of their turns before the motion.
    turners: Vec<(usize, f32, f64)>,
    chosen_velocities: Velocities,
    /// Chosen velocities in the order of the grid.
    by_place: Vec<Vec2>,
    targets: Vec<BodyPose>,
    reach: Column<f32>,
    guarded: Column<bool>,
    contacts: Contacts,
    solids: Solids,
    guard: Guard,
    measured: Vec<measure::Measured>,
    /// Whether the status of any agent may change in this sub-step.
    any_may_change: bool,
    /// Number of agents that have arrived at each goal, and whether any agent has arrived at a goal.
    arrivals: Vec<u32>,
    any_arrived: bool,
    cycles: Cycles,
    /// Standing places in goal areas.
    lattices: fill::Lattices,
    /// Progress of all agents at the last check but one: memory that is reused.
    progress_marks: Vec<ProgressMark>,
    /// Rows with a status that may change, with their next status.
    changes: Vec<(usize, Status)>,
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
    pub fn step_in_stages(&mut self, mut ended: impl FnMut(Stage)) {
        self.state.events.clear();
        self.enter();
        self.state.adapt();
        let parts = self.sub_steps();
        let seconds = self.state.seconds(parts);
        for part in 0..parts {
            let now = self.state.time() + self.state.settings.step * f64::from(part + 1) / f64::from(parts);
            self.decide(part == 0, seconds, now, &mut ended);
            if part + 1 == parts {
                self.note_progress(now);
            }
            self.advance(seconds, now);
            ended(Stage::Move);
        }
        self.state.sort_events();
        self.state.steps += 1;
        self.play();
    }

    /// Runs a sub-step that ends at `now`, without the motion. `first` marks the first sub-step of a step.
    fn decide(&mut self, first: bool, seconds: f32, now: f64, mut ended: impl FnMut(Stage)) {
        self.fall_asleep(seconds);
        self.perceive(seconds);
        ended(Stage::Perceive);
        self.intend(first, seconds, now);
        ended(Stage::Intend);
        self.avoid(seconds);
        ended(Stage::Avoid);
        self.guard(seconds, now);
        ended(Stage::Guard);
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

    /// Returns the centre of an agent, world coordinates; `None` if it has been removed.
    pub fn position(&self, id: AgentId) -> Option<DVec3> {
        self.agent(id).map(|agent| agent.position())
    }

    /// Returns the id of the agent in a row of [`agents`](Self::agents).
    pub fn id(&self, row: usize) -> AgentId {
        self.state.id(row)
    }

    /// Returns the row of an agent in [`agents`](Self::agents), valid until the next step; `None` if it has been
    /// removed.
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
                if agents.number[row] < near.number && (agents.avoids(row, other) || agents.avoids(other, row)) {
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

    /// Returns a hash of the state of all agents and of the figures of the rules: FNV-1a, 64 bits. Equal bits give
    /// equal hashes, in any order of rows.
    pub fn state_hash(&self) -> u64 {
        let agents = &self.state.agents;
        let mut rows: Vec<usize> = (0..agents.len()).collect();
        rows.sort_by_key(|&row| agents.number[row]);
        let words = rows.into_iter().flat_map(|row| {
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
            words.into_iter().chain(air.map(f32::to_bits))
        });
        let figures = self.state.game.figures.iter().flat_map(|figure| figure.to_le_bytes());
        fnv_1a(words.flat_map(u32::to_le_bytes).chain(figures))
    }
}

impl State {
    /// Returns the seconds of each sub-step, for this number of sub-steps.
    fn seconds(&self, parts: u32) -> f32 {
        (self.settings.step / f64::from(parts)) as f32
    }

    /// Returns the seconds since the start.
    pub(crate) fn time(&self) -> f64 {
        self.steps as f64 * self.settings.step
    }

    /// Returns the number of whole intervals, each of `interval` seconds, in this number of steps.
    fn ticks(&self, steps: u64, interval: f64) -> u64 {
        (steps as f64 * self.settings.step / interval + 1e-9).floor() as u64
    }

    /// Whether any agent is above the ground, moves vertically, or may start to.
    fn in_space_now(&self) -> bool {
        let agents = &self.agents;
        let rises = agents.commanded.values().iter().flatten().any(|velocity| velocity.z != 0.0);
        let in_air = rises || agents.any_flies() || agents.vertical_velocity.uniform() != Some(0.0);
        in_air || self.legs.lead_up() || self.any_steers_in_space()
    }

    /// Returns the id of the agent in a row of [`agents`](Self::agents).
    pub(crate) fn id(&self, row: usize) -> AgentId {
        let slot = self.agents.slot[row];
        AgentId { slot, generation: self.slots.generations[slot as usize] }
    }

    /// Returns the row of an agent in [`agents`](Self::agents), valid until the next step; `None` if it has been
    /// removed.
    pub(crate) fn row(&self, id: AgentId) -> Option<usize> {
        let &row = self.slots.rows.get(id.slot as usize)?;
        (row != u32::MAX && self.slots.generations[id.slot as usize] == id.generation).then_some(row as usize)
    }

    /// Returns the goal that an agent walks to; `None` if its journey has ended or has no stops.
    pub(crate) fn goal_of(&self, row: usize) -> Option<GoalId> {
        let journey = &self.journeys[self.agents.journey[row].index()];
        journey.stops.get(self.agents.travel[row].leg as usize).map(|stop| stop.goal)
    }
}

/// Returns the FNV-1a hash of the bytes, 64 bits. Source: RFC 9923, section 2.
fn fnv_1a(bytes: impl Iterator<Item = u8>) -> u64 {
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3))
}
