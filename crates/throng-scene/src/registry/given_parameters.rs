//! The parameters of a type of the engine that a scene gives.

use super::choice::{differing, insert, is_same};
use super::given::FileGiven;
use super::schema::{of_table, schema_of, type_name};
use crate::file::{Path, Problem};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;
use throng::parameters::Parameters;
use toml::{Table, Value};

/// The parameters of a `P` that a scene gives. Those that it leaves out have their defaults. In files a table.
///
/// ```
/// use throng::motion::Vehicle;
/// use throng_scene::GivenParameters;
///
/// let in_code = GivenParameters::of(&Vehicle { max_speed: 3.0, ..Vehicle::default() }).with("turn_rate", 90);
/// let in_a_file: GivenParameters<Vehicle> = toml::from_str("max_speed = 3\nturn_rate = 90")?;
/// assert_eq!(in_code, in_a_file);
/// # Ok::<(), toml::de::Error>(())
/// ```
pub struct GivenParameters<P>(Value, PhantomData<fn() -> P>);

impl<P: Parameters> GivenParameters<P> {
    /// Returns the parameters that differ from their defaults.
    pub fn of(parameters: &P) -> Self
    where
        P: Default,
    {
        Self(differing(parameters), PhantomData)
    }

    /// Returns the parameters with one more, or with another value of it.
    pub fn with(mut self, key: impl Into<String>, value: impl Into<Value>) -> Self {
        insert(&mut self.0, key, value);
        self
    }

    /// Reads the parameters, which name no part of the scene. `at` is the path to them.
    pub(crate) fn read(&self, at: &Path) -> Result<P, Problem> {
        FileGiven::new(&self.0, at).parameters()
    }

    /// Checks that the type has the given parameters and can read them. Their limits are checked when they are read.
    pub(crate) fn check_keys(&self, at: &Path) -> Result<(), Problem> {
        FileGiven::new(&self.0, at).without_limits().parameters::<P>().map(|_| ())
    }
}

impl<P> Clone for GivenParameters<P> {
    fn clone(&self) -> Self {
        Self(self.0.clone(), PhantomData)
    }
}

impl<P> fmt::Debug for GivenParameters<P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl<P> PartialEq for GivenParameters<P> {
    fn eq(&self, other: &Self) -> bool {
        is_same(&self.0, &other.0)
    }
}

impl<P> Serialize for GivenParameters<P> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}

impl<'de, P> Deserialize<'de> for GivenParameters<P> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Table::deserialize(deserializer).map(|table| Self(Value::Table(table), PhantomData))
    }
}

impl<P: Parameters> JsonSchema for GivenParameters<P> {
    fn schema_name() -> Cow<'static, str> {
        type_name::<P>().into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        schema_of(of_table(P::ABOUT, P::PARAMETERS.iter(), generator))
    }
}
