//! Generates the table of thumbnails that the window build embeds. The web build fetches the files instead. `cargo run
//! -p throng-studio --example thumbnails` renders the thumbnails.

use std::fmt::Write;
use std::path::Path;
use std::{env, fs};

/// Returns the scene name of a thumbnail, or `None` if the file is no PNG.
fn stem(file: &Path) -> Option<String> {
    let picture = file.extension()? == "png";
    Some(file.file_stem()?.to_str()?.to_owned()).filter(|_| picture)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = Path::new(&env::var("CARGO_MANIFEST_DIR")?).join("thumbnails");
    println!("cargo::rerun-if-changed={}", folder.display());
    let mut names: Vec<String> = match fs::read_dir(&folder) {
        Ok(files) => files.flatten().filter_map(|file| stem(&file.path())).collect(),
        Err(_) => Vec::new(),
    };
    names.sort();
    let mut table = String::from("&[\n");
    for name in &names {
        let file = folder.join(format!("{name}.png"));
        writeln!(table, "    ({name:?}, include_bytes!({file:?}).as_slice()),")?;
    }
    table.push(']');
    fs::write(Path::new(&env::var("OUT_DIR")?).join("thumbnails.rs"), table)?;
    Ok(())
}
