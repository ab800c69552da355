//! The command line of `throng info`.

use crate::tracks::TrackArgs;
use clap::Args;
use std::path::PathBuf;

/// The formats, keys and examples for `throng info --help`.
pub const LONG: &str = "\
Files of trajectories: tables (.csv) as `throng run -o NAME.csv` writes them or with the columns ID and Frame; text and
HDF5 of the Pedestrian Dynamics Data Archive (.txt, .h5); UCY's obsmat.txt; Vadere's .traj; and the other formats of
`throng run`.

Keys of --json (one object on standard output; metres, seconds):
  file, format     its name and its format
  people           number of people
  groups           [{ name, people }]
  rows             number of samples: one person at one moment
  moments          number of moments
  from, to         time of the first and of the last moment
  frame_rate       samples of a person per second, from the time between them (files can hold every tenth frame only)
  unit             metres per unit of length of the file
  extent           [least x, least y, greatest x, greatest y]
  height           [least z, greatest z]
  speed            { mean, sd, least, most, median }
  walkable         walkable areas, if the file has them: [{ size, corners, holes }]
  obstacles        number of solid obstacles
Unknown values are null.

Examples:
  throng info run.csv
  throng info n34_cam2.csv --frame-rate 25
  throng info bi_corr.txt --json";

/// The arguments of `throng info`.
#[derive(Args, Debug)]
pub struct InfoArgs {
    /// A file of trajectories
    #[arg(value_name = "FILE")]
    pub file: PathBuf,

    /// How the file is read.
    #[command(flatten)]
    pub tracks: TrackArgs,

    /// Writes the report as one JSON object to standard output
    #[arg(long)]
    pub json: bool,
}
