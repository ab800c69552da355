//! People as [BVH](https://research.cs.wisc.edu/graphics/Courses/cs-838-1999/Jeff/BVH.html) (Biovision hierarchy), one
//! file a person, for programs that transfer motion to other characters.
//!
//! The number of the agent takes the place of `*` in the name of the output: `people/*.bvh` gives `people/7.bvh`.
//!
//! Lengths are centimetres, as Maya, MotionBuilder and Unreal expect, and y is up: the point (x, y, z) of the scene, in
//! metres, is (100 x, 100 z, -100 y) of the file. At rest a person faces +z, with +x to its left, and no joint is
//! rotated. The 19 joints have the names of Mixamo's rigs. The root, `Hips`, has the place of the hips in the scene and
//! rotates in the order z, x, y; the other joints in the order z, y, x. So no joint comes near the singularity of its
//! angles in walking, and angles are continuous.
//!
//! The first frame is the first moment of the agent, and frames come at the mean rate of the recording, at the planned
//! poses of these times. Agents with radii above 0.5 m are no people, and have no file. A file is named when it is
//! complete. While the files are written, up to 88 bytes per agent and frame wait beside them on disk.

mod euler;
mod read;
#[cfg(test)]
mod tests;
mod write;

pub use write::BvhWriter;

use super::Format;
use crate::people::FigureStyle;

/// BVH: written; of its files, only the joints are read.
pub(super) const FORMAT: Format = Format {
    ending: "bvh",
    title: "Biovision hierarchy: a person's joints",
    kept: false,
    sniff: None,
    columns: false,
    styles: &[FigureStyle::Auto, FigureStyle::Skins],
    create: Some(|output, setting, _| Ok(Box::new(BvhWriter::new(output, setting)?))),
    read: None,
    figures: Some(read::read),
};

/// Units of a file in a metre.
const UNITS: f64 = 100.0;
