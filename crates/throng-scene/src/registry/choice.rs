//! What a scene chooses by name from the registry, with the values that it gives.

use super::given::FileGiven;
use crate::error::{Error, Kind};
use crate::file::Path;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::de::{self, DeserializeOwned, Deserializer, MapAccess};
use serde::ser::{SerializeMap, Serializer};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;
use throng::parameters::{Parameters, Written};
use toml::{Table, Value};

/// A part of the registry that scenes choose from.
pub trait Catalogue {
    /// The name of the choice in the JSON schema.
    const NAME: &'static str;
    /// An example of a choice, for messages.
    const EXAMPLE: &'static str;

    /// Returns the schema of all choices that throng itself has.
    fn schema(generator: &mut SchemaGenerator) -> Schema;
}

/// What a scene says of a choice of throng, and the name of the choice.
pub trait Described: Serialize + DeserializeOwned {
    /// The name of the choice.
    const NAME: &'static str;
}

/// A choice by name, with the given parameters. The parameters that it leaves out have their defaults. In files `NAME =
/// { its parameters }`.
///
/// ```
/// use throng::avoid::Orca;
/// use throng_scene::Avoid;
///
/// let in_code = Avoid::of(&Orca { time_horizon: 2.0, ..Orca::default() }).with("neighbours", 20);
/// let in_a_file: Avoid = toml::from_str("orca = { time_horizon = 2, neighbours = 20 }")?;
/// assert_eq!(in_code, in_a_file);
/// # Ok::<(), toml::de::Error>(())
/// ```
pub struct Choice<C> {
    /// The name.
    pub name: String,
    /// The given parameters: a table, or what a combination of behaviours writes instead, such as a list of its parts.
    pub parameters: Value,
    catalogue: PhantomData<fn() -> C>,
}

impl<C> Choice<C> {
    /// Returns the choice with this name, without parameters.
    pub fn named(name: impl Into<String>) -> Self {
        Self::new(name.into(), Value::Table(Table::new()))
    }

    /// Returns the choice with this name of several parts, in files `NAME = [ .. ]`: a combination of behaviours.
    ///
    /// ```
    /// use throng_scene::Steer;
    /// let in_code = Steer::combining("priority", [Steer::named("flee").with("target", "goal"), Steer::named("wander")]);
    /// let in_a_file: Steer = toml::from_str("priority = [{ flee.target = \"goal\" }, { wander = {} }]")?;
    /// assert_eq!(in_code, in_a_file);
    /// # Ok::<(), toml::de::Error>(())
    /// ```
    pub fn combining(name: impl Into<String>, parts: impl IntoIterator<Item = Self>) -> Self {
        Self::new(name.into(), Value::Array(parts.into_iter().map(Value::from).collect()))
    }

    /// Returns the choice of a type, with the parameters that differ from their defaults. Parameters that name a part of
    /// the scene are left out: add them by [`with`](Self::with).
    pub fn of<P: Parameters + Default>(chosen: &P) -> Self {
        Self::new(P::NAME.to_owned(), differing(chosen))
    }

    /// Returns the choice with one more parameter, or another value of it. It has no effect on a list.
    pub fn with(mut self, key: impl Into<String>, value: impl Into<Value>) -> Self {
        insert(&mut self.parameters, key, value);
        self
    }

    /// Returns the choice with this description, without the values that are defaults.
    ///
    /// ```
    /// use throng_scene::{Place, Ring};
    /// let in_code = Place::described(&Ring { radius: 7.0, ..Ring::default() });
    /// let in_a_file: Place = toml::from_str("ring = { radius = 7 }")?;
    /// assert_eq!(in_code, in_a_file);
    /// # Ok::<(), toml::de::Error>(())
    /// ```
    pub fn described<D: Described>(description: &D) -> Self {
        Self::new(D::NAME.to_owned(), without_defaults::<D>(written(description)))
    }

    /// Returns the description of this choice as a `D`; `None` for another choice, and for parameters that a `D` does not
    /// have.
    ///
    /// ```
    /// use throng_scene::Flow;
    /// use throng_scene::flow::{Named, Picture};
    /// let flow: Flow = toml::from_str("picture = { file = \"map.png\", min = [0, 0], max = [9, 9], speed = 3 }")?;
    /// assert_eq!(flow.read::<Picture>().and_then(|picture| picture.speed), Some(3.0));
    /// assert_eq!(flow.read::<Named>(), None);
    /// # Ok::<(), toml::de::Error>(())
    /// ```
    pub fn read<D: Described>(&self) -> Option<D> {
        (self.name == D::NAME).then(|| self.parameters.clone().try_into().ok()).flatten()
    }

    /// Returns the parameters as a `P`. They name no part of a scene.
    ///
    /// # Errors
    /// It is another choice, a `P` does not have these parameters, or a value is outside its limit.
    ///
    /// ```
    /// use throng::avoid::Orca;
    /// use throng_scene::Avoid;
    /// let avoid: Avoid = toml::from_str("orca = { time_horizon = 2 }")?;
    /// assert_eq!(avoid.parameters_as::<Orca>().map(|orca| orca.time_horizon), Ok(2.0));
    /// # Ok::<(), toml::de::Error>(())
    /// ```
    pub fn parameters_as<P: Parameters>(&self) -> Result<P, Error> {
        if self.name != P::NAME {
            let message = format!("this is `{}`, not `{}`", self.name, P::NAME);
            return Err(Error::new(Kind::UnknownKey, message));
        }
        let read = FileGiven::new(&self.parameters, &Path::of(P::NAME)).parameters();
        read.map_err(|problem| Error { hint: problem.hint, ..Error::new(problem.kind, problem.message) })
    }

    pub(crate) fn new(name: String, parameters: Value) -> Self {
        Self { name, parameters, catalogue: PhantomData }
    }
}

/// Registers descriptions of choices: each with what it is as the doc comment, and its name in files.
macro_rules! described {
    ($choice:ident in $catalogue:ident: $($(#[doc = $about:literal])+ $described:ident = $name:literal,)*) => {
        $(
            impl $crate::registry::Described for $described {
                const NAME: &'static str = $name;
            }

            impl From<$described> for $choice {
                fn from(described: $described) -> Self {
                    Self::described(&described)
                }
            }
        )*

        /// Adds the choices of throng to a registry.
        pub(crate) fn register(catalogue: &mut $catalogue) {
            $(catalogue.add_own::<$described>(concat!($($about),+).trim());)*
        }
    };
}
pub(crate) use described;

/// Gives descriptions that hold one value the schema of this value.
macro_rules! schema_of_value {
    ($($described:ident: $value:ty,)*) => { $(
        impl schemars::JsonSchema for $described {
            fn inline_schema() -> bool {
                true
            }

            fn schema_name() -> std::borrow::Cow<'static, str> {
                stringify!($described).into()
            }

            fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
                generator.subschema_for::<$value>()
            }
        }
    )* };
}
pub(crate) use schema_of_value;

/// Returns what files write. What they cannot write, such as a whole number that is too large, becomes a text that says
/// so: the choice is then refused with this text.
fn written(description: &impl Serialize) -> Value {
    Value::try_from(description).unwrap_or_else(|error| Value::String(format!("cannot be written: {error}")))
}

/// Returns what files write of a `D` without the values of keys that mean the same if they are left out.
fn without_defaults<D: Described>(all: Value) -> Value {
    let Value::Table(table) = &all else { return all };
    let is_default = |key: &String| {
        let mut less = table.clone();
        less.remove(key);
        let read: Result<D, _> = Value::Table(less).try_into();
        read.is_ok_and(|read| written(&read) == all)
    };
    let given = table.iter().filter(|(key, _)| !is_default(key));
    Value::Table(given.map(|(key, value)| (key.clone(), value.clone())).collect())
}

/// Returns parameters as files write them.
pub(super) fn table_of(parameters: &impl Parameters) -> Table {
    match parameters.write().map(value_of) {
        Some(Value::Table(table)) => table,
        _ => Table::new(),
    }
}

/// Returns the table of the parameters that differ from their defaults.
pub(super) fn differing<P: Parameters + Default>(parameters: &P) -> Value {
    let (usual, mut given) = (table_of(&P::default()), table_of(parameters));
    given.retain(|key, value| usual.get(key) != Some(value));
    Value::Table(given)
}

/// Adds a parameter to a table, or gives it another value.
pub(super) fn insert(parameters: &mut Value, key: impl Into<String>, value: impl Into<Value>) {
    if let Value::Table(table) = parameters {
        table.insert(key.into(), value.into());
    }
}

/// Returns a value as files write it.
fn value_of(written: Written) -> Value {
    match written {
        Written::Number(number) => number.into(),
        // a greater number is not a default, and is refused when it is read
        Written::Whole(number) => i64::try_from(number).unwrap_or(i64::MAX).into(),
        Written::Flag(flag) => flag.into(),
        Written::Text(text) => text.into_owned().into(),
        Written::List(items) => Value::Array(items.into_iter().map(value_of).collect()),
        Written::Table(entries) => {
            Value::Table(entries.into_iter().map(|(key, value)| (key.into_owned(), value_of(value))).collect())
        }
    }
}

/// Whether two values are the same: 2 is 2.0.
pub(super) fn is_same(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Integer(a), Value::Float(b)) | (Value::Float(b), Value::Integer(a)) => *a as f64 == *b,
        (Value::Array(a), Value::Array(b)) => a.len() == b.len() && a.iter().zip(b).all(|(a, b)| is_same(a, b)),
        (Value::Table(a), Value::Table(b)) => is_same_table(a, b),
        (a, b) => a == b,
    }
}

fn is_same_table(a: &Table, b: &Table) -> bool {
    a.len() == b.len() && a.iter().all(|(key, a)| b.get(key).is_some_and(|b| is_same(a, b)))
}

/// A choice as the value of a parameter: `{ NAME = its parameters }`.
impl<C> From<Choice<C>> for Value {
    fn from(Choice { name, parameters, .. }: Choice<C>) -> Self {
        Self::Table(Table::from_iter([(name, parameters)]))
    }
}

impl<C> Clone for Choice<C> {
    fn clone(&self) -> Self {
        Self::new(self.name.clone(), self.parameters.clone())
    }
}

impl<C> fmt::Debug for Choice<C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_map().entry(&self.name, &self.parameters).finish()
    }
}

impl<C> PartialEq for Choice<C> {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name && is_same(&self.parameters, &other.parameters)
    }
}

impl<C> Serialize for Choice<C> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(1))?;
        map.serialize_entry(&self.name, &self.parameters)?;
        map.end()
    }
}

impl<'de, C: Catalogue> Deserialize<'de> for Choice<C> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visitor<C>(PhantomData<C>);
        impl<'de, C: Catalogue> de::Visitor<'de> for Visitor<C> {
            type Value = Choice<C>;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                write!(f, "a choice, as in `{}`", C::EXAMPLE)
            }
            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Choice<C>, A::Error> {
                let found = map.next_entry()?;
                match (found, map.next_key::<String>()?) {
                    (Some((name, parameters)), None) => Ok(Choice::new(name, parameters)),
                    (None, _) => Err(de::Error::custom("wanted exactly 1 element")),
                    (Some(_), Some(_)) => Err(de::Error::custom("wanted exactly 1 element, more than 1 element")),
                }
            }
        }
        deserializer.deserialize_map(Visitor(PhantomData))
    }
}

impl<C: Catalogue> JsonSchema for Choice<C> {
    fn schema_name() -> Cow<'static, str> {
        C::NAME.into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        C::schema(generator)
    }
}
