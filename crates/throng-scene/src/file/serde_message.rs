//! Translates the messages of the deserialiser into the terms of scene files.

use super::value::{Misread, Value};
use crate::error::{Error, Kind};
use serde::Deserialize;
use toml::de::DeTable;

/// Turns a message of serde into an error with a hint.
pub(crate) fn explain(message: &str) -> Error {
    let message = message.trim();
    let quoted = quoted(message);
    if message.starts_with("unknown field")
        && let Some((wrong, keys)) = quoted.split_first()
    {
        return unknown_key(wrong, keys);
    }
    if message.starts_with("unknown variant")
        && let Some((wrong, choices)) = quoted.split_first()
    {
        return unknown_variant(wrong, choices);
    }
    if message.starts_with("missing field")
        && let Some(key) = quoted.first()
    {
        return Error::new(Kind::MissingKey, format!("the key `{key}` is missing here"))
            .hint(format!("add `{key}` to this table"));
    }
    if message.starts_with("duplicate field")
        && let Some(key) = quoted.first()
    {
        return Error::new(Kind::Conflict, format!("`{key}` is given twice"));
    }
    if message.starts_with("wanted exactly 1 element") {
        let what = if message.contains("more than") { "several choices are given" } else { "nothing is chosen" };
        return Error::new(Kind::Conflict, format!("{what}, where exactly one belongs"))
            .hint("one choice is one key, as in `place.ring = { radius = 7 }`");
    }
    let kind = if message.starts_with("invalid value") { Kind::OutOfRange } else { Kind::WrongType };
    Error::new(kind, in_plain_words(message))
}

/// Returns the error for a name that is not one of the choices.
pub(crate) fn unknown_variant(wrong: &str, choices: &[String]) -> Error {
    let error = Error::new(Kind::UnknownKey, format!("`{wrong}` is not one of the choices here"));
    with_nearest(error, wrong, choices, "the choices")
}

/// Removed keys, and the key that replaces each.
const REPLACED: [(&str, &str); 2] = [("queue", "look_ahead"), ("detour", "look_ahead")];

/// Renamed keys: the old name and the new one.
const RENAMED: [(&str, &str); 5] = [
    ("who", "groups"),
    ("what", "obstacles"),
    ("way", "direction"),
    ("says", "encoding"),
    ("description", "about.see"),
];

/// Returns the error for an unknown key, with the keys that exist.
pub(crate) fn unknown_key(wrong: &str, keys: &[String]) -> Error {
    let error = Error::new(Kind::UnknownKey, format!("there is no key `{wrong}` here"));
    let is_here = |new: &str| keys.iter().any(|key| new.split('.').next() == Some(key));
    if let Some((_, new)) = RENAMED.iter().find(|(old, new)| *old == wrong && is_here(new)) {
        return error.hint(format!("its name is `{new}` now"));
    }
    match REPLACED.iter().find(|(old, new)| *old == wrong && keys.iter().any(|key| key == new)) {
        Some((_, new)) => {
            error.hint(format!("`{new}` does what it did, and is on unless it says false: leave `{wrong}` out"))
        }
        None => with_nearest(error, wrong, keys, "the keys"),
    }
}

fn with_nearest(error: Error, wrong: &str, known: &[String], what: &str) -> Error {
    if known.is_empty() {
        return error.hint("nothing can stand here: leave it out");
    }
    let all = known.join(", ");
    match nearest(wrong, known) {
        Some(near) => error.hint(format!("did you mean `{near}`? {what} here are: {all}")),
        None => error.hint(format!("{what} here are: {all}")),
    }
}

/// Returns the known word nearest to the written one, if any is near.
pub(crate) fn nearest<'a>(wrong: &str, known: &'a [String]) -> Option<&'a str> {
    let wrong = wrong.to_lowercase();
    known
        .iter()
        .map(|word| {
            let contained = wrong.len() >= 3 && (word.contains(&wrong) || wrong.contains(word.as_str()));
            (if contained { 1 } else { edits(&wrong, word) }, word)
        })
        .filter(|(distance, word)| *distance <= 1 + word.chars().count().max(wrong.chars().count()) / 3)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, word)| word.as_str())
}

/// Returns the number of letters to add, leave out or change to make one word of the other (Levenshtein).
fn edits(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, y) in b.iter().enumerate() {
            let change = diagonal + usize::from(x != *y);
            diagonal = row[j + 1];
            row[j + 1] = change.min(row[j] + 1).min(row[j + 1] + 1);
        }
    }
    row[b.len()]
}

/// Returns the keys that a table of this type can have, as serde knows them.
pub(crate) fn keys_of<T: for<'de> Deserialize<'de>>() -> Vec<String> {
    match value_of::<T>("\"no such key\" = 0") {
        Err(misread) => quoted(&misread.message).into_iter().skip(1).collect(),
        Ok(_) => vec![],
    }
}

/// Reads a value from a text that is not a file.
pub(crate) fn value_of<T: for<'de> Deserialize<'de>>(text: &str) -> Result<T, Misread> {
    let tree = DeTable::parse(text).map_err(|error| Misread { message: error.message().into(), span: error.span() })?;
    T::deserialize(Value::from(tree))
}

/// Returns the words between backticks.
fn quoted(message: &str) -> Vec<String> {
    message.split('`').skip(1).step_by(2).map(str::to_owned).collect()
}

/// Describes a point with this number of coordinates.
pub(crate) fn point(coordinates: usize) -> &'static str {
    if coordinates == 2 { "two numbers, [x, y]" } else { "three numbers, [x, y, z]" }
}

/// Replaces the type names of Rust and serde by plain words.
fn in_plain_words(message: &str) -> String {
    let (found, expected) = match message.split_once(", expected ") {
        Some((found, expected)) => (found.to_owned(), Some(expected)),
        None => (message.to_owned(), None),
    };
    let mut found = found
        .replace("invalid type: ", "this is the wrong type: ")
        .replace("invalid value: ", "this value cannot be: ")
        .replace("invalid length ", "this has the wrong number of entries: ")
        .replace("floating point `", "the number `")
        .replace("integer `", "the whole number `")
        .replace("boolean `", "the truth value `")
        .replace(": string ", ": the text ")
        .replace(": map", ": a table")
        .replace(": sequence", ": a list")
        .replace('`', "");
    if let Some(expected) = expected {
        let bare = expected.strip_prefix('`').and_then(|expected| expected.strip_suffix('`'));
        let plain = match bare.unwrap_or(expected) {
            "f64" | "f32" => "a number".to_owned(),
            "u8" | "u32" | "u64" | "usize" => "a whole number that is not negative".to_owned(),
            "a boolean" => "true or false".to_owned(),
            "a string" => "a text in quotes".to_owned(),
            "a sequence" => "a list".to_owned(),
            "an array of length 2" => point(2).to_owned(),
            "an array of length 3" => point(3).to_owned(),
            "a map" => "a table such as { key = value }".to_owned(),
            text if text.starts_with("struct ") => "a table such as { key = value }".to_owned(),
            text if text.starts_with("enum ") || text == "string or map" || text == "string or table" => {
                "a choice, as in `place.ring = { .. }`".to_owned()
            }
            text => text.to_owned(),
        };
        found.push_str(", but should be ");
        found.push_str(&plain);
    }
    found
}
