//! Packs the JSON schema of scene files, and the scenes of the gallery.

use std::fs;
use std::path::Path;

/// The folder of the scenes: in this crate's folder, which has a link to it, or in the repository where a checkout has
/// no links (Windows).
const SCENES: [&str; 2] = ["scenes", "../../scenes"];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let out = std::env::var("OUT_DIR")?;
    let pack = |name: &str, text: &str| {
        fs::write(Path::new(&out).join(name), miniz_oxide::deflate::compress_to_vec(text.as_bytes(), 9))
    };
    println!("cargo::rerun-if-changed=scene.schema.json");
    let schema: serde_json::Value = serde_json::from_slice(&fs::read("scene.schema.json")?)?;
    pack("schema.deflate", &schema.to_string())?;

    let folder = SCENES.into_iter().find(|folder| Path::new(folder).is_dir());
    let folder = folder.ok_or_else(|| format!("no folder of scenes: neither {} nor {}", SCENES[0], SCENES[1]))?;
    println!("cargo::rerun-if-changed={folder}");
    let mut scenes = Vec::new();
    for file in fs::read_dir(folder)? {
        let path = file?.path();
        if let (Some(stem), Some("toml")) = (path.file_stem(), path.extension().and_then(|ending| ending.to_str())) {
            scenes.push(format!("{}\0{}", stem.to_string_lossy(), fs::read_to_string(&path)?));
        }
    }
    scenes.sort();
    pack("scenes.deflate", &scenes.join("\0"))?;
    Ok(())
}
