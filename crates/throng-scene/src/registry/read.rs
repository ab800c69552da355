//! Reads the given parameters of a choice as the type that declares them.

use crate::assemble::name;
use crate::error::{Error, Kind};
use crate::file::{Path, Problem, explain, unknown_key};
use throng::parameters::Declared;
use toml::Table;

/// Why a choice was not made.
pub(crate) enum Unmade {
    /// There is no such parameter: its key, and the keys that exist.
    Unknown(String, Vec<String>),
    /// A parameter cannot be read.
    Misread(toml::de::Error),
    /// The type refused its parameters or the scene.
    Refused(throng::Error),
    /// The code panicked with this message.
    Panicked(String),
}

/// Reads parameters. All of them are within their limits. The choice has the keys `more` besides, which are not in
/// `given` any more.
pub(super) fn read<P: Declared>(given: Table, more: &[&str]) -> Result<P, Unmade> {
    let known = || P::PARAMETERS.iter().map(|parameter| parameter.name);
    if let Some(key) = given.keys().find(|key| !known().any(|name| name == *key)) {
        return Err(Unmade::Unknown(key.clone(), known().chain(more.iter().copied()).map(str::to_owned).collect()));
    }
    let parameters: P = given.try_into().map_err(Unmade::Misread)?;
    parameters.check_limits().map_err(Unmade::Refused)?;
    Ok(parameters)
}

impl Unmade {
    /// Returns the problem of a choice at the path `at` with its parameters at `inside`. `what` is the kind and the name
    /// of the choice, for messages about plug-ins.
    pub(crate) fn at(self, at: &Path, inside: &Path, what: &str) -> Problem {
        match self {
            Self::Unknown(key, known) => placed(unknown_key(&key, &known), &inside.name(&key)),
            Self::Misread(error) => {
                let shown = error.to_string();
                let keys = shown.split_once("\nin `").and_then(|(_, rest)| rest.split_once('`'));
                let at = keys.map_or_else(|| inside.clone(), |(keys, _)| inside.key(keys));
                placed(explain(error.message()), &at)
            }
            Self::Refused(throng::Error::Limit { what, value, limit }) => {
                let at = inside.key(&what.replace(' ', "_"));
                let message = format!("{} is {value}, but must be {limit}", name(&at));
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
