//! The local models, by name.

use super::choice::{Catalogue, Choice, table_of};
use super::entries::{Entries, Entry};
use super::given::{FileGiven, Unmade, made_by_plugin};
use super::schema::{definition, of_table, schema_of, type_name};
use crate::caught::named;
use crate::file::{Path, Problem};
use crate::scene::Neighbours;
use glam::{Vec2, Vec3};
use schemars::{Schema, SchemaGenerator};
use serde_json::Value as Json;
use std::sync::Arc;
use throng::Error;
use throng::avoid::{AvoidanceBatch, AvoidanceInput, AvoidanceReason, LocalModel, Models as Register, Workspace};
use throng::parameters::{Given, Kind, Limit, Parameter, Parameters, Value as _, Written, shortest};
use toml::{Table, Value};

/// The local model of a group: its name and its parameters. Besides those of its type, every model has the two of the
/// neighbour search, `neighbours` and `neighbour_distance`.
pub type Avoid = Choice<Models>;

/// The local models that scene files can name: those of throng, then those that a program adds.
#[derive(Clone, Debug)]
pub struct Models(Entries<MakeModel>);

/// Makes a local model from what the scene says at a path.
#[derive(Clone, Copy)]
struct MakeModel {
    make: fn(&Value, &Path) -> Result<ChosenModel, Problem>,
    /// Checks the keys and the kinds of values.
    check_keys: fn(&Value, &Path) -> Result<(), Problem>,
    /// Adds the defaults of the parameters that are not given.
    complete: fn(&Value) -> Result<Table, Problem>,
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
    pub(super) fn add_plugin<M: LocalModel + Parameters + Default>(&mut self) {
        let make = |given: &Value, at: &Path| {
            let (model, neighbours, neighbour_distance) =
                made_by_plugin(at, &what(M::NAME), || read::<M>(FileGiven::new(given, at)))?;
            Ok(ChosenModel { model: Arc::new(PluginModel(model)), neighbours, neighbour_distance })
        };
        let own = entry::<M>();
        self.0.add(Entry { is_plugin: true, make: MakeModel { make, ..own.make }, ..own });
    }

    /// Makes the model of a choice at this path of the scene.
    pub(crate) fn make(&self, avoid: &Avoid, at: &Path) -> Result<ChosenModel, Problem> {
        let at = at.name(&avoid.name);
        (self.0.find(&avoid.name, &at)?.make.make)(&avoid.parameters, &at)
    }

    /// Checks that the model of a choice, if it is known, has the given parameters and can read them. Their limits are
    /// checked when the model is made.
    pub(crate) fn check_keys(&self, avoid: &Avoid, at: &Path) -> Result<(), Problem> {
        let at = at.name(&avoid.name);
        self.0.find(&avoid.name, &at).map_or(Ok(()), |entry| (entry.make.check_keys)(&avoid.parameters, &at))
    }

    /// Returns a choice with the defaults of all parameters that it leaves out; or as it is, if it cannot be made.
    pub(crate) fn complete(&self, avoid: &Avoid) -> Avoid {
        let found = self.0.find(&avoid.name, &Path::default());
        let complete = found.and_then(|entry| (entry.make.complete)(&avoid.parameters));
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
    fn add<M: LocalModel + Parameters + Default>(&mut self) {
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
fn entry<M: LocalModel + Parameters + Default>() -> Entry<MakeModel> {
    let make = MakeModel {
        make: |given, at| {
            let (model, neighbours, neighbour_distance) =
                read::<M>(FileGiven::new(given, at)).map_err(|unmade| unmade.at(at, &what(M::NAME)))?;
            Ok(ChosenModel { model: Arc::new(model), neighbours, neighbour_distance })
        },
        check_keys: |given, at| match read::<M>(FileGiven::new(given, at).without_limits()) {
            Err(Unmade::Unread(problem)) => Err(problem),
            _ => Ok(()),
        },
        complete: |given| {
            let at = Path::default();
            let (model, neighbours, neighbour_distance) =
                read::<M>(FileGiven::new(given, &at)).map_err(|unmade| unmade.at(&at, &what(M::NAME)))?;
            let mut all = table_of(&model);
            let neighbours = match neighbours {
                Neighbours::Nearest(count) => Value::Integer(count.into()),
                Neighbours::All => Value::String("all".into()),
            };
            all.insert(SIGHT[0].into(), neighbours);
            all.insert(SIGHT[1].into(), Value::Float(neighbour_distance));
            Ok(all)
        },
    };
    Entry { name: M::NAME.into(), about: M::ABOUT, is_plugin: false, schema: schema::<M>, make }
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
    limit: Limit { above: None, least: Some(1.0), most: Some(1000.0), is_infinite: false, words: "from 1 to 1000" },
    kind: Kind::Whole,
    is_required: false,
    default: || Some(Written::Whole(NEIGHBOURS.into())),
};
/// The doc line of the number of neighbours, for models that do not avoid: their agents may see all agents, as flocks do.
const OR_ALL: &str = "The maximum number of neighbours taken into account, the nearest first, 1 to 1000; or `\"all\"` \
                      within the distance, for flocks.";

/// Returns the parameter for the reach of the neighbour search.
const fn distance<M: LocalModel + Default>() -> Parameter {
    Parameter {
        name: SIGHT[1],
        about: "Reach of the neighbour search, metres between centres. Limit: > 0.",
        unit: "m",
        limit: Limit { above: Some(0.0), least: None, most: None, is_infinite: false, words: "more than 0" },
        kind: Kind::Number,
        is_required: false,
        default: || Some(Written::Number(shortest(M::default().neighbour_distance()))),
    }
}

/// Reads a model, the number of neighbours and the reach of the neighbour search.
fn read<M: LocalModel + Parameters + Default>(given: FileGiven<'_>) -> Result<(M, Neighbours, f64), Unmade> {
    let given = given.with_keys(&SIGHT);
    let model: M = given.parameters()?;
    model.check()?;
    let neighbours = match given.get(SIGHT[0]) {
        None => Neighbours::Nearest(NEIGHBOURS),
        Some(given) => {
            let neighbours = match model.avoids() {
                true => Neighbours::Nearest(u32::read(&given, None)?),
                false => given.plain()?,
            };
            if let Neighbours::Nearest(count) = &neighbours {
                given.check(&COUNT, count)?;
            }
            neighbours
        }
    };
    let usual = shortest(model.neighbour_distance());
    let distance = given.parameter(&distance::<M>(), Some(usual))?;
    Ok((model, neighbours, distance))
}

/// Returns the schema of the parameters of a model and of its neighbour search.
fn schema<M: LocalModel + Parameters + Default>(generator: &mut SchemaGenerator) -> Schema {
    let schema = definition(type_name::<M>(), M::ABOUT, generator, |generator| {
        let sight = [COUNT, distance::<M>()];
        let mut table = of_table(M::ABOUT, M::PARAMETERS.iter().chain(&sight), generator);
        if !M::default().avoids() {
            let mut count = generator.subschema_for::<Neighbours>().to_value();
            count["description"] = OR_ALL.into();
            count["default"] = NEIGHBOURS.into();
            table["properties"][COUNT.name] = count;
        }
        table
    });
    schema_of(schema)
}

/// A model of a plug-in: panics in it name it.
#[derive(Debug)]
struct PluginModel<M>(M);

impl<M: LocalModel + Parameters + Default> PluginModel<M> {
    fn named<T>(&self, code: impl FnOnce(&M) -> T) -> T {
        named("model", M::NAME, || code(&self.0))
    }
}

impl<M: LocalModel + Parameters + Default> LocalModel for PluginModel<M> {
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
