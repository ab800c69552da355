//! Behaviours that a program adds to those of scene files.

use super::read::{Unmade, read};
use crate::caught::{caught, named};
use crate::scene::SceneNames;
use schemars::{Schema, SchemaGenerator};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;
use throng::Error;
use throng::motion::Steering;
use throng::parameters::Declared;
use throng::steer::{Behaviour, BoxedBehaviour, FlockBatch, SteeringBatch, SteeringInput, TraceRecorder};
use toml::Table;

/// Behaviours by name, for `steer.custom = "name"`: a scene uses the behaviours of a program by these names.
/// [`Plugins`](crate::Plugins) gives them to every scene of a program.
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
///     steer.priority = [{ custom = "vertical_velocity" }, { wander = {} }]
/// "#
/// .parse()?;
/// scene.plugins.behaviours.add("vertical_velocity", |_| Ok(Climb { height: 3.0 }.into()));
/// let (mut world, _) = scene.build()?;
/// (0..100).for_each(|_| world.step());
/// assert!(world.relative_columns().altitude[0] > 2.9);
/// # Ok::<(), throng_scene::Error>(())
/// ```
#[derive(Clone, Default)]
pub struct Behaviours(BTreeMap<String, Maker>);

/// How a behaviour is made, and the schema of its parameters.
#[derive(Clone)]
struct Maker {
    make: MakeBehaviour,
    /// The schema of its parameters, if it has any.
    schema: Option<fn(&mut SchemaGenerator) -> Schema>,
}

/// Makes a behaviour for a scene, with the given parameters.
type MakeBehaviour = Arc<dyn Fn(&Table, &SceneNames<'_>) -> Result<BoxedBehaviour, Unmade> + Send + Sync>;

impl Behaviours {
    /// Adds a behaviour, or replaces the behaviour with the same name. `make` gets the names in the scene, and returns
    /// an error for anything that it needs and the scene lacks.
    pub fn add(
        &mut self,
        name: impl Into<String>,
        make: impl Fn(&SceneNames<'_>) -> Result<BoxedBehaviour, Error> + Send + Sync + 'static,
    ) {
        let make: MakeBehaviour = Arc::new(move |_, cast| make(cast).map_err(Unmade::Refused));
        self.0.insert(name.into(), Maker { make, schema: None });
    }

    /// Adds a behaviour with parameters, as [`add`](Self::add) does. Files set the parameters by
    /// `steer.custom.NAME = { .. }`, which is read as `P`.
    ///
    /// ```
    /// use throng::parameters::parameters;
    /// use throng_steer::Wander;
    /// use throng_scene::{Behaviours, Scene};
    ///
    /// /// Walks at ease.
    /// #[parameters]
    /// struct Stroll {
    ///     /// Strength of the wandering.
    ///     #[parameter(required, least = 0, most = 1)]
    ///     strength: f32,
    /// }
    ///
    /// let mut behaviours = Behaviours::default();
    /// behaviours.add_with("stroll", |Stroll { strength }, _| Ok(Wander { strength, rate: 1.0 }.into()));
    /// let mut scene: Scene = "[[group]]\nplace.point = [5, 0]\nsteer.custom.stroll = { strength = 1.5 }".parse()?;
    /// scene.plugins.behaviours = behaviours;
    /// let says = scene.build().unwrap_err().to_string();
    /// assert!(says.contains("strength is 1.5, but must be from 0 to 1"), "{says}");
    /// # Ok::<(), throng_scene::Error>(())
    /// ```
    pub fn add_with<P: Declared>(
        &mut self,
        name: impl Into<String>,
        make: impl Fn(P, &SceneNames<'_>) -> Result<BoxedBehaviour, Error> + Send + Sync + 'static,
    ) {
        let make: MakeBehaviour = Arc::new(move |given, cast| {
            let parameters = read(given.clone(), &[])?;
            make(parameters, cast).map_err(Unmade::Refused)
        });
        self.0.insert(name.into(), Maker { make, schema: Some(|generator| generator.subschema_for::<P>()) });
    }

    /// Adds the behaviours of another set. They replace behaviours with the same names.
    pub fn extend(&mut self, others: Self) {
        self.0.extend(others.0);
    }

    /// Returns the names of all behaviours.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.keys().map(String::as_str)
    }

    /// Returns the schema of the parameters of a behaviour, without references, if it has parameters.
    pub(crate) fn schema(&self, name: &str) -> Option<Value> {
        let mut generator = SchemaGenerator::new(schemars::generate::SchemaSettings::default().with(|settings| {
            settings.inline_subschemas = true;
        }));
        let schema = self.0.get(name)?.schema?;
        Some(schema(&mut generator).to_value())
    }

    /// Returns a behaviour by its name, made for a scene. A panic in it names the behaviour.
    pub(crate) fn make(
        &self,
        name: &str,
        said: &Table,
        cast: &SceneNames<'_>,
    ) -> Option<Result<BoxedBehaviour, Unmade>> {
        let maker = self.0.get(name)?;
        let made = caught(|| {
            let branch = (maker.make)(said, cast)?;
            branch.check().map_err(Unmade::Refused)?;
            Ok(branch)
        });
        let made = made.unwrap_or_else(|says| Err(Unmade::Panicked(says)));
        Some(made.map(|branch| NamedBehaviour { name: name.into(), branch }.into()))
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

impl fmt::Debug for Behaviours {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_set().entries(self.0.keys()).finish()
    }
}
