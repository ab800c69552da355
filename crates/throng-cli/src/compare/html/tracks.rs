//! Trajectories, small enough for a page: a word of 32 bits an agent and frame.
//!
//! From the lowest bit: 12 bits x and 12 bits y in parts of the larger side of the box, 6 bits heading in parts of a
//! turn, 2 bits status: 0 not there, 1 on its way, 2 arrived, 3 cannot arrive. At 25 frames a second at most; where
//! that is more than the page should hold, every other frame is left out, again and again, and of very many agents only
//! every n-th is kept.

use super::super::race::Run;
use glam::DVec2;
use serde_json::{Value, json};
use std::f32::consts::TAU;
use throng::Status;
use throng_draw::WorldBox;
use throng_draw::base64;
use throng_record::{Body, Frame};

/// Words on a page: 12 MB of text.
const BUDGET: usize = 2_250_000;
/// Frames a run, for which rather agents are left out.
const FRAMES: usize = 60;
/// Frames a second.
const RATE: f64 = 25.0;

/// Trajectories of all runs.
pub struct Tracks {
    corner: DVec2,
    quantum: f64,
    /// Of so many agents one is kept.
    every: usize,
    /// Agents kept.
    slots: usize,
    /// Frames a run at most.
    most: usize,
    /// Steps from one frame to the next.
    stride: u64,
    finest: u64,
    step: f64,
    runs: Vec<Track>,
    radius: Vec<f32>,
    core: Vec<[f32; 2]>,
    group: Vec<u32>,
}

#[derive(Default)]
struct Track {
    words: Vec<u32>,
    arrived: Vec<usize>,
    end: f64,
}

impl Tracks {
    /// Of these runs, in this box.
    pub fn new(runs: &[Run], view: WorldBox) -> Self {
        Self::within(BUDGET, runs, view)
    }

    /// In so many words.
    fn within(budget: usize, runs: &[Run], view: WorldBox) -> Self {
        let room = 0.1 * (view.max - view.min).max_element() + 1.0;
        let (low, high) = (view.min - room, view.max + room);
        // what moves by a script has a number too
        let present = runs.iter().flat_map(|run| &run.frame.bodies).map(|body| body.number as usize + 1);
        let agents = present.chain(runs.iter().map(|run| run.built.agents)).max().unwrap_or(0);
        let every = (agents * runs.len() * FRAMES).div_ceil(budget).max(1);
        let slots = agents.div_ceil(every);
        let step = runs[0].world.settings().step;
        // frames lie on steps, so that they are evenly apart
        let finest = (1.0 / (RATE * step) - 1e-6).ceil().max(1.0) as u64;
        Self {
            corner: low,
            quantum: (high - low).max_element() / 4095.0,
            every,
            slots,
            most: (budget / (slots * runs.len()).max(1)).max(2),
            stride: finest,
            finest,
            step,
            runs: runs.iter().map(|_| Track::default()).collect(),
            radius: vec![0.0; slots],
            core: vec![[0.0; 2]; slots],
            group: vec![0; slots],
        }
    }

    /// Takes in the runs that have moved on.
    pub fn push(&mut self, runs: &[Run]) {
        let now = runs.iter().map(|run| run.world.steps()).max().unwrap_or(0);
        if now % self.stride != 0 {
            return;
        }
        for (k, run) in runs.iter().enumerate().filter(|(_, run)| run.world.steps() == now) {
            self.add(k, &run.frame);
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

    /// Adds the last moment of each run.
    pub fn end(&mut self, runs: &[Run]) {
        for (k, run) in runs.iter().enumerate() {
            self.add(k, &run.frame);
            self.runs[k].end = run.frame.time;
        }
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

    /// What was left out, in words; empty for nothing.
    pub fn left_out(&self) -> String {
        let rate = if self.stride > self.finest {
            format!("{} frames a second", (100.0 / self.seconds()).round() / 100.0)
        } else {
            String::new()
        };
        let agents = if self.every > 1 { format!("one of {} agents", self.every) } else { String::new() };
        [rate, agents].into_iter().filter(|text| !text.is_empty()).collect::<Vec<_>>().join(", ")
    }

    /// From one frame to the next.
    fn seconds(&self) -> f64 {
        self.stride as f64 * self.step
    }

    /// As the page's script reads it. A run's last frame is at its end, the others are evenly apart.
    pub fn json(&self) -> Value {
        let runs = self.runs.iter().map(|run| {
            let bytes: Vec<u8> = run.words.iter().flat_map(|word| word.to_le_bytes()).collect();
            json!({ "frames": run.arrived.len(), "end": run.end, "arrived": run.arrived, "words": base64(&bytes) })
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
    use super::super::super::race::{Plan, Race};
    use super::*;
    use crate::progress::Progress;
    use crate::threads::Workers;

    /// The scene headon, 2 people, 100 steps of 0.04 s in so many words for two models.
    fn headon(budget: usize) -> Tracks {
        use crate::args::{Arguments, Command};
        use clap::Parser;
        let arguments = Arguments::parse_from(["throng", "compare", "headon", "-m", "vo,orca"]);
        let Command::Compare(args) = arguments.command else { panic!() };
        let (loaded, models) = (args.scene.load().unwrap(), args.models().unwrap());
        let plan = Plan { loaded, models, seeds: vec![1] };
        let workers = Workers::new(1, 1).unwrap();
        let mut race = Race::start(&plan, &workers, Progress::new(true)).unwrap();
        let view = WorldBox { min: DVec2::splat(-10.0), max: DVec2::splat(10.0) };
        let mut tracks = Tracks::within(budget, race.leaders(), view);
        tracks.push(race.leaders());
        for _ in 0..100 {
            assert!(race.step());
            tracks.push(race.leaders());
        }
        tracks.end(race.leaders());
        tracks
    }

    #[test]
    fn what_would_be_too_much_is_thinned_evenly() {
        let whole = headon(BUDGET);
        assert_eq!((whole.left_out().as_str(), whole.runs[0].arrived.len(), whole.seconds()), ("", 102, 0.04));
        // 102 frames of 2 agents of 2 models are 408 words
        let thin = headon(250);
        assert_eq!((thin.left_out().as_str(), thin.runs[1].arrived.len()), ("12.5 frames a second", 52));
        for (k, words) in thin.runs[1].words.chunks_exact(2).enumerate() {
            let frame = if k == 51 { 101 } else { 2 * k };
            assert_eq!(words, &whole.runs[1].words[2 * frame..][..2]);
        }
        let few = headon(200);
        assert_eq!((few.left_out().as_str(), few.runs[1].words.len()), ("12.5 frames a second, one of 2 agents", 52));
        assert!(few.runs[1].words.iter().zip(thin.runs[1].words.chunks_exact(2)).all(|(one, both)| *one == both[0]));
    }

    #[test]
    fn base64_is_as_the_standard_says() {
        let pairs =
            [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy"), ("\0\u{7f}~", "AH9+")];
        for (plain, want) in pairs {
            assert_eq!(base64(plain.as_bytes()), want);
        }
    }
}
