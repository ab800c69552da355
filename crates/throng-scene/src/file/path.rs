//! Paths to values, and problems at them.

use crate::error::Kind;
use std::fmt;

/// The path to a value of a scene: `group`, `0`, `body`, `radius`.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Path {
    pub steps: Vec<TomlStep>,
}

/// One step of a path to a value of a TOML file.
#[derive(Clone, Debug, PartialEq)]
pub enum TomlStep {
    /// The key of a table.
    Key(String),
    /// The position in a list, from 0.
    Index(usize),
}

impl From<&str> for TomlStep {
    fn from(key: &str) -> Self {
        Self::Key(key.to_owned())
    }
}

impl From<usize> for TomlStep {
    fn from(index: usize) -> Self {
        Self::Index(index)
    }
}

impl Path {
    pub fn of(key: &str) -> Self {
        Self::default().key(key)
    }

    /// Returns the path extended by keys; dots separate keys.
    pub fn key(&self, keys: &str) -> Self {
        let mut path = self.clone();
        path.steps.extend(keys.split('.').map(|key| TomlStep::Key(key.to_owned())));
        path
    }

    /// Returns the path extended by one key, which may contain dots.
    pub fn name(&self, key: &str) -> Self {
        let mut path = self.clone();
        path.steps.push(TomlStep::Key(key.to_owned()));
        path
    }

    /// Returns the path extended by a position in a list.
    pub fn index(&self, index: usize) -> Self {
        let mut path = self.clone();
        path.steps.push(TomlStep::Index(index));
        path
    }

    /// Returns the path extended by the steps of another path.
    pub fn join(&self, below: &Self) -> Self {
        Self { steps: self.steps.iter().chain(&below.steps).cloned().collect() }
    }

    /// Returns the path with dots between all its steps, as it is in `--set`.
    pub fn dotted(&self) -> String {
        let steps = self.steps.iter().map(|step| match step {
            TomlStep::Key(key) => key.clone(),
            TomlStep::Index(index) => index.to_string(),
        });
        steps.collect::<Vec<_>>().join(".")
    }

    /// Returns the name of the value in messages: its path below the group, obstacle or table.
    pub fn below_list(&self) -> String {
        let text = self.to_string();
        match text.split_once("].") {
            Some((head, rest))
                if ["group[", "obstacle[", "mover[", "surface[", "path[", "field["]
                    .iter()
                    .any(|list| head.starts_with(list)) =>
            {
                rest.to_owned()
            }
            _ => text,
        }
    }
}

impl fmt::Display for Path {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        for (i, step) in self.steps.iter().enumerate() {
            match step {
                TomlStep::Key(key) if i == 0 => write!(f, "{key}")?,
                TomlStep::Key(key) => write!(f, ".{key}")?,
                TomlStep::Index(index) => write!(f, "[{index}]")?,
            }
        }
        Ok(())
    }
}

/// A problem with the value at a path.
#[derive(Clone, Debug)]
pub(crate) struct Problem {
    pub path: Path,
    /// Whether the problem is the last key of the path, not its value.
    pub is_key: bool,
    pub kind: Kind,
    pub message: String,
    pub hint: Option<Box<str>>,
}

impl Problem {
    pub fn new(path: &Path, kind: Kind, message: impl Into<String>) -> Self {
        Self { path: path.clone(), is_key: false, kind, message: message.into(), hint: None }
    }

    /// Returns the problem of a name that does not exist. Its hint is the names that exist, or `if_none`.
    pub fn no_such(path: &Path, what: &str, name: &str, known: &[&str], if_none: impl FnOnce() -> String) -> Self {
        let hint = if known.is_empty() { if_none() } else { format!("there is: {}", known.join(", ")) };
        Self::new(path, Kind::UnknownKey, format!("there is no {what} `{name}`")).hint(hint)
    }

    pub fn hint(mut self, hint: impl Into<Box<str>>) -> Self {
        self.hint = Some(hint.into());
        self
    }
}
