//! The JSON schema of scene files, for editors and for what shows sliders.

/// The file `scene.schema.json`, packed.
const PACKED: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/schema.deflate"));

/// The JSON schema (draft 2020-12) of scene files. Editors that know it complete and check keys while one types.
///
/// It is kept as a file, `scene.schema.json` beside this crate's sources, which a test compares with what the types say: a
/// program that asks for it brings along 26 kilobytes, and no generator.
pub fn schema() -> serde_json::Value {
    let text = miniz_oxide::inflate::decompress_to_vec(PACKED).unwrap_or_default();
    // what the build has packed is what comes out
    serde_json::from_slice(&text).unwrap_or_default()
}
