//! What scenes can name: local models, behaviours, fields, rules, and scenes. throng registers its own through the same type as
//! a plug-in.

mod behaviours;
mod choice;
mod entries;
mod fields;
mod model;
mod models;
mod plugins;
mod read;
mod rulebook;

pub use behaviours::{Behaviours, Steer};
pub(crate) use choice::described;
pub use choice::{Catalogue, Choice, Described};
pub use fields::{Fields, Flow};
pub use model::Model;
pub(crate) use models::ChosenModel;
pub use models::{Avoid, Models};
pub use plugins::Plugins;
pub use rulebook::Rulebook;
