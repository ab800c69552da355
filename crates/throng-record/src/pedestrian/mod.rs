//! Measures of pedestrians: density, speed, flow, lanes, how near they come, how they move and when they have left.
//!
//! `docs/measures.md` defines each, says where it is from, and compares with PedPy and with what real people did. What they have in
//! common: [`People`], on the ground, in metres and seconds; a velocity is that from some rows before to some rows after
//! ([`velocities`]).

mod area;
mod contact;
mod crossing;
mod figures;
mod groups;
pub mod lanes;
mod microscopic;
mod motion;
mod people;
pub mod replay;
mod speed;
pub mod voronoi;
mod ways;

pub use area::Area;
pub use contact::{Contacts, NEAR_MISS, time_to_collision};
pub use crossing::{Crossing, Line, count, flow, flows, steady_flow};
pub use figures::{Figures, Inside, Instant, Question};
pub use groups::groups;
pub use microscopic::Microscopic;
pub use motion::Motion;
pub use people::{Here, Moment, People, Walk, median};
pub use speed::{Border, Velocities, accelerations, velocities};
pub use voronoi::Ground;
pub use ways::Ways;
