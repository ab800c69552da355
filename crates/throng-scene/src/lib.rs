//! What a scene says: scene files, importers of floor plans and of other programs' scenarios, and the gallery.
//!
//! A [`Scene`] is plain data. Everything a scene file (TOML) can say can be said in code, and the other way round:
//!
//! ```
//! use throng_scene::{Goal, Group, Place, Ring, Scene};
//!
//! let in_code = Scene {
//!     title: "Ring of 36".into(),
//!     groups: vec![Group {
//!         name: "walkers".into(),
//!         count: Some(36),
//!         place: Place::Ring(Ring { radius: 7.0, ..Ring::default() }),
//!         goal: Some(Goal::Opposite(Default::default())),
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
//! `docs/scenes.md` describes every key, `docs/steering.md` those of steering. Files use degrees for angles, metres and seconds for the rest.
//!
//! | to do | use |
//! |---|---|
//! | read a scene file | [`Scene::load`], or [`open`] for anything that can be a scene |
//! | change one value, as the program's `--set` does | [`Scene::set`] |
//! | try another local model | [`Model`], [`Scene::with_model`] |
//! | make the world | [`Scene::build`] |
//! | say what agents steer by; bring behaviours of your own | [`steer`], [`Behaviours`], [`Cast`] |
//! | bring all that along under names, scenes too | [`Plugins`] |
//! | play a game; bring rules of your own | [`Scene::rules`], [`Rulebook`] |
//! | look at what would be built | [`Scene::plan`] |
//! | check what the scene expects | [`Watch`], [`Verdict`] |
//! | the scenes that come with the project | [`gallery`] |
//! | a floor plan, a JuPedSim scenario, a project of Menge's | [`import`] |
//! | the JSON schema of scene files | [`schema()`] |

mod build;
mod caught;
mod error;
mod file;
pub mod gallery;
mod games;
mod geometry;
pub mod import;
mod plugins;
mod random;
mod scene;
mod watch;

pub use build::{Built, BuiltGroup, MAX_AGENTS, MAX_COORDINATE, Plan, PlannedAgent, PlannedField, PlannedJourney};
pub use caught::{caught, hush};
pub use error::{Error, Kind};
pub use import::{Imported, open};
pub use plugins::Plugins;
pub use random::{Purpose, Random};
pub use scene::*;
pub use watch::{Check, Figure, Verdict, Watch};

/// The examples of the README, compiled and run as tests.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
