//! What can be wrong with a scene, said so that it can be mended.

use std::fmt;

/// What can be wrong with a scene: where, what, and how to mend it.
#[derive(Clone, Debug, PartialEq)]
pub struct Error {
    /// What kind of mistake.
    pub kind: Kind,
    /// What is wrong, one line.
    pub message: String,
    /// The file (or `--set key=value`) it is in, where known.
    pub file: Option<Box<str>>,
    /// Line and column, both from 1, columns in characters, where known.
    pub at: Option<(usize, usize)>,
    /// The offending line, and how many of its characters from the column on are meant.
    pub line: Option<(String, usize)>,
    /// How to mend it.
    pub hint: Option<Box<str>>,
}

/// Kinds of mistakes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Kind {
    /// Not TOML, WKT, OBJ, JSON or zip.
    Syntax,
    /// A key, or a choice, that does not exist.
    UnknownKey,
    /// A key that must be there is not.
    MissingKey,
    /// A text where a number should be, and the like.
    WrongType,
    /// A number outside its limits.
    OutOfRange,
    /// A file that is not there or cannot be read.
    File,
    /// A polygon that crosses itself or has too few corners.
    Geometry,
    /// Two agents at one place.
    Overlap,
    /// An agent in a wall or off the walkable ground.
    InWall,
    /// A goal nobody can stand at.
    GoalInWall,
    /// Not all agents fit.
    NoRoom,
    /// No agents, or too many.
    Count,
    /// Things that do not go together.
    Conflict,
    /// No such scene in the gallery.
    UnknownScene,
    /// A kind of file that is not a scene.
    NotAScene,
    /// The world refused something.
    World,
    /// Code that a program brought along panicked.
    Panic,
}

impl Error {
    /// An error without a place.
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

    /// Adds the place: bytes `span` of `text`.
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
    /// `file:line:column: message`, the line with what is meant underlined, and the hint.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        if let Some(file) = &self.file {
            write!(f, "{file}:")?;
            if let Some((line, column)) = self.at {
                write!(f, "{line}:{column}:")?;
            }
            write!(f, " ")?;
        }
        f.write_str(&self.message)?;
        if let (Some((line, column)), Some((text, length))) = (self.at, &self.line) {
            let gutter = line.to_string();
            // A line may be a whole polygon: show the part round the place.
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
            write!(f, "\n  hint: {hint}")?;
        }
        Ok(())
    }
}
