//! The step is a pipeline: data flows from stage to stage, forward only.

use std::fs;
use std::path::{Path, PathBuf};

/// The rooms of the stages, in the order of a sub-step, and the room of the pipeline.
const ROOMS: [&str; 8] = ["sleep", "perceive", "navigate", "intend", "avoid", "guard", "moving", "step"];
/// The stages, each with its room.
const STAGES: [(&str, &str); 6] = [
    ("perceive", "Perceive"),
    ("navigate", "Navigate"),
    ("intend", "Intend"),
    ("avoid", "Avoid"),
    ("guard", "KeepApart"),
    ("moving", "Move"),
];

/// Returns the files of a room, each with its text without comments and tests.
fn files(room: &str) -> Vec<(PathBuf, String)> {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut paths = vec![source.join(format!("{room}.rs"))];
    let entries = fs::read_dir(source.join(room)).into_iter().flatten();
    paths.extend(entries.map(|entry| entry.expect("a directory can be read").path()));
    let code = |text: String| {
        let text = text.split("#[cfg(test)]").next().unwrap_or_default().to_owned();
        text.lines().filter(|line| !line.trim_start().starts_with("//")).collect::<Vec<_>>().join("\n")
    };
    let files = paths.into_iter().filter_map(|path| fs::read_to_string(&path).ok().map(|text| (path, code(text))));
    files.collect()
}

/// Whether a text imports a name from a room.
fn imports(text: &str, room: &str, name: &str) -> bool {
    let is_name = |word: &str| word == name;
    let words = |import: &str| import.split(|c: char| !c.is_alphanumeric() && c != '_').any(is_name);
    text.split(';').filter_map(|part| part.split_once(&format!("use crate::{room}"))).any(|(_, import)| words(import))
}

#[test]
fn no_stage_imports_a_later_one() {
    for (index, room) in ROOMS.iter().enumerate() {
        let files = files(room);
        assert!(!files.is_empty(), "the room {room} is gone");
        for (path, text) in files {
            for later in &ROOMS[index + 1..] {
                assert!(!text.contains(&format!("crate::{later}")), "{} imports {later}", path.display());
            }
        }
    }
}

#[test]
fn only_the_pipeline_knows_all_stages() {
    for (path, text) in ROOMS.iter().flat_map(|room| files(room)) {
        let known = STAGES.iter().filter(|(room, stage)| imports(&text, room, stage)).count();
        let is_pipeline = path.ends_with("step/pipeline.rs");
        assert_eq!(known, if is_pipeline { STAGES.len() } else { 0 }, "{}", path.display());
    }
}
