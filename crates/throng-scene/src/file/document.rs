//! A scene file as it was read: its text, what `--set` changed, and where each value stands.

use super::path::{Path, Problem, Step};
use super::serde_message;
use super::set::{self, Override};
use crate::error::{Error, Kind};
use serde::Deserialize;
use std::ops::Range;
use std::path::PathBuf;
use std::sync::Arc;
use toml::Spanned;
use toml::de::{DeTable, DeValue, Deserializer};

/// Where a scene was read from.
#[derive(Clone, Debug, Default)]
pub struct Origin {
    /// The folder that relative file names in the scene refer to; empty for the current one.
    pub folder: PathBuf,
    pub(crate) document: Option<Arc<Document>>,
}

impl PartialEq for Origin {
    /// Always: where a scene was read from is not part of what it says.
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// A scene file as it was read. Byte positions beyond the file's text name places in the overrides' values, one
/// after the other.
#[derive(Clone, Debug)]
pub(crate) struct Document {
    name: Option<String>,
    text: String,
    overrides: Vec<Override>,
}

impl Document {
    pub fn new(name: Option<String>, text: String) -> Self {
        Self { name, text, overrides: vec![] }
    }

    /// With one more value changed.
    pub fn with(&self, change: Override) -> Self {
        let mut document = self.clone();
        document.overrides.push(change);
        document
    }

    /// The tree of values, overrides applied.
    fn tree(&self) -> Result<Spanned<DeTable<'_>>, Error> {
        let mut tree = DeTable::parse(&self.text).map_err(|error| {
            let out = Error::new(Kind::Syntax, format!("this is not TOML: {}", error.message()));
            self.place(out, error.span().unwrap_or(0..0))
        })?;
        let mut start = self.text.len() + 1;
        for change in &self.overrides {
            set::apply(tree.get_mut(), change, start)?;
            start += change.value.len() + 1;
        }
        Ok(tree)
    }

    /// Reads the document as a `T`.
    pub fn read<T: for<'de> Deserialize<'de>>(&self) -> Result<T, Error> {
        let tree = self.tree()?;
        let surplus = surplus(tree.get_ref(), 2);
        let read = T::deserialize(Deserializer::from(tree)).map_err(|error| {
            let out = serde_message::explain(error.message());
            self.place(out, error.span().unwrap_or(0..0))
        })?;
        match surplus {
            None => Ok(read),
            Some((span, length, most)) => {
                let point = serde_message::point(most);
                let message = format!("this has the wrong number of entries: {length}, but should be {point}");
                Err(self.place(Error::new(Kind::WrongType, message), span))
            }
        }
    }

    /// Turns a problem with a value into an error with the value's place.
    pub fn explain(&self, problem: Problem) -> Error {
        let mut error = Error::new(problem.kind, problem.message);
        error.hint = problem.hint;
        match self.tree() {
            Ok(tree) => self.place(error, locate(&tree, &problem.path)),
            Err(_) => error,
        }
    }

    /// Adds file, line and column to an error about these bytes.
    fn place(&self, error: Error, span: Range<usize>) -> Error {
        let mut start = self.text.len() + 1;
        for change in &self.overrides {
            if (start..=start + change.value.len()).contains(&span.start) {
                return error.file(format!("--set {}={}", change.written, change.value));
            }
            start += change.value.len() + 1;
        }
        let name = self.name.clone().unwrap_or_else(|| "scene".into());
        error.file(name).place(&self.text, span)
    }
}

/// The bytes of the value at a path, or of the nearest enclosing thing that the file has.
fn locate(tree: &Spanned<DeTable<'_>>, path: &Path) -> Range<usize> {
    let mut span = 0..0;
    let mut table = Some(tree.get_ref());
    let mut array = None;
    for step in &path.steps {
        let value = match (step, table, array) {
            (Step::Key(key), Some(items), _) => items.get(key.as_str()),
            (Step::Index(index), _, Some(items)) => <[Spanned<DeValue>]>::get(items, *index),
            // A single source may stand where a list could be, and a list where a table of it could.
            (Step::Index(0), Some(_), _) => continue,
            (Step::Key(key), _, Some(_)) if key == "of" => continue,
            _ => None,
        };
        let Some(value) = value else { break };
        span = value.span();
        (table, array) = match value.get_ref() {
            DeValue::Table(items) => (Some(items), None),
            DeValue::Array(items) => (None, Some::<&[_]>(items)),
            _ => (None, None),
        };
    }
    // The table of a dotted key (`place.ring = ..`) stands nowhere itself: its only value does.
    while let (Some(Step::Key(_)), Some(items)) = (path.steps.last(), table) {
        let mut values = items.values();
        match (values.next(), values.next()) {
            (Some(only), None) if !(span.start..=span.end).contains(&only.span().start) => {
                span = only.span();
                table = only.get_ref().as_table();
            }
            _ => break,
        }
    }
    span
}

/// Lists of numbers that may have any length, and what programs bring along; all others are points of the plane ...
const NUMBER_LISTS: [&str; 5] = ["layers", "avoids", "heights", "radii", "custom"];
/// ... but those in these tables, which are points in space ...
const IN_SPACE: [&str; 9] = ["sphere", "air", "camera", "steer", "surface", "path", "field", "distance", "wrap_around"];
/// ... or not, after all.
const IN_PLANE: [&str; 6] = ["rectangle", "corners", "sketch", "paint", "picture", "map"];

/// The place of a list with more numbers than a point has, how many, and how many it should have: the deserialiser
/// would drop the surplus.
fn surplus(table: &DeTable, most: usize) -> Option<(Range<usize>, usize, usize)> {
    fn inside(value: &Spanned<DeValue>, most: usize) -> Option<(Range<usize>, usize, usize)> {
        match value.get_ref() {
            DeValue::Table(table) => surplus(table, most),
            DeValue::Array(items) => {
                let number = |item: &Spanned<DeValue>| item.get_ref().is_float() || item.get_ref().is_integer();
                if items.len() > most && items.iter().all(number) {
                    return Some((value.span(), items.len(), most));
                }
                items.iter().find_map(|item| inside(item, most))
            }
            _ => None,
        }
    }
    let points = table.iter().filter(|(key, _)| !NUMBER_LISTS.contains(&key.get_ref().as_ref()));
    points.into_iter().find_map(|(key, value)| {
        let key = key.get_ref().as_ref();
        let most = if IN_SPACE.contains(&key) {
            3
        } else if IN_PLANE.contains(&key) {
            2
        } else {
            most
        };
        inside(value, most)
    })
}
