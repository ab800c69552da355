//! What scenes of a program can name, and its scenes.

use super::{Behaviours, Fields, GoalRule, Goals, Models, Placement, Placements, Rulebook};
use crate::error::Error;
use crate::gallery;
use crate::scene::{Scene, SceneNames};
use schemars::SchemaGenerator;
use schemars::generate::SchemaSettings;
use serde_json::Value;
use std::path::Path;
use std::sync::Arc;
use throng::avoid::LocalModel;
use throng::field::Field;
use throng::parameters::Parameters;
use throng::steer::Behaviour;
use throng::{Error as Refused, Rules};

/// The group of the program's own scenes in its gallery.
const GROUP: &str = "plug-ins";

/// What a program knows by name: placements, goals, local models, behaviours, fields and rules that scene files can name, and
/// scenes besides those of the gallery. At first it holds those of throng, which are registered like those of a plug-in. The
/// studio takes it, and so can every program that opens scenes.
///
/// ```
/// use throng::motion::Steering;
/// use throng::parameters::parameters;
/// use throng::steer::{Behaviour, SteeringInput, TraceRecorder};
/// use throng_scene::Plugins;
///
/// /// Rises to a height.
/// #[parameters]
/// #[derive(Debug)]
/// struct Climb {
///     /// The height, metres.
///     #[parameter(default = 3.0, unit = "m", least = 0, most = 100)]
///     height: f32,
/// }
///
/// impl Behaviour for Climb {
///     fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], _: &mut TraceRecorder<'_>) -> Option<Steering> {
///         (view.position().z < self.height).then(|| view.reach(glam::Vec3::Z * view.vehicle.max_speed))
///     }
/// }
///
/// const LIFT: &str = r#"
///     title = "A lift"
///     [[group]]
///     place.point = [5, 0]
///     vehicle = { kind = "level", max_speed = 2.0 }
///     steer.climb = { height = 4 }
/// "#;
///
/// let plugins = Plugins::new().behaviour::<Climb>().scene("lift", LIFT);
/// let (mut world, _) = plugins.open("lift")?.build()?;
/// (0..200).for_each(|_| world.step());
/// assert!(world.relative_columns().altitude[0] > 3.9);
/// # Ok::<(), throng_scene::Error>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Plugins {
    /// The placements, for `place`.
    pub placements: Placements,
    /// The goals, for `goal`.
    pub goals: Goals,
    /// The local models, for `avoid`.
    pub models: Models,
    /// The steering behaviours, for `steer`.
    pub behaviours: Behaviours,
    /// The vector fields, for `flow`.
    pub fields: Fields,
    /// The rules of games, for `rules`.
    pub rules: Rulebook,
    /// Names and texts, in the order in which they were added.
    scenes: Arc<Vec<(String, String)>>,
}

impl Plugins {
    /// Returns what throng itself has.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a placement, or replaces the placement with the same name. The fields of its type are its parameters
    /// ([`throng::parameters`]), and its name in `place.NAME` is [`NAME`](throng::parameters::Parameters::NAME).
    pub fn placement<P: Placement + Parameters + 'static>(mut self) -> Self {
        self.placements.add_plugin::<P>();
        self
    }

    /// Adds a goal, or replaces the goal with the same name. The fields of its type are its parameters
    /// ([`throng::parameters`]), and its name in `goal.NAME` is [`NAME`](throng::parameters::Parameters::NAME).
    pub fn goal<G: GoalRule + Parameters + 'static>(mut self) -> Self {
        self.goals.add_plugin::<G>();
        self
    }

    /// Adds a local model, or replaces the model with the same name. The fields of its type are its parameters
    /// ([`throng::parameters`]), and its name in `avoid.NAME` is [`NAME`](throng::parameters::Parameters::NAME).
    pub fn model<M: LocalModel + Parameters + Default>(mut self) -> Self {
        self.models.add_plugin::<M>();
        self
    }

    /// Adds a behaviour, or replaces the behaviour with the same name. The fields of its type are its parameters
    /// ([`throng::parameters`]), and its name in `steer.NAME` is
    /// [`NAME`](throng::parameters::Parameters::NAME).
    pub fn behaviour<B: Behaviour + Parameters + 'static>(mut self) -> Self {
        self.behaviours.add_with(B::NAME, |behaviour: B, _: &SceneNames<'_>| Ok(behaviour.into()));
        self
    }

    /// Adds a vector field, or replaces the field with the same name. The fields of its type are its parameters, and its
    /// name in `flow.NAME` is [`NAME`](throng::parameters::Parameters::NAME). Its places are world coordinates.
    pub fn field<F: Field + Parameters + 'static>(mut self) -> Self {
        self.fields.add_plugin::<F>();
        self
    }

    /// Adds behaviours that need the names in the scene.
    pub fn behaviours(mut self, behaviours: Behaviours) -> Self {
        self.behaviours.extend(behaviours);
        self
    }

    /// Adds the rules of a game, for `rules = "NAME"`: see [`Rulebook::add`].
    pub fn rules<R: Rules + 'static>(
        mut self,
        name: impl Into<String>,
        make: impl Fn(&SceneNames<'_>) -> Result<R, Refused> + Send + Sync + 'static,
    ) -> Self {
        self.rules.add(name, make);
        self
    }

    /// Adds a scene: its name, and the text of its file. It replaces a scene with the same name.
    pub fn scene(mut self, name: impl Into<String>, text: impl Into<String>) -> Self {
        let (name, text) = (name.into(), text.into());
        let scenes = Arc::make_mut(&mut self.scenes);
        scenes.retain(|(known, _)| *known != name);
        scenes.push((name, text));
        self
    }

    /// Adds a scene made in code. If it cannot be written as a file ([`Scene::to_toml`]), its text is the error
    /// message.
    pub fn scene_in_code(self, name: impl Into<String>, scene: &Scene) -> Self {
        let text = scene.to_toml().unwrap_or_else(|error| error.to_string());
        self.scene(name, text)
    }

    /// Gives a scene what it can name.
    pub fn equip(&self, scene: &mut Scene) {
        scene.plugins.clone_from(self);
    }

    /// Returns the groups of the gallery, after the group of the program's own scenes: the name of each, and the names
    /// of its scenes.
    pub fn groups(&self) -> Vec<(&str, Vec<&str>)> {
        let own: Vec<&str> = self.scenes.iter().map(|(name, _)| name.as_str()).collect();
        let others =
            gallery::groups().map(|(group, names)| (group, names.filter(|name| !own.contains(name)).collect()));
        let others: Vec<(&str, Vec<&str>)> = others.collect();
        let own = Some((GROUP, own)).filter(|(_, names)| !names.is_empty());
        own.into_iter().chain(others).collect()
    }

    /// Returns the names of all scenes, in the order of their groups.
    pub fn names(&self) -> Vec<&str> {
        self.groups().into_iter().flat_map(|(_, names)| names).collect()
    }

    /// Returns the text of a scene: the program's scene, or else the gallery's.
    pub fn text(&self, name: &str) -> Option<&str> {
        let own = self.scenes.iter().find(|(known, _)| known == name);
        own.map(|(_, text)| text.as_str()).or_else(|| gallery::text(name))
    }

    /// Returns the title of a scene.
    pub fn title(&self, name: &str) -> Option<&str> {
        gallery::title_in(self.text(name)?)
    }

    /// Opens a scene of the program by its name, or anything that [`open`](crate::open) accepts, and gives it what
    /// it can name.
    ///
    /// # Errors
    /// Those of [`open`](crate::open).
    pub fn open(&self, scene: impl AsRef<Path>) -> Result<Scene, Error> {
        let path = scene.as_ref();
        let own = path.to_str().filter(|_| !path.exists()).and_then(|name| Some((name, self.text(name)?)));
        let mut scene = match own {
            Some((name, text)) => Scene::parse(&format!("{name}.toml"), text)?,
            None => crate::open(path)?.scene,
        };
        self.equip(&mut scene);
        Ok(scene)
    }

    /// Returns the JSON schema of scene files, as [`schema`](crate::schema()) does, with what was added and its
    /// parameters.
    pub fn schema(&self) -> Value {
        let mut root = crate::schema();
        let settings = SchemaSettings::default().with(|settings| settings.inline_subschemas = true);
        let mut generator = SchemaGenerator::new(settings);
        for (choice, added) in [
            ("Place", self.placements.plugin_schemas(&mut generator)),
            ("Goal", self.goals.plugin_schemas(&mut generator)),
            ("Avoid", self.models.plugin_schemas(&mut generator)),
            ("Steer", self.behaviours.plugin_schemas(&mut generator)),
            ("Flow", self.fields.plugin_schemas(&mut generator)),
        ] {
            if let Some(known) = root["$defs"][choice]["oneOf"].as_array_mut() {
                known.retain(|choice| added.iter().all(|(name, _)| choice["properties"].get(*name).is_none()));
                known.extend(added.into_iter().map(|(_, choice)| choice));
            }
        }
        root
    }
}

impl PartialEq for Plugins {
    /// Returns true: what a program knows is not part of a scene's content.
    fn eq(&self, _: &Self) -> bool {
        true
    }
}
