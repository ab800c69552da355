//! Files of trajectories that a command reads.

use crate::failure::Failure;
use crate::look::parse_positive;
use clap::Args;
use std::path::Path;
use throng_record::{Reading, Tracks};

/// Greatest number of moments, pictures or steps that a command makes of a file: five days at 25 a second.
const MOST: f64 = 1e7;

/// Checks that a command makes at most [`MOST`] moments, pictures or steps, which `what` names, of a file.
///
/// # Errors
/// There are more: a time in the file is far from the others.
pub fn limit(path: &Path, what: &str, count: f64, [from, to]: [f64; 2], hint: &str) -> Result<(), Failure> {
    if count <= MOST {
        return Ok(());
    }
    let text = format!("{}: {count:.0} {what} from {from:.2} to {to:.2} s, but the limit is {MOST}", path.display());
    Err(Failure::hint(text, hint))
}

/// What a file of trajectories does not say itself.
#[derive(Args, Clone, Copy, Debug, Default, PartialEq)]
#[command(next_help_heading = "Trajectories")]
pub struct TrackArgs {
    /// Frames a second of a file that counts frames and does not say how long they are; goes before what it says
    #[arg(long, value_name = "N", value_parser = parse_positive)]
    pub frame_rate: Option<f64>,

    /// The unit of length of a file of trajectories: m, cm, mm, ft, in, or so many metres; goes before what it says
    #[arg(long, value_name = "UNIT", value_parser = parse_unit)]
    pub unit: Option<f64>,
}

impl TrackArgs {
    /// What is said of a file.
    pub fn reading(&self) -> Reading {
        Reading { rate: self.frame_rate, unit: self.unit }
    }

    /// Reads a file of trajectories.
    ///
    /// # Errors
    /// Those of [`Tracks::read_as`].
    pub fn read(&self, path: &Path) -> Result<Tracks, Failure> {
        Ok(Tracks::read_as(path, &self.reading())?)
    }
}

/// Reads a unit of length: metres.
fn parse_unit(text: &str) -> Result<f64, String> {
    let wrong = || "write m, cm, mm, ft or in, or how many metres it has, such as 0.01".to_owned();
    match text {
        "m" => Ok(1.0),
        "cm" => Ok(0.01),
        "mm" => Ok(0.001),
        "ft" => Ok(0.3048),
        "in" => Ok(0.0254),
        _ => parse_positive(text).map_err(|_| wrong()),
    }
}
