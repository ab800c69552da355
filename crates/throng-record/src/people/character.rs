//! Bodies of files that agents can have.

use crate::formats::{FormatFlaw, glb};
use throng_figure::Character;

/// Reads a body that walks from a file in memory: binary glTF 2.0 (`.glb`), or glTF with everything embedded (`.gltf`).
///
/// The joints are found by their names (Mixamo, VRM, Blender, Unreal) or by the humanoid bones of VRM.
///
/// ```
/// let error = throng_record::people::character(b"no body").unwrap_err();
/// assert_eq!(error.why, "the file does not begin like binary glTF");
/// ```
///
/// # Errors
/// The file is no glTF, has no skin, lacks joints, is damaged or too large, or its body does not stand upright.
pub fn character(bytes: &[u8]) -> Result<Character, FormatFlaw> {
    glb::character::read(bytes)
}
