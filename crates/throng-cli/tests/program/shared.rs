//! Helpers that the tests share.

use assert_cmd::Command;
use assert_cmd::assert::Assert;
use std::path::Path;
use tempfile::TempDir;

/// A scene of one agent that walks 5 m to the right.
pub const WALK: &str = "\
[[group]]
name = \"a\"
place.point = [0.0, 0.0]
goal.point = [5.0, 0.0]
";

/// Creates an empty folder.
pub fn folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

/// Returns the program, to be run in a folder.
pub fn throng(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_throng"));
    command.current_dir(folder);
    command
}

/// Runs the program with these arguments, separated by spaces.
pub fn call(folder: &Path, arguments: &str) -> Assert {
    throng(folder).args(arguments.split_whitespace()).assert()
}

/// Returns standard output.
pub fn stdout(assert: &Assert) -> String {
    String::from_utf8(assert.get_output().stdout.clone()).unwrap()
}

/// Returns standard error.
pub fn stderr(assert: &Assert) -> String {
    String::from_utf8(assert.get_output().stderr.clone()).unwrap()
}

/// Returns the names of the files in a folder, sorted.
pub fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

/// Returns the anchor of a heading of a page, as forges and mdBook make it.
pub fn anchor(heading: &str) -> String {
    let kept = heading.chars().filter(|c| c.is_alphanumeric() || "_- ".contains(*c));
    kept.collect::<String>().to_lowercase().replace(' ', "-")
}
