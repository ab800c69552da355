//! The command lines of `throng convert` and `throng render`.

use crate::choice::ChoiceArgs;
use crate::map::MapArgs;
use crate::options::FilmArgs;
use crate::tracks::TrackArgs;
use clap::Args;
use std::path::PathBuf;

/// The formats and examples for `throng convert --help`.
pub const CONVERT: &str = "\
Reads the file formats of `throng info` and writes those of `throng run`; the ending of a name determines the format.

Examples:
  throng convert run.rec -o run.parquet
  throng convert bi_corr.txt -o corridor.sqlite -o corridor.usda
      people of the Pedestrian Dynamics Data Archive for JuPedSim and for Blender
  throng convert run.csv -o part.csv --from 5 --to 20 --rate 10 --columns number,time,x,y
  throng convert run.parquet --agents 1,5,10-20 --groups left -o some.csv
  throng convert run.csv --map office -o run.usda
      with the walls of the scene, which a .csv does not hold
  throng convert run/ -o run.sqlite
      joins the parts that throng-mpi has written to a folder";

/// The outputs and examples for `throng render --help`.
pub const RENDER: &str = "\
Outputs, by the ending of the name:
  .mp4, .gif        video
  .png, .svg        one picture: the last moment, or that of --frame
  NAME/             a folder of PNG files, one a picture
  .avi, .webm, ...  other video, through the program ffmpeg if it is installed

Examples:
  throng render run.rec
      writes run.mp4
  throng render bi_corr.txt -o corridor.mp4 --speed-up 2 --color density --trails 3
  throng render run.csv --map office -o end.png
  throng render zara01/obsmat.txt --map zara01/map.xml --map-offset 0.5,16.2 -o street.mp4
  throng render obsmat.txt --frame-rate 25 --from 10 --to 30 -o frames/";

/// A file of trajectories and its map.
#[derive(Args, Debug)]
pub struct RecordedArgs {
    /// A file of trajectories (see `throng info`)
    #[arg(value_name = "FILE")]
    pub file: PathBuf,

    /// The map.
    #[command(flatten)]
    pub map: MapArgs,

    /// How the file is read.
    #[command(flatten)]
    pub tracks: TrackArgs,
}

/// The arguments of `throng convert`.
#[derive(Args, Debug)]
pub struct ConvertArgs {
    /// The file to read.
    #[command(flatten)]
    pub recorded: RecordedArgs,

    /// A file of trajectories to write, its kind by its ending; can be given several times
    #[arg(short, long, value_name = "FILE", required = true)]
    pub output: Vec<PathBuf>,

    /// What is written.
    #[command(flatten)]
    pub choice: ChoiceArgs,

    /// Shows no progress bar and no list of written files
    #[arg(short, long)]
    pub quiet: bool,
}

/// The arguments of `throng render`.
#[derive(Args, Debug)]
pub struct RenderArgs {
    /// The file to read.
    #[command(flatten)]
    pub recorded: RecordedArgs,

    /// A picture or video to write, its kind by its ending; can be given several times [default: <file>.mp4]
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,

    /// What is drawn.
    #[command(flatten)]
    pub choice: ChoiceArgs,

    /// The moments that pictures show, and how pictures look.
    #[command(flatten)]
    pub film: FilmArgs,

    /// Shows no progress bar and no list of written files
    #[arg(short, long)]
    pub quiet: bool,
}
