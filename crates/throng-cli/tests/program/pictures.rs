//! The pictures of README.md and of docs/: the table of docs/pictures.md has the command that makes each of them. Pictures
//! that the program draws in seconds are drawn again and compared. `UPDATE=1 cargo test --workspace --locked --offline
//! --test program -- pictures::` writes those that differ.

use crate::shared::{folder, throng};
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

/// A row of the table: a picture, the command that makes it, and whether the test makes it again.
struct Row {
    picture: String,
    command: String,
    is_drawn: bool,
}

/// Returns the rows of the table.
fn rows() -> Vec<Row> {
    let page = std::fs::read_to_string(root().join("docs/pictures.md")).unwrap();
    let table = page.split("## The pictures of these pages").nth(1).expect("docs/pictures.md has the table");
    // the first code of a cell, or its words
    let code = |cell: &str| match cell.trim().strip_prefix('`').and_then(|rest| rest.split_once('`')) {
        Some((code, _)) => code.to_owned(),
        None => cell.trim().to_owned(),
    };
    let row = |line: &str| {
        let cells: Vec<&str> = line.trim_matches('|').split(" | ").collect();
        let [picture, command, check] = cells[..] else { panic!("three cells: {line}") };
        Row { picture: code(picture), command: code(command), is_drawn: check.trim() == "drawn again" }
    };
    let own = table.lines().filter(|line| line.starts_with("| `")).map(row);
    own.chain(constructions()).collect()
}

/// Returns the pictures of docs/constructions.md: its commands, with their outputs in docs/constructions/.
fn constructions() -> Vec<Row> {
    let page = std::fs::read_to_string(root().join("docs/constructions.md")).unwrap();
    let commands = page.lines().filter(|line| line.starts_with("throng run "));
    let row = |line: &str| {
        let (rest, name) = line.rsplit_once(" -o ").expect(line);
        let picture = format!("docs/constructions/{name}");
        Row { command: format!("{rest} -o {picture}").replace('\'', ""), picture, is_drawn: true }
    };
    commands.map(row).collect()
}

/// Returns the pictures in a folder of docs/, as paths from the root.
fn pictures(folder: &str) -> Vec<String> {
    let entries = std::fs::read_dir(root().join(folder)).unwrap().map(|entry| entry.unwrap().path());
    let ends =
        |path: &Path| path.extension().is_some_and(|ending| ["png", "jpg", "svg"].iter().any(|end| ending == *end));
    let name = |path: PathBuf| format!("{folder}/{}", path.file_name().unwrap().to_str().unwrap());
    entries.filter(|path| ends(path)).map(name).collect()
}

#[test]
fn every_picture_has_its_command() {
    let mut named: Vec<String> = rows().into_iter().map(|row| row.picture).collect();
    let mut existing: Vec<String> =
        ["docs", "docs/studio", "docs/constructions"].into_iter().flat_map(pictures).collect();
    named.sort();
    existing.sort();
    assert_eq!(named, existing, "the table of docs/pictures.md (left) and the pictures of docs/ (right)");
    for Row { picture, command, .. } in rows() {
        let words: Vec<&str> = command.split_whitespace().collect();
        // examples and scripts exist; the options of the program are known
        if let Some(at) = words.iter().position(|word| *word == "--example") {
            let package = words[words.iter().position(|word| *word == "-p").unwrap() + 1];
            let example = root().join("crates").join(package).join("examples").join(words[at + 1]);
            assert!(example.with_extension("rs").exists() || example.is_dir(), "{picture}: {}", example.display());
        }
        for script in words.iter().filter(|word| word.ends_with(".py")) {
            assert!(root().join(script).exists(), "{picture}: {script}");
        }
        if words[0] == "throng" {
            let folder = folder();
            throng(folder.path()).args(&words[1..]).arg("--help").assert().success();
        }
    }
}

#[test]
fn pictures_are_those_that_their_commands_draw() {
    let (update, mut stale) = (std::env::var_os("UPDATE").is_some(), Vec::new());
    for Row { picture, command, .. } in rows().into_iter().filter(|row| row.is_drawn) {
        let folder = folder();
        std::fs::create_dir_all(folder.path().join(&picture).parent().unwrap()).unwrap();
        let words = command.split_whitespace().skip(1);
        throng(folder.path()).args(words).assert().success();
        let (drawn, kept) = (folder.path().join(&picture), root().join(&picture));
        if std::fs::read(&drawn).unwrap() != std::fs::read(&kept).unwrap_or_default() {
            if update {
                std::fs::copy(&drawn, &kept).unwrap();
            } else {
                stale.push(format!("{picture} is not what `{command}` draws"));
            }
        }
    }
    let hint = "look at them, then: UPDATE=1 cargo test --workspace --locked --offline --test program -- pictures::";
    assert!(stale.is_empty(), "{}\n{hint}", stale.join("\n"));
}
