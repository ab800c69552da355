//! The local models against their papers' definitions and against independent searches.

mod avo;
mod clearpath;
mod collision;
mod common;
mod family;
mod hrvo;
mod orca;
mod outline;
mod rvo;
mod rvo_lab;
mod space;
