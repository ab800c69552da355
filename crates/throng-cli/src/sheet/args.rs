//! What `throng sheet` is told, and its help.

use crate::field::FieldArgs;
use crate::look::parse_not_negative;
use crate::options::ThreadArgs;
use clap::Args;
use std::path::PathBuf;

/// After `throng sheet -h` and `--help`.
pub const EXAMPLES: &str = "\
Examples:
  throng sheet                                every scene of the gallery, sheet.png
  throng sheet walls flocks -o walls.svg --columns 5
  throng sheet circle box my-scene.toml --at 4 --trails 4

Ctrl-C ends it and writes nothing.";

/// What `throng sheet` is told.
#[derive(Args, Debug)]
pub struct SheetArgs {
    /// Scenes: groups of the gallery and names of single ones (see `throng list`), and files [default: all groups]
    #[arg(value_name = "GROUP|SCENE")]
    pub scenes: Vec<PathBuf>,

    /// The picture to write, .png or .svg
    #[arg(short, long, value_name = "FILE", default_value = "sheet.png")]
    pub output: PathBuf,

    /// The moment of all panels [default: of each scene its `view.moment`, else a third of its `expect.within`, else a
    /// third of its `time.limit`]
    #[arg(long, value_name = "SECONDS", value_parser = parse_not_negative)]
    pub at: Option<f64>,

    /// How many threads.
    #[command(flatten)]
    pub threads: ThreadArgs,

    /// Shows no progress bar
    #[arg(short, long)]
    pub quiet: bool,

    /// Width of the picture, pixels; it is as high as needed
    #[arg(long, value_name = "PIXELS", value_parser = clap::value_parser!(u32).range(16..=16384),
        default_value_t = 1600, help_heading = "Pictures")]
    pub width: u32,

    /// Panels side by side
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=100), default_value_t = 6,
        help_heading = "Pictures")]
    pub columns: u16,

    /// How long the trails behind agents are, seconds; 0 for none [default: the scene's `view.trails`, else 3]
    #[arg(long, value_name = "SECONDS", value_parser = parse_not_negative, help_heading = "Pictures")]
    pub trails: Option<f64>,

    /// How fields are drawn.
    #[command(flatten)]
    pub field: FieldArgs,
}
