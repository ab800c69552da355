//! The local models, compared with their papers' definitions and with independent searches.

mod anticipation_velocity;
mod avo;
mod clearpath;
mod collision;
mod collision_free_speed;
mod common;
mod family;
mod hrvo;
mod kept;
mod orca;
mod outline;
mod power_law;
mod repulsion;
mod rvo;
mod rvo_lab;
mod social_force;
mod space;
mod walls;
