//! What a scene file gives for the parameters of a choice.

use super::names::Names;
use super::{Flow, Steer};
use crate::caught::caught;
use crate::error::{Error, Kind};
use crate::file::{FileValue, Path, Problem, explain, unknown_key, unknown_variant};
use crate::scene::Point;
use crate::scene::flow::Map;
use crate::scene::steer::{GroupFilter, ObstacleNames, Position, Target};
use glam::{Vec2, Vec3};
use serde::de::DeserializeOwned;
use serde_path_to_error::Segment;
use std::borrow::Cow;
use std::sync::Arc;
use throng::field::{FactorMap, Field};
use throng::parameters::{self, Given, Parameter, Parameters};
use throng::space::Pathway;
use throng::space::surface::{Barrier, Surface};
use throng::steer::{self, Barriers, BoxedBehaviour};
use toml::de::DeTable;
use toml::{Table, Value};

/// A value of a scene file, with the path to it.
#[derive(Clone)]
pub(super) struct FileGiven<'a> {
    value: Cow<'a, Value>,
    at: Path,
    /// What names stand for, where the scene is known.
    names: Option<&'a dyn Names>,
    /// Keys that the table has besides its parameters, which others read.
    more: &'a [&'a str],
    checks_limits: bool,
}

impl<'a> FileGiven<'a> {
    pub fn new(value: &'a Value, at: &Path) -> Self {
        Self { value: Cow::Borrowed(value), at: at.clone(), names: None, more: &[], checks_limits: true }
    }

    /// Returns it with what names stand for.
    pub fn with_names(self, names: &'a dyn Names) -> Self {
        Self { names: Some(names), ..self }
    }

    /// Returns it with keys that the table may have besides.
    pub fn with_keys(self, more: &'a [&'a str]) -> Self {
        Self { more, ..self }
    }

    /// Returns it with values outside their limits allowed.
    pub fn without_limits(self) -> Self {
        Self { checks_limits: false, ..self }
    }

    /// Reads the parameters of a choice.
    pub fn parameters<P: Parameters>(&self) -> Result<P, Problem> {
        P::read(self, None)
    }

    fn below(&self, value: &'a Value, at: Path) -> Self {
        Self { value: Cow::Borrowed(value), at, more: &[], ..self.clone() }
    }

    /// Reads a value that names nothing.
    pub fn plain<T: DeserializeOwned>(&self) -> Result<T, Problem> {
        read_value(&self.value, &self.at)
    }

    /// Reads what names something of the scene.
    fn named<T: DeserializeOwned, R>(
        &self,
        find: impl FnOnce(&dyn Names, T, &Path) -> Result<R, Problem>,
    ) -> Result<R, Problem> {
        let names = self.names.ok_or_else(|| {
            let message = "this names a part of the scene, which only behaviours can do";
            Problem::new(&self.at, Kind::Conflict, message)
        })?;
        find(names, self.plain()?, &self.at)
    }

    /// Returns the keys and values of a table.
    fn entries(&self) -> Result<&'a Table, Problem> {
        match &self.value {
            Cow::Borrowed(Value::Table(table)) => Ok(table),
            // what is not a table cannot be read as one
            _ => self.plain::<Table>().and(Err(Problem::new(&self.at, Kind::WrongType, "this is not a table"))),
        }
    }
}

impl Given for FileGiven<'_> {
    type Error = Problem;

    fn number(&self) -> Result<f64, Problem> {
        self.plain()
    }

    fn whole(&self, most: u64) -> Result<u64, Problem> {
        match u32::try_from(most) {
            Ok(_) => self.plain::<u32>().map(u64::from),
            Err(_) => self.plain(),
        }
    }

    fn flag(&self) -> Result<bool, Problem> {
        self.plain()
    }

    fn text(&self) -> Result<String, Problem> {
        self.plain()
    }

    fn name(&self, names: &parameters::Names) -> Result<usize, Problem> {
        let text: String = self.plain()?;
        names.names.iter().position(|known| known.name == text).ok_or_else(|| {
            let known: Vec<String> = names.names.iter().map(|known| known.name.to_owned()).collect();
            placed(unknown_variant(&text, &known), &self.at)
        })
    }

    fn one_of(&self, kind: &str, names: &[&str]) -> Result<usize, Problem> {
        let text: String = self.plain()?;
        names.iter().position(|known| *known == text).ok_or_else(|| {
            Problem::no_such(&self.at, kind, &text, names, || format!("there is none: add a {kind} with this name"))
        })
    }

    fn list(&self) -> Result<Vec<Self>, Problem> {
        match &self.value {
            Cow::Borrowed(Value::Array(items)) => {
                Ok(items.iter().enumerate().map(|(i, item)| self.below(item, self.at.index(i))).collect())
            }
            // what is not a list cannot be read as one
            _ => self.plain::<Vec<Value>>().and(Ok(vec![])),
        }
    }

    fn is_list(&self) -> bool {
        self.value.is_array()
    }

    fn table(&self, table: &parameters::Table) -> Result<(), Problem> {
        let known = || table.parameters.iter().map(|parameter| parameter.name).chain(self.more.iter().copied());
        match self.entries()?.keys().find(|key| !known().any(|name| name == *key)) {
            None => Ok(()),
            Some(key) => {
                let known: Vec<String> = known().map(str::to_owned).collect();
                Err(Problem { is_key: true, ..placed(unknown_key(key, &known), &self.at.name(key)) })
            }
        }
    }

    fn choice(&self, table: &parameters::Table) -> Result<(usize, Self), Problem> {
        let entries = self.entries()?;
        let (Some((name, value)), 1) = (entries.iter().next(), entries.len()) else {
            let more = if entries.is_empty() { "" } else { ", more than 1 element" };
            return Err(placed(explain(&format!("wanted exactly 1 element{more}")), &self.at));
        };
        let at = self.at.name(name);
        match table.parameters.iter().position(|known| known.name == name) {
            Some(position) => Ok((position, self.below(value, at))),
            None => {
                let known: Vec<String> = table.parameters.iter().map(|known| known.name.to_owned()).collect();
                Err(Problem { is_key: true, ..placed(unknown_variant(name, &known), &at) })
            }
        }
    }

    fn named(&self) -> Result<Vec<(String, Self)>, Problem> {
        let mut entries: Vec<_> = self.entries()?.iter().collect();
        entries.sort_by_key(|(name, _)| *name);
        Ok(entries.into_iter().map(|(name, value)| (name.clone(), self.below(value, self.at.name(name)))).collect())
    }

    fn get(&self, key: &str) -> Option<Self> {
        match &self.value {
            Cow::Borrowed(value) => value.get(key).map(|value| self.below(value, self.at.name(key))),
            Cow::Owned(_) => None,
        }
    }

    fn absent(&self, key: &str, text: &str) -> Self {
        let value = Cow::Owned(Value::String(text.to_owned()));
        Self { value, at: self.at.name(key), more: &[], ..self.clone() }
    }

    fn vector(&self) -> Result<Vec3, Problem> {
        let Position(vector) = self.plain()?;
        if let Some((i, x)) = vector.iter().enumerate().find(|(_, x)| !x.is_finite()) {
            let at = self.at.index(i);
            let message = format!("{} is {x}, but must be a finite number", at.below_list());
            return Err(Problem::new(&at, Kind::OutOfRange, message));
        }
        Ok(Vec3::from_array(vector.map(|x| x as f32)))
    }

    fn space_place(&self) -> Result<Vec3, Problem> {
        self.named(|names, place: Position, at| names.place(place, at))
    }

    fn ground_place(&self) -> Result<Vec2, Problem> {
        self.named(|names, place: Point, at| names.place(place.into(), at).map(Vec3::truncate))
    }

    fn target(&self) -> Result<steer::Target, Problem> {
        self.named(|names, target: Target, at| names.target(&target, at))
    }

    fn groups(&self) -> Result<steer::GroupFilter, Problem> {
        self.named(|names, groups: GroupFilter, at| names.groups(&groups, at))
    }

    fn obstacles(&self) -> Result<Barriers, Problem> {
        self.named(|names, obstacles: ObstacleNames, at| names.obstacles(&obstacles, at))
    }

    fn surface(&self) -> Result<Barrier<Arc<dyn Surface>>, Problem> {
        self.named(|names, name: String, at| names.surface(&name, at))
    }

    fn path(&self) -> Result<Arc<Pathway>, Problem> {
        self.named(|names, name: String, at| names.path(&name, at))
    }

    fn field(&self) -> Result<Arc<dyn Field>, Problem> {
        self.named(|names, flow: Flow, at| names.field(&flow, at))
    }

    fn map(&self) -> Result<Arc<dyn FactorMap>, Problem> {
        self.named(|names, map: Map, at| names.map(&map, at))
    }

    fn behaviour(&self) -> Result<BoxedBehaviour, Problem> {
        self.named(|names, steer: Steer, at| names.behaviour(&steer, at))
    }

    fn figure(&self) -> Result<usize, Problem> {
        self.named(|names, name: String, at| names.figure(&name, at))
    }

    fn check<V: parameters::Value>(&self, parameter: &Parameter, value: &V) -> Result<(), Problem> {
        match value.quantity() {
            Some(value) if self.checks_limits && !parameter.limit.holds(value) => {
                let message = format!("{} is {value}, but must be {}", self.at.below_list(), parameter.limit.words);
                Err(Problem::new(&self.at, Kind::OutOfRange, message))
            }
            _ => Ok(()),
        }
    }

    fn missing(&self, key: &str) -> Problem {
        placed(explain(&format!("missing field `{key}`")), &self.at)
    }

    fn refused(&self, error: throng::Error) -> Problem {
        refused(&self.at, &error)
    }
}

/// Reads a value at a path.
pub(super) fn read_value<T: DeserializeOwned>(given: &Value, at: &Path) -> Result<T, Problem> {
    given.clone().try_into().map_err(|error| misread::<T>(given, at, &error))
}

/// Returns the place and the message of an error, as the reader of files states them: it knows more than `error`.
fn misread<T: DeserializeOwned>(given: &Value, at: &Path, error: &toml::de::Error) -> Problem {
    let text = Table::from_iter([("value".to_owned(), given.clone())]).to_string();
    let value = DeTable::parse(&text).ok().and_then(|tree| tree.into_inner().remove("value"));
    match value.map(|value| serde_path_to_error::deserialize::<_, T>(FileValue(value))) {
        Some(Err(error)) => {
            let below = |path: Path, segment: &Segment| match segment {
                Segment::Seq { index } => path.index(*index),
                Segment::Map { key } | Segment::Enum { variant: key } => path.name(key),
                Segment::Unknown => path,
            };
            let message = &error.inner().message;
            let path = error.path().iter().fold(at.clone(), below);
            // the path to an unknown key ends with the key, that to an unknown choice before it
            let choice = message.strip_prefix("unknown variant `").and_then(|rest| rest.split_once('`'));
            let path = choice.map_or_else(|| path.clone(), |(choice, _)| path.name(choice));
            let problem = placed(explain(message), &path);
            Problem { is_key: problem.kind == Kind::UnknownKey, ..problem }
        }
        _ => placed(explain(error.message()), at),
    }
}

/// Converts an error to a problem at a path.
pub(super) fn placed(error: Error, at: &Path) -> Problem {
    let mut problem = Problem::new(at, error.kind, error.message);
    problem.hint = error.hint;
    problem
}

/// Converts an error of the library. Most of its names of parameters are the keys, and lead to them.
pub(crate) fn refused(at: &Path, error: &throng::Error) -> Problem {
    match error {
        throng::Error::Limit { what, value, limit } => {
            // the library computes in f32: further digits have no meaning
            let message = format!("{what} is {}, but must be {limit}", *value as f32);
            Problem::new(&at.key(&what.replace(' ', "_")), Kind::OutOfRange, message)
        }
        error => Problem::new(at, Kind::Geometry, error.to_string()),
    }
}

/// Why a choice is not made.
pub(super) enum Unmade {
    /// What the file gives cannot be read.
    Unread(Problem),
    /// It refused its parameters or the scene.
    Refused(throng::Error),
}

impl From<Problem> for Unmade {
    fn from(problem: Problem) -> Self {
        Self::Unread(problem)
    }
}

impl From<throng::Error> for Unmade {
    fn from(error: throng::Error) -> Self {
        Self::Refused(error)
    }
}

impl Unmade {
    /// Returns the problem of a choice at this path. `what` is its kind and name.
    pub fn at(self, at: &Path, what: &str) -> Problem {
        match self {
            Self::Unread(problem) => problem,
            Self::Refused(throng::Error::Limit { what, value, limit }) => {
                let at = at.key(&what.replace(' ', "_"));
                let message = format!("{} is {value}, but must be {limit}", at.below_list());
                Problem::new(&at, Kind::OutOfRange, message)
            }
            Self::Refused(error) => Problem::new(at, Kind::World, format!("{what}: {error}")),
        }
    }
}

/// Runs the code of a plug-in that makes its choice. `what` is the kind and name of the choice.
pub(super) fn made_by_plugin<T>(at: &Path, what: &str, make: impl FnOnce() -> Result<T, Unmade>) -> Result<T, Problem> {
    match caught(make) {
        Ok(made) => made.map_err(|unmade| unmade.at(at, what)),
        Err(says) => Err(Problem::new(at, Kind::Panic, format!("a plug-in panicked: {what}: {says}"))),
    }
}
