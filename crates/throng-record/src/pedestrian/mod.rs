//! Measures of pedestrians: density, speed, flow, lane formation, contacts, motion and evacuation times.
//!
//! `docs/measures.md` defines each measure and its source, and compares the results with PedPy and with recordings of
//! pedestrians. All measures apply to [`People`], on the ground, in metres and seconds. A velocity is the displacement
//! from some rows before to some rows after over the time between them ([`velocities`]).

mod area;
mod cells;
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
pub use motion::PeopleMotion;
pub use people::{People, PeopleMoment, PersonRow, Walk, median};
pub use speed::{Border, Velocities, accelerations, velocities};
pub use voronoi::Ground;
pub use ways::Ways;
