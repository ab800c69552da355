//! Errors in a scene, with how to fix each.

use std::borrow::Cow;
use std::fmt;

/// An error in a scene: where it is, what it is, and how to fix it.
#[derive(Clone, Debug, PartialEq)]
pub struct Error {
    /// The kind of mistake.
    pub kind: Kind,
    /// What is wrong, in one line.
    pub message: String,
    /// The file (or `--set key=value`) that has the mistake, if known.
    pub file: Option<Box<str>>,
    /// Line and column, if known. Both count from 1; columns count characters.
    pub at: Option<(usize, usize)>,
    /// The offending line, and the number of its characters, from the column on, that are at fault.
    pub line: Option<(String, usize)>,
    /// How to fix it.
    pub hint: Option<Box<str>>,
}

/// Kinds of mistakes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Kind {
    /// Not TOML, WKT, OBJ, JSON or zip.
    Syntax,
    /// A key or a choice that does not exist.
    UnknownKey,
    /// A required key that is missing.
    MissingKey,
    /// A value of the wrong type, such as a text in place of a number.
    WrongType,
    /// A number outside its limits.
    OutOfRange,
    /// A file that does not exist or cannot be read.
    File,
    /// A polygon that crosses itself or has too few corners.
    Geometry,
    /// Two agents at the same place.
    Overlap,
    /// An agent in a wall or off the walkable ground.
    InWall,
    /// A goal at which no agent can stand.
    GoalInWall,
    /// Not all agents fit.
    NoRoom,
    /// No agents, or too many.
    Count,
    /// Values that contradict each other.
    Conflict,
    /// No such scene in the gallery.
    UnknownScene,
    /// A kind of file that is not a scene.
    NotAScene,
    /// The world rejected a value.
    World,
    /// Code of a plug-in panicked.
    Panic,
}

impl Error {
    /// Returns an error without a place.
    pub(crate) fn new(kind: Kind, message: impl Into<String>) -> Self {
        Self { kind, message: message.into(), file: None, at: None, line: None, hint: None }
    }

    pub(crate) fn hint(mut self, hint: impl Into<Box<str>>) -> Self {
        self.hint = Some(hint.into());
        self
    }

    pub(crate) fn message(mut self, message: impl Into<String>) -> Self {
        self.message = message.into();
        self
    }

    pub(crate) fn file(mut self, file: impl Into<Box<str>>) -> Self {
        self.file = Some(file.into());
        self
    }

    /// Adds the place: the bytes `span` of `text`.
    pub(crate) fn place(mut self, text: &str, span: std::ops::Range<usize>) -> Self {
        let mut start = span.start.min(text.len());
        while !text.is_char_boundary(start) {
            start -= 1;
        }
        let line_start = text[..start].rfind('\n').map_or(0, |i| i + 1);
        let line = text[line_start..].split('\n').next().unwrap_or_default().trim_end_matches('\r');
        let line_end = line_start + line.len();
        let mut end = span.end.clamp(start, line_end.max(start));
        while !text.is_char_boundary(end) {
            end -= 1;
        }
        self.at = Some((text[..start].matches('\n').count() + 1, text[line_start..start].chars().count() + 1));
        self.line = Some((line.to_owned(), text[start..end].chars().count().max(1)));
        self
    }
}

impl std::error::Error for Error {}

impl fmt::Display for Error {
    /// Writes `file:line:column: message`, the line with the offending part underlined, and the hint.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        if let Some(file) = &self.file {
            write!(f, "{}:", abridged(file))?;
            if let Some((line, column)) = self.at {
                write!(f, "{line}:{column}:")?;
            }
            write!(f, " ")?;
        }
        f.write_str(&abridged(&self.message))?;
        if let (Some((line, column)), Some((text, length))) = (self.at, &self.line) {
            let gutter = line.to_string();
            // A line may hold a whole polygon: show the part around the place.
            let skip = if column > 80 { column - 40 } else { 0 };
            let shown: String = text.chars().skip(skip).take(110).collect();
            let shown = shown.replace('\t', " ");
            let dots = if skip > 0 { "…" } else { "" };
            let marks = (*length).min(shown.chars().count().saturating_sub(column - 1 - skip)).max(1);
            write!(f, "\n  {gutter} | {dots}{shown}")?;
            let indent = column - 1 - skip + dots.chars().count();
            write!(f, "\n  {:gutter$} | {:indent$}{}", "", "", "^".repeat(marks), gutter = gutter.len())?;
        }
        if let Some(hint) = &self.hint {
            write!(f, "\n  hint: {}", at_most(hint, LONGEST_HINT))?;
        }
        Ok(())
    }
}

/// The maximum number of characters of a message or a file name.
const LONGEST: usize = 800;
/// The maximum number of characters of a hint. A hint may list names that can be used, such as all scenes of the
/// gallery.
const LONGEST_HINT: usize = 2000;
/// The number of characters kept from the end of a longer text.
const END: usize = 200;

/// Returns a text for a message, without its middle if it is longer than 800 characters: values in a file may have any
/// length.
///
/// ```
/// let long = format!("`{}` is no number", "x".repeat(100_000));
/// let short = throng_scene::abridged(&long);
/// assert_eq!(short.chars().count(), 800);
/// assert!(short.starts_with("`xxx") && short.contains('…') && short.ends_with("x` is no number"));
/// ```
pub fn abridged(text: &str) -> Cow<'_, str> {
    at_most(text, LONGEST)
}

/// Returns a text, without its middle if it is longer than `longest` characters.
fn at_most(text: &str, longest: usize) -> Cow<'_, str> {
    let place = |count: usize| text.char_indices().nth(count).map(|(at, _)| at);
    // most texts are short and need no count
    if text.len() <= longest || place(longest).is_none() {
        return text.into();
    }
    let start = place(longest - END - 1).unwrap_or(text.len());
    let end = text.char_indices().rev().nth(END - 1).map_or(0, |(at, _)| at);
    format!("{}…{}", &text[..start], &text[end..]).into()
}
