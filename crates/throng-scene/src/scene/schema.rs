//! The JSON schema of scene files, for editors and for programs that show sliders.

/// The file `scene.schema.json`, packed.
const PACKED: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/schema.deflate"));

/// Returns the JSON schema (draft 2020-12) of scene files. Editors use it to complete and check keys.
///
/// The schema is a file, `scene.schema.json` in this crate's folder, and a test compares it with the types. A program
/// that uses it carries 26 kilobytes and no generator.
pub fn schema() -> serde_json::Value {
    let text = miniz_oxide::inflate::decompress_to_vec(PACKED).unwrap_or_default();
    // the build script packed this text: unpacking cannot fail
    serde_json::from_slice(&text).unwrap_or_default()
}
