//! The steering behaviours, by name.

use super::choice::{Catalogue, Choice};
use super::entries::{Entries, Entry};
use super::given::{FileGiven, made_by_plugin, refused};
use super::names::Names;
use super::schema::of_parameters;
use crate::caught::named;
use crate::file::{Path, Problem};
use crate::scene::SceneNames;
use schemars::{Schema, SchemaGenerator};
use serde_json::Value as Json;
use std::sync::Arc;
use throng::Error;
use throng::motion::Steering;
use throng::parameters::{Parameters, parameters};
use throng::steer::{Behaviour, BoxedBehaviour, FlockBatch, SteeringBatch, SteeringInput, TraceRecorder};
use throng_steer::{Behaviours as Register, ForGroup};
use toml::Value;

/// What an agent steers by: a behaviour, or a combination of behaviours. Its name, and what its table says.
pub type Steer = Choice<Behaviours>;

/// The behaviours that scene files can name: those of throng, then those that a program adds.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::{Behaviour, SteeringInput, TraceRecorder};
/// use throng::motion::Steering;
/// use throng_scene::Scene;
///
/// /// Rises to a height.
/// #[derive(Debug)]
/// struct Climb {
///     height: f32,
/// }
///
/// impl Behaviour for Climb {
///     fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], _: &mut TraceRecorder<'_>) -> Option<Steering> {
///         (view.position().z < self.height).then(|| view.reach(Vec3::Z * view.vehicle.max_speed))
///     }
/// }
///
/// let mut scene: Scene = r#"
///     [[group]]
///     place.point = [5, 0]
///     vehicle = { kind = "level", max_speed = 2.0 }
///     steer.priority = [{ climb = {} }, { wander = {} }]
/// "#
/// .parse()?;
/// scene.plugins.behaviours.add("climb", |_| Ok(Climb { height: 3.0 }.into()));
/// let (mut world, _) = scene.build()?;
/// (0..100).for_each(|_| world.step());
/// assert!(world.relative_columns().altitude[0] > 2.9);
/// # Ok::<(), throng_scene::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Behaviours(Entries<MakeBehaviour>);

/// Makes a behaviour for a group of a scene, from what the scene says at this path.
type MakeBehaviour = Arc<dyn Fn(&Value, &dyn Names, &Path) -> Result<BoxedBehaviour, Problem> + Send + Sync>;

/// A behaviour that the program adds.
#[parameters]
#[derive(Debug)]
struct NoParameters;

impl Behaviours {
    /// Adds a behaviour without parameters, or replaces the behaviour with the same name. `make` gets the names in the
    /// scene, and returns an error for anything that it needs and the scene lacks.
    pub fn add(
        &mut self,
        name: impl Into<String>,
        make: impl Fn(&SceneNames<'_>) -> Result<BoxedBehaviour, Error> + Send + Sync + 'static,
    ) {
        self.add_with(name, move |_: NoParameters, names| make(names));
    }

    /// Adds a behaviour with parameters, as [`add`](Self::add) does. Files set the parameters by `steer.NAME = { .. }`,
    /// which is read as `P`.
    ///
    /// ```
    /// use throng::parameters::parameters;
    /// use throng_scene::Scene;
    /// use throng_steer::Wander;
    ///
    /// /// Walks at ease.
    /// #[parameters]
    /// struct Stroll {
    ///     /// Strength of the wandering.
    ///     #[parameter(required, least = 0, most = 1)]
    ///     strength: f32,
    /// }
    ///
    /// let mut scene: Scene = "[[group]]\nplace.point = [5, 0]\nsteer.stroll = { strength = 1.5 }".parse()?;
    /// let behaviours = &mut scene.plugins.behaviours;
    /// behaviours.add_with("stroll", |Stroll { strength }, _| Ok(Wander { strength, ..Wander::default() }.into()));
    /// let says = scene.build().unwrap_err().to_string();
    /// assert!(says.contains("strength is 1.5, but must be from 0 to 1"), "{says}");
    /// # Ok::<(), throng_scene::Error>(())
    /// ```
    pub fn add_with<P: Parameters + 'static>(
        &mut self,
        name: impl Into<String>,
        make: impl Fn(P, &SceneNames<'_>) -> Result<BoxedBehaviour, Error> + Send + Sync + 'static,
    ) {
        let name: Arc<str> = name.into().into();
        let of = name.clone();
        let make: MakeBehaviour = Arc::new(move |given, names, at| {
            let branch = made_by_plugin(at, &format!("behaviour `{of}`"), || {
                let parameters = FileGiven::new(given, at).with_names(names).parameters()?;
                let branch = make(parameters, names.names(at)?)?;
                branch.check()?;
                Ok(branch)
            })?;
            Ok(NamedBehaviour { name: of.clone(), branch }.into())
        });
        let schema = of_parameters::<P>;
        self.0.add(Entry { name: name.to_string().into(), about: P::ABOUT, is_plugin: true, schema, make });
    }

    /// Adds a behaviour of throng.
    fn add_own<P: Parameters + 'static>(&mut self, make: fn(P, &dyn Names, &Path) -> Result<BoxedBehaviour, Problem>) {
        let make: MakeBehaviour = Arc::new(move |given, names, at| {
            let branch = make(FileGiven::new(given, at).with_names(names).parameters()?, names, at)?;
            branch.check().map_err(|error| refused(at, &error))?;
            Ok(branch)
        });
        let schema = of_parameters::<P>;
        self.0.add(Entry { name: P::NAME.into(), about: P::ABOUT, is_plugin: false, schema, make });
    }

    /// Adds the behaviours that another set has from programs. They replace behaviours with the same names.
    pub fn extend(&mut self, more: Self) {
        self.0.extend(more.0);
    }

    /// Returns the names of all behaviours.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.names()
    }

    /// Makes the behaviour that a scene chooses at a path.
    pub(crate) fn make(&self, steer: &Steer, names: &dyn Names, at: &Path) -> Result<BoxedBehaviour, Problem> {
        let inside = at.name(&steer.name);
        let entry = self.0.find(&steer.name, &inside).map_err(|problem| match steer.name.as_str() {
            "custom" => problem.hint("a behaviour of a program is named like any other: steer.NAME = { .. }"),
            _ => problem,
        })?;
        (entry.make)(&steer.parameters, names, &inside)
    }

    /// Returns the name of each behaviour of a plug-in, and the schema of its choice.
    pub(super) fn plugin_schemas(&self, generator: &mut SchemaGenerator) -> Vec<(&str, Json)> {
        self.0.plugin_schemas(generator)
    }
}

impl Register for Behaviours {
    fn add<P: Parameters + TryInto<BoxedBehaviour, Error: Into<Error>> + 'static>(&mut self) {
        self.add_own::<P>(|parameters, _, at| parameters.try_into().map_err(|error| refused(at, &error.into())));
    }

    fn add_for_group<P: ForGroup + 'static>(&mut self) {
        self.add_own::<P>(|parameters, names, at| {
            parameters.for_group(&names.group(at)?).map_err(|error| refused(at, &error))
        });
    }
}

impl Default for Behaviours {
    /// Returns the behaviours of throng.
    fn default() -> Self {
        let mut behaviours = Self(Entries::default());
        throng_steer::register(&mut behaviours);
        crate::games::register(&mut behaviours);
        behaviours.0.own();
        behaviours
    }
}

impl Catalogue for Behaviours {
    const NAME: &'static str = "Steer";
    const EXAMPLE: &'static str = "steer.wander = { .. }";

    fn schema(generator: &mut SchemaGenerator) -> Schema {
        let description = "What an agent steers by: a behaviour, or a combination of behaviours.";
        Self::default().0.schema(description, generator)
    }
}

/// A behaviour of a plug-in: panics in it name it.
#[derive(Debug)]
struct NamedBehaviour {
    name: Arc<str>,
    branch: BoxedBehaviour,
}

impl Behaviour for NamedBehaviour {
    fn memory(&self) -> usize {
        self.branch.words()
    }

    fn steer(&self, view: &SteeringInput<'_>, memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        named("behaviour", &self.name, || self.branch.steer(view, memory, why))
    }

    fn steer_many(&self, batch: &mut SteeringBatch<'_>) {
        named("behaviour", &self.name, || self.branch.steer_many(batch));
    }

    fn is_flock(&self) -> bool {
        self.branch.is_flock()
    }

    fn steer_flock(&self, batch: &mut FlockBatch<'_>) {
        named("behaviour", &self.name, || self.branch.steer_flock(batch));
    }

    fn perception_range(&self) -> Option<f32> {
        self.branch.perception_range()
    }

    fn check(&self) -> Result<(), Error> {
        named("behaviour", &self.name, || self.branch.check())
    }
}
