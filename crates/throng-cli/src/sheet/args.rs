//! The command line of `throng sheet`.

use crate::field::FieldArgs;
use crate::look::{ProjectionArg, parse_not_negative};
use crate::options::ThreadArgs;
use clap::Args;
use std::path::PathBuf;

/// The examples for `throng sheet -h` and `--help`.
pub const EXAMPLES: &str = "\
Examples:
  throng sheet                                every scene of the gallery, sheet.png
  throng sheet walls flocks -o walls.svg --columns 5
  throng sheet papers -o papers.png           figures and demonstrations of papers, with citations
  throng sheet circle box my-scene.toml --at 4 --trails 4

Ctrl-C ends the command without writing the picture.";

/// The arguments of `throng sheet`.
#[derive(Args, Debug)]
pub struct SheetArgs {
    /// Groups of the gallery, names of scenes (see `throng list`), and scene files; `papers`: the scenes that show figures
    /// of papers, with citations [default: all groups but `papers`]
    #[arg(value_name = "GROUP|SCENE")]
    pub scenes: Vec<PathBuf>,

    /// The picture to write, .png or .svg
    #[arg(short, long, value_name = "FILE", default_value = "sheet.png")]
    pub output: PathBuf,

    /// The moment of all panels [default: each scene's `view.moment`, else a third of its `expect.within`, else a third
    /// of its `time.limit`]
    #[arg(long, value_name = "SECONDS", value_parser = parse_not_negative)]
    pub at: Option<f64>,

    /// The number of threads.
    #[command(flatten)]
    pub threads: ThreadArgs,

    /// Shows no progress bar
    #[arg(short, long)]
    pub quiet: bool,

    /// Width of the picture, pixels; the height follows
    #[arg(long, value_name = "PIXELS", value_parser = clap::value_parser!(u32).range(16..=16384),
        default_value_t = 1600, help_heading = "Pictures")]
    pub width: u32,

    /// Panels side by side
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=100), default_value_t = 6,
        help_heading = "Pictures")]
    pub columns: u16,

    /// Length of the trails behind agents, seconds; 0 for none [default: the scene's `view.trails`, else 3]
    #[arg(long, value_name = "SECONDS", value_parser = parse_not_negative, help_heading = "Pictures")]
    pub trails: Option<f64>,

    /// Whether all scenes are drawn in plan view or in perspective [default: as each scene says]
    #[arg(long, value_enum, value_name = "HOW", help_heading = "Pictures")]
    pub projection: Option<ProjectionArg>,

    /// How fields are drawn.
    #[command(flatten)]
    pub field: FieldArgs,
}
