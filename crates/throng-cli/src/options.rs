//! Options that several commands share.

use crate::failure::Failure;
use crate::look::{LookArgs, parse_not_negative, parse_positive};
use clap::Args;
use glam::DVec2;
use throng_draw::{MotionBlur, Still, Style};
use throng_scene::{Scene, Until};

/// The size and the rate of films for showing.
const BEAUTY_SIZE: (u32, u32) = (1920, 1080);
const BEAUTY_RATE: f64 = 60.0;

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
    /// The moment that .png and .svg show, seconds [default: the last; `compare` chooses a telling one]
    #[arg(long, value_name = "SECONDS", value_parser = parse_not_negative, help_heading = "Pictures")]
    pub frame: Option<f64>,

    /// Pictures per second of video [default: the scene's `view.fps`, else 25]
    #[arg(long, value_name = "N", value_parser = parse_rate, help_heading = "Pictures")]
    pub fps: Option<f64>,

    /// Films for showing: 1920x1080, 60 pictures per second, with motion blur (a shutter of 180°). N is the number of
    /// times at which each picture shows the scene: 8 in plan view and 4 in perspective if it is not given. --size and
    /// --fps take precedence
    #[arg(long, value_name = "N", num_args = 0..=1, require_equals = true,
        value_parser = clap::value_parser!(u32).range(1..=256), help_heading = "Pictures")]
    pub beauty: Option<Option<u32>>,

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
        self.fps.or(self.beauty.map(|_| BEAUTY_RATE)).or(scene.view.fps).unwrap_or(25.0)
    }

    /// Returns the style ([`LookArgs::style`]), with motion blur and the size of `--beauty`.
    ///
    /// # Errors
    /// Those of [`LookArgs::style`].
    pub fn style(&self, scene: &Scene, bounds: [DVec2; 2]) -> Result<Style, Failure> {
        let style = self.look.style(scene, bounds)?;
        let Some(samples) = self.beauty else { return Ok(style) };
        let (width, height) = self.look.size.unwrap_or(BEAUTY_SIZE);
        let blur = Some(MotionBlur { interval: self.speed_up / self.rate(scene), samples });
        Ok(Style { width, height, blur, ..style })
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
