//! A few vehicles, each steered by a behaviour: everybody sees everybody, nearest first.

use glam::{Quat, Vec3};
use proptest::prelude::*;
use throng::motion::{Basis, Locomotion, Motion, Vehicle};
use throng::steer::{Behaviour, Branch, Dice, Event, Mark, Neighbour, Others, Steering, Told, View, Why};

/// Steps of time in which all that behaviours promise holds, seconds.
pub const RATES: [f32; 3] = [1.0 / 15.0, 1.0 / 60.0, 1.0 / 240.0];

/// One of them.
pub fn rate() -> impl Strategy<Value = f32> {
    prop::sample::select(&RATES[..])
}

pub fn vector(range: f32) -> impl Strategy<Value = Vec3> {
    (-range..range, -range..range, -range..range).prop_map(Vec3::from)
}

pub fn on_ground(range: f32) -> impl Strategy<Value = Vec3> {
    vector(range).prop_map(|v| v.with_z(0.0))
}

pub fn rotation() -> impl Strategy<Value = Quat> {
    (vector(1.0), 0.0f32..6.0).prop_filter_map("no axis", |(axis, angle)| {
        (axis.length() > 0.1).then(|| Quat::from_axis_angle(axis.normalize(), angle))
    })
}

pub fn angle(a: Vec3, b: Vec3) -> f32 {
    a.cross(b).length().atan2(a.dot(b))
}

pub fn flier() -> Vehicle {
    Vehicle { locomotion: Locomotion::Level, ..Vehicle::default() }
}

/// What a behaviour without a past says.
pub fn ask(behaviour: &dyn Behaviour, view: &View<'_>) -> Option<Steering> {
    behaviour.steer(view, &mut vec![0.0; behaviour.memory()], &mut Why::default())
}

/// What it says, and why.
pub fn told(behaviour: &dyn Behaviour, view: &View<'_>) -> (Option<Steering>, Vec<Told>) {
    let mut told = Vec::new();
    let said = behaviour.steer(view, &mut vec![0.0; behaviour.memory()], &mut Why::asked(&mut told));
    (said, told)
}

/// One that is steered.
#[derive(Clone, Debug)]
pub struct Actor {
    pub motion: Motion,
    pub vehicle: Vehicle,
    pub group: usize,
    pub slot: usize,
    pub behaviour: Branch,
    pub memory: Vec<f32>,
    pub said: Option<Steering>,
}

impl Actor {
    pub fn new(motion: Motion, vehicle: Vehicle, behaviour: impl Into<Branch>) -> Self {
        let behaviour = behaviour.into();
        let memory = vec![0.0; behaviour.words()];
        Self { motion, vehicle, group: 0, slot: 0, behaviour, memory, said: None }
    }
}

#[derive(Clone, Debug, Default)]
pub struct Stage {
    pub actors: Vec<Actor>,
    pub events: Vec<Event>,
    pub step: u64,
    pub seconds: f32,
    pub seed: u64,
}

pub const RADIUS: f32 = 0.2;

impl Others for Stage {
    fn find(&self, number: u32) -> Option<Mark> {
        let Motion { position, velocity, basis, .. } = self.actors.get(number as usize)?.motion;
        Some(Mark { position, velocity, basis, radius: RADIUS })
    }
}

impl Stage {
    pub fn new(seconds: f32, actors: Vec<Actor>) -> Self {
        Self { actors, seconds, ..Self::default() }
    }

    pub fn time(&self) -> f64 {
        self.step as f64 * f64::from(self.seconds)
    }

    pub fn neighbours(&self, row: usize) -> Vec<Neighbour> {
        let own = self.actors[row].motion.position;
        let others = self.actors.iter().enumerate().filter(|(other, _)| *other != row);
        let mut all: Vec<Neighbour> = others
            .map(|(number, other)| Neighbour {
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

    pub fn view<'a>(&'a self, row: usize, neighbours: &'a [Neighbour]) -> View<'a> {
        let Actor { motion, vehicle, group, slot, .. } = self.actors[row];
        View {
            motion,
            vehicle,
            radius: RADIUS,
            group,
            slot,
            neighbours,
            others: self,
            events: &self.events,
            time: self.time(),
            seconds: self.seconds,
            dice: Dice { seed: self.seed, number: row as u32, step: self.step },
            ..View::default()
        }
    }

    /// Everybody moves on by a step; all see the start of it.
    pub fn step(&mut self) {
        let before = self.clone();
        for row in 0..self.actors.len() {
            let neighbours = before.neighbours(row);
            let view = before.view(row, &neighbours);
            let actor = &mut self.actors[row];
            actor.said = actor.behaviour.steer(&view, &mut actor.memory, &mut Why::default());
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

    /// The same, turned about the origin.
    pub fn turned(&self, by: Quat) -> Self {
        let turn = |motion: Motion| Motion {
            position: by * motion.position,
            velocity: by * motion.velocity,
            basis: turn_basis(by, motion.basis),
            acceleration: by * motion.acceleration,
            curvature: by * motion.curvature,
        };
        let actors = self.actors.iter().map(|actor| Actor { motion: turn(actor.motion), ..actor.clone() }).collect();
        let events = self.events.iter().map(|e| Event { position: by * e.position, ..*e }).collect();
        Self { actors, events, ..self.clone() }
    }
}

fn turn_basis(by: Quat, Basis { forward, side, up }: Basis) -> Basis {
    Basis { forward: by * forward, side: by * side, up: by * up }
}
