//! The contents of a scene, as plain data: one concept a file.

mod about;
mod annotate;
mod annulus;
mod body;
mod expect;
pub mod flow;
pub(crate) mod goal;
mod ground;
mod group;
mod intervention;
mod motor;
mod mover;
mod names;
mod neighbours;
mod number;
mod obstacle;
pub(crate) mod place;
mod schema;
mod source;
pub mod steer;
mod surface;
mod time;
mod view;
mod wrap_around;

pub(crate) use about::LONGEST;
pub use about::{About, AboutPreset, AboutSlider};
pub use annotate::{Annotate, Annotation};
pub use annulus::{Annulus, Lap};
pub use body::{Body, Sides};
pub use expect::{Arrived, DistanceExpect, Expect, FigureExpect, FlowExpect, GroupExpect, To, When};
pub use flow::Field;
pub use goal::{
    AirGoal, AreaGoal, ChoiceGoal, CycleGoal, ExitGoal, JourneyGoal, NearestGoal, Opposite, PointGoal, PointsGoal,
    Shift, Stop, Weighted,
};
pub use ground::{Area, PlanFile, Rectangle, Region, Walkable};
pub use group::{Group, Preset, Speed};
pub use intervention::{AddAgents, Change, Intervention, Led, NewGoal, Push};
pub use motor::Motor;
pub use mover::{Keyframe, Mover};
pub use names::SceneNames;
pub use neighbours::Neighbours;
pub use number::{Normal, Number};
pub use obstacle::{As, Circle, Obstacle, Shape};
pub use place::{
    DiscPlace, Grid, Line, PointPlace, PointsPlace, PolygonPlace, RectanglePlace, Ring, Sphere, WalkablePlace,
};
pub use schema::schema;
pub use source::Source;
pub use surface::{
    Ball, Block, Column, Form, HalfSpace, HeightField, MeshFile, Pathway, Rod, SeenFrom, Sheet, Surface, Up,
};
pub use time::{SubSteps, Time, Until};
pub use view::{AgentShape, Camera, CameraKey, Colour, DrawnFields, FieldLayer, Projection, StageSet, Sun, View};
pub use wrap_around::WrapAround;

pub use crate::file::Origin;
use crate::registry::Plugins;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A point, `[x, y]` in metres, world coordinates.
pub type Point = [f64; 2];

/// A point in space, `[x, y, z]` in metres, z up from the ground.
pub type SpacePoint = [f64; 3];

/// A scene: the contents of a scene file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// A title of one line.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub title: String,
    /// What viewers read about it, and what they can try.
    #[serde(default, skip_serializing_if = "About::is_empty")]
    pub about: About,
    /// Seed of all random numbers. Limit: 0 to 9223372036854775807, the largest whole number of a TOML file.
    #[serde(default = "default_seed")]
    pub seed: u64,
    /// The step, and the end of the scene.
    #[serde(default)]
    pub time: Time,
    /// The walkable ground. Without it, all ground is walkable.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub walkable: Option<Walkable>,
    /// The obstacles.
    #[serde(default, rename = "obstacle", skip_serializing_if = "Vec::is_empty")]
    pub obstacles: Vec<Obstacle>,
    /// Surfaces that behaviours steer by.
    #[serde(default, rename = "surface", skip_serializing_if = "Vec::is_empty")]
    pub surfaces: Vec<Surface>,
    /// Paths that behaviours steer by.
    #[serde(default, rename = "path", skip_serializing_if = "Vec::is_empty")]
    pub paths: Vec<Pathway>,
    /// Fields that guide groups.
    #[serde(default, rename = "field", skip_serializing_if = "Vec::is_empty")]
    pub fields: Vec<Field>,
    /// The groups of agents.
    #[serde(default, rename = "group", skip_serializing_if = "Vec::is_empty")]
    pub groups: Vec<Group>,
    /// Obstacles that move by a script.
    #[serde(default, rename = "mover", skip_serializing_if = "Vec::is_empty")]
    pub movers: Vec<Mover>,
    /// Changes that are made while the scene runs.
    #[serde(default, rename = "intervention", skip_serializing_if = "Vec::is_empty")]
    pub interventions: Vec<Intervention>,
    /// The name of the rules of a game. Without it, the scene has no rules.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rules: Option<String>,
    /// The look of its pictures.
    #[serde(default, skip_serializing_if = "View::is_default")]
    pub view: View,
    /// What a run must show.
    #[serde(default, skip_serializing_if = "Expect::is_default")]
    pub expect: Expect,
    /// What the scene can name. It is not part of the scene's content.
    #[serde(skip)]
    #[schemars(skip)]
    pub plugins: Plugins,
    /// The source of the scene: relative file names and the positions of errors refer to it. It is not part of the
    /// scene's content: scenes that differ only in it are equal.
    #[serde(skip)]
    #[schemars(skip)]
    pub origin: Origin,
}

fn default_seed() -> u64 {
    1
}

/// The part of a run that has passed at its typical moment, if the scene does not name one.
const TELLING: f64 = 1.0 / 3.0;

impl Scene {
    /// Returns the most typical moment of the scene, seconds: `view.moment`, or a third of the run.
    pub fn moment(&self) -> f64 {
        self.view.moment.unwrap_or_else(|| TELLING * self.expect.within.unwrap_or(self.time.limit))
    }
}

impl Default for Scene {
    fn default() -> Self {
        Self {
            title: String::new(),
            about: About::default(),
            seed: default_seed(),
            time: Time::default(),
            walkable: None,
            obstacles: vec![],
            surfaces: vec![],
            paths: vec![],
            fields: vec![],
            groups: vec![],
            movers: vec![],
            interventions: vec![],
            rules: None,
            view: View::default(),
            expect: Expect::default(),
            plugins: Plugins::default(),
            origin: Origin::default(),
        }
    }
}
