//! The command line of `throng explain`.

use crate::look::{parse_not_negative, parse_size};
use crate::source::SceneArgs;
use clap::Args;
use std::path::PathBuf;

/// The arguments of `throng explain`.
#[derive(Args, Debug)]
pub struct ExplainArgs {
    /// The scene.
    #[command(flatten)]
    pub scene: SceneArgs,

    /// The number of the agent; agents are numbered from 0, group after group
    #[arg(short, long, value_name = "N")]
    pub agent: u32,

    /// The moment, seconds since the start; the nearest step is explained
    #[arg(short, long, value_name = "SECONDS", value_parser = parse_not_negative, default_value_t = 0.0)]
    pub time: f64,

    /// The figure to write, .svg or .png; can be given several times [default: <scene>-agent-<N>.svg, none with --json]
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,

    /// Writes the explanation as one JSON object to standard output
    #[arg(long)]
    pub json: bool,

    /// Width and height of the figure, pixels
    #[arg(long, value_name = "WxH", value_parser = parse_size, default_value = "1200x760", help_heading = "Pictures")]
    pub size: (u32, u32),

    /// Light on dark
    #[arg(long, help_heading = "Pictures")]
    pub dark: bool,
}

/// The examples for `throng explain -h`.
pub const SHORT: &str = "\
Examples:
  throng explain circle --agent 3 --time 2.5
  throng explain circle --agent 3 --time 2.5 --set 'avoid={hrvo={}}' -o hrvo.svg -o hrvo.png

`throng explain --help` describes the keys of --json; docs/explain.md, how to read the figure.";

/// The description, keys and examples for `throng explain --help`.
pub const LONG: &str = "\
The figure shows, left, the agent and what is near it, and right its possible velocities: those that each neighbour and
each wall forbids, those that remain, and its current, preferred and resulting velocity. docs/explain.md describes how
to read it.

Keys of --json (one object on standard output; metres, seconds, radians, m/s; vectors are [x, y]):
  scene, agent, time          name of the scene; the agent's number; seconds since the start
  seconds                     the length of the next sub-step, for which it chooses
  model                       its local model, with all parameters
  position, heading, radius   of its body; the heading counter-clockwise from +x
  max_speed, max_acceleration
  velocity, preferred         the current and the preferred velocity
  relaxed                     velocity towards `preferred` in this sub-step, by the relaxation time: the model's input
  chosen, limited, guarded    the model's choice, its part within the limits of the body, the result after the guard
  neighbours                  [{ agent, offset, velocity, radius, seen_velocity, radii, share, room }], nearest first
  edges, discs                walls in view: [{ start, end }] and [{ offset, radius }], from the agent
  reasons                     what led to `chosen`, each of the form
                              { cause, permits: { point, direction } }: the half-plane left of a line
                              { cause, forbids: { KIND: { ... } } }: a region of velocities
                              { cause, push: [x, y] }: what repulsion adds to the acceleration, or to the direction
                              { candidate: { velocity, cost } }: a velocity that was tried
                              a cause is { neighbour: AGENT }, { edge: INDEX }, { disc: INDEX } or \"body\"
  held_by                     [{ cause, depth }]: constraints with `chosen` on their boundary (depth 0), or inside
  collision                   { preferred, chosen }: { time, cause } of the first collision at that velocity if all
                              other agents keep their velocities
  files                       the files written
Infinite and unknown values are null.

Examples:
  throng explain circle --agent 3 --time 2.5
      writes circle-agent-3.svg
  throng explain circle --agent 3 --time 2.5 --set 'avoid={hrvo={}}' -o hrvo.svg -o hrvo.png
  throng explain doorway --agent 12 --time 6 --size 1600x1000 --dark -o door.png
  throng explain plan.toml --agent 0 --json";
