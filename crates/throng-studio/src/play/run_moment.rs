//! The published state of a run.

use super::figures::Figures;
use super::pace::Pace;
use super::people::PosesBetween;
use super::reel::Reel;
use super::series::Series;
use std::sync::Arc;
use throng::{Explanation, Summary};
use throng_draw::WorldBox;
use throng_record::{Frame, Setting};
use throng_scene::{Intervention, Scene};
use web_time::Instant;

/// A published moment of a run. Cheap to clone.
#[derive(Clone, Debug)]
pub struct RunMoment {
    /// The name of the scene: a name of the gallery, or the stem of the file name.
    pub name: Arc<str>,
    /// The scene.
    pub scene: Arc<Scene>,
    /// The constant part of the run.
    pub setting: Arc<Setting>,
    /// The first moment.
    pub first: Arc<Frame>,
    /// The box around the scene and the agents at the start.
    pub bounds: WorldBox,
    /// The number of the run. It increases with each new run.
    pub run: u64,
    /// The current moment.
    pub frame: Arc<Frame>,
    /// The moment one step before.
    pub before: Arc<Frame>,
    /// Number of steps.
    pub step: u64,
    /// The seed of the run.
    pub seed: u64,
    /// Whether the run is playing.
    pub playing: bool,
    /// Whether the run has ended.
    pub over: bool,
    /// The time series up to now.
    pub series: Arc<Series>,
    /// The cost of steps.
    pub cost: Cost,
    /// The summary of the run, updated at intervals.
    pub summary: Arc<Summary>,
    /// The explanation of the requested agent, updated at intervals.
    pub explanation: Option<Arc<Explanation>>,
    /// [`World::state_hash`](throng::World::state_hash) of the state at `step`.
    pub hash: u64,
    /// What the user has done to the run so far.
    pub interventions: Arc<[Intervention]>,
    /// Whether a change of the scene waits for a restart.
    pub waits: bool,
    /// The bytes of saved states.
    pub kept: usize,
    /// The run with the second model, at the same step.
    pub beside: Option<Arc<RunMoment>>,
    /// The replayed trajectories, if this is a replay.
    pub reel: Option<Arc<Reel>>,
    /// The bodies of people from files, if people are wanted.
    pub figures: Arc<Figures>,
    /// The people from [`RunMoment::before`] to [`RunMoment::frame`], if they are wanted.
    pub people: PosesBetween,
    /// Whether the run is on its way to a step, so that this moment is seen only in passing.
    pub arriving: bool,
    /// The moments before this one on the way to it, oldest first, if the run went to its step as fast as possible.
    pub wake: Arc<[Arc<Frame>]>,
    pub(super) pace: Pace,
}

impl RunMoment {
    /// Returns the interpolation weight between [`RunMoment::before`] and [`RunMoment::frame`], 0 to 1.
    pub fn share(&self) -> f32 {
        // of two runs, the one that has ended stands
        let moves = self.playing && !self.over;
        let share = if moves { self.pace.share(self.scene.time.step, Instant::now()) } else { 1.0 };
        share as f32
    }

    /// Returns the displayed time, seconds.
    pub fn time(&self) -> f64 {
        self.before.time + (self.frame.time - self.before.time) * f64::from(self.share())
    }
}

/// The cost of steps, smoothed over several steps.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cost {
    /// Seconds per step in each stage, in the order of [`throng::Stage::ALL`].
    pub stages: [f64; 5],
    /// Seconds per step.
    pub step: f64,
    /// Share of real time spent in steps, 1 for all of it.
    pub usage: f64,
}

/// An error of the player.
#[derive(Clone, Debug, PartialEq)]
pub enum Trouble {
    /// The scene cannot be built. The previous run continues.
    Scene(Box<throng_scene::Error>),
    /// Code of a scene panicked, with its message.
    Panic(String),
    /// A trajectory file cannot be replayed.
    Film(String),
    /// The run refuses an intervention. It continues without it.
    Refused(String),
}

impl std::fmt::Display for Trouble {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Scene(error) => error.fmt(f),
            Self::Film(says) | Self::Refused(says) => f.write_str(says),
            Self::Panic(says) => write!(f, "a plug-in panicked: {says}"),
        }
    }
}
