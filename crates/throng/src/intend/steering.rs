//! Intention, for agents that steer.
//!
//! A behaviour returns a force, and the velocity that the vehicle reaches with it is the preferred velocity. Avoidance
//! and guard follow, as for all agents.

use super::flock::Flocks;
use super::velocities::{Rows, Velocities, set};
use crate::agent::{Group, Memory, Status};
use crate::motion::{Attitude, Basis, Motion, Steering, Stepping};
use crate::parallel::{self, RowLists};
use crate::perceive::{CellLattice, Neighbours, Perceived};
use crate::steer::{
    AgentQuery, Birds, BoxedBehaviour, Kinematics, SteeringInput, SteeringNeighbour, TraceEntry, TraceRecorder,
};
use crate::world::State;
use fearless_simd::Level;
use glam::Vec3;

/// Seconds after which events are forgotten.
const FORGOTTEN: f64 = 600.0;

/// The planned motion of agents that steer, if nothing hinders them, by row.
#[derive(Clone, Debug, Default)]
pub(crate) struct Planned {
    pub velocity: Vec<Vec3>,
    pub attitude: Vec<Attitude>,
    /// Whether they face the direction that the behaviour gives, instead of the direction of motion.
    pub faces: Vec<bool>,
}

impl Planned {
    fn resize(&mut self, rows: usize) {
        self.velocity.resize(rows, Vec3::ZERO);
        self.attitude.resize(rows, Attitude::default());
        self.faces.resize(rows, false);
    }
}

/// Rows of agents by their numbers; `u32::MAX` for an unused number.
#[derive(Clone, Debug, Default)]
pub(super) struct SteeringIndex {
    rows: Vec<u32>,
    /// Index of each agent within its group, in the order of numbers.
    slots: Vec<u32>,
    counts: Vec<u32>,
}

impl SteeringIndex {
    fn rebuild(&mut self, state: &State) {
        let agents = &state.agents;
        self.rows.clear();
        self.rows.resize(state.slots.next_number as usize, u32::MAX);
        agents.number.iter().zip(0..).for_each(|(&number, row)| self.rows[number as usize] = row);
        self.counts.clear();
        self.counts.resize(state.local_groups.len(), 0);
        self.slots.resize(agents.len(), 0);
        for &row in self.rows.iter().filter(|&&row| row != u32::MAX) {
            let count = &mut self.counts[agents.group[row as usize].index()];
            self.slots[row as usize] = *count;
            *count += 1;
        }
    }
}

/// Computes the motion that agents plan that steer.
#[derive(Clone, Debug, Default)]
pub(super) struct Steer {
    pub planned: Planned,
    pub flocks: Flocks,
    index: SteeringIndex,
    scratch: Vec<SteeringScratch>,
}

/// Scratch memory of a thread.
#[derive(Clone, Debug, Default)]
struct SteeringScratch {
    rows: Vec<u32>,
    neighbours: Vec<SteeringNeighbour>,
}

impl Steer {
    /// Computes the planned motions, and so the preferred velocities, of all agents that steer.
    pub fn run(&mut self, state: &mut State, seen: Perceived<'_>, preferred: &mut Velocities, seconds: f32, now: f64) {
        self.flocks.clear();
        if !state.any_steers() {
            self.planned.resize(0);
            return;
        }
        state.stimuli.retain(|stimulus| now - stimulus.time <= FORGOTTEN);
        self.index.rebuild(state);
        self.flocks.run(state, seen, &self.index, seconds, now);
        let Self { planned, flocks, index, scratch } = self;
        planned.resize(state.agents.len());
        state.with_memory(|state, memory| {
            let steering = Behaving::new(state, seen, index, (&flocks.birds, &flocks.forces));
            steering.run(planned, memory, preferred, scratch, (seconds, now));
        });
    }

    /// Returns what the behaviours read, after a sub-step.
    pub fn view<'a>(&'a self, state: &'a State, seen: Perceived<'a>) -> Behaving<'a> {
        Behaving::new(state, seen, &self.index, (&self.flocks.birds, &self.flocks.forces))
    }
}

impl State {
    /// Lends the memory of all behaviours to be changed, while all else is read.
    fn with_memory(&mut self, work: impl FnOnce(&Self, &mut Memory)) {
        let mut memory = std::mem::take(&mut self.agents.memory);
        work(self, &mut memory);
        self.agents.memory = memory;
    }
}

/// The planned motions of some rows.
pub(super) struct Plans<'a> {
    /// The first row.
    pub first: usize,
    pub velocity: &'a mut [Vec3],
    pub attitude: &'a mut [Attitude],
    pub faces: &'a mut [bool],
    pub preferred: Rows<'a>,
    memory: RowLists<'a, f32>,
}

impl Plans<'_> {
    /// Returns the memory of a behaviour for a row.
    pub fn memory(&mut self, row: usize, words: usize) -> &mut [f32] {
        &mut self.memory.all[(row - self.first) * self.memory.stride..][..words]
    }
}

/// What steers the agents of a group, in the sub-step that ends at `now`.
#[derive(Clone, Copy)]
pub(super) struct GroupSteering<'a> {
    pub group: &'a Group,
    pub steering: &'a BoxedBehaviour,
    /// The SIMD level and the step of the vehicles, if the kernel supports them.
    pub simd: Option<(Level, Stepping)>,
    pub seconds: f32,
    pub now: f64,
}

impl<'a> GroupSteering<'a> {
    /// Returns what steers the agents of a group; `None` if they do not steer.
    fn of(state: &State, group: &'a Group, seconds: f32, now: f64) -> Option<Self> {
        let steering = group.steering.as_ref()?;
        let step = |level| Some((level, Stepping::of(&group.vehicle, seconds)?));
        Some(Self { group, steering, simd: state.instructions.level().and_then(step), seconds, now })
    }
}

/// What behaviours read.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Behaving<'a> {
    pub(super) state: &'a State,
    pub(super) near: &'a Neighbours,
    pub(super) lattice: &'a CellLattice,
    pub(super) index: &'a SteeringIndex,
    /// The data of all agents, in the order of the lattice, if any agent searches for all neighbours.
    pub(super) birds: &'a Birds,
    /// The forces of the birds of flocks, in the order of the lattice.
    pub(super) forces: &'a [Vec3],
}

impl AgentQuery for Behaving<'_> {
    fn find(&self, number: u32) -> Option<Kinematics> {
        let &row = self.index.rows.get(number as usize).filter(|&&row| row != u32::MAX)?;
        let Motion { position, velocity, basis, .. } = self.state.motion(row as usize);
        Some(Kinematics { position, velocity, basis, radius: self.state.agents.radius[row as usize] })
    }
}

impl<'a> Behaving<'a> {
    pub(super) fn new(
        state: &'a State,
        seen: Perceived<'a>,
        index: &'a SteeringIndex,
        (birds, forces): (&'a Birds, &'a [Vec3]),
    ) -> Self {
        Self { state, near: seen.near, lattice: seen.lattice, index, birds, forces }
    }

    /// Computes the planned motions of all agents that steer.
    fn run(
        &self,
        planned: &mut Planned,
        memory: &mut Memory,
        preferred: &mut Velocities,
        scratch: &mut Vec<SteeringScratch>,
        (seconds, now): (f32, f64),
    ) {
        let Planned { velocity, attitude, faces } = planned;
        let all = ((&mut velocity[..], &mut attitude[..], &mut faces[..]), memory.lists(), preferred.rows());
        let state = self.state;
        let groups = || state.local_groups.iter().zip(&state.groups_with_agents).enumerate();
        parallel::costly_ranges_with(
            all,
            scratch,
            |scratch, range, ((velocity, attitude, faces), memory, preferred)| {
                let mut plans = Plans { first: range.start, velocity, attitude, faces, preferred, memory };
                let SteeringScratch { rows, neighbours } = scratch;
                for (index, (group, _)) in groups().filter(|(_, (_, in_use))| **in_use) {
                    let Some(of) = GroupSteering::of(state, group, seconds, now) else { continue };
                    rows.clear();
                    rows.extend(
                        (range.start as u32..range.end as u32)
                            .filter(|&row| state.agents.group[row as usize].index() == index),
                    );
                    match of.simd {
                        Some(simd) => self.steer_many(simd, &of, rows, &mut plans, neighbours),
                        None => rows.iter().for_each(|&row| {
                            let steering = self.steering(&of, row as usize, &mut plans, neighbours);
                            self.steer_row(&of, row as usize, steering, &mut plans);
                        }),
                    }
                }
            },
        );
    }

    /// Returns the steering of an agent.
    fn steering(
        &self,
        of: &GroupSteering<'_>,
        row: usize,
        plans: &mut Plans<'_>,
        neighbours: &mut Vec<SteeringNeighbour>,
    ) -> Steering {
        if of.group.is_flock() {
            return self.force(row).into();
        }
        let view = self.view(row, of.seconds, of.now, neighbours);
        let memory = plans.memory(row, of.steering.words());
        of.steering.steer(&view, memory, &mut TraceRecorder::default()).unwrap_or_default()
    }

    /// Sets the planned motion of an agent with this steering.
    pub(super) fn steer_row(&self, of: &GroupSteering<'_>, row: usize, steering: Steering, plans: &mut Plans<'_>) {
        let before = self.state.motion(row);
        let mut motion = before;
        of.group.vehicle.step(&mut motion, steering, of.seconds);
        let at = row - plans.first;
        set(&mut plans.preferred, at, (motion.position - before.position) / of.seconds);
        (plans.velocity[at], plans.attitude[at]) = (motion.velocity, motion.into());
        plans.faces[at] = steering.facing.is_some();
    }

    /// Returns the steering of an agent in the sub-step that ends at `now`, and the recorded reasons.
    pub fn reasons(&self, row: usize, seconds: f32, now: f64) -> (Option<Steering>, Vec<TraceEntry>) {
        let mut entries = Vec::new();
        let said = self.state.steering(row).and_then(|steering| {
            let (mut memory, mut neighbours) = (self.state.agents.memory.of(row).to_vec(), Vec::new());
            let view = self.view(row, seconds, now, &mut neighbours);
            steering.steer(&view, &mut memory[..steering.words()], &mut TraceRecorder::requested(&mut entries))
        });
        (said, entries)
    }

    /// Returns the input of the behaviour of an agent.
    pub fn view<'b>(
        &'b self,
        row: usize,
        seconds: f32,
        now: f64,
        neighbours: &'b mut Vec<SteeringNeighbour>,
    ) -> SteeringInput<'b> {
        let (agents, own) = (&self.state.agents, self.state.motion(row));
        neighbours.clear();
        self.look_at_all(row, neighbours);
        neighbours.extend(self.near.of(row).iter().map(|&other| {
            let other = other as usize;
            SteeringNeighbour {
                offset: self.state.place_in_space(other) - own.position,
                velocity: agents.velocity[other].extend(agents.vertical_velocity[other]),
                forward: self.state.forward(other),
                radius: agents.radius[other],
                number: agents.number[other],
                group: agents.group[other].index(),
            }
        }));
        SteeringInput {
            motion: own,
            vehicle: self.state.local_groups[agents.group[row].index()].vehicle,
            radius: agents.radius[row],
            group: agents.group[row].index(),
            slot: self.index.slots[row] as usize,
            goal: self.state.steering_goal(row),
            neighbours,
            others: self,
            stimuli: &self.state.stimuli,
            figures: &self.state.game.figures,
            time: now - f64::from(seconds),
            seconds,
            rng: self.state.rng(row),
        }
    }
}

impl State {
    /// Returns the behaviour that an agent steers by; `None` if it does not steer.
    pub(crate) fn steering(&self, row: usize) -> Option<&BoxedBehaviour> {
        self.local_groups[self.agents.group[row].index()].steering.as_ref()
    }

    /// Whether any agent steers.
    pub(crate) fn any_steers(&self) -> bool {
        self.groups_in_use().any(|group| group.steering.is_some())
    }

    /// Whether all agents steer.
    pub(crate) fn all_steer(&self) -> bool {
        self.agents.script.uniform() == Some(None) && self.groups_in_use().all(|group| group.steering.is_some())
    }

    /// Whether any agent that steers may leave the ground.
    pub(crate) fn any_steers_in_space(&self) -> bool {
        self.groups_in_use().any(Group::steers_in_space)
    }

    /// Returns the position, velocity and orientation of an agent.
    pub(crate) fn motion(&self, row: usize) -> Motion {
        let agents = &self.agents;
        let position = self.place_in_space(row);
        let velocity = agents.velocity_in_space(row);
        if self.steering(row).is_some() {
            agents.attitude[row].motion(position, velocity)
        } else {
            Motion { position, velocity, basis: Basis::facing(self.forward(row)), ..Motion::default() }
        }
    }

    /// Returns the centre of an agent in space.
    pub(crate) fn place_in_space(&self, row: usize) -> Vec3 {
        self.agents.position[row].extend(self.agents.altitude[row])
    }

    /// Returns the direction that an agent faces.
    pub(crate) fn forward(&self, row: usize) -> Vec3 {
        if self.steering(row).is_some() {
            self.agents.attitude[row].basis.forward
        } else {
            let (sin, cos) = libm::sincosf(self.agents.heading[row]);
            Vec3::new(cos, sin, 0.0)
        }
    }

    /// Returns the point that the journey of an agent leads to next: the next corner of its path, or its goal if it
    /// waits or has arrived.
    pub(crate) fn steering_goal(&self, row: usize) -> Option<Vec3> {
        let travel = &self.agents.travel[row];
        let leg = travel.leg;
        let stop = self.stop(row, leg)?;
        let corner = travel.aim().filter(|_| self.agents.status[row] == Status::Walking);
        let aim = corner.or_else(|| self.goal_middle(row, leg))?;
        let altitude = self.goals[stop.goal.index()].altitude().unwrap_or(0.0);
        Some((aim - self.settings.origin).as_vec2().extend(altitude as f32))
    }
}
