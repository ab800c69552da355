//! The state of the studio as JSON, for tests. It is written to a file, or to `globalThis.throng` in a web page.

use crate::play::RunMoment;
use serde::Serialize;

/// The published state.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct State {
    /// The name of the scene.
    pub scene: String,
    /// Number of steps.
    pub step: u64,
    /// Simulation time, seconds.
    pub time: f64,
    /// Number of frames that the studio has drawn.
    pub frames: u64,
    /// Number of agents.
    pub agents: usize,
    /// Number of agents that have arrived.
    pub arrived: usize,
    /// The hash of the world, as `throng run` prints it.
    pub hash: String,
    /// Whether the scene is playing.
    pub playing: bool,
    /// Whether the scene has ended.
    pub over: bool,
    /// The selected agent.
    pub selected: Option<u32>,
    /// The title of the scene.
    pub title: String,
    /// The current error.
    pub trouble: Option<String>,
    /// Whether the text has unsaved changes.
    pub unsaved: bool,
    /// The step of the run with the second model.
    pub beside: Option<u64>,
    /// The number of changes that the user has made to the running scene.
    pub interventions: usize,
    /// Whether the window that explains the selected agent is open.
    pub why: bool,
    /// The open question about unsaved work, or the title of the window that asks for a name.
    pub asks: Option<String>,
}

impl State {
    /// Creates the state of a published moment, without selection, frames, error or unsaved text.
    pub fn new(shown: &RunMoment) -> Self {
        Self {
            scene: shown.name.to_string(),
            step: shown.step,
            time: shown.frame.time,
            frames: 0,
            agents: shown.frame.total,
            arrived: shown.frame.arrived,
            hash: format!("{:016x}", shown.hash),
            playing: shown.playing,
            over: shown.over,
            selected: None,
            title: shown.setting.title.clone(),
            trouble: None,
            unsaved: false,
            beside: shown.beside.as_ref().map(|beside| beside.step),
            interventions: shown.interventions.len(),
            why: false,
            asks: None,
        }
    }

    /// Returns the state as JSON.
    pub fn json(&self) -> String {
        serde_json::to_string(self).unwrap_or_default()
    }
}
