//! Trajectories as [JuPedSim](https://www.jupedsim.org) writes them: an SQLite database, version 2 of its layout, which is what JuPedSim
//! and PedPy open. Versions 1 and 3 are read too; the latter, of JuPedSim to come, leaves out `ori_x` and `ori_y`.
//!
//! | table | columns |
//! |---|---|
//! | `trajectory_data` | `frame`, `id`, `pos_x`, `pos_y` (m, world coordinates), `ori_x`, `ori_y` (direction of the body) |
//! | `frame_data` | `frame`, `geometry_hash` |
//! | `geometry` | `hash`, `wkt`: the ground less what is solid; walls are 1 cm wide, circles polygons of 64 corners |
//! | `metadata` | `key`, `value`: `version`, `fps`, `xmin`, `xmax`, `ymin`, `ymax`, and the [`keys`](super::keys) |
//! | `throng_moment` | `frame`, `time` (s) |
//! | `throng_agent` | `id`, `name` of the group, `radius` (m) |
//!
//! The last two are ours: others do not look at them. A frame is a moment; `fps` is how many come a second, the mean where they come
//! unevenly. Where everybody can walk everywhere, the ground is a box round all that was seen, 1 m wider. Heights, velocities and what people do
//! are not kept: velocities are read as ways over time.

mod ground;
mod read;
mod write;

pub use write::SqliteWriter;

use super::Format;

/// JuPedSim's: written and read.
pub(super) const FORMAT: Format = Format {
    ending: "sqlite",
    title: "JuPedSim's trajectories",
    kept: false,
    sniff: None,
    columns: false,
    create: Some(|output, setting, _| Ok(Box::new(SqliteWriter::new(output, setting)?))),
    read: Some(read::read),
};
