//! The local models, by name.

use super::choice::{Catalogue, Choice, in_short};
use super::entries::{Entries, Entry};
use super::read::{self, Unmade, read_value};
use crate::caught::{caught, named};
use crate::file::{Path, Problem};
use crate::scene::Neighbours;
use glam::{Vec2, Vec3};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;
use serde_json::{Value as Json, json};
use std::borrow::Cow;
use std::marker::PhantomData;
use std::sync::Arc;
use throng::Error;
use throng::avoid::{AvoidanceBatch, AvoidanceInput, AvoidanceReason, LocalModel, Models as Register, Workspace};
use throng::parameters::{Declared, Limit, Parameter, shortest};
use toml::{Table, Value};

/// The local model of a group: its name and its parameters. Besides those of its type, every model has the two of the
/// neighbour search, `neighbours` and `neighbour_distance`.
pub type Avoid = Choice<Models>;

/// The local models that scene files can name: those of throng, then those that a program adds.
#[derive(Clone, Debug)]
pub struct Models(Entries<MakeModel>);

/// Makes a local model from what the scene says.
#[derive(Clone, Copy)]
struct MakeModel {
    read: fn(&Value) -> Result<ChosenModel, Unmade>,
    /// Adds the defaults of the parameters that are not given.
    complete: fn(&Value) -> Result<Table, Unmade>,
}

/// A local model with its parameters, and the neighbour search of its agents.
#[derive(Clone, Debug)]
pub(crate) struct ChosenModel {
    pub model: Arc<dyn LocalModel>,
    pub neighbours: Neighbours,
    /// Metres between centres.
    pub neighbour_distance: f64,
}

impl Models {
    /// Returns the names of all models.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.names()
    }

    /// Adds a model of a plug-in, or replaces the model with the same name. A panic in it names it.
    pub(super) fn add_plugin<M: LocalModel + Declared + Default>(&mut self) {
        let read = |given: &Value| {
            let (model, neighbours, neighbour_distance) = caught(|| read::<M>(given)).map_err(Unmade::Panicked)??;
            Ok(ChosenModel { model: Arc::new(PluginModel(model)), neighbours, neighbour_distance })
        };
        let own = entry::<M>();
        self.0.add(Entry { is_plugin: true, make: MakeModel { read, ..own.make }, ..own });
    }

    /// Makes the model of a choice at this path of the scene.
    pub(crate) fn make(&self, avoid: &Avoid, at: &Path) -> Result<ChosenModel, Problem> {
        let chosen = self.0.find(&avoid.name).and_then(|entry| (entry.make.read)(&avoid.parameters));
        chosen.map_err(|unmade| unmade.at(at, &at.name(&avoid.name), &what(&avoid.name)))
    }

    /// Checks that the model of a choice, if it is known, has the given parameters and can read them. Their limits are
    /// checked when the model is made.
    pub(crate) fn check_keys(&self, avoid: &Avoid, at: &Path) -> Result<(), Problem> {
        match self.0.find(&avoid.name).and_then(|entry| (entry.make.read)(&avoid.parameters)) {
            Err(unread @ (Unmade::NoKey(..) | Unmade::Misread(..))) => {
                Err(unread.at(at, &at.name(&avoid.name), &what(&avoid.name)))
            }
            _ => Ok(()),
        }
    }

    /// Returns a choice with the defaults of all parameters that it leaves out; or as it is, if it cannot be made.
    pub(crate) fn complete(&self, avoid: &Avoid) -> Avoid {
        let complete = self.0.find(&avoid.name).and_then(|entry| (entry.make.complete)(&avoid.parameters));
        complete.map_or_else(|_| avoid.clone(), |all| Avoid::new(avoid.name.clone(), Value::Table(all)))
    }

    /// Returns the name of each model of a plug-in, and the schema of its choice.
    pub(super) fn plugin_schemas(&self, generator: &mut SchemaGenerator) -> Vec<(&str, Json)> {
        self.0.plugin_schemas(generator)
    }
}

impl Default for Models {
    /// Returns the models of throng.
    fn default() -> Self {
        let mut models = Self(Entries::default());
        throng::avoid::register(&mut models);
        models
    }
}

impl Register for Models {
    fn add<M: LocalModel + Declared + Default>(&mut self) {
        self.0.add(entry::<M>());
    }
}

impl Catalogue for Models {
    const NAME: &'static str = "Avoid";
    const EXAMPLE: &'static str = "avoid.orca = { .. }";

    fn schema(generator: &mut SchemaGenerator) -> Schema {
        Self::default().0.schema("The local model of a group.", generator)
    }
}

/// Returns the entry of a model of throng.
fn entry<M: LocalModel + Declared + Default>() -> Entry<MakeModel> {
    let make = MakeModel {
        read: |given| {
            let (model, neighbours, neighbour_distance) = read::<M>(given)?;
            Ok(ChosenModel { model: Arc::new(model), neighbours, neighbour_distance })
        },
        complete: |given| {
            let (model, neighbours, neighbour_distance) = read::<M>(given)?;
            let Value::Table(mut all) = in_short(&model) else { return Ok(Table::new()) };
            let neighbours = match neighbours {
                Neighbours::Nearest(count) => Value::Integer(count.into()),
                Neighbours::All => Value::String("all".into()),
            };
            all.insert(SIGHT[0].into(), neighbours);
            all.insert(SIGHT[1].into(), Value::Float(neighbour_distance));
            Ok(all)
        },
    };
    let schema = |generator: &mut SchemaGenerator| generator.subschema_for::<WithSight<M>>();
    Entry { name: M::NAME.into(), about: M::ABOUT, is_plugin: false, schema, make }
}

/// Returns the kind and name of a model, for messages.
fn what(name: &str) -> String {
    format!("model `{name}`")
}

/// The parameters of the neighbour search, which every model has besides its own.
pub(super) const SIGHT: [&str; 2] = ["neighbours", "neighbour_distance"];
/// The default number of neighbours.
const NEIGHBOURS: u32 = 10;
const COUNT: Parameter = Parameter {
    name: SIGHT[0],
    about: "The maximum number of neighbours taken into account, the nearest first. Limit: 1 to 1000.",
    unit: "",
    limit: Limit { above: None, least: Some(1.0), most: Some(1000.0), words: "from 1 to 1000" },
};
/// The doc line of the number of neighbours, for models that do not avoid.
const OR_ALL: &str = "The maximum number of neighbours taken into account, the nearest first, 1 to 1000; or `\"all\"` \
                      within the distance, for flocks.";
const DISTANCE: Parameter = Parameter {
    name: SIGHT[1],
    about: "Reach of the neighbour search, metres between centres. Limit: > 0.",
    unit: "m",
    limit: Limit { above: Some(0.0), least: None, most: None, words: "more than 0" },
};

/// The neighbour search of a model that avoids.
#[derive(Deserialize)]
struct Nearest {
    neighbours: Option<u32>,
    neighbour_distance: Option<f64>,
}

/// The neighbour search of a model that does not avoid: its agents may see all agents, as flocks do.
#[derive(Deserialize)]
struct OrAll {
    neighbours: Option<Neighbours>,
    neighbour_distance: Option<f64>,
}

/// Reads a model, the number of neighbours and the reach of the neighbour search.
fn read<M: LocalModel + Declared + Default>(given: &Value) -> Result<(M, Neighbours, f64), Unmade> {
    let (mut own, mut sight) = (given.clone(), Table::new());
    if let Value::Table(own) = &mut own {
        sight.extend(SIGHT.iter().filter_map(|key| own.remove_entry(*key)));
    }
    let sight = Value::Table(sight);
    let model: M = read::read(&own, &SIGHT)?;
    model.check().map_err(Unmade::Refused)?;
    let (neighbours, distance) = if model.avoids() {
        let Nearest { neighbours, neighbour_distance } = read_value(&sight)?;
        (neighbours.map(Neighbours::Nearest), neighbour_distance)
    } else {
        let OrAll { neighbours, neighbour_distance } = read_value(&sight)?;
        (neighbours, neighbour_distance)
    };
    let neighbours = neighbours.unwrap_or(Neighbours::Nearest(NEIGHBOURS));
    if let Neighbours::Nearest(count) = &neighbours {
        COUNT.check(count).map_err(Unmade::Refused)?;
    }
    let distance = distance.unwrap_or_else(|| shortest(model.neighbour_distance()));
    DISTANCE.check(&distance).map_err(Unmade::Refused)?;
    Ok((model, neighbours, distance))
}

/// The schema of the parameters of a model and of its neighbour search.
struct WithSight<M>(PhantomData<M>);

impl<M: LocalModel + Declared + Default> JsonSchema for WithSight<M> {
    fn schema_name() -> Cow<'static, str> {
        M::schema_name()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let model = M::default();
        let (count, about) = match model.avoids() {
            true => (u32::json_schema(generator), COUNT.about),
            false => (generator.subschema_for::<Neighbours>(), OR_ALL),
        };
        let distance = f64::json_schema(generator);
        let mut schema = M::json_schema(generator);
        let properties = schema.ensure_object().entry("properties").or_insert_with(|| json!({}));
        let more = [
            (COUNT.name, about, count, json!(NEIGHBOURS)),
            (DISTANCE.name, DISTANCE.about, distance, json!(shortest(model.neighbour_distance()))),
        ];
        for (name, about, mut property, default) in more {
            property.insert("description".into(), about.into());
            property.insert("default".into(), default);
            properties[name] = property.to_value();
        }
        for (_, property) in properties.as_object_mut().into_iter().flatten() {
            in_double_precision(property);
        }
        schema
    }
}

/// Gives a number in single precision the digits and the format that it has in files.
fn in_double_precision(property: &mut Json) {
    if property["format"] == "float" {
        property["format"] = "double".into();
        property["default"] = property["default"].as_f64().map(|x| shortest(x as f32)).into();
    }
}

/// A model of a plug-in: panics in it name it.
#[derive(Debug)]
struct PluginModel<M>(M);

impl<M: LocalModel + Declared + Default> PluginModel<M> {
    fn named<T>(&self, code: impl FnOnce(&M) -> T) -> T {
        named("model", M::NAME, || code(&self.0))
    }
}

impl<M: LocalModel + Declared + Default> LocalModel for PluginModel<M> {
    fn velocity(&self, view: &AvoidanceInput<'_>, workspace: &mut Workspace) -> Vec2 {
        self.named(|model| model.velocity(view, workspace))
    }

    fn velocity_in_space(&self, view: &AvoidanceInput<'_>, workspace: &mut Workspace) -> Vec3 {
        self.named(|model| model.velocity_in_space(view, workspace))
    }

    fn looks_in_space(&self) -> bool {
        self.0.looks_in_space()
    }

    fn avoids(&self) -> bool {
        self.0.avoids()
    }

    fn relaxes(&self) -> bool {
        self.0.relaxes()
    }

    fn parts_bodies(&self) -> bool {
        self.0.parts_bodies()
    }

    fn neighbour_distance(&self) -> f32 {
        self.0.neighbour_distance()
    }

    fn wants_guard(&self) -> bool {
        self.0.wants_guard()
    }

    fn velocities(&self, batch: &mut AvoidanceBatch<'_>) {
        self.named(|model| model.velocities(batch));
    }

    fn is_same(&self, other: &dyn LocalModel) -> bool {
        let other = (other as &dyn std::any::Any).downcast_ref::<Self>();
        other.is_some_and(|other| self.named(|model| model.is_same(&other.0)))
    }

    fn is_random(&self) -> bool {
        self.0.is_random()
    }

    fn explain(&self, view: &AvoidanceInput<'_>, workspace: &mut Workspace) -> Vec<AvoidanceReason> {
        self.named(|model| model.explain(view, workspace))
    }

    fn wall_range(&self, radius: f32, max_speed: f32) -> f32 {
        self.named(|model| model.wall_range(radius, max_speed))
    }

    fn check(&self) -> Result<(), Error> {
        self.named(M::check)
    }
}
