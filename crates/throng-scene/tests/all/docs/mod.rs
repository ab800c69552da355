//! The pages match the code: their scenes can be built, they name every key, and the model, the behaviour and the field of
//! the pages on each run.

mod behaviour;
mod field;
mod model;
pub mod tables;

use std::path::Path;
use throng_scene::{Scene, schema};

/// The pages that describe the keys of scene files, by hand.
const PAGES: [&str; 5] = [
    include_str!("../../../../../docs/scenes.md"),
    include_str!("../../../../../docs/models.md"),
    include_str!("../../../../../docs/steering.md"),
    include_str!("../../../../../docs/fields.md"),
    include_str!("../../../../../docs/swarms.md"),
];

/// The pages with blocks that are no scenes (```toml,no_run), and how many: bounds, a manifest and keys of a plug-in, a
/// camera, a plan.
const SKIPPED: [(&str, usize); 5] =
    [("characters.md", 1), ("compare.md", 1), ("pictures.md", 1), ("plugins.md", 5), ("sweeps.md", 1)];

/// Returns the names and texts of README.md and of all pages, except docs/errors.md: it shows invalid scenes, and a test
/// of throng-cli runs them.
fn pages() -> Vec<(String, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let docs = std::fs::read_dir(root.join("docs")).unwrap().map(|entry| entry.unwrap().path());
    let mut paths: Vec<_> = docs.filter(|path| path.extension().is_some_and(|ending| ending == "md")).collect();
    paths.sort();
    paths.push(root.join("README.md"));
    let name = |path: &Path| path.file_name().unwrap().to_str().unwrap().to_owned();
    let pages = paths.iter().map(|path| (name(path), std::fs::read_to_string(path).unwrap()));
    pages.filter(|(name, _)| name != "errors.md").collect()
}

/// Checks that a page has this number of blocks of code that begin with `fence`, and that a file of tests has all their
/// lines.
fn assert_shown(page: &str, fence: &str, count: usize, file: &str) {
    let blocks: Vec<&str> = page.split(fence).skip(1).filter_map(|rest| rest.split("```").next()).collect();
    assert_eq!(blocks.len(), count, "blocks of {fence}");
    let lines: Vec<&str> = file.lines().map(str::trim).collect();
    for line in blocks.iter().flat_map(|code| code.lines()).map(str::trim) {
        assert!(lines.contains(&line), "the page has a line that is not in the file of its test: {line}");
    }
}

#[test]
fn every_scene_of_the_pages_builds() {
    let mut built = 0;
    for (name, page) in pages() {
        let mut skipped = 0;
        for (at, block) in page.match_indices("```toml").map(|(at, fence)| (at, &page[at + fence.len()..])) {
            let (info, rest) = block.split_once('\n').unwrap();
            let line = page[..at].lines().count() + 1;
            match info {
                "" => {}
                ",no_run" => {
                    skipped += 1;
                    continue;
                }
                _ => panic!("docs/{name}:{line}: ```toml{info} is neither ```toml nor ```toml,no_run"),
            }
            let example = rest.split("```").next().unwrap();
            let scene: Scene = example.parse().unwrap_or_else(|error| panic!("docs/{name}:{line}: {error}"));
            if !scene.groups.is_empty() {
                scene.build().unwrap_or_else(|error| panic!("docs/{name}:{line}: {error}"));
                built += 1;
            }
        }
        let expected = SKIPPED.iter().find(|(page, _)| *page == name).map_or(0, |(_, count)| *count);
        assert_eq!(skipped, expected, "docs/{name}: blocks of ```toml,no_run");
    }
    assert!(built >= 15, "{built}");
}

#[test]
fn every_key_is_on_a_page() {
    fn keys(value: &serde_json::Value, out: &mut Vec<String>) {
        if let Some(properties) = value["properties"].as_object() {
            out.extend(properties.keys().cloned());
        }
        match value {
            serde_json::Value::Object(map) => map.values().for_each(|value| keys(value, out)),
            serde_json::Value::Array(list) => list.iter().for_each(|value| keys(value, out)),
            _ => {}
        }
    }
    let mut all = vec![];
    keys(&schema(), &mut all);
    assert!(all.len() > 60);
    let words: Vec<&str> =
        PAGES.iter().flat_map(|page| page.split(|c: char| !(c.is_alphanumeric() || c == '_'))).collect();
    for key in all {
        let is_named = |page: &&str| page.contains(&format!("`{key}`"));
        let is_mentioned = words.contains(&key.as_str()) || PAGES.iter().any(is_named);
        assert!(is_mentioned, "the pages do not mention `{key}`");
    }
}
