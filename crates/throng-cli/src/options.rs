//! Options that several commands share.

use crate::look::{LookArgs, parse_not_negative, parse_positive};
use clap::Args;
use throng_draw::Still;
use throng_scene::{Scene, Until};

/// Options for the end of a run.
#[derive(Args, Debug)]
pub struct EndArgs {
    /// Ends the run after at most this many seconds, instead of the scene's `time.limit`
    #[arg(long, value_name = "SECONDS", value_parser = parse_positive, conflicts_with = "duration")]
    pub limit: Option<f64>,

    /// Ends the run after exactly this many seconds, whatever the scene's `time.until` says
    #[arg(long, value_name = "SECONDS", value_parser = parse_positive)]
    pub duration: Option<f64>,
}

impl EndArgs {
    /// Applies the options to the scene.
    pub fn apply(&self, scene: &mut Scene) {
        if let Some(limit) = self.limit.or(self.duration) {
            scene.time.limit = limit;
        }
        if self.duration.is_some() {
            scene.time.until = Until::Limit;
        }
    }
}

/// Options for reports of results.
#[derive(Args, Debug)]
pub struct ReportArgs {
    /// Shows no progress bar and no results
    #[arg(short, long)]
    pub quiet: bool,

    /// Writes the results as JSON to standard output
    #[arg(long)]
    pub json: bool,
}

/// Options for threads.
#[derive(Args, Debug)]
pub struct ThreadArgs {
    /// Threads for the steps; 0: the number of cores. The result is the same for any number
    #[cfg(feature = "parallel")]
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u16).range(..=1024))]
    pub threads: u16,
}

impl ThreadArgs {
    /// Returns the number of threads for the steps; 0 stands for the number of cores.
    pub fn count(&self) -> usize {
        #[cfg(feature = "parallel")]
        return usize::from(self.threads);
        #[cfg(not(feature = "parallel"))]
        1
    }
}

/// Options for the moments that pictures show, and their look.
#[derive(Args, Debug)]
pub struct FilmArgs {
    /// The moment that .png and .svg show, seconds [default: the last]
    #[arg(long, value_name = "SECONDS", value_parser = parse_not_negative, help_heading = "Pictures")]
    pub frame: Option<f64>,

    /// Pictures per second of video [default: the scene's `view.fps`, else 25]
    #[arg(long, value_name = "N", value_parser = parse_rate, help_heading = "Pictures")]
    pub fps: Option<f64>,

    /// Seconds of the scene per second of video
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0, value_parser = parse_factor, help_heading = "Pictures")]
    pub speed_up: f64,

    /// How pictures look.
    #[command(flatten)]
    pub look: LookArgs,
}

impl FilmArgs {
    /// Returns the pictures per second of video.
    pub fn rate(&self, scene: &Scene) -> f64 {
        self.fps.or(scene.view.fps).unwrap_or(25.0)
    }

    /// Returns the moment that single pictures show.
    pub fn still(&self) -> Still {
        self.frame.map_or(Still::Last, Still::Time)
    }
}

fn parse_rate(text: &str) -> Result<f64, String> {
    let rate = parse_positive(text)?;
    if (0.001..=1000.0).contains(&rate) { Ok(rate) } else { Err("write a number from 0.001 to 1000".into()) }
}

fn parse_factor(text: &str) -> Result<f64, String> {
    let factor = parse_positive(text)?;
    if (1e-3..=1e6).contains(&factor) { Ok(factor) } else { Err("write a number from 0.001 to 1000000".into()) }
}
