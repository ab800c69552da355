//! A few vehicles, each steered by a behaviour: all agents are neighbours of each other, nearest first.

pub use crate::vehicles::{RATES, angle, flier, vector};
use glam::{Quat, Vec3};
use proptest::prelude::*;
use throng::motion::{Basis, Motion, Vehicle};
use throng::steer::{
    AgentQuery, Behaviour, BoxedBehaviour, Kinematics, Rng, Steering, SteeringInput, SteeringNeighbour, Stimulus,
    TraceEntry, TraceRecorder,
};

/// One of the time steps.
pub fn rate() -> impl Strategy<Value = f32> {
    prop::sample::select(&RATES[..])
}

pub fn on_ground(range: f32) -> impl Strategy<Value = Vec3> {
    vector(range).prop_map(|v| v.with_z(0.0))
}

pub fn rotation() -> impl Strategy<Value = Quat> {
    (vector(1.0), 0.0f32..6.0).prop_filter_map("no axis", |(axis, angle)| {
        (axis.length() > 0.1).then(|| Quat::from_axis_angle(axis.normalize(), angle))
    })
}

/// Returns the steering of a behaviour with empty memory.
pub fn ask(behaviour: &dyn Behaviour, view: &SteeringInput<'_>) -> Option<Steering> {
    behaviour.steer(view, &mut vec![0.0; behaviour.memory()], &mut TraceRecorder::default())
}

/// Returns the steering, and the trace.
pub fn told(behaviour: &dyn Behaviour, view: &SteeringInput<'_>) -> (Option<Steering>, Vec<TraceEntry>) {
    let mut told = Vec::new();
    let said = behaviour.steer(view, &mut vec![0.0; behaviour.memory()], &mut TraceRecorder::requested(&mut told));
    (said, told)
}

/// A steered vehicle.
#[derive(Clone, Debug)]
pub struct Actor {
    pub motion: Motion,
    pub vehicle: Vehicle,
    pub group: usize,
    pub slot: usize,
    pub behaviour: BoxedBehaviour,
    pub memory: Vec<f32>,
    pub said: Option<Steering>,
}

impl Actor {
    pub fn new(motion: Motion, vehicle: Vehicle, behaviour: impl Into<BoxedBehaviour>) -> Self {
        let behaviour = behaviour.into();
        let memory = vec![0.0; behaviour.words()];
        Self { motion, vehicle, group: 0, slot: 0, behaviour, memory, said: None }
    }
}

#[derive(Clone, Debug, Default)]
pub struct Stage {
    pub actors: Vec<Actor>,
    pub stimuli: Vec<Stimulus>,
    pub step: u64,
    pub seconds: f32,
    pub seed: u64,
}

pub const RADIUS: f32 = 0.2;

impl AgentQuery for Stage {
    fn find(&self, number: u32) -> Option<Kinematics> {
        let Motion { position, velocity, basis, .. } = self.actors.get(number as usize)?.motion;
        Some(Kinematics { position, velocity, basis, radius: RADIUS })
    }

    fn slot(&self, number: u32) -> usize {
        self.actors[number as usize].slot
    }
}

impl Stage {
    pub fn new(seconds: f32, actors: Vec<Actor>) -> Self {
        Self { actors, seconds, ..Self::default() }
    }

    pub fn time(&self) -> f64 {
        self.step as f64 * f64::from(self.seconds)
    }

    pub fn neighbours(&self, row: usize) -> Vec<SteeringNeighbour> {
        let own = self.actors[row].motion.position;
        let others = self.actors.iter().enumerate().filter(|(other, _)| *other != row);
        let mut all: Vec<SteeringNeighbour> = others
            .map(|(number, other)| SteeringNeighbour {
                offset: other.motion.position - own,
                velocity: other.motion.velocity,
                forward: other.motion.basis.forward,
                radius: RADIUS,
                number: number as u32,
                group: other.group,
            })
            .collect();
        all.sort_by(|a, b| a.offset.length().total_cmp(&b.offset.length()).then(a.number.cmp(&b.number)));
        all
    }

    pub fn view<'a>(&'a self, row: usize, neighbours: &'a [SteeringNeighbour]) -> SteeringInput<'a> {
        let Actor { motion, vehicle, group, .. } = self.actors[row];
        SteeringInput {
            motion,
            vehicle,
            radius: RADIUS,
            group,
            neighbours,
            others: self,
            stimuli: &self.stimuli,
            time: self.time(),
            seconds: self.seconds,
            rng: Rng { seed: self.seed, number: row as u32, step: self.step },
            ..SteeringInput::default()
        }
    }

    /// Moves all vehicles by a step; all see the state at its start.
    pub fn step(&mut self) {
        let before = self.clone();
        for row in 0..self.actors.len() {
            let neighbours = before.neighbours(row);
            let view = before.view(row, &neighbours);
            let actor = &mut self.actors[row];
            actor.said = actor.behaviour.steer(&view, &mut actor.memory, &mut TraceRecorder::default());
            actor.vehicle.step(&mut actor.motion, actor.said.unwrap_or_default(), self.seconds);
        }
        self.step += 1;
    }

    pub fn run(&mut self, seconds: f32, mut after: impl FnMut(&Self)) {
        for _ in 0..(seconds / self.seconds).round() as usize {
            self.step();
            after(self);
        }
    }

    /// Returns the stage rotated about the origin.
    pub fn turned(&self, by: Quat) -> Self {
        let turn = |motion: Motion| Motion {
            position: by * motion.position,
            velocity: by * motion.velocity,
            basis: turn_basis(by, motion.basis),
            acceleration: by * motion.acceleration,
            curvature: by * motion.curvature,
        };
        let actors = self.actors.iter().map(|actor| Actor { motion: turn(actor.motion), ..actor.clone() }).collect();
        let stimuli = self.stimuli.iter().map(|e| Stimulus { position: by * e.position, ..*e }).collect();
        Self { actors, stimuli, ..self.clone() }
    }
}

fn turn_basis(by: Quat, Basis { forward, side, up }: Basis) -> Basis {
    Basis { forward: by * forward, side: by * side, up: by * up }
}
