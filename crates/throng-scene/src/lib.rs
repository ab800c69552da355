//! Scenes: scene files, importers of floor plans and of other programs' scenarios, and the gallery.
//!
//! A [`Scene`] is plain data. Code can set everything that a scene file (TOML) can set, and a file everything that code
//! can.
//!
//! ```
//! use throng_scene::{Group, Opposite, Ring, Scene};
//!
//! let in_code = Scene {
//!     title: "Ring of 36".into(),
//!     groups: vec![Group {
//!         name: "walkers".into(),
//!         count: Some(36),
//!         place: Ring { radius: 7.0, ..Ring::default() }.into(),
//!         goal: Some(Opposite::default().into()),
//!         ..Group::default()
//!     }],
//!     ..Scene::default()
//! };
//! let in_a_file: Scene = r#"
//!     title = "Ring of 36"
//!
//!     [[group]]
//!     name = "walkers"
//!     count = 36
//!     place.ring = { radius = 7.0 }
//!     goal.opposite = {}
//! "#
//! .parse()?;
//! assert_eq!(in_code, in_a_file);
//!
//! let (world, built) = in_code.build()?;
//! assert_eq!(built.agents, 36);
//! # drop(world);
//! # Ok::<(), throng_scene::Error>(())
//! ```
//!
//! `docs/scenes.md` describes every key, `docs/steering.md` the steering keys. Files use degrees for angles, metres and
//! seconds for everything else.
//!
//! | to do | use |
//! |---|---|
//! | read a scene file | [`Scene::load`], or [`open`] for anything that can be a scene |
//! | change one value, as the program's `--set` does | [`Scene::set`] |
//! | try another local model | [`Model`], [`Scene::with_model`] |
//! | make the world | [`Scene::build`] |
//! | define what agents steer by; add your own behaviours | [`steer`], [`Behaviours`], [`SceneNames`] |
//! | put agents where you want; add your own placements | [`Place`], [`Placement`] |
//! | send agents where you want; add your own goals | [`Goal`], [`GoalRule`] |
//! | register models, behaviours, rules and scenes under names | [`Plugins`] |
//! | play a game; add your own rules | [`Scene::rules`], [`Rulebook`] |
//! | intervene in a running scene, and keep what was done | [`Intervention`], [`Interventions`] |
//! | see what would be built | [`Scene::plan`] |
//! | check the expectations of a scene | [`Expectations`], [`Outcome`] |
//! | the scenes that come with the project | [`gallery`] |
//! | teach with scenes, questions and exercises | [`lessons`] |
//! | import a floor plan, a JuPedSim scenario or a Menge project | [`import`] |
//! | read other TOML files with the same messages | [`TomlFile`] |
//! | the JSON schema of scene files | [`schema()`] |

mod assemble;
mod caught;
mod error;
mod expectations;
mod file;
pub mod gallery;
mod games;
mod geometry;
pub mod import;
pub mod lessons;
mod random;
mod registry;
mod scene;

pub use assemble::{
    Built, BuiltGroup, Interventions, MAX_AGENTS, MAX_COORDINATE, Plan, PlannedAgent, PlannedField, PlannedJourney,
};
pub use caught::{caught, hush};
pub use error::{Error, Kind, abridged};
pub use expectations::{Expectation, Expectations, Figure, Outcome, WalkingSpeed};
pub use file::{TomlFile, TomlStep};
pub use import::{Imported, open};
pub use random::{Purpose, Random};
pub use registry::{
    AgentJourney, AgentStart, Avoid, Behaviours, Catalogue, Choice, Described, Fields, Flow, GivenParameters, Goal,
    GoalRule, Goals, Model, Models, Place, Placement, Placements, Plugins, Rulebook, Steer,
};
pub use scene::*;

/// The examples of the README, compiled and run as tests.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
