//! What the studio shows, as a little JSON for tests: written to a file, or, in a web page, to `globalThis.throng`.

use crate::play::Shown;
use serde::Serialize;

/// What is shown.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct State {
    /// The scene's name.
    pub scene: String,
    /// Steps made.
    pub step: u64,
    /// Seconds since the start.
    pub time: f64,
    /// Agents in all.
    pub agents: usize,
    /// Agents that have arrived.
    pub arrived: usize,
    /// The hash of the state, as the program's.
    pub hash: String,
    /// Whether it goes on.
    pub playing: bool,
    /// Whether the scene has ended.
    pub over: bool,
    /// The selected agent.
    pub selected: Option<u32>,
    /// The scene's title.
    pub title: String,
    /// What is wrong.
    pub trouble: Option<String>,
    /// Whether the text has changes that are not saved.
    pub unsaved: bool,
    /// What people are asked before changes would be lost.
    pub asks: Option<String>,
}

impl State {
    /// Of a moment: nothing is selected, wrong, or unsaved.
    pub fn new(shown: &Shown) -> Self {
        Self {
            scene: shown.name.to_string(),
            step: shown.step,
            time: shown.frame.time,
            agents: shown.frame.total,
            arrived: shown.frame.arrived,
            hash: format!("{:016x}", shown.hash),
            playing: shown.playing,
            over: shown.over,
            selected: None,
            title: shown.setting.title.clone(),
            trouble: None,
            unsaved: false,
            asks: None,
        }
    }

    /// As JSON.
    pub fn json(&self) -> String {
        serde_json::to_string(self).unwrap_or_default()
    }
}
