//! What `throng explain` is told, and its help.

use crate::look::{parse_not_negative, parse_size};
use crate::source::SceneArgs;
use clap::Args;
use std::path::PathBuf;

/// What `throng explain` is told.
#[derive(Args, Debug)]
pub struct ExplainArgs {
    /// Which scene.
    #[command(flatten)]
    pub scene: SceneArgs,

    /// The agent, by its number: they are counted from 0, group after group
    #[arg(short, long, value_name = "N")]
    pub agent: u32,

    /// The moment, seconds since the start; the step nearest to it is explained
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

/// After `throng explain -h`.
pub const SHORT: &str = "\
Examples:
  throng explain circle --agent 3 --time 2.5
  throng explain circle --agent 3 --time 2.5 --set 'avoid={hrvo={}}' -o hrvo.svg -o hrvo.png

`throng explain --help` describes the keys of --json; docs/explain.md, how to read the figure.";

/// After `throng explain --help`.
pub const LONG: &str = "\
The figure shows, left, the agent and what is near it, and right the velocities it can have: what each neighbour and each
wall forbids, what is left of them, and the velocities that it has, would like, and gets. docs/explain.md says how to
read it.

Keys of --json (one object on standard output; metres, seconds, radians, m/s; vectors are [x, y]):
  scene, agent, time          name of the scene; the agent's number; seconds since the start
  seconds                     what it chooses for: the length of the next sub-step
  model                       its local model, with all parameters
  position, heading, radius   of its body; the heading counter-clockwise from +x
  max_speed, max_acceleration
  velocity, preferred         what it has, and what it would like
  relaxed                     how far it comes to `preferred` in this sub-step, by its relaxation time: what the model is asked for
  chosen, limited, guarded    what the model chooses, what the body can do of it, what the guard leaves: what it gets
  neighbours                  [{ agent, offset, velocity, radius, seen_velocity, radii, share, room }], nearest first
  edges, discs                walls in view: [{ start, end }] and [{ offset, radius }], from the agent
  reasons                     what led to `chosen`, each one of
                              { cause, permits: { point, direction } }: the half-plane left of a line
                              { cause, forbids: { KIND: { ... } } }: a region
                              { cause, push: [x, y] }: what repulsion adds to the acceleration, or to the direction
                              { candidate: { velocity, cost } }: what was tried
                              a cause is { neighbour: AGENT }, { edge: INDEX }, { disc: INDEX } or \"body\"
  held_by                     [{ cause, depth }]: what `chosen` is on the edge of (depth 0), or that far within
  collision                   { preferred, chosen }: { time, cause } of the first collision at that velocity if
                              everybody else keeps theirs
  files                       the files written
What is infinite or not known is null.

Examples:
  throng explain circle --agent 3 --time 2.5
      writes circle-agent-3.svg
  throng explain circle --agent 3 --time 2.5 --set 'avoid={hrvo={}}' -o hrvo.svg -o hrvo.png
  throng explain doorway --agent 12 --time 6 --size 1600x1000 --dark -o door.png
  throng explain plan.toml --agent 0 --json";
