//! A scene file as it was read: its text, the values that `--set` changed, and the position of each value.

use super::about::about;
use super::path::{Path, Problem, TomlStep};
use super::serde_message;
use super::set::{self, Override};
use super::value::Value;
use crate::error::{Error, Kind};
use serde::Deserialize;
use std::borrow::Cow;
use std::ops::Range;
use std::path::PathBuf;
use std::sync::Arc;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The source of a scene.
#[derive(Clone, Debug, Default)]
pub struct Origin {
    /// The folder to which relative file names in the scene refer; empty for the current folder.
    pub folder: PathBuf,
    pub(crate) document: Option<Arc<Document>>,
}

impl PartialEq for Origin {
    /// Returns true: the source of a scene is not part of its content.
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

/// A scene file as it was read. Byte positions beyond the file's text are positions in the values of the overrides,
/// which follow each other.
#[derive(Clone, Debug)]
pub(crate) struct Document {
    name: Option<String>,
    text: String,
    overrides: Vec<Override>,
}

/// The maximum number of tables of one kind in a scene.
const MOST_TABLES: usize = 100_000;

impl Document {
    pub fn new(name: Option<String>, text: String) -> Self {
        Self { name, text, overrides: vec![] }
    }

    /// Returns the document with one more changed value.
    pub fn with(&self, change: Override) -> Self {
        let mut document = self.clone();
        document.overrides.push(change);
        document
    }

    /// Returns the tree of values, with the overrides applied.
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
        if let Some((key, surplus)) = tree.get_ref().iter().find_map(surplus) {
            let out = Error::new(Kind::Count, format!("there are more than {MOST_TABLES} tables `[[{key}]]`"));
            let hint = "say many agents of one kind by the `count` of a group, and much ground by `walkable.file`";
            return Err(self.place(out.hint(hint), surplus));
        }
        T::deserialize(Value::from(tree)).map_err(|misread| {
            let mut out = serde_message::explain(&misread.message);
            let span = misread.span.unwrap_or(0..0);
            if let (None, true, Ok(tree)) = (&out.hint, is_of_value(out.kind), self.tree()) {
                let path = holding(&DeValue::Table(tree.into_inner()), span.start, &Path::default());
                out.hint = path.and_then(|path| about(&path)).map(Into::into);
            }
            self.place(out, span)
        })
    }

    /// Returns the number at a path, as for `--set`; `None` if the document leaves it out. A path into all groups needs a
    /// number in each; the first counts.
    pub fn number(&self, path: &str) -> Result<Option<f64>, Error> {
        let mut tree = self.tree()?;
        let (tables, keys) = set::places(tree.get_mut(), path)?;
        let number = |value: &DeValue<'_>| {
            f64::deserialize(Value(Spanned::new(0..0, value.clone()))).map_err(|misread| {
                let found = serde_message::explain(&misread.message);
                Error::new(Kind::WrongType, format!("`{path}` is no number: {}", found.message))
                    .hint("write the path of a number as for --set: group.walkers.body.radius")
            })
        };
        let values = tables.iter().map(|table| set::value_at(table, &keys).map(number).transpose());
        let numbers: Vec<Option<f64>> = values.collect::<Result<_, _>>()?;
        Ok(numbers.into_iter().collect::<Option<Vec<f64>>>().and_then(|numbers| numbers.first().copied()))
    }

    /// Turns a problem with a value into an error with the value's position.
    pub fn explain(&self, problem: Problem) -> Error {
        let mut error = Error::new(problem.kind, problem.message);
        let hint = || about(&problem.path).filter(|_| is_of_value(problem.kind)).map(Into::into);
        error.hint = problem.hint.or_else(hint);
        match self.tree() {
            Ok(tree) => self.place(error, locate(&tree, &problem.path, problem.is_key)),
            Err(_) => error,
        }
    }

    /// Adds file, line and column to an error about the bytes `span`.
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

/// Whether a mistake is a value of the wrong type or out of range.
fn is_of_value(kind: Kind) -> bool {
    matches!(kind, Kind::WrongType | Kind::OutOfRange)
}

/// Returns the path to the innermost value that contains the byte `at` of the text, below the value at `path`.
fn holding(value: &DeValue<'_>, at: usize, path: &Path) -> Option<Path> {
    let within = |value: &Spanned<DeValue<'_>>, path: Path| {
        holding(value.get_ref(), at, &path).or_else(|| value.span().contains(&at).then_some(path))
    };
    match value {
        DeValue::Table(items) => items.iter().find_map(|(key, value)| within(value, path.name(key.get_ref()))),
        DeValue::Array(items) => items.iter().enumerate().find_map(|(k, value)| within(value, path.index(k))),
        _ => None,
    }
}

/// Returns the key of a list that is too long, and the position of its first surplus table.
fn surplus<'a>((key, value): (&'a Spanned<Cow<'_, str>>, &Spanned<DeValue<'_>>)) -> Option<(&'a str, Range<usize>)> {
    let surplus = <[_]>::get(value.get_ref().as_array()?, MOST_TABLES)?;
    Some((key.get_ref(), surplus.span()))
}

/// Returns the bytes of the value at a path, or of the nearest enclosing value in the file; or those of its key.
fn locate(tree: &Spanned<DeTable<'_>>, path: &Path, is_key: bool) -> Range<usize> {
    let mut span = 0..0;
    let mut table = Some(tree.get_ref());
    let mut array = None;
    for (k, step) in path.steps.iter().enumerate() {
        if let (true, TomlStep::Key(key), Some(items)) = (is_key && k + 1 == path.steps.len(), step, table)
            && let Some((found, _)) = items.iter().find(|(found, _)| found.get_ref() == key)
            && !found.span().is_empty()
        {
            return found.span();
        }
        let value = match (step, table, array) {
            (TomlStep::Key(key), Some(items), _) => items.get(key.as_str()),
            (TomlStep::Index(index), _, Some(items)) => <[Spanned<DeValue>]>::get(items, *index),
            // A file may have a single source where the path has a list, and a list where the path has a table with
            // that list.
            (TomlStep::Index(0), Some(_), _) => continue,
            (TomlStep::Key(key), _, Some(_)) if key == "of" => continue,
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
    // The table of a dotted key (`place.ring = ..`) has no position in the text: its only value has.
    while let (Some(TomlStep::Key(_)), Some(items)) = (path.steps.last(), table) {
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
