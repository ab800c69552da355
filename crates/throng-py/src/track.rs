//! The track of an agent: its state and its pose at any time.

use glam::{DQuat, DVec3};
use std::f64::consts::{PI, TAU};
use std::sync::OnceLock;
use throng_figure::{JOINTS, Person, Skeleton, Walk};

/// The state of an agent at a time.
pub struct State {
    pub number: u32,
    pub group: u32,
    pub radius: f32,
    pub time: f64,
    pub place: DVec3,
    pub heading: f64,
}

/// Positions and rotations, number by number.
type Parts = (Vec<f64>, Vec<f32>);

/// An agent with its samples.
pub struct Agent {
    pub number: u32,
    pub group: u32,
    pub radius: f32,
    /// The person, if the agent is one.
    pub person: Option<Person>,
    /// In the order of time; at least one when anything is asked.
    pub track: Vec<Moment>,
    /// Planned when it is first needed.
    walk: OnceLock<Walk>,
}

/// A sample.
#[derive(Clone, Copy)]
pub struct Moment {
    pub time: f64,
    pub place: DVec3,
    pub heading: f64,
}

impl Agent {
    pub fn new(number: u32, group: u32, radius: f32) -> Self {
        Self { number, group, radius, person: None, track: vec![], walk: OnceLock::new() }
    }

    /// Returns the times of the first and the last sample, seconds.
    pub fn span(&self) -> [f64; 2] {
        [self.track[0].time, self.track[self.track.len() - 1].time]
    }

    fn is_there(&self, time: f64) -> bool {
        let [first, last] = self.span();
        (first..=last).contains(&time)
    }

    /// Returns the state at a time, between samples on a line and by the shorter turn.
    pub fn at(&self, time: f64) -> Moment {
        if !self.is_there(time) {
            return Moment { time, place: DVec3::NAN, heading: f64::NAN };
        }
        let next = self.track.partition_point(|moment| moment.time <= time);
        let before = self.track[next - 1];
        let Some(after) = self.track.get(next) else { return before };
        let share = (time - before.time) / (after.time - before.time);
        let turn = (after.heading - before.heading + PI).rem_euclid(TAU) - PI;
        Moment { time, place: before.place.lerp(after.place, share), heading: before.heading + turn * share }
    }

    /// Returns the walk, which is planned at the first call.
    fn walk(&self, person: &Person) -> Result<&Walk, throng_figure::Error> {
        if let Some(walk) = self.walk.get() {
            return Ok(walk);
        }
        let sample = |&Moment { time, place, heading }: &Moment| throng_figure::Sample {
            time,
            position: place.truncate(),
            heading,
        };
        let samples: Vec<_> = self.track.iter().map(sample).collect();
        let walk = Walk::recorded(person, &samples)?;
        Ok(self.walk.get_or_init(|| walk))
    }

    /// Returns positions and rotations at times, as `Trajectories::poses` describes them.
    pub fn poses(&self, person: &Person, times: &[f64], world: bool) -> Result<Parts, throng_figure::Error> {
        let (walk, skeleton) = (self.walk(person)?, Skeleton::new(person));
        let (mut places, mut turns) = (vec![], vec![]);
        for &time in times {
            let pose = self.is_there(time).then(|| walk.pose(time));
            if world {
                let joints = pose.map(|pose| skeleton.world(&pose));
                let place = |joint: usize| joints.map_or(DVec3::NAN, |joints| joints[joint].position);
                places.extend((0..JOINTS).flat_map(|joint| place(joint).to_array()));
                let turn = |joint: usize| joints.map_or(DQuat::NAN, |joints| joints[joint].rotation);
                turns.extend((0..JOINTS).flat_map(|joint| wxyz(turn(joint))));
            } else {
                places.extend(pose.map_or(DVec3::NAN, |pose| pose.hips).to_array());
                let turn = |joint: usize| pose.map_or(DQuat::NAN, |pose| pose.rotations[joint]);
                turns.extend((0..JOINTS).flat_map(|joint| wxyz(turn(joint))));
            }
        }
        Ok((places, turns))
    }
}

fn wxyz(turn: DQuat) -> [f32; 4] {
    [turn.w, turn.x, turn.y, turn.z].map(|part| part as f32)
}
