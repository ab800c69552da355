//! The vector fields, by name.

use super::choice::{Catalogue, Choice, Described, choice_schema};
use super::read::{Unmade, read, read_value};
use crate::assemble::{BuildField, BuiltField, FieldContext};
use crate::caught::{caught, named};
use crate::file::Problem;
use glam::{DVec2, Vec2, Vec3};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde_json::Value as Json;
use std::fmt;
use throng::field::{Adaptive, Field};
use throng::parameters::Declared;
use toml::Value;

/// A velocity at every place: its name, and what its table says.
pub type Flow = Choice<Fields>;

/// The fields that scene files can name: those of throng, then those that a program adds.
#[derive(Clone)]
pub struct Fields(Vec<Entry>);

/// A field of the registry.
#[derive(Clone)]
struct Entry {
    name: &'static str,
    about: &'static str,
    is_plugin: bool,
    make: MakeField,
    schema: fn(&mut SchemaGenerator) -> Schema,
}

/// Makes a field from what the scene says in this context.
type MakeField = fn(&Value, &FieldContext<'_>) -> Result<BuiltField, Problem>;

impl Fields {
    /// Adds a field of a plug-in, or replaces the field with the same name. A panic in it names it.
    pub(super) fn add_plugin<F: Field + Declared>(&mut self) {
        let make: MakeField = |given, at| {
            let made = caught(|| read::<F>(given, &[])).unwrap_or_else(|says| Err(Unmade::Panicked(says)));
            let field = made.map_err(|unmade| unmade.at(at.path(), at.path(), &what(F::NAME)))?;
            Ok(BuiltField::of(PluginField { field, origin: at.origin() }))
        };
        self.0.retain(|entry| entry.name != F::NAME);
        self.0.push(Entry {
            name: F::NAME,
            about: F::ABOUT,
            is_plugin: true,
            make,
            schema: |generator| generator.subschema_for::<F>(),
        });
    }

    /// Adds a field of throng, which a scene describes as a `D`.
    pub(crate) fn add_own<D: Described + JsonSchema + BuildField>(&mut self, about: &'static str) {
        let make: MakeField = |given, at| {
            let described: D = read_value(given).map_err(|unmade| unmade.at(at.path(), at.path(), ""))?;
            described.make(at)
        };
        let schema = |generator: &mut SchemaGenerator| generator.subschema_for::<D>();
        self.0.push(Entry { name: D::NAME, about, is_plugin: false, make, schema });
    }

    /// Returns the names of all fields.
    pub fn names(&self) -> impl Iterator<Item = &'static str> + '_ {
        self.0.iter().map(|entry| entry.name)
    }

    /// Makes the field that a scene chooses in a context.
    pub(crate) fn make(&self, flow: &Flow, at: &FieldContext<'_>) -> Result<BuiltField, Problem> {
        let inside = at.key(&flow.name);
        match self.0.iter().find(|entry| entry.name == flow.name) {
            Some(entry) => (entry.make)(&flow.parameters, &inside),
            None => Err(Unmade::no_choice(&flow.name, self.names()).at(at.path(), inside.path(), "")),
        }
    }

    /// Returns the name of each field of a plug-in, and the schema of its choice.
    pub(super) fn plugin_schemas(&self, generator: &mut SchemaGenerator) -> Vec<(&str, Json)> {
        let plugins = self.0.iter().filter(|entry| entry.is_plugin);
        plugins.map(|entry| (entry.name, entry.choice(generator))).collect()
    }
}

impl Entry {
    /// Returns the schema of the choice of this field.
    fn choice(&self, generator: &mut SchemaGenerator) -> Json {
        choice_schema(self.name, self.about, (self.schema)(generator))
    }
}

impl Default for Fields {
    /// Returns the fields of throng.
    fn default() -> Self {
        let mut fields = Self(Vec::new());
        crate::scene::flow::register(&mut fields);
        fields
    }
}

impl Catalogue for Fields {
    const NAME: &'static str = "Flow";
    const EXAMPLE: &'static str = "flow.whirl = { .. }";

    fn schema(generator: &mut SchemaGenerator) -> Schema {
        let choices: Vec<Json> = Self::default().0.iter().map(|entry| entry.choice(generator)).collect();
        json_schema!({ "description": "A velocity at every place.", "oneOf": choices })
    }
}

impl fmt::Debug for Fields {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_set().entries(self.names()).finish()
    }
}

/// Returns the kind and name of a field, for messages.
fn what(name: &str) -> String {
    format!("field `{name}`")
}

/// A field of a plug-in, at world coordinates: panics in it name it.
struct PluginField<F> {
    field: F,
    /// The origin of the places that it is asked for, world coordinates.
    origin: DVec2,
}

impl<F: Field + Declared> Field for PluginField<F> {
    fn velocity(&self, place: Vec3, time: f64) -> Vec3 {
        let place = (place.truncate().as_dvec2() + self.origin).as_vec2().extend(place.z);
        named("field", F::NAME, || self.field.velocity(place, time))
    }

    fn row(&self, (first, step): (DVec2, f64), from: usize, time: f64, out: &mut [Vec2]) {
        named("field", F::NAME, || self.field.row((first + self.origin, step), from, time, out));
    }

    fn adaptive(&self) -> Option<&dyn Adaptive> {
        self.field.adaptive()
    }
}
