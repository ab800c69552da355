//! Reads the given parameters of a choice as the type that declares them.

use crate::error::{Error, Kind};
use crate::file::{FileValue, Path, Problem, explain, unknown_key, unknown_variant};
use serde::de::DeserializeOwned;
use serde_path_to_error::Segment;
use throng::parameters::Declared;
use toml::de::DeTable;
use toml::{Table, Value};

/// Why a choice was not made.
pub(crate) enum Unmade {
    /// There is no such choice: its name, and the names that exist.
    NoChoice(String, Vec<String>),
    /// There is no such parameter: its key, and the keys that exist.
    NoKey(String, Vec<String>),
    /// A parameter cannot be read: the path to it, and the message.
    Misread(Path, String),
    /// The type refused its parameters or the scene.
    Refused(throng::Error),
    /// The code panicked with this message.
    Panicked(String),
}

/// Reads parameters. All of them are within their limits. The choice has the keys `more` besides, which are not in
/// `given` any more.
pub(super) fn read<P: Declared>(given: &Value, more: &[&str]) -> Result<P, Unmade> {
    let known = || P::PARAMETERS.iter().map(|parameter| parameter.name);
    if let Some(key) = given.as_table().and_then(|table| table.keys().find(|key| !known().any(|name| name == *key))) {
        return Err(Unmade::NoKey(key.clone(), known().chain(more.iter().copied()).map(str::to_owned).collect()));
    }
    let parameters: P = read_value(given)?;
    parameters.check_limits().map_err(Unmade::Refused)?;
    Ok(parameters)
}

/// Reads a value.
pub(super) fn read_value<T: DeserializeOwned>(given: &Value) -> Result<T, Unmade> {
    given.clone().try_into().map_err(|error| misread::<T>(given, &error))
}

/// Returns the place and the message of an error, as the reader of files states them: it knows more than `error`.
fn misread<T: DeserializeOwned>(given: &Value, error: &toml::de::Error) -> Unmade {
    let text = Table::from_iter([("value".to_owned(), given.clone())]).to_string();
    let value = DeTable::parse(&text).ok().and_then(|tree| tree.into_inner().remove("value"));
    match value.map(|value| serde_path_to_error::deserialize::<_, T>(FileValue(value))) {
        Some(Err(error)) => {
            let below = |path: Path, segment: &Segment| match segment {
                Segment::Seq { index } => path.index(*index),
                Segment::Map { key } | Segment::Enum { variant: key } => path.name(key),
                Segment::Unknown => path,
            };
            Unmade::Misread(error.path().iter().fold(Path::default(), below), error.inner().message.clone())
        }
        _ => Unmade::Misread(Path::default(), error.message().to_owned()),
    }
}

impl Unmade {
    /// Returns the problem of a choice at the path `at` with its parameters at `inside`. `what` is the kind and the name
    /// of the choice, for messages about plug-ins.
    pub(crate) fn at(self, at: &Path, inside: &Path, what: &str) -> Problem {
        match self {
            Self::NoChoice(name, known) => Problem { is_key: true, ..placed(unknown_variant(&name, &known), inside) },
            Self::NoKey(key, known) => {
                Problem { is_key: true, ..placed(unknown_key(&key, &known), &inside.name(&key)) }
            }
            Self::Misread(path, message) => placed(explain(&message), &inside.join(&path)),
            Self::Refused(throng::Error::Limit { what, value, limit }) => {
                let at = inside.key(&what.replace(' ', "_"));
                let message = format!("{} is {value}, but must be {limit}", at.below_list());
                Problem::new(&at, Kind::OutOfRange, message)
            }
            Self::Refused(error) => Problem::new(at, Kind::World, format!("{what}: {error}")),
            Self::Panicked(says) => Problem::new(at, Kind::Panic, format!("a plug-in panicked: {what}: {says}")),
        }
    }
}

/// Converts an error to a problem at a path.
fn placed(error: Error, at: &Path) -> Problem {
    let mut problem = Problem::new(at, error.kind, error.message);
    problem.hint = error.hint;
    problem
}
