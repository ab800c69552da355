//! The page on the features of other libraries: each item that it names exists, and each scene is in the gallery and uses
//! what its row names.

use crate::docs::tables::{Uses, registered};
use std::path::Path;
use throng_scene::{Behaviours, gallery};

const PAGE: &str = include_str!("../../../../docs/parity.md");

/// Returns the cells of every row on other libraries: feature, item, scene. The tables before are generated.
fn rows() -> Vec<[&'static str; 3]> {
    let (_, page) = PAGE.split_once("\n## OpenSteer\n").unwrap();
    let rows =
        page.lines().filter(|line| line.starts_with('|') && !line.starts_with("| what ") && !line.starts_with("|--"));
    rows.map(|line| {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        cells.try_into().unwrap_or_else(|_| panic!("not three cells: {line}"))
    })
    .collect()
}

/// Returns the words between backquotes.
fn quoted(cell: &str) -> impl Iterator<Item = &str> {
    cell.split('`').skip(1).step_by(2)
}

/// Returns all Rust files of a folder and its subfolders; none if the folder does not exist.
fn sources(folder: &Path) -> Vec<String> {
    let mut folders = vec![folder.to_owned()];
    let mut texts = vec![];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).into_iter().flatten() {
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

/// Whether a text contains a phrase, and the last word of the phrase is whole.
fn says(text: &str, phrase: &str) -> bool {
    let ends = |rest: &str| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_');
    text.match_indices(phrase).any(|(at, _)| ends(&text[at + phrase.len()..]))
}

/// Whether a text defines an item.
fn defines(text: &str, item: &str) -> bool {
    ["struct", "enum", "trait", "fn", "const", "type"].iter().any(|kind| says(text, &format!("pub {kind} {item}")))
}

/// Whether a text that defines or extends an item has this method, field or variant.
fn has(text: &str, item: &str, member: &str) -> bool {
    let extends = ["struct", "enum", "trait", "impl"].iter().any(|kind| says(text, &format!("{kind} {item}")));
    let fields =
        [format!("pub {member}:"), format!("    {member},"), format!("    {member}("), format!("    {member} {{")];
    extends && (says(text, &format!("fn {member}")) || fields.iter().any(|field| text.contains(field)))
}

/// Whether a path such as `throng::motion::Vehicle::brake` names something: its crate defines the item, its module
/// defines or uses it, and a file about the item has the member.
fn exists(path: &str) -> bool {
    let mut names: Vec<&str> = path.split("::").collect();
    let is_member = names.len() > 2 && names[names.len() - 2].starts_with(char::is_uppercase);
    let member = if is_member { names.pop() } else { None };
    let (Some(item), [library, modules @ ..]) = (names.pop(), &names[..]) else { return false };
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(library.replace('_', "-")).join("src");
    let module = modules.iter().fold(src.clone(), |folder, name| folder.join(name));
    let own = match std::fs::read_to_string(module.with_extension("rs")) {
        Ok(text) => vec![text],
        Err(_) => sources(&module),
    };
    let uses =
        |text: &String| text.split(';').any(|line| line.contains("pub use") && words(line).any(|word| word == item));
    let all = sources(&src);
    all.iter().any(|text| defines(text, item))
        && own.iter().any(|text| defines(text, item) || uses(text))
        && member.is_none_or(|member| all.iter().any(|text| has(text, item, member)))
}

#[test]
fn every_item_exists() {
    let items = || rows().into_iter().flat_map(|row| quoted(row[1])).filter(|item| item.contains("::"));
    assert!(items().count() > 150);
    let missing: Vec<&str> = items().filter(|item| !exists(item)).collect();
    assert!(missing.is_empty(), "{missing:?}");
    let wrong = ["throng_steer::Sekk", "throng::motion::Seek", "throng_steer::Seek::prey", "throng::nowhere::Seek"];
    assert!(wrong.iter().all(|wrong| !exists(wrong)));
}

/// Returns the behaviours in a cell: the names of types that are registered, and names of scene files, `steer.NAME`.
fn behaviours(cell: &'static str) -> Vec<&'static str> {
    let known = registered();
    let of_type = |path: &str| {
        let name = path.strip_prefix("throng_steer::")?.split("::").next()?;
        known.iter().find(|known| known.type_name == name).map(|known| known.name)
    };
    quoted(cell).filter_map(|item| item.strip_prefix("steer.").or_else(|| of_type(item))).collect()
}

#[test]
fn every_scene_is_in_the_gallery_and_uses_the_behaviours_of_its_row() {
    let uses = Uses::of_gallery();
    let known: Vec<&str> = gallery::names().collect();
    let mut wrong = vec![];
    for [what, place, cell] in rows() {
        assert!(cell == "all" || cell.starts_with("none") || cell.starts_with('`'), "{what}: {cell}");
        let behaviours = behaviours(place);
        for name in &behaviours {
            assert!(Behaviours::default().names().any(|known| known == *name), "{what}: there is no `steer.{name}`");
        }
        let scenes: Vec<&str> = behaviours.iter().flat_map(|name| uses.scenes("Steer", name)).collect();
        let fits = |scene: &str| known.contains(&scene) && (behaviours.is_empty() || scenes.contains(&scene));
        wrong.extend(quoted(cell).filter(|scene| !fits(scene)).map(|scene| format!("{what}: {scene}")));
        if cell.starts_with("none") && !scenes.is_empty() {
            wrong.push(format!("{what}: not none, but {scenes:?}"));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn nothing_is_without_a_place_or_a_reason() {
    for [what, place, _] in rows() {
        let reason = place.split_whitespace().count() > 3;
        assert!(place.contains("::") || place.starts_with("studio") || reason, "{what}: {place}");
    }
}
