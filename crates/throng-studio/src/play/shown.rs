//! What there is to see of a run.

use super::pace::Pace;
use super::reel::Reel;
use super::series::Series;
use std::sync::Arc;
use throng::{Explanation, Summary};
use throng_draw::WorldBox;
use throng_record::{Frame, Setting};
use throng_scene::Scene;
use web_time::Instant;

/// A moment of a run, and all that is to be known of it. Cheap to clone.
#[derive(Clone, Debug)]
pub struct Shown {
    /// What the scene is called: a name of the gallery, or the stem of a file's name.
    pub name: Arc<str>,
    /// The scene.
    pub scene: Arc<Scene>,
    /// What stays the same.
    pub setting: Arc<Setting>,
    /// The first moment.
    pub first: Arc<Frame>,
    /// The box that holds the place and everybody at first.
    pub bounds: WorldBox,
    /// Which run it is: it grows whenever one begins.
    pub run: u64,
    /// The last moment, and the one a step before it.
    pub frame: Arc<Frame>,
    /// A step before.
    pub before: Arc<Frame>,
    /// Steps made.
    pub step: u64,
    /// The seed it was built with.
    pub seed: u64,
    /// Whether it goes on.
    pub playing: bool,
    /// Whether the scene has ended.
    pub over: bool,
    /// Figures against time, up to now.
    pub series: Arc<Series>,
    /// What steps cost.
    pub cost: Cost,
    /// How it went so far, taken now and then.
    pub summary: Arc<Summary>,
    /// Why the agent that is to explain itself goes where it goes, taken now and then.
    pub explanation: Option<Arc<Explanation>>,
    /// [`World::state_hash`](throng::World::state_hash) of the state at `step`.
    pub hash: u64,
    /// Bytes of states that are kept to go back to.
    pub kept: usize,
    /// The same scene with another model, at the same step.
    pub beside: Option<Arc<Shown>>,
    /// The film that this is a moment of, if it is replayed.
    pub reel: Option<Arc<Reel>>,
    pub(super) pace: Pace,
}

impl Shown {
    /// How far the clock is on its way from [`Shown::before`] to [`Shown::frame`], 0 to 1: what is drawn lies between the two.
    pub fn share(&self) -> f32 {
        let share = if self.playing { self.pace.share(self.scene.time.step, Instant::now()) } else { 1.0 };
        share as f32
    }

    /// The time that is shown, seconds.
    pub fn time(&self) -> f64 {
        self.before.time + (self.frame.time - self.before.time) * f64::from(self.share())
    }
}

/// What steps cost, smoothed over some of them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cost {
    /// Seconds of a step in each stage, in the order of [`throng::Stage::ALL`].
    pub stages: [f64; 5],
    /// Seconds of a step.
    pub step: f64,
    /// Share of real time spent in steps; 1: all of it.
    pub usage: f64,
}

/// What went wrong.
#[derive(Clone, Debug, PartialEq)]
pub enum Trouble {
    /// The scene cannot be built; the one before goes on.
    Scene(Box<throng_scene::Error>),
    /// Code of a scene panicked: it says so.
    Panic(String),
    /// A file of trajectories cannot be replayed.
    Film(String),
}

impl std::fmt::Display for Trouble {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Scene(error) => error.fmt(f),
            Self::Film(says) => f.write_str(says),
            Self::Panic(says) => write!(f, "a plug-in panicked: {says}"),
        }
    }
}
