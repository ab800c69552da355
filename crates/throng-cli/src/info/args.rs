//! What `throng info` is told, and its help.

use crate::tracks::TrackArgs;
use clap::Args;
use std::path::PathBuf;

/// After `throng info --help`.
pub const LONG: &str = "\
Files of trajectories: tables (.csv) as `throng run -o NAME.csv` writes them or with the columns ID and Frame; text and HDF5
of the Pedestrian Dynamics Data Archive (.txt, .h5); UCY's obsmat.txt; Vadere's .traj; and what else `throng run` writes.

Keys of --json (one object on standard output; metres, seconds):
  file, format     its name, and what it is
  people           how many
  groups           [{ name, people }]
  rows             places of somebody at a moment
  moments          how many
  from, to         the first and the last
  frame_rate       moments a second, from the time from row to row; people may be seen at every tenth frame only
  unit             metres in the unit of length of the file
  extent           [least x, least y, greatest x, greatest y]
  height           [least z, greatest z]
  speed            { mean, sd, least, most, median }
  walkable         areas that can be walked on, as far as the file has them: [{ size, corners, holes }]
  obstacles        how many solids it has
What is not known is null.

Examples:
  throng info run.csv
  throng info n34_cam2.csv --frame-rate 25
  throng info bi_corr.txt --json";

/// What `throng info` is told.
#[derive(Args, Debug)]
pub struct InfoArgs {
    /// A file of trajectories
    #[arg(value_name = "FILE")]
    pub file: PathBuf,

    /// What it does not say itself.
    #[command(flatten)]
    pub tracks: TrackArgs,

    /// Writes it as one JSON object to standard output
    #[arg(long)]
    pub json: bool,
}
