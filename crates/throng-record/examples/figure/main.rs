//! Writes a figure of blocks that walks as the figure of a group: `cargo run -p throng-record --example figure NAME.glb`.

#[path = "blocks.rs"]
mod blocks;

use std::process::ExitCode;

fn main() -> ExitCode {
    let Some(path) = std::env::args_os().nth(1) else {
        eprintln!("give the name of the file, such as figure.glb");
        return ExitCode::FAILURE;
    };
    match std::fs::write(&path, blocks::Blocks::default().glb()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{}: {error}", path.display());
            ExitCode::FAILURE
        }
    }
}
