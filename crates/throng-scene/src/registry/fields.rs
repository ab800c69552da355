//! The vector fields, by name.

use super::choice::{Catalogue, Choice, Described};
use super::entries::{Entries, Entry};
use super::field_context::{BuildField, FieldContext};
use super::given::{FileGiven, made_by_plugin, read_value};
use super::parts::parts;
use super::schema::of_parameters;
use crate::caught::named;
use crate::file::Problem;
use glam::{DVec2, Vec2, Vec3};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde_json::Value as Json;
use std::sync::Arc;
use throng::Error;
use throng::field::{Adaptive, FactorMap, Field, FieldSpine};
use throng::parameters::{Given, Parameters};
use throng_field::{Fields as Register, ForPlace};
use toml::Value;

/// A velocity at every place: its name, and what its table says.
pub type Flow = Choice<Fields>;

/// The fields that scene files can name: those of throng, then those that a program adds.
#[derive(Clone, Debug)]
pub struct Fields(Entries<FieldKind>);

/// A kind of fields.
#[derive(Clone, Copy)]
struct FieldKind {
    make: MakeField,
    /// Returns the fields in what the scene says, each with its path.
    parts: fn(&Value) -> Vec<(String, Flow)>,
}

/// Makes a field from what the scene says in this context.
type MakeField = fn(&Value, &FieldContext<'_>) -> Result<Arc<dyn Field>, Problem>;

impl Fields {
    /// Adds a field of a plug-in, or replaces the field with the same name. A panic in it names it.
    pub(super) fn add_plugin<F: Field + Parameters + 'static>(&mut self) {
        let make: MakeField = |given, at| {
            let path = &at.path;
            let field: F = made_by_plugin(path, &what(F::NAME), || Ok(FileGiven::new(given, path).parameters()?))?;
            Ok(Arc::new(PluginField { field, origin: at.scene.origin() }))
        };
        self.add_declared::<F>(true, make);
    }

    /// Adds a field of throng, which a scene describes as a `D`.
    pub(crate) fn add_own<D: Described + JsonSchema + BuildField>(&mut self, about: &'static str) {
        let make: MakeField = |given, at| {
            let described: D = read_value(given, &at.path)?;
            described.make(at)
        };
        let parts = |given: &Value| {
            let described: Option<D> = given.clone().try_into().ok();
            let parts = described.iter().flat_map(BuildField::parts);
            parts.map(|(key, flow)| (format!(".{key}"), flow.clone())).collect()
        };
        let schema = |generator: &mut SchemaGenerator| generator.subschema_for::<D>();
        let make = FieldKind { make, parts };
        self.0.add(Entry { name: D::NAME.into(), about, is_plugin: false, schema, make });
    }

    /// Adds a field that is made of parameters.
    fn add_declared<P: Parameters>(&mut self, is_plugin: bool, make: MakeField) {
        let make = FieldKind { make, parts: |given| parts(P::KIND, given) };
        self.0.add(Entry { name: P::NAME.into(), about: P::ABOUT, is_plugin, schema: of_parameters::<P>, make });
    }

    /// Returns the names of all fields.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.names()
    }

    /// Makes the field that a scene chooses in a context.
    pub(crate) fn make(&self, flow: &Flow, at: &FieldContext<'_>) -> Result<Arc<dyn Field>, Problem> {
        let inside = at.key(&flow.name);
        let entry = self.0.find(&flow.name, &inside.path)?;
        (entry.make.make)(&flow.parameters, &inside)
    }

    /// Returns the fields of which a field is made, each with its path below the field.
    ///
    /// ```
    /// use throng_scene::{Flow, Plugins};
    /// let flow: Flow = toml::from_str("sum = [{ of.named = \"street\" }, { of.uniform = [1, 0], weight = 0.5 }]")?;
    /// let parts = Plugins::new().fields.parts(&flow);
    /// assert_eq!(parts[0].0, "sum.0.of");
    /// assert_eq!(parts[1], ("sum.1.of".to_owned(), toml::from_str("uniform = [1, 0]")?));
    /// # Ok::<(), toml::de::Error>(())
    /// ```
    pub fn parts(&self, flow: &Flow) -> Vec<(String, Flow)> {
        let Some(entry) = self.0.get(&flow.name) else { return vec![] };
        let parts = (entry.make.parts)(&flow.parameters);
        parts.into_iter().map(|(path, part)| (format!("{}{path}", flow.name), part)).collect()
    }

    /// Returns the name of each field of a plug-in, and the schema of its choice.
    pub(super) fn plugin_schemas(&self, generator: &mut SchemaGenerator) -> Vec<(&str, Json)> {
        self.0.plugin_schemas(generator)
    }
}

impl Register for Fields {
    fn add<P: Parameters + 'static, F: Field + TryFrom<P, Error: Into<Error>> + 'static>(&mut self) {
        self.add_declared::<P>(false, |given, at| {
            let given = FileGiven::new(given, &at.path).with_names(at.scene);
            let field = F::try_from(given.parameters()?).map_err(|error| given.refused(error.into()))?;
            Ok(Arc::new(field))
        });
    }

    fn add_for_place<P: ForPlace + 'static>(&mut self) {
        self.add_declared::<P>(false, |given, at| {
            let given = FileGiven::new(given, &at.path).with_names(at.scene);
            let (parameters, ground): (P, _) = (given.parameters()?, at.scene.ground(&at.path)?);
            let field = parameters.for_place(ground, at.scene.origin()).map_err(|error| given.refused(error))?;
            Ok(Arc::new(field))
        });
    }
}

impl Default for Fields {
    /// Returns the fields of throng.
    fn default() -> Self {
        let mut fields = Self(Entries::default());
        throng_field::register(&mut fields);
        crate::scene::flow::register(&mut fields);
        fields
    }
}

impl Catalogue for Fields {
    const NAME: &'static str = "Flow";
    const EXAMPLE: &'static str = "flow.whirl = { .. }";

    fn schema(generator: &mut SchemaGenerator) -> Schema {
        Self::default().0.schema("A velocity at every place.", generator)
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

impl<F: Field + Parameters + 'static> Field for PluginField<F> {
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

    fn cover(&self) -> Option<Arc<dyn FactorMap>> {
        let (cover, origin) = (named("field", F::NAME, || self.field.cover())?, self.origin);
        Some(Arc::new(move |place: DVec2| named("field", F::NAME, || cover.at(place + origin))))
    }

    fn spine(&self) -> Option<FieldSpine> {
        let (mut spine, origin) = (named("field", F::NAME, || self.field.spine())?, self.origin.as_vec2());
        spine.points.iter_mut().for_each(|point| *point -= origin.extend(0.0));
        Some(spine)
    }
}
