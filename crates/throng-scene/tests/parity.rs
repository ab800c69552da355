//! The page on what other libraries have: each item that it names exists, each scene is in the gallery, nothing is missing.

use std::path::{Path, PathBuf};
use throng_scene::gallery;

const PAGE: &str = include_str!("../../../docs/parity.md");

/// The cells of every row: what, where, scene.
fn rows() -> Vec<[&'static str; 3]> {
    let rows =
        PAGE.lines().filter(|line| line.starts_with('|') && !line.starts_with("| what ") && !line.starts_with("|--"));
    rows.map(|line| {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        cells.try_into().unwrap_or_else(|_| panic!("not three cells: {line}"))
    })
    .collect()
}

/// What stands between backquotes.
fn quoted(cell: &str) -> impl Iterator<Item = &str> {
    cell.split('`').skip(1).step_by(2)
}

/// All Rust files of a folder and those below it.
fn sources(folder: &Path) -> Vec<String> {
    let mut folders = vec![folder.to_owned()];
    let mut texts = vec![];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|end| end == "rs") {
                texts.push(std::fs::read_to_string(path).unwrap());
            }
        }
    }
    texts
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !(c.is_alphanumeric() || c == '_')).filter(|word| !word.is_empty())
}

/// Whether a text has these words one after the other.
fn says(text: &str, phrase: &[&str]) -> bool {
    words(text).collect::<Vec<_>>().windows(phrase.len()).any(|window| window == phrase)
}

/// Whether a path such as `throng::motion::Vehicle::brake` names something public: the item is defined in the crate and its
/// module says `pub use` or defines it; a method, a field or a variant is in a file that defines or extends it.
fn exists(path: &str) -> bool {
    let mut names: Vec<&str> = path.split("::").collect();
    let is_item = |name: &&str| name.starts_with(char::is_uppercase);
    let member = (names.len() > 2 && is_item(&names[names.len() - 2])).then(|| names.pop().unwrap());
    let (item, modules) = (names.pop().unwrap(), &names[1..]);
    let src = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..").join(names[0].replace('_', "-")).join("src");
    let module = modules.iter().fold(src.clone(), |folder, name| folder.join(name));
    let texts: Vec<String> = sources(&src);
    let defines = |text: &&String| {
        ["struct", "enum", "trait", "fn", "const", "type"].iter().any(|kind| says(text, &["pub", kind, item]))
            // scenes' parameters are made by a macro
            || text.contains("parameters!") && text.contains(&format!("    {item} {{"))
    };
    let own = if module.is_dir() {
        sources(&module)
    } else {
        vec![std::fs::read_to_string(module.with_extension("rs")).unwrap_or_default()]
    };
    let uses = own
        .iter()
        .any(|text| text.split(';').any(|line| line.contains("pub use") && words(line).any(|word| word == item)));
    let is_there = texts.iter().any(|text| defines(&text)) && (uses || own.iter().any(|text| defines(&text)));
    let has = |member: &str| {
        let extends = |text: &&String| {
            text.contains(&format!(" {item} {{"))
                || text.contains(&format!(" {item}<"))
                || text.contains(&format!(" {item}("))
        };
        let told = |text: &String| {
            says(text, &["pub", "fn", member])
                || says(text, &["fn", member]) && text.contains("pub trait")
                || text.contains(&format!("pub {member}:"))
                || [",", "(", " {"].iter().any(|end| text.contains(&format!("\n    {member}{end}")))
        };
        texts.iter().filter(extends).any(told)
    };
    is_there && member.is_none_or(has)
}

#[test]
fn every_item_exists() {
    let items = || rows().into_iter().flat_map(|row| quoted(row[1])).filter(|item| item.contains("::"));
    assert!(items().count() > 150);
    let missing: Vec<&str> = items().filter(|item| !exists(item)).collect();
    assert!(missing.is_empty(), "{missing:?}");
    let wrong = ["throng::steer::Sekk", "throng::motion::Seek", "throng::steer::Seek::prey", "throng::nowhere::Seek"];
    assert!(wrong.iter().all(|wrong| !exists(wrong)));
}

#[test]
fn every_scene_is_in_the_gallery() {
    let known: Vec<&str> = gallery::names().collect();
    for [what, _, scene] in rows() {
        assert!(scene == "all" || scene.starts_with("none") || scene.starts_with('`'), "{what}: {scene}");
    }
    let mut missing: Vec<&str> =
        rows().into_iter().flat_map(|row| quoted(row[2])).filter(|name| !known.contains(name)).collect();
    missing.sort_unstable();
    missing.dedup();
    assert!(missing.is_empty(), "{missing:?}");
}

#[test]
fn nothing_is_without_a_place_or_a_reason() {
    for [what, place, _] in rows() {
        let reason = place.split_whitespace().count() > 3;
        assert!(place.contains("::") || place.starts_with("studio") || reason, "{what}: {place}");
    }
}

#[test]
fn every_behaviour_is_on_the_page() {
    let steer = Path::new(env!("CARGO_MANIFEST_DIR")).join("../throng/src/steer");
    let texts = sources(&steer);
    let behaviours =
        texts.iter().flat_map(|text| text.lines()).filter_map(|line| line.strip_prefix("impl Behaviour for "));
    let missing: Vec<&str> = behaviours
        .map(|name| name.trim_end_matches(" {"))
        .filter(|name| !words(PAGE).any(|word| word == *name))
        .collect();
    assert!(missing.is_empty(), "{missing:?}");
}
