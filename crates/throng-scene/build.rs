//! Packs the JSON schema of scene files.

use std::path::Path;
use std::{env, fs};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("cargo::rerun-if-changed=scene.schema.json");
    let schema: serde_json::Value = serde_json::from_slice(&fs::read("scene.schema.json")?)?;
    let packed = miniz_oxide::deflate::compress_to_vec(schema.to_string().as_bytes(), 9);
    fs::write(Path::new(&env::var("OUT_DIR")?).join("schema.deflate"), packed)?;
    Ok(())
}
