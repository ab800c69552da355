//! What scenes can name: placements, goals, local models, behaviours, fields, rules, and scenes. throng registers its own through the same type as
//! a plug-in.

mod behaviours;
mod choice;
mod entries;
mod field_context;
mod fields;
mod given;
mod given_parameters;
mod goal_rule;
mod goal_tree;
mod goals;
mod model;
mod models;
mod names;
mod parts;
mod placement;
mod placements;
mod plugins;
mod rulebook;
mod schema;

pub use behaviours::{Behaviours, Steer};
pub use choice::{Catalogue, Choice, Described};
pub(crate) use choice::{described, schema_of_value};
pub(crate) use field_context::{BuildField, FieldContext, FieldScene};
pub use fields::{Fields, Flow};
pub(crate) use given::refused;
pub use given_parameters::GivenParameters;
pub use goal_rule::{AgentJourney, AgentStart, GoalRule};
pub(crate) use goal_tree::{GoalOfEach, GoalTree};
pub(crate) use goals::{BuildGoal, GoalContext};
pub use goals::{Goal, Goals};
pub use model::Model;
pub(crate) use models::ChosenModel;
pub use models::{Avoid, Models};
pub(crate) use names::Names;
pub use placement::Placement;
pub(crate) use placements::{BuildPlacement, ChosenPlacement, PlacementContext};
pub use placements::{Place, Placements};
pub use plugins::Plugins;
pub use rulebook::Rulebook;
