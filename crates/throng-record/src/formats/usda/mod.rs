//! Trajectories as a stage of [Universal Scene Description](https://openusd.org), as text: for film and animation.
//!
//! Z is up, a unit a metre. `/World` stands at the origin of the scene, and has
//!
//! | prim | what |
//! |---|---|
//! | `Ground`, `Obstacles` | meshes; what is solid is 1 m high |
//! | `Agents` | a `PointInstancer`: `positions`, `orientations`, `velocities` (m/s) and `invisibleIds` at every moment; `ids` (the agents' numbers), `scales` (their radii) and `protoIndices` (their groups) once |
//! | `Agents.primvars:group`, `primvars:speed` | the index of the group, and the speed in m/s |
//! | `Agents/Prototypes/Group_0` and so on | a body a group, in a colour of its own, of radius 1: who walks is 1.75 m high, with a chest that points where it faces; where somebody flies, a dart |
//!
//! Its own attributes say what there is to say of the scene ([`keys`](super::keys), with `:` for `.`), and in `throng:times` the seconds of
//! the moments.
//!
//! Everybody has a place in the lists from beginning to end: who has not come yet, or has gone, is among the `invisibleIds`, at the place where it came or
//! went. Time codes are moments where these come evenly, else 24ths of a second. Places are written to 0.1 mm, velocities to 1 mm/s;
//! orientations are halves, good to 0.06°. While a file is made, 44 bytes an agent and moment wait beside it on the disk.
//!
//! Read are such files, also as other programs write them again, as text: the first `PointInstancer`, moved by no more than translations.

mod cursor;
mod layer;
mod read;
#[cfg(test)]
mod tests;
mod value;
mod write;

pub use write::UsdaWriter;

use super::Format;

/// USD as text: written and read.
pub(super) const FORMAT: Format = Format {
    ending: "usda",
    title: "Universal Scene Description, as text",
    kept: false,
    sniff: None,
    columns: false,
    create: Some(|output, setting, _| Ok(Box::new(UsdaWriter::new(output, setting)?))),
    read: Some(read::read),
};

/// The attribute with the times of the moments, seconds.
const TIMES: &str = "throng:times";
/// Time codes a second where moments come unevenly, and where nobody says how many.
const CODES: f64 = 24.0;
