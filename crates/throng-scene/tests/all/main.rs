//! Tests of the library as its users call it.

mod damaged;
mod data;
mod docs;
mod drawings;
mod expectations;
mod fields;
mod flocks;
mod gallery;
mod games;
mod grounds;
mod import;
mod layout;
mod levels;
mod menge;
mod messages;
mod parity;
mod pictures;
mod plans;
mod plugins;
mod robust;
mod run;
mod schema;
mod set;
mod steering;
mod steering_places;
mod tune;
