//! Behaviours that a program adds to those of scene files.

use super::Cast;
use crate::caught::{caught, named};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::de::DeserializeOwned;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;
use throng::Error;
use throng::motion::Steering;
use throng::steer::swarm::Swarm;
use throng::steer::{Behaviour, Branch, Flocking, View, Why};
use toml::Table;

/// Behaviours by name, for `steer.custom = "name"`: how a scene uses a behaviour that a program brings along.
/// [`Plugins`](crate::Plugins) hands them to every scene of a program.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::{Behaviour, View, Why};
/// use throng::motion::Steering;
/// use throng_scene::Scene;
///
/// /// Goes up, but not above a height.
/// #[derive(Debug)]
/// struct Climb {
///     height: f32,
/// }
///
/// impl Behaviour for Climb {
///     fn steer(&self, view: &View<'_>, _: &mut [f32], _: &mut Why<'_>) -> Option<Steering> {
///         (view.position().z < self.height).then(|| view.reach(Vec3::Z * view.vehicle.max_speed))
///     }
/// }
///
/// let mut scene: Scene = r#"
///     [[group]]
///     place.point = [5, 0]
///     vehicle = { kind = "level", max_speed = 2.0 }
///     steer.priority = [{ custom = "climb" }, { wander = {} }]
/// "#
/// .parse()?;
/// scene.behaviours.add("climb", |_| Ok(Climb { height: 3.0 }.into()));
/// let (mut world, _) = scene.build()?;
/// (0..100).for_each(|_| world.step());
/// assert!(world.agents().altitude[0] > 2.9);
/// # Ok::<(), throng_scene::Error>(())
/// ```
#[derive(Clone, Default)]
pub struct Behaviours(BTreeMap<String, Maker>);

/// How a behaviour is made, and what can be said of it.
#[derive(Clone)]
struct Maker {
    make: Make,
    /// The schema of its parameters, if it has any.
    schema: Option<fn(&mut SchemaGenerator) -> Schema>,
}

/// Makes a behaviour for a scene, with the parameters that are said.
type Make = Arc<dyn Fn(&Table, &Cast<'_>) -> Result<Branch, Unmade> + Send + Sync>;

/// Why a behaviour was not made.
pub(crate) enum Unmade {
    /// What is said of its parameters does not fit them.
    Parameters(toml::de::Error),
    /// What it says itself.
    Refused(Error),
    /// It panicked: what it said.
    Panicked(String),
}

impl Behaviours {
    /// Adds a behaviour, or takes the place of the one of this name. `make` is told who and what is in the
    /// scene; what it misses there it says.
    pub fn add(
        &mut self,
        name: impl Into<String>,
        make: impl Fn(&Cast<'_>) -> Result<Branch, Error> + Send + Sync + 'static,
    ) {
        let make: Make = Arc::new(move |_, cast| make(cast).map_err(Unmade::Refused));
        self.0.insert(name.into(), Maker { make, schema: None });
    }

    /// Adds a behaviour with parameters, as [`add`](Self::add) does: files say them by
    /// `steer.custom.NAME = { .. }`, as `P` is read, and whoever asks for the [schema](crate::Plugins::schema) knows them: their
    /// doc lines, units, limits (`#[schemars(range(min = 0, max = 1))]`, which files are held to) and defaults
    /// (`#[serde(default)]`).
    ///
    /// ```
    /// use schemars::JsonSchema;
    /// use serde::Deserialize;
    /// use throng::steer::Wander;
    /// use throng_scene::{Behaviours, Scene};
    ///
    /// #[derive(Deserialize, JsonSchema)]
    /// struct Stroll {
    ///     /// How far it strays. Limit: 0 to 1.
    ///     #[schemars(range(min = 0, max = 1))]
    ///     strength: f32,
    /// }
    ///
    /// let mut behaviours = Behaviours::default();
    /// behaviours.add_with("stroll", |Stroll { strength }, _| Ok(Wander { strength, rate: 1.0 }.into()));
    /// let mut scene: Scene = "[[group]]\nplace.point = [5, 0]\nsteer.custom.stroll = { strength = 1.5 }".parse()?;
    /// scene.behaviours = behaviours;
    /// let says = scene.build().unwrap_err().to_string();
    /// assert!(says.contains("strength is 1.5, but must be from 0 to 1"), "{says}");
    /// # Ok::<(), throng_scene::Error>(())
    /// ```
    pub fn add_with<P: DeserializeOwned + JsonSchema>(
        &mut self,
        name: impl Into<String>,
        make: impl Fn(P, &Cast<'_>) -> Result<Branch, Error> + Send + Sync + 'static,
    ) {
        let make: Make = Arc::new(move |said, cast| {
            let parameters = P::deserialize(said.clone()).map_err(Unmade::Parameters)?;
            make(parameters, cast).map_err(Unmade::Refused)
        });
        self.0.insert(name.into(), Maker { make, schema: Some(|generator| generator.subschema_for::<P>()) });
    }

    /// Adds those of others; they take the place of those of the same name.
    pub fn extend(&mut self, others: Self) {
        self.0.extend(others.0);
    }

    /// The names of all.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.keys().map(String::as_str)
    }

    /// The schema of the parameters of the behaviour of this name, by itself, if it has any.
    pub(crate) fn schema(&self, name: &str) -> Option<Value> {
        let mut generator = SchemaGenerator::new(schemars::generate::SchemaSettings::default().with(|settings| {
            settings.inline_subschemas = true;
        }));
        let schema = self.0.get(name)?.schema?;
        Some(schema(&mut generator).to_value())
    }

    /// The behaviour of this name, made for a scene; a panic in it says whose it is.
    pub(crate) fn make(&self, name: &str, said: &Table, cast: &Cast<'_>) -> Option<Result<Branch, Unmade>> {
        let maker = self.0.get(name)?;
        let made = caught(|| {
            let branch = (maker.make)(said, cast)?;
            branch.check().map_err(Unmade::Refused)?;
            Ok(branch)
        });
        let made = made.unwrap_or_else(|says| Err(Unmade::Panicked(says)));
        Some(made.map(|branch| Named { name: name.into(), branch }.into()))
    }
}

/// A behaviour that a program brings along: panics in it say whose they are.
#[derive(Debug)]
struct Named {
    name: Arc<str>,
    branch: Branch,
}

impl Behaviour for Named {
    fn memory(&self) -> usize {
        self.branch.words()
    }

    fn steer(&self, view: &View<'_>, memory: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        named("behaviour", &self.name, || self.branch.steer(view, memory, why))
    }

    fn as_flocking(&self) -> Option<&Flocking> {
        self.branch.as_flocking()
    }

    fn as_swarm(&self) -> Option<&Swarm> {
        self.branch.as_swarm()
    }

    fn check(&self) -> Result<(), Error> {
        named("behaviour", &self.name, || self.branch.check())
    }
}

impl PartialEq for Behaviours {
    /// Always: what a program brings along is not part of what the scene says.
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl fmt::Debug for Behaviours {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_set().entries(self.0.keys()).finish()
    }
}
