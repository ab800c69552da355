//! What people want to have recorded.

use super::Chosen;
use crate::play::Shown;
use crate::record::{Format, Which};

/// The widest picture, pixels.
pub(super) const WIDEST: u32 = 3840;

/// What people want to have recorded.
#[derive(Clone, Debug, PartialEq)]
pub struct Wish {
    /// What it becomes.
    pub format: Format,
    /// The name of the file.
    pub file: String,
    /// From when on, seconds of the scene.
    pub from: f64,
    /// Until when; `None`: to the end.
    pub to: Option<f64>,
    /// Pictures a second.
    pub rate: f64,
    /// Seconds of the scene in a second of video.
    pub speed_up: f64,
    /// Width and height, pixels; `None`: as large as the view.
    pub size: Option<[u32; 2]>,
    /// Whether title, time, counts and the key of the colours are drawn.
    pub legend: bool,
    /// Which, where two models are side by side.
    pub which: Which,
    /// What trajectories have.
    pub chosen: Chosen,
}

impl Default for Wish {
    fn default() -> Self {
        Self {
            format: Format::default(),
            file: String::new(),
            from: 0.0,
            to: None,
            rate: 25.0,
            speed_up: 1.0,
            size: None,
            legend: true,
            which: Which::default(),
            chosen: Chosen::default(),
        }
    }
}

impl Wish {
    /// Which of two models: a file of trajectories is of one run.
    pub fn which(&self) -> Which {
        match self.format {
            Format::Trajectories if self.which == Which::Both => Which::Own,
            _ => self.which,
        }
    }

    /// Width and height of pictures, pixels, where a view has so many: those that are wished for, else of all views together.
    pub fn size_beside(&self, shown: &Shown, [width, height]: [u32; 2]) -> [u32; 2] {
        let views = if shown.beside.is_some() && self.which() == Which::Both { 2 } else { 1 };
        self.size.unwrap_or([(views * width).min(WIDEST), height])
    }
}
