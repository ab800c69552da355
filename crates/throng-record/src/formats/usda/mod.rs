//! Trajectories as a stage of [Universal Scene Description](https://openusd.org), as text, for film and animation.
//!
//! Z is up, and the unit is the metre. `/World` stands at the origin of the scene. Its prims are
//!
//! | prim | what |
//! |---|---|
//! | `Ground`, `Obstacles` | meshes; obstacles are 1 m high |
//! | `Agents` | a `PointInstancer`: `positions`, `orientations`, `velocities` (m/s) and `invisibleIds` at every frame; `ids` (the agents' numbers), `scales` (their radii) and `protoIndices` (their groups) once |
//! | `Agents.primvars:group`, `primvars:speed` | the index of the group, and the speed in m/s |
//! | `Agents/Prototypes/Group_0` and so on | a body per group, in its own colour, of radius 1: a figure of 1.75 m with a chest that points ahead; a dart in scenes with flying agents |
//! | `Agents/Prototypes/Person` | empty: what the instancer draws of an agent that is a person |
//! | `People/Agent_7` and so on | a person: a `SkelRoot` that stands and turns as the hips do and is scaled by the height, with a `Skeleton`, a `SkelAnimation` (`Walk`) of 19 joints, and a mesh (`Body`) with weights and normals |
//! | `People/Bodies` | a class with the bodies that people refer to, by build and look |
//!
//! The attributes of `/World` hold the metadata of the scene ([`keys`](super::keys), with `:` for `.`), and
//! `throng:times` the times of the frames in seconds.
//!
//! People are agents on the ground with a radius of at most 0.5 m, in a file of at most 300 agents (or as
//! [`FigureStyle`] says). They refer to their bodies without `instanceable`: importers that make instances would show
//! the same walk for all. A person is invisible before its first and after its last sample, and while it is away;
//! its scale is 0 then, since some programs ignore visibility. At rest it faces +x and no joint is rotated.
//!
//! Every agent has an entry in the lists at every frame. Before its first and after its last sample, an agent is among
//! the `invisibleIds`, at its first or last position. Time codes count frames if frames come at an even rate, else
//! 24ths of a second. Positions are written to 0.1 mm, velocities to 1 mm/s; orientations are half floats, accurate to
//! 0.06°. While a file is written, 44 bytes per agent and frame wait beside it on disk.
//!
//! Such files are read too, also when another program has rewritten them, as text: the first `PointInstancer`, if only
//! translations move it.

mod cursor;
mod figures;
mod layer;
mod people;
mod read;
#[cfg(test)]
mod tests;
mod text;
mod value;
mod write;

pub use write::UsdaWriter;

use super::Format;
use crate::people::FigureStyle;

/// USD as text: written and read.
pub(super) const FORMAT: Format = Format {
    ending: "usda",
    title: "Universal Scene Description, as text",
    kept: false,
    sniff: None,
    columns: false,
    styles: &[FigureStyle::Auto, FigureStyle::Skins, FigureStyle::None],
    create: Some(|output, setting, choice| Ok(Box::new(UsdaWriter::new(output, setting)?.style(choice.figures)))),
    read: Some(read::read),
    figures: Some(figures::read),
};

/// The attribute with the times of the frames, seconds.
const TIMES: &str = "throng:times";
/// Time codes per second of uneven frames, and of files that state no rate.
const CODES: f64 = 24.0;
