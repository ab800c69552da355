//! The world as a whole: its promises, on scenes that nothing was tuned to, against checks of their own.

mod anywhere;
mod bad_starts;
mod bodies;
mod calm;
mod changes;
mod common;
mod determinism;
mod doors;
mod entry;
mod explain;
mod flocks;
mod governed;
mod instructions;
mod journeys;
mod limits;
mod manners;
mod mistakes;
mod models;
mod movers;
mod narrow;
mod obstacles;
mod oracle;
mod order;
mod overlap;
#[path = "../shared/polygons.rs"]
mod polygons;
mod rules;
mod saved;
mod scenes;
mod solids;
mod space;
mod steering;
mod stranded;
mod stuck;
mod sub_steps;
mod tuned;
