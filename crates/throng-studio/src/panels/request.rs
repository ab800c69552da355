//! The settings of a recording.

use super::Chosen;
use crate::play::RunMoment;
use crate::record::{Format, Which};

/// The widest picture, pixels.
pub(super) const WIDEST: u32 = 3840;

/// The settings of a recording.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordRequest {
    /// The format.
    pub format: Format,
    /// The file name.
    pub file: String,
    /// The start, seconds of scene time.
    pub from: f64,
    /// The end, seconds of scene time. `None` for the end of the run.
    pub to: Option<f64>,
    /// Pictures per second.
    pub rate: f64,
    /// Seconds of the scene per second of video.
    pub speed_up: f64,
    /// Width and height, pixels. `None` for the size of the view.
    pub size: Option<[u32; 2]>,
    /// Whether title, time, counts and the key of the colours are drawn.
    pub legend: bool,
    /// The recorded model, where two models run side by side.
    pub which: Which,
    /// The choice of trajectories.
    pub chosen: Chosen,
}

impl Default for RecordRequest {
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

impl RecordRequest {
    /// Returns the recorded model. A trajectory file holds a single run.
    pub fn which(&self) -> Which {
        match self.format {
            Format::Trajectories if self.which == Which::Both => Which::Own,
            _ => self.which,
        }
    }

    /// Returns the width and height of pictures, pixels: the chosen size, or else the size of all recorded views side
    /// by side.
    pub fn size_beside(&self, shown: &RunMoment, [width, height]: [u32; 2]) -> [u32; 2] {
        let views = if shown.beside.is_some() && self.which() == Which::Both { 2 } else { 1 };
        self.size.unwrap_or([(views * width).min(WIDEST), height])
    }
}
