//! What scenes can name: local models, behaviours, fields, rules, and scenes. throng registers its own through the same type as
//! a plug-in.

mod behaviours;
mod choice;
mod entries;
mod fields;
mod given;
mod given_parameters;
mod model;
mod models;
mod names;
mod plugins;
mod rulebook;
mod schema;

pub use behaviours::{Behaviours, Steer};
pub(crate) use choice::described;
pub use choice::{Catalogue, Choice, Described};
pub use fields::{Fields, Flow};
pub(crate) use given::refused;
pub use given_parameters::GivenParameters;
pub use model::Model;
pub(crate) use models::ChosenModel;
pub use models::{Avoid, Models};
pub(crate) use names::Names;
pub use plugins::Plugins;
pub use rulebook::Rulebook;
