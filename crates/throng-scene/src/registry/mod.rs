//! What scenes can name: local models, behaviours, rules, and scenes. throng registers its own through the same type as
//! a plug-in.

mod behaviours;
mod choice;
mod model;
mod models;
mod plugins;
mod read;
mod rulebook;

pub use behaviours::{Behaviours, Steer};
pub use choice::{Catalogue, Choice};
pub use model::Model;
pub(crate) use models::ChosenModel;
pub use models::{Avoid, Models};
pub use plugins::Plugins;
pub use rulebook::Rulebook;
