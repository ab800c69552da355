//! Intention, for agents with behaviours or vehicles.
//!
//! A behaviour returns a force. Without a behaviour, the force of a vehicle leads to the velocity of its journey or
//! field. The velocity that the motor reaches with the force is the preferred velocity. Avoidance and guard follow, as
//! for all agents.

use super::flock::Flocks;
use super::govern::Sources;
use super::velocities::{Rows, Velocities, set};
use crate::agent::{ColumnValue, Columns, Group, Guidance, Memory, Status};
use crate::halo::{FarQuestions, Halo, ask_far};
use crate::motion::{Attitude, Basis, Motion, Steering, Stepping, Vehicle};
use crate::navigate::{NeighbourData, Surroundings};
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

/// The planned motion of agents with behaviours or vehicles, if nothing hinders them, by row.
#[derive(Clone, Debug, Default)]
pub(crate) struct Planned {
    pub velocity: Vec<Vec3>,
    pub attitude: Vec<Attitude>,
    /// Whether they face the direction that the behaviour requests, instead of the direction of motion.
    pub faces: Vec<bool>,
}

/// Number of the words of a planned motion.
const WORDS: usize = 19;

impl Planned {
    /// Returns the planned motion of a row as words; zeros if no motion is planned.
    pub fn words(&self, row: usize) -> [u32; WORDS] {
        let mut words = [0; WORDS];
        if row < self.faces.len() {
            let record = self.attitude[row].record();
            let numbers = self.velocity[row].to_array().into_iter().chain(record).map(f32::to_bits);
            words.iter_mut().zip(numbers).for_each(|(word, number)| *word = number);
            // the place of the zero of the record
            words[WORDS - 1] = u32::from(self.faces[row]);
        }
        words
    }

    /// Sets the planned motion of a row from [`words`](Self::words), if any motion is planned.
    pub fn set_words(&mut self, row: usize, words: [u32; WORDS]) {
        if row >= self.faces.len() {
            return;
        }
        let [x, y, z, record @ ..] = words.map(f32::from_bits);
        self.velocity[row] = Vec3::new(x, y, z);
        self.attitude[row] = Attitude::of_record(&record);
        self.faces[row] = words[WORDS - 1] != 0;
    }

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

/// Computes the planned motions.
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
    /// Computes the planned motions, and so the preferred velocities, of all agents with behaviours or vehicles. In a
    /// division it does so again while behaviours of any world read further agents of other worlds.
    pub fn run(
        &mut self,
        state: &mut State,
        around: (Perceived<'_>, &[NeighbourData]),
        sources: &Sources,
        preferred: &mut Velocities,
        time: (f32, f64),
        halo: &mut dyn Halo,
    ) {
        if !(state.others.are_there && state.may_behave()) {
            return self.plan(state, around, sources, preferred, time, None);
        }
        let before = (state.agents.memory.clone(), preferred.clone());
        loop {
            let questions = FarQuestions::default();
            self.plan(state, around, sources, preferred, time, Some(&questions));
            if !ask_far(state, halo, questions) {
                return;
            }
            (state.agents.memory, *preferred) = before.clone();
        }
    }

    /// Computes the planned motions once. Notes `questions` about agents of other worlds.
    fn plan(
        &mut self,
        state: &mut State,
        (seen, shown): (Perceived<'_>, &[NeighbourData]),
        sources: &Sources,
        preferred: &mut Velocities,
        (seconds, now): (f32, f64),
        questions: Option<&FarQuestions>,
    ) {
        self.flocks.clear();
        if !state.any_plans() {
            self.planned.resize(0);
            return;
        }
        state.stimuli.retain(|stimulus| now - stimulus.time <= FORGOTTEN);
        self.index.rebuild(state);
        self.flocks.run(state, seen, (&self.index, questions), seconds, now);
        let Self { planned, flocks, index, scratch } = self;
        planned.resize(state.agents.len());
        state.with_memory(|state, memory| {
            let behaving = Behaving::new(state, seen, (index, questions), (&flocks.birds, &flocks.forces));
            let around = Surroundings { state, near: seen.near, shown };
            behaving.run(planned, memory, preferred, scratch, Frame { around, sources, seconds, now });
        });
    }

    /// Returns what the behaviours read, after a sub-step.
    pub fn view<'a>(&'a self, state: &'a State, seen: Perceived<'a>) -> Behaving<'a> {
        Behaving::new(state, seen, (&self.index, None), (&self.flocks.birds, &self.flocks.forces))
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
    /// Returns the preferred velocity of a row so far.
    fn preferred(&self, row: usize) -> Vec3 {
        let (ground, vertical_velocity) = &self.preferred;
        let at = row - self.first;
        ground[at].extend(vertical_velocity.all.get(at).copied().unwrap_or(0.0))
    }

    /// Sets the planned motion of a vehicle with this steering, from its present motion.
    pub fn plan(&mut self, row: usize, steering: Steering, (vehicle, before): (&Vehicle, Motion), seconds: f32) {
        let mut motion = before;
        vehicle.step(&mut motion, steering, seconds);
        let at = row - self.first;
        set(&mut self.preferred, at, (motion.position - before.position) / seconds);
        (self.velocity[at], self.attitude[at]) = (motion.velocity, motion.into());
        self.faces[at] = steering.facing.is_some();
    }

    /// Makes the planned velocity of a row the preferred velocity.
    fn prefer_planned(&mut self, row: usize) {
        let at = row - self.first;
        set(&mut self.preferred, at, self.velocity[at]);
    }

    /// Sets the preferred velocity of an agent without a vehicle, and the direction that it is to face.
    fn aim(&mut self, row: usize, velocity: Vec3, facing: Option<Vec3>) {
        let at = row - self.first;
        set(&mut self.preferred, at, velocity);
        self.faces[at] = facing.is_some();
        self.attitude[at].basis = facing.map_or(Basis::default(), Basis::facing);
    }

    /// Returns the memory of a behaviour for a row.
    pub fn memory(&mut self, row: usize, words: usize) -> &mut [f32] {
        &mut self.memory.all[(row - self.first) * self.memory.stride..][..words]
    }
}

/// What the steering of all agents depends on, in the sub-step that ends at `now`.
#[derive(Clone, Copy)]
pub(super) struct Frame<'a> {
    around: Surroundings<'a>,
    sources: &'a Sources,
    pub seconds: f32,
    pub now: f64,
}

/// What steers agents of a group.
#[derive(Clone, Copy)]
pub(super) struct GroupSteering<'a> {
    pub group: &'a Group,
    pub behaviour: &'a BoxedBehaviour,
    pub frame: Frame<'a>,
}

/// What behaviours read.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Behaving<'a> {
    pub(super) state: &'a State,
    pub(super) near: &'a Neighbours,
    pub(super) lattice: &'a CellLattice,
    pub(super) index: &'a SteeringIndex,
    /// Takes questions about agents of other worlds.
    questions: Option<&'a FarQuestions>,
    /// The data of all agents, in the order of the lattice, if any agent searches for all neighbours.
    pub(super) birds: &'a Birds,
    /// The forces of the birds of flocks, in the order of the lattice.
    pub(super) forces: &'a [Vec3],
}

impl AgentQuery for Behaving<'_> {
    fn find(&self, number: u32) -> Option<Kinematics> {
        match self.index.rows.get(number as usize) {
            Some(&row) if row != u32::MAX => Some(self.state.kinematics(row as usize)),
            _ => self.state.others.far.find(number, self.questions),
        }
    }

    fn slot(&self, number: u32) -> usize {
        let Some(&row) = self.index.rows.get(number as usize).filter(|&&row| row != u32::MAX) else { return 0 };
        if self.state.others.are_there {
            let group = self.state.agents.group[row as usize];
            return self.state.others.far.slot(group.0, number, self.questions);
        }
        self.index.slots[row as usize] as usize
    }
}

impl<'a> Behaving<'a> {
    pub(super) fn new(
        state: &'a State,
        seen: Perceived<'a>,
        (index, questions): (&'a SteeringIndex, Option<&'a FarQuestions>),
        (birds, forces): (&'a Birds, &'a [Vec3]),
    ) -> Self {
        Self { state, near: seen.near, lattice: seen.lattice, index, questions, birds, forces }
    }

    /// Computes the planned motions of all agents that steer.
    fn run(
        &self,
        planned: &mut Planned,
        memory: &mut Memory,
        preferred: &mut Velocities,
        scratch: &mut Vec<SteeringScratch>,
        frame: Frame<'_>,
    ) {
        let Planned { velocity, attitude, faces } = planned;
        let all = ((&mut velocity[..], &mut attitude[..], &mut faces[..]), memory.lists(), preferred.rows());
        let state = self.state;
        let any_vehicle = state.any_vehicle();
        let groups = || {
            let plans = |group: &Group| any_vehicle || group.guidance.behaviour.is_some();
            let all = state.local_groups.iter().zip(&state.groups_with_agents).enumerate();
            all.filter(move |(_, (group, in_use))| **in_use && plans(group)).map(|(index, (group, _))| (index, group))
        };
        parallel::costly_ranges_with(
            all,
            scratch,
            |scratch, range, ((velocity, attitude, faces), memory, preferred)| {
                let mut plans = Plans { first: range.start, velocity, attitude, faces, preferred, memory };
                // a row that plans nothing requests no facing
                plans.faces.fill(false);
                let SteeringScratch { rows, neighbours } = scratch;
                for (index, group) in groups() {
                    rows.clear();
                    // the worlds of ghosts steer them
                    let all = range.start as u32..range.end.min(state.own().end) as u32;
                    let belongs = |row: usize| state.agents.group[row].index() == index && state.plans(row);
                    rows.extend(all.filter(|&row| belongs(row as usize)));
                    // a SIMD vector holds agents with the same vehicle
                    for rows in rows.chunk_by(|&a, &b| state.share_vehicle(a as usize, b as usize)) {
                        match self.in_lanes(group, rows[0] as usize, frame) {
                            Some((level, stepping, of)) => {
                                self.steer_many((level, stepping), &of, rows, &mut plans, neighbours);
                            }
                            None => rows
                                .iter()
                                .for_each(|&row| self.steer(group, row as usize, frame, &mut plans, neighbours)),
                        }
                    }
                }
            },
        );
    }

    /// Returns what steers agents of a group with SIMD, and the SIMD level and the step of their vehicle, which is that of
    /// `row`; `None` if the kernel does not support them.
    fn in_lanes(&self, group: &'a Group, row: usize, frame: Frame<'a>) -> Option<(Level, Stepping, GroupSteering<'a>)> {
        let Guidance { behaviour: Some(behaviour), field: None } = &group.guidance else { return None };
        let level = self.state.instructions.level()?;
        let stepping = Stepping::of(&self.state.vehicle(row)?, frame.seconds)?;
        let is_commanded = self.state.agents.commanded.uniform() != Some(None);
        (!is_commanded).then_some((level, stepping, GroupSteering { group, behaviour, frame }))
    }

    /// Sets the planned motion of an agent. A vehicle steers to the velocity of its guidance; the limits of other motors
    /// apply after avoidance.
    fn steer(
        &self,
        group: &Group,
        row: usize,
        frame: Frame<'_>,
        plans: &mut Plans<'_>,
        neighbours: &mut Vec<SteeringNeighbour>,
    ) {
        let Frame { around, sources, seconds, now } = frame;
        let behaviour = group.guidance.behaviour.as_ref().filter(|_| self.state.agents.commanded[row].is_none());
        let own = behaviour.map(|behaviour| self.steering(group, behaviour, row, (seconds, now), plans, neighbours));
        let (vehicle, motion) = (self.state.steered_vehicle(row, seconds), self.state.motion(row));
        let leads_to = |velocity: Vec3| vehicle.force_towards(&motion, velocity, seconds).into();
        let aim = |own: Steering| {
            let aim = vehicle.velocity_of(&motion, own.force, seconds).clamp_length_max(vehicle.max_speed);
            if aim.is_finite() { aim } else { motion.velocity }
        };
        let governed = |aim: Vec3| sources.governed(around, row, aim, now);
        if !self.state.has_vehicle(row) {
            let velocity = own.map_or(plans.preferred(row), |own| governed(aim(own)));
            plans.aim(row, velocity.with_z(0.0), own.and_then(|own| own.facing));
            return;
        }
        let steering = match own {
            None => leads_to(plans.preferred(row)),
            Some(own) if group.guidance.field.is_none() => own,
            Some(own) => {
                let aim = aim(own);
                let governed = governed(aim);
                if governed == aim { own } else { Steering { facing: own.facing, ..leads_to(governed) } }
            }
        };
        plans.plan(row, steering, (&vehicle, motion), seconds);
        if own.is_none() {
            // the exact velocity, where a displacement is rounded to the resolution of positions: it decays to rest
            plans.prefer_planned(row);
        }
    }

    /// Returns the steering of an agent by its behaviour.
    fn steering(
        &self,
        group: &Group,
        behaviour: &BoxedBehaviour,
        row: usize,
        (seconds, now): (f32, f64),
        plans: &mut Plans<'_>,
        neighbours: &mut Vec<SteeringNeighbour>,
    ) -> Steering {
        if group.is_flock() {
            return self.force(row).into();
        }
        let view = self.view(row, seconds, now, neighbours);
        let memory = plans.memory(row, behaviour.words());
        behaviour.steer(&view, memory, &mut TraceRecorder::default()).unwrap_or_default()
    }

    /// Returns the steering of an agent in the sub-step that ends at `now`, and the recorded reasons.
    pub fn reasons(&self, row: usize, seconds: f32, now: f64) -> (Option<Steering>, Vec<TraceEntry>) {
        let mut entries = Vec::new();
        let said = self.state.behaviour(row).and_then(|steering| {
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
            vehicle: self.state.steered_vehicle(row, seconds),
            radius: agents.radius[row],
            group: agents.group[row].index(),
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
    /// Returns the behaviour that an agent steers by.
    pub(crate) fn behaviour(&self, row: usize) -> Option<&BoxedBehaviour> {
        self.local_groups[self.agents.group[row].index()].guidance.behaviour.as_ref()
    }

    /// Returns the vehicle that moves an agent. A script needs none.
    pub(crate) fn vehicle(&self, row: usize) -> Option<Vehicle> {
        self.agents.vehicle[row].filter(|_| self.agents.script[row].is_none())
    }

    /// Whether a vehicle moves an agent.
    #[inline(always)]
    pub(crate) fn has_vehicle(&self, row: usize) -> bool {
        self.agents.vehicle[row].is_some() && self.agents.script[row].is_none()
    }

    /// Returns the vehicle that the behaviour of an agent steers.
    fn steered_vehicle(&self, row: usize, seconds: f32) -> Vehicle {
        self.agents.vehicle[row].unwrap_or_else(|| self.agents.motor(row).vehicle(seconds))
    }

    /// Whether two agents have the same motor, if it is a vehicle.
    fn share_vehicle(&self, row: usize, other: usize) -> bool {
        let vehicle = &self.agents.vehicle;
        vehicle.uniform().is_some() || vehicle[row].same(vehicle[other])
    }

    /// Whether the motion of an agent is planned: it has a behaviour or a vehicle.
    fn plans(&self, row: usize) -> bool {
        let Columns { vehicle, script, commanded, .. } = &self.agents;
        let behaves = || commanded[row].is_none() && self.behaviour(row).is_some();
        script[row].is_none() && (vehicle[row].is_some() || behaves())
    }

    /// Whether the motion of any agent is planned.
    pub(crate) fn any_plans(&self) -> bool {
        self.any_vehicle() || self.groups_in_use().any(|group| group.guidance.behaviour.is_some())
    }

    /// Whether a vehicle moves any agent.
    pub(crate) fn any_vehicle(&self) -> bool {
        self.agents.vehicle.values().iter().any(Option::is_some)
    }

    /// Whether all agents steer by behaviours.
    pub(crate) fn all_behave(&self) -> bool {
        self.agents.script.uniform() == Some(None)
            && self.groups_in_use().all(|group| group.guidance.behaviour.is_some())
    }

    /// Whether any agent may leave the ground because its vehicle flies.
    pub(crate) fn any_vehicle_flies(&self) -> bool {
        self.agents.vehicle.values().iter().flatten().any(|vehicle| vehicle.flies())
    }

    /// Returns the position, velocity and orientation of an agent.
    pub(crate) fn motion(&self, row: usize) -> Motion {
        let agents = &self.agents;
        let position = self.place_in_space(row);
        let velocity = agents.velocity_in_space(row);
        if self.has_vehicle(row) {
            agents.attitude[row].motion(position, velocity)
        } else {
            Motion { position, velocity, basis: Basis::facing(self.forward(row)), ..Motion::default() }
        }
    }

    /// Returns the motion of an agent, as behaviours see it.
    pub(crate) fn kinematics(&self, row: usize) -> Kinematics {
        let Motion { position, velocity, basis, .. } = self.motion(row);
        Kinematics { position, velocity, basis, radius: self.agents.radius[row] }
    }

    /// Returns the centre of an agent in space.
    pub(crate) fn place_in_space(&self, row: usize) -> Vec3 {
        self.agents.position[row].extend(self.agents.altitude[row])
    }

    /// Returns the direction that an agent faces.
    pub(crate) fn forward(&self, row: usize) -> Vec3 {
        if self.has_vehicle(row) {
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
