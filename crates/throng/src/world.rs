//! The world: what is there, and the step that moves it on.

mod account;
mod adapt;
mod advance;
mod advance_lanes;
mod agree;
mod arrive;
mod avoid;
mod avoid_lanes;
mod build;
mod choose;
mod crowd_ahead;
mod explain;
mod fill;
mod flock;
mod flock_lanes;
mod govern;
mod hindrance;
mod intend;
mod intend_lanes;
mod look_ahead;
mod measure;
mod order;
mod perceive;
mod plan;
mod plan_lanes;
mod play;
mod relax;
mod replace;
mod rest;
mod schedule;
mod snapshot;
mod squeeze;
mod stage;
mod standoff;
mod status;
mod steer;
mod tune;
mod velocities;
mod walls_ahead;
mod way;

pub use account::{Account, Asked};
pub use explain::{Explanation, Seen};
pub use stage::Stage;

use crate::agent::{AgentId, Column, Columns, Cycles, GoalId, Group, GroupId, JourneyId, ProgressMark, Status};
use crate::guard::Pose;
use crate::guard::{Contacts, Guard, Solids};
use crate::navigate::{Goal, Journey, Legs, Meshes, Script, Unreachable};
use crate::perceive::{Grid, Instructions, Near, Pack};
use crate::space::{Place, Walls};
use crate::steer::{Event, Neighbour};
use crate::summary::Tally;
use glam::{DVec2, Vec2};
use play::Game;
use schedule::Schedule;
use serde::{Deserialize, Serialize};
use standoff::Standoff;
use velocities::Velocities;
use way::Shown;

/// How a step is divided into sub-steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum SubSteps {
    /// By a rule that depends only on the world's state: nobody moves farther in a sub-step than a quarter of the
    /// smallest radius, an eighth when somebody is within a body's width of somebody else.
    #[default]
    Auto,
    /// Always into this many. Limit: >= 1.
    Fixed(u32),
}

/// What a world is made with.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    /// Seconds a step covers. Limit: > 0, at most 10.
    pub step: f64,
    /// How a step is divided into sub-steps.
    pub sub_steps: SubSteps,
    /// Seed of everything random.
    pub seed: u64,
    /// World coordinates of the local origin: choose it near the middle of the scene, since positions are kept
    /// relative to it in `f32`.
    pub origin: DVec2,
}

impl Default for Settings {
    fn default() -> Self {
        Self { step: 1.0 / 60.0, sub_steps: SubSteps::Auto, seed: 1, origin: DVec2::ZERO }
    }
}

/// Agents, groups, goals and the place they are in. See the [crate's page](crate) for an example. A clone goes on with
/// the same bits.
#[derive(Clone, Debug)]
pub struct World {
    settings: Settings,
    steps: u64,
    agents: Columns,
    slots: Slots,
    groups: Vec<Group>,
    goals: Vec<Goal>,
    journeys: Vec<Journey>,
    /// Journeys that are alternatives to each other.
    choices: Vec<Vec<JourneyId>>,
    scripts: Vec<Script>,
    place: Place,
    schedule: Schedule,
    tally: Tally,
    /// Agents whose goals cannot be reached, with the reasons, by number.
    stranded: Vec<(u32, Unreachable)>,
    /// Who steps aside for whom.
    standoffs: Vec<Standoff>,
    /// What happened lately, for those who steer.
    events: Vec<Event>,
    game: Game,
    /// Fields that change with where people are, by group.
    adapted: Vec<Option<adapt::Adapted>>,
    /// Box of the ground that ways are planned on where no walkable area bounds it. Not made anew when needed:
    /// meshes of the same ground at another time would differ.
    extent: Option<(DVec2, DVec2)>,

    // made anew from the above whenever it is needed
    walls: Walls,
    meshes: Meshes,
    legs: Legs,
    step: StepMemory,
    instructions: Instructions,
    asked: Asked,
}

/// Which row each id names.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Slots {
    /// The row of the agent that has a slot; `u32::MAX`: nobody has it.
    rows: Vec<u32>,
    /// How many had it before.
    generations: Column<u32>,
    free: Vec<u32>,
    next_number: u32,
}

/// What one step hands from stage to stage; kept so that a step allocates nothing.
#[derive(Clone, Debug, Default)]
struct StepMemory {
    /// Which groups have agents.
    groups: Vec<bool>,
    rest: rest::Rest,
    grid: Grid,
    long: perceive::Long,
    /// Rows of two who were within a body's width of each other when that was asked last: a guess where to look first.
    close_pair: Option<(usize, usize)>,
    perceiving: Vec<(Pack, Vec<Near>)>,
    near: perceive::Neighbours,
    shown: Vec<Shown>,
    accounts: Vec<Account>,
    flocks: flock::Flocks,
    index: steer::Index,
    sources: govern::Sources,
    steering: Vec<Vec<Neighbour>>,
    planned: steer::Planned,
    stuck: Vec<usize>,
    /// What each agent found when it looked ahead; empty if none does.
    ahead: Vec<look_ahead::Ahead>,
    looking: Vec<look_ahead::Scratch>,
    manners: Vec<intend::Manners>,
    preferred: Velocities,
    avoiding: Vec<avoid::Scratch>,
    wishes: Velocities,
    /// Wishes by places of the grid.
    by_place: Vec<Vec2>,
    targets: Vec<Pose>,
    reach: Column<f32>,
    guarded: Column<bool>,
    contacts: Contacts,
    solids: Solids,
    guard: Guard,
    measured: Vec<measure::Measured>,
    /// Whether the status of anybody may change in this sub-step.
    anybody_may_change: bool,
    /// How many have arrived at each goal, and whether anybody has at any.
    arrivals: Vec<u32>,
    anybody_arrived: bool,
    cycles: Cycles,
    /// Places to stand in goal areas.
    lattices: fill::Lattices,
    /// The progress of all agents as it was at the look before the last.
    progress_marks: Vec<ProgressMark>,
    /// Rows with their next status, where it may be another.
    changes: Vec<(usize, Status)>,
}

impl World {
    /// Moves everybody on by one time step; then it is the [rules'](crate::Rules) turn, if there are any.
    pub fn step(&mut self) {
        self.step_in_stages(|_| ());
    }

    /// As [`step`](Self::step), and calls `ended` at the end of each stage of each sub-step: the world has no clock, who
    /// wants to know where the time goes has one.
    pub fn step_in_stages(&mut self, mut ended: impl FnMut(Stage)) {
        self.enter();
        self.adapt();
        let parts = self.sub_steps();
        let seconds = self.seconds(parts);
        for part in 0..parts {
            let now = self.time() + self.settings.step * f64::from(part + 1) / f64::from(parts);
            self.decide(part == 0, seconds, now, &mut ended);
            if part + 1 == parts {
                self.note_progress(now);
            }
            self.advance(seconds, now);
            ended(Stage::Move);
        }
        self.steps += 1;
        self.play();
    }

    /// Seconds of each of the parts that a step is divided into.
    fn seconds(&self, parts: u32) -> f32 {
        (self.settings.step / f64::from(parts)) as f32
    }

    /// All of a sub-step, the first of a step or another, that ends at `now`, but the motion.
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

    /// Seconds since the start.
    pub fn time(&self) -> f64 {
        self.steps as f64 * self.settings.step
    }

    /// How many whole intervals, in seconds, so many steps last.
    fn ticks(&self, steps: u64, interval: f64) -> u64 {
        (steps as f64 * self.settings.step / interval + 1e-9).floor() as u64
    }

    /// Steps made so far.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// What the world was made with.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Whether no agent is left to come and all agents present are in place at the end of their journeys, or cannot get
    /// there. An agent that was pushed out of its place is not.
    pub fn finished(&self) -> bool {
        let done = |status: &Status| matches!(status, Status::Arrived | Status::Stranded);
        self.schedule.is_empty() && self.agents.status.iter().all(done)
    }

    /// Whether somebody flies, or will: has an altitude, enters with one, or has a goal in the air.
    pub fn in_space(&self) -> bool {
        let goals = self.goals.iter().any(|goal| goal.altitude().is_some());
        goals || self.schedule.anybody_flies() || self.agents.anybody_flies()
    }

    /// Whether anybody is off the ground, rises, or may want to.
    fn in_space_now(&self) -> bool {
        let agents = &self.agents;
        let in_air = agents.anybody_flies() || agents.climb.uniform() != Some(0.0);
        in_air || self.legs.lead_up() || self.anybody_steers_in_space()
    }

    /// Chooses the instructions that steps are made with: all give the same bits.
    pub fn use_instructions(&mut self, instructions: Instructions) {
        self.instructions = instructions;
    }

    /// The agents' state, as columns; positions are relative to [`Settings::origin`]. Rows change from step to step.
    pub fn agents(&self) -> &Columns {
        &self.agents
    }

    /// Centre of an agent, world coordinates; `None` if it has been removed.
    pub fn position(&self, id: AgentId) -> Option<DVec2> {
        Some(self.agents.position[self.row(id)?].as_dvec2() + self.settings.origin)
    }

    /// The agent that is in a row of [`agents`](Self::agents) now.
    pub fn id(&self, row: usize) -> AgentId {
        let slot = self.agents.slot[row];
        AgentId { slot, generation: self.slots.generations[slot as usize] }
    }

    /// The row of an agent in [`agents`](Self::agents), until the next step; `None` if it has been removed.
    pub fn row(&self, id: AgentId) -> Option<usize> {
        let &row = self.slots.rows.get(id.slot as usize)?;
        (row != u32::MAX && self.slots.generations[id.slot as usize] == id.generation).then_some(row as usize)
    }

    /// A group.
    pub fn group(&self, id: GroupId) -> &Group {
        &self.groups[id.index()]
    }

    /// All groups, by index.
    pub fn groups(&self) -> &[Group] {
        &self.groups
    }

    /// All goals, by index.
    pub fn goals(&self) -> &[Goal] {
        &self.goals
    }

    /// A journey.
    pub fn journey(&self, id: JourneyId) -> &Journey {
        &self.journeys[id.index()]
    }

    /// All scripts, by index.
    pub fn scripts(&self) -> &[Script] {
        &self.scripts
    }

    /// What is solid and what can be walked on.
    pub fn place(&self) -> &Place {
        &self.place
    }

    /// The goal an agent is on its way to; `None` if its journey has ended or it has none.
    pub fn goal_of(&self, row: usize) -> Option<GoalId> {
        let journey = &self.journeys[self.agents.journey[row].index()];
        journey.stops.get(self.agents.travel[row].leg as usize).map(|stop| stop.goal)
    }

    /// Numbers of the agents whose goals cannot be reached, and why.
    pub fn stranded(&self) -> &[(u32, Unreachable)] {
        &self.stranded
    }

    /// Pairs of agents that overlap, with the distance of their cores (centres of discs) over the sum of their radii: a bad
    /// start, or a group without the guard.
    /// By number, each pair once.
    pub fn overlapping(&self) -> Vec<(u32, u32, f64)> {
        let mut grid = Grid::default();
        grid.rebuild(&self.agents.position, &self.agents.number, 1.0);
        let agents = &self.agents;
        let bound = |row: usize| agents.body(row).bound();
        let largest = agents.bodies().map(|body| body.bound()).fold(0.0, f32::max);
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

    /// A hash of the state of all agents and of the rules' figures: the same for the same bits, whatever the order of rows. FNV-1a, 64 bits.
    pub fn state_hash(&self) -> u64 {
        let agents = &self.agents;
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
            // those who walk have none
            let air = [agents.altitude[row], agents.climb[row]].into_iter().filter(|&z| z != 0.0);
            words.into_iter().chain(air.map(f32::to_bits))
        });
        let figures = self.game.figures.iter().flat_map(|figure| figure.to_le_bytes());
        words
            .flat_map(u32::to_le_bytes)
            .chain(figures)
            .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3))
    }
}
