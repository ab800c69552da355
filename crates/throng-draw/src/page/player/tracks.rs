//! Trajectories, packed for a page: one word of 32 bits per agent and frame.
//!
//! From the lowest bit: 12 bits x and 12 bits y in parts of the larger side of the box, 6 bits heading in parts of a
//! turn, 2 bits status: 0 absent, 1 walking, 2 arrived, 3 cannot arrive. There are at most 25 frames per second. While
//! the data exceeds the limit of the page, every other frame is dropped, repeatedly. Of very many agents only every
//! n-th agent is kept.

use crate::WorldBox;
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use glam::DVec2;
use serde_json::{Value, json};
use std::f32::consts::TAU;
use throng::Status;
use throng_record::{Body, Frame};

/// The maximum number of words on a page: 12 MB of text.
const BUDGET: usize = 2_250_000;
/// The number of frames per run below which agents are dropped instead.
const FRAMES: usize = 60;
/// Frames per second.
const RATE: f64 = 25.0;

/// The trajectories of all runs.
pub struct PlayerTracks {
    corner: DVec2,
    quantum: f64,
    /// One agent of this many is kept.
    every: usize,
    /// The number of agents kept.
    slots: usize,
    /// The maximum number of frames per run.
    most: usize,
    /// The number of steps from one frame to the next.
    stride: u64,
    finest: u64,
    step: f64,
    runs: Vec<PlayerTrack>,
    radius: Vec<f32>,
    core: Vec<[f32; 2]>,
    group: Vec<u32>,
}

#[derive(Default)]
struct PlayerTrack {
    words: Vec<u32>,
    arrived: Vec<usize>,
    end: f64,
}

impl PlayerTracks {
    /// Creates the trajectories of `runs` runs within a box. Numbers of agents are below `agents`; `step` is the time
    /// between moments, seconds.
    pub fn new(runs: usize, agents: usize, step: f64, view: WorldBox) -> Self {
        Self::within(BUDGET, runs, agents, step, view)
    }

    /// Creates the trajectories within a budget of words.
    fn within(budget: usize, runs: usize, agents: usize, step: f64, view: WorldBox) -> Self {
        let room = 0.1 * (view.max - view.min).max_element() + 1.0;
        let (low, high) = (view.min - room, view.max + room);
        let every = (agents * runs * FRAMES).div_ceil(budget).max(1);
        let slots = agents.div_ceil(every);
        // Frames lie on steps, so that they are evenly spaced.
        let finest = (1.0 / (RATE * step) - 1e-6).ceil().max(1.0) as u64;
        Self {
            corner: low,
            quantum: (high - low).max_element() / 4095.0,
            every,
            slots,
            most: (budget / (slots * runs).max(1)).max(2),
            stride: finest,
            finest,
            step,
            runs: (0..runs).map(|_| PlayerTrack::default()).collect(),
            radius: vec![0.0; slots],
            core: vec![[0.0; 2]; slots],
            group: vec![0; slots],
        }
    }

    /// Adds a moment, `steps` steps after the first, of the runs that have reached it.
    pub fn push<'a>(&mut self, steps: u64, frames: impl IntoIterator<Item = (usize, &'a Frame)>) {
        if !steps.is_multiple_of(self.stride) {
            return;
        }
        for (k, frame) in frames {
            self.add(k, frame);
        }
        if self.runs.iter().any(|run| run.arrived.len() > self.most) {
            self.stride *= 2;
            for run in &mut self.runs {
                let mut words = run.words.chunks_exact(self.slots.max(1)).step_by(2).map(<[u32]>::to_vec);
                run.words = words.by_ref().flatten().collect();
                run.arrived = run.arrived.iter().copied().step_by(2).collect();
            }
        }
    }

    /// Adds the last moment of a run, `seconds` after its first.
    pub fn end(&mut self, run: usize, frame: &Frame, seconds: f64) {
        self.add(run, frame);
        self.runs[run].end = seconds;
    }

    fn add(&mut self, run: usize, frame: &Frame) {
        let from = self.runs[run].words.len();
        self.runs[run].words.resize(from + self.slots, 0);
        for body in frame.bodies.iter().filter(|body| (body.number as usize).is_multiple_of(self.every)) {
            let slot = body.number as usize / self.every;
            if slot < self.slots {
                (self.radius[slot], self.group[slot]) = (body.radius, body.group);
                self.core[slot] = body.core.into();
                self.runs[run].words[from + slot] = self.word(body);
            }
        }
        self.runs[run].arrived.push(frame.arrived);
    }

    fn word(&self, body: &Body) -> u32 {
        let at = ((body.position - self.corner) / self.quantum).round().clamp(DVec2::ZERO, DVec2::splat(4095.0));
        let heading = (body.heading.rem_euclid(TAU) / TAU * 64.0).round() as u32 % 64;
        let status = match body.status {
            Status::Walking | Status::Waiting => 1,
            Status::Arrived => 2,
            Status::Stranded => 3,
        };
        at.x as u32 | (at.y as u32) << 12 | heading << 24 | status << 30
    }

    /// Describes what was dropped; empty for nothing.
    pub fn left_out(&self) -> String {
        let rate = if self.stride > self.finest {
            format!("{} frames a second", (100.0 / self.seconds()).round() / 100.0)
        } else {
            String::new()
        };
        let agents = if self.every > 1 { format!("one of {} agents", self.every) } else { String::new() };
        [rate, agents].into_iter().filter(|text| !text.is_empty()).collect::<Vec<_>>().join(", ")
    }

    /// Returns the time from one frame to the next, seconds.
    fn seconds(&self) -> f64 {
        self.stride as f64 * self.step
    }

    /// Returns the data for the page's script. A run's last frame is at its end, all other frames are evenly spaced.
    pub fn json(&self) -> Value {
        let runs = self.runs.iter().map(|run| {
            let bytes: Vec<u8> = run.words.iter().flat_map(|word| word.to_le_bytes()).collect();
            json!({ "frames": run.arrived.len(), "end": run.end, "arrived": run.arrived, "words": BASE64_STANDARD.encode(&bytes) })
        });
        json!({
            "corner": [self.corner.x, self.corner.y],
            "quantum": self.quantum,
            "seconds": self.seconds(),
            "radius": self.radius,
            "core": self.core,
            "group": self.group,
            "runs": runs.collect::<Vec<_>>(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns two people that walk 100 steps of 0.04 s in two runs, within a budget of words.
    fn walk(budget: usize) -> PlayerTracks {
        let frame = |step: u32| {
            let body = |number: u32| {
                let x = f64::from(step) * 0.05 * if number == 0 { 1.0 } else { -1.0 };
                Body { number, position: DVec2::new(x, 1.0), ..BODY }
            };
            Frame { time: f64::from(step) * 0.04, bodies: vec![body(0), body(1)], ..Frame::default() }
        };
        let view = WorldBox { min: DVec2::splat(-10.0), max: DVec2::splat(10.0) };
        let mut tracks = PlayerTracks::within(budget, 2, 2, 0.04, view);
        for step in 0..=100 {
            let frame = frame(step);
            tracks.push(step.into(), [(0, &frame), (1, &frame)]);
        }
        (0..2).for_each(|run| tracks.end(run, &frame(100), 4.0));
        tracks
    }

    const BODY: Body = Body {
        number: 0,
        group: 0,
        goal: None,
        position: DVec2::ZERO,
        altitude: 0.0,
        velocity: glam::Vec2::ZERO,
        vertical_velocity: 0.0,
        heading: 0.0,
        basis: None,
        radius: 0.2,
        core: glam::Vec2::ZERO,
        preferred_speed: 1.0,
        status: Status::Walking,
    };

    #[test]
    fn data_over_the_budget_is_thinned_evenly() {
        let whole = walk(BUDGET);
        assert_eq!((whole.left_out().as_str(), whole.runs[0].arrived.len(), whole.seconds()), ("", 102, 0.04));
        // 102 frames of 2 agents in 2 runs are 408 words.
        let thin = walk(250);
        assert_eq!((thin.left_out().as_str(), thin.runs[1].arrived.len()), ("12.5 frames a second", 52));
        for (k, words) in thin.runs[1].words.chunks_exact(2).enumerate() {
            let frame = if k == 51 { 101 } else { 2 * k };
            assert_eq!(words, &whole.runs[1].words[2 * frame..][..2]);
        }
        let few = walk(200);
        assert_eq!((few.left_out().as_str(), few.runs[1].words.len()), ("12.5 frames a second, one of 2 agents", 52));
        assert!(few.runs[1].words.iter().zip(thin.runs[1].words.chunks_exact(2)).all(|(half, both)| *half == both[0]));
    }
}
