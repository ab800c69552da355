//! What a scene can say: plain data, one idea a file.

mod annotate;
mod annulus;
mod avoid;
mod behaviours;
mod body;
mod cast;
mod expect;
pub mod flow;
mod goal;
mod ground;
mod group;
mod model;
mod mover;
mod neighbours;
mod number;
mod obstacle;
mod place;
mod rulebook;
mod schema;
mod source;
pub mod steer;
mod surface;
mod time;
mod vehicle;
mod view;

pub use annotate::{Annotate, Annotation};
pub use annulus::{Annulus, Lap};
pub use avoid::{
    AnticipationVelocity, Avo, Avoid, BuiltFrom, Clearpath, CollisionFreeSpeed, Hrvo, Moussaid2009, Orca, Orca3d,
    PowerLaw, Rvo, RvoLab, SocialForce, Unavoiding, Vo,
};
pub use behaviours::Behaviours;
pub(crate) use behaviours::Unmade;
pub use body::{Body, Sides};
pub use cast::Cast;
pub use expect::{Arrived, DistanceExpect, Expect, FigureExpect, FlowExpect, GroupExpect, To, When};
pub use flow::{Field, Flow};
pub use goal::{AirGoal, Goal, Opposite, PointGoal, PointsGoal, Shift, Stop, Weighted};
pub use ground::{Area, PlanFile, Rectangle, Region, Walkable};
pub use group::{Group, Preset, Speed};
pub use model::Model;
pub use mover::{Keyframe, Mover};
pub use neighbours::Neighbours;
pub use number::{Normal, Number};
pub use obstacle::{As, Circle, Obstacle, Shape};
pub use place::{DiscPlace, Grid, Line, Place, PolygonPlace, RectanglePlace, Ring, Sphere, WalkablePlace};
pub use rulebook::Rulebook;
pub use schema::schema;
pub use source::Source;
pub use steer::Steer;
pub use surface::{
    Ball, Block, Column, Form, HalfSpace, HeightField, MeshFile, Pathway, Rod, SeenFrom, Sheet, Surface, Up,
};
pub use time::{SubSteps, Time, Until};
pub use vehicle::{Forces, Integrator, Vehicle, VehicleKind, WrapAround};
pub use view::{Camera, Colour, Mark, Projection, View};

pub use crate::file::Origin;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A point, `[x, y]` in metres, world coordinates.
pub type Point = [f64; 2];

/// A point in space, `[x, y, z]` in metres, z up from the ground.
pub type Spot = [f64; 3];

/// Everything a scene file says.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// One line for people.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub title: String,
    /// More, for people.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub description: String,
    /// Seed of everything random. Limit: 0 to 9223372036854775807, the largest whole number of a TOML file.
    #[serde(default = "default_seed")]
    pub seed: u64,
    /// Step, and when the scene ends.
    #[serde(default)]
    pub time: Time,
    /// Ground that can be walked on; without it, everywhere.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub walkable: Option<Walkable>,
    /// What is solid.
    #[serde(default, rename = "obstacle", skip_serializing_if = "Vec::is_empty")]
    pub obstacles: Vec<Obstacle>,
    /// Surfaces that behaviours steer by.
    #[serde(default, rename = "surface", skip_serializing_if = "Vec::is_empty")]
    pub surfaces: Vec<Surface>,
    /// Paths that behaviours steer by.
    #[serde(default, rename = "path", skip_serializing_if = "Vec::is_empty")]
    pub paths: Vec<Pathway>,
    /// Fields that lead groups.
    #[serde(default, rename = "field", skip_serializing_if = "Vec::is_empty")]
    pub fields: Vec<Field>,
    /// Who is there.
    #[serde(default, rename = "group", skip_serializing_if = "Vec::is_empty")]
    pub groups: Vec<Group>,
    /// What moves by itself.
    #[serde(default, rename = "mover", skip_serializing_if = "Vec::is_empty")]
    pub movers: Vec<Mover>,
    /// The name of the rules of its game. Without it, agents do what they do by themselves.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rules: Option<String>,
    /// How pictures of it look.
    #[serde(default, skip_serializing_if = "View::is_default")]
    pub view: View,
    /// What it must show.
    #[serde(default, skip_serializing_if = "Expect::is_default")]
    pub expect: Expect,
    /// Behaviours that a program brings along, for `steer.custom`. Not part of what the scene says either.
    #[serde(skip)]
    #[schemars(skip)]
    pub behaviours: Behaviours,
    /// The rules that it can name: the gallery's, and what a program brings along. Not part of what the scene says either.
    #[serde(skip)]
    #[schemars(skip)]
    pub rulebook: Rulebook,
    /// Where it was read from: what relative file names and the places of errors refer to. Not part of what the
    /// scene says: scenes that differ only in this are equal.
    #[serde(skip)]
    #[schemars(skip)]
    pub origin: Origin,
}

fn default_seed() -> u64 {
    1
}

/// Of a run that nobody chose a moment of, this much is over when one looks.
const TELLING: f64 = 1.0 / 3.0;

impl Scene {
    /// The moment that tells what it is about, seconds: what `view.moment` says, or a third of the run.
    pub fn moment(&self) -> f64 {
        self.view.moment.unwrap_or_else(|| TELLING * self.expect.within.unwrap_or(self.time.limit))
    }
}

impl Default for Scene {
    fn default() -> Self {
        Self {
            title: String::new(),
            description: String::new(),
            seed: default_seed(),
            time: Time::default(),
            walkable: None,
            obstacles: vec![],
            surfaces: vec![],
            paths: vec![],
            fields: vec![],
            groups: vec![],
            movers: vec![],
            rules: None,
            view: View::default(),
            expect: Expect::default(),
            behaviours: Behaviours::default(),
            rulebook: Rulebook::default(),
            origin: Origin::default(),
        }
    }
}
