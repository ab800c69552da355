//! What scenes can name: local models, behaviours, fields, rules, and scenes. throng registers its own through the same type as
//! a plug-in.

mod behaviours;
mod choice;
mod entries;
mod field_context;
mod fields;
mod given;
mod given_parameters;
mod model;
mod models;
mod names;
mod parts;
mod plugins;
mod rulebook;
mod schema;

pub use behaviours::{Behaviours, Steer};
pub(crate) use choice::described;
pub use choice::{Catalogue, Choice, Described};
pub(crate) use field_context::{BuildField, FieldContext, FieldScene};
pub use fields::{Fields, Flow};
pub(crate) use given::refused;
pub use given_parameters::GivenParameters;
pub use model::Model;
pub(crate) use models::ChosenModel;
pub use models::{Avoid, Models};
pub(crate) use names::Names;
pub use plugins::Plugins;
pub use rulebook::Rulebook;
