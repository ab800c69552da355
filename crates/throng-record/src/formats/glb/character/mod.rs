//! Bodies of glTF files: skinned meshes with the joints of a human.
//!
//! Only the places of joints, and the places of vertices at rest, are taken from a file: axes of bones, scales of nodes and the
//! pose do not matter. The pose at rest is that of the nodes, as viewers show the file without animation.

#[cfg(test)]
mod damaged_tests;
mod joints;
mod names;
#[cfg(test)]
pub(crate) mod tests;
mod vertices;

use super::data::Data;
use crate::formats::FormatFlaw;
use throng_figure::{Character, CharacterError, RestBody};

const HINT: &str = "a figure is a .glb file (or a .gltf file with everything in it) of one body with a skin; joints have the names of \
     Mixamo, VRM, Blender or Unreal: Hips, Spine, Head, and for each side UpperArm, ForeArm, UpLeg, Leg, Foot \
     (docs/characters.md)";

/// Reads a body.
///
/// # Errors
/// The file is no glTF, has no skin, lacks joints, is damaged or too large, or the body does not stand.
pub(crate) fn read(bytes: &[u8]) -> Result<Character, FormatFlaw> {
    parse(bytes).map_err(|why| FormatFlaw { line: None, why, hint: Some(HINT) })
}

fn parse(bytes: &[u8]) -> Result<Character, String> {
    let data = Data::open_any(bytes)?;
    let joints = joints::Joints::of(&data)?;
    let mut body = RestBody { joints: joints.places, ..RestBody::default() };
    vertices::add(&mut body, &data, &joints)?;
    Character::new(&body).map_err(|error: CharacterError| error.to_string())
}
