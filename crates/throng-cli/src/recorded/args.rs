//! What `throng convert` and `throng render` are told, and their help.

use crate::choice::ChoiceArgs;
use crate::map::MapArgs;
use crate::options::FilmArgs;
use crate::tracks::TrackArgs;
use clap::Args;
use std::path::PathBuf;

/// After `throng convert --help`.
pub const CONVERT: &str = "\
Files of trajectories: what `throng info` reads; what `throng run` writes. Each kind is told by the ending of its name.

Examples:
  throng convert run.rec -o run.parquet
  throng convert bi_corr.txt -o corridor.sqlite -o corridor.usda
      people of the Pedestrian Dynamics Data Archive for JuPedSim and for Blender
  throng convert run.csv -o part.csv --from 5 --to 20 --rate 10 --columns number,time,x,y
  throng convert run.parquet --agents 1,5,10-20 --groups left -o some.csv
  throng convert run.csv --map office -o run.usda
      with the walls of the scene, which a .csv does not hold";

/// After `throng render --help`.
pub const RENDER: &str = "\
Outputs, by the ending of the name:
  .mp4, .gif        video
  .png, .svg        one picture: the last moment, or that of --frame
  NAME/             a folder of PNG files, one a picture
  .avi, .webm, ...  other video, through the program ffmpeg where that is installed

Examples:
  throng render run.rec
      writes run.mp4
  throng render bi_corr.txt -o corridor.mp4 --speed-up 2 --color density --trails 3
  throng render run.csv --map office -o end.png
  throng render zara01/obsmat.txt --map zara01/map.xml --map-offset 0.5,16.2 -o street.mp4
  throng render obsmat.txt --frame-rate 25 --from 10 --to 30 -o frames/";

/// A file of trajectories, and what is known of it.
#[derive(Args, Debug)]
pub struct RecordedArgs {
    /// A file of trajectories (see `throng info`)
    #[arg(value_name = "FILE")]
    pub file: PathBuf,

    /// Where it was.
    #[command(flatten)]
    pub map: MapArgs,

    /// What it does not say itself.
    #[command(flatten)]
    pub tracks: TrackArgs,
}

/// What `throng convert` is told.
#[derive(Args, Debug)]
pub struct ConvertArgs {
    /// The file that is read.
    #[command(flatten)]
    pub recorded: RecordedArgs,

    /// A file of trajectories to write, its kind by its ending; can be given several times
    #[arg(short, long, value_name = "FILE", required = true)]
    pub output: Vec<PathBuf>,

    /// What of it is written.
    #[command(flatten)]
    pub choice: ChoiceArgs,

    /// Shows no progress bar, and does not say what was written
    #[arg(short, long)]
    pub quiet: bool,
}

/// What `throng render` is told.
#[derive(Args, Debug)]
pub struct RenderArgs {
    /// The file that is read.
    #[command(flatten)]
    pub recorded: RecordedArgs,

    /// A picture or video to write, its kind by its ending; can be given several times [default: <file>.mp4]
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,

    /// What of it is written.
    #[command(flatten)]
    pub choice: ChoiceArgs,

    /// Which moments pictures show, and how they look.
    #[command(flatten)]
    pub film: FilmArgs,

    /// Shows no progress bar, and does not say what was written
    #[arg(short, long)]
    pub quiet: bool,
}
