//! Trajectories as [JuPedSim](https://www.jupedsim.org) writes them: an SQLite database, version 2 of its layout, which
//! JuPedSim and PedPy open. Versions 1 and 3 are read too. Version 3, of an unreleased JuPedSim, lacks `ori_x` and
//! `ori_y`.
//!
//! | table | columns |
//! |---|---|
//! | `trajectory_data` | `frame`, `id`, `pos_x`, `pos_y` (m, world coordinates), `ori_x`, `ori_y` (direction of the body) |
//! | `frame_data` | `frame`, `geometry_hash` |
//! | `geometry` | `hash`, `wkt`: the walkable area without the obstacles; walls are 1 cm wide, circles polygons of 64 corners |
//! | `metadata` | `key`, `value`: `version`, `fps`, `xmin`, `xmax`, `ymin`, `ymax`, and the [`keys`](super::keys) |
//! | `throng_moment` | `frame`, `time` (s) |
//! | `throng_agent` | `id`, `name` of the group, `radius` (m) |
//!
//! The last two tables are particular to throng; other programs ignore them. `fps` is the frame rate, the mean rate of
//! uneven frames. If the walkable area is unbounded, the geometry is a box around all agents and obstacles, with a
//! margin of 1 m. Altitudes, velocities and states are not stored: velocities are read as displacements over time.

mod ground;
mod read;
mod write;

pub use write::SqliteWriter;

use super::Format;

/// JuPedSim's format: written and read.
pub(super) const FORMAT: Format = Format {
    ending: "sqlite",
    title: "JuPedSim's trajectories",
    kept: false,
    sniff: None,
    columns: false,
    styles: &[],
    create: Some(|output, setting, _| Ok(Box::new(SqliteWriter::new(output, setting)?))),
    read: Some(read::read),
    figures: None,
};
