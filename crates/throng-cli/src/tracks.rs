//! Options for files of trajectories that a command reads.

use crate::failure::Failure;
use crate::look::parse_positive;
use crate::progress::waiting;
use clap::Args;
use std::path::Path;
use throng_record::{Reading, Trajectories};

/// The maximum number of moments, pictures or steps that a command makes from a file: about five days at 25 per second.
const MOST: f64 = 1e7;

/// Checks that a command makes at most [`MOST`] moments, pictures or steps from a file; `what` names them in the
/// message.
///
/// # Errors
/// There are more, as when one time in the file is far from all other times.
pub fn limit(path: &Path, what: &str, count: f64, [from, to]: [f64; 2], hint: &str) -> Result<(), Failure> {
    if count <= MOST {
        return Ok(());
    }
    let text = format!("{}: {count:.0} {what} from {from:.2} to {to:.2} s, but the limit is {MOST}", path.display());
    Err(Failure::hint(text, hint))
}

/// Options for how a file of trajectories is read.
#[derive(Args, Clone, Copy, Debug, Default, PartialEq)]
#[command(next_help_heading = "Trajectories")]
pub struct TrackArgs {
    /// Frames per second of a file that numbers frames; overrides the file's own value
    #[arg(long, value_name = "N", value_parser = parse_positive)]
    pub frame_rate: Option<f64>,

    /// The unit of length of a file of trajectories: m, cm, mm, ft, in, or a number of metres; overrides the file's own
    /// value
    #[arg(long, value_name = "UNIT", value_parser = parse_unit)]
    pub unit: Option<f64>,
}

impl TrackArgs {
    /// Returns the options as a [`Reading`].
    pub fn reading(&self) -> Reading {
        Reading { rate: self.frame_rate, unit: self.unit }
    }

    /// Reads a file of trajectories. If reading takes long, a line on standard error says so, unless `quiet`.
    ///
    /// # Errors
    /// Those of [`Trajectories::read_as`].
    pub fn read(&self, path: &Path, quiet: bool) -> Result<Trajectories, Failure> {
        let doing = format!("reading {}", path.display());
        Ok(waiting(quiet, &doing, || Trajectories::read_as(path, &self.reading()))?)
    }
}

/// Parses a unit of length; returns metres.
fn parse_unit(text: &str) -> Result<f64, String> {
    let wrong = || "write m, cm, mm, ft or in, or a number of metres, such as 0.01".to_owned();
    match text {
        "m" => Ok(1.0),
        "cm" => Ok(0.01),
        "mm" => Ok(0.001),
        "ft" => Ok(0.3048),
        "in" => Ok(0.0254),
        _ => parse_positive(text).map_err(|_| wrong()),
    }
}
