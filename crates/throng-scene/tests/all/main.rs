//! Tests of the library as its users call it.

mod about;
mod damaged;
mod data;
mod divided;
mod docs;
#[path = "../../../throng/tests/shared/draw.rs"]
#[allow(dead_code, reason = "other tests use more")]
mod draw;
mod drawings;
mod expectations;
mod fields;
mod flocks;
mod gallery;
mod games;
mod grounds;
mod import;
mod interventions;
mod lab;
mod layout;
mod lessons;
mod levels;
mod menge;
mod messages;
mod motors;
mod parameters;
mod parity;
mod pictures;
mod plans;
mod plugin_goals;
mod plugin_places;
mod plugins;
#[path = "../../../throng/tests/divided/cuts.rs"]
#[allow(dead_code, reason = "other tests use more")]
mod random_cuts;
mod robust;
mod run;
mod schema;
mod set;
mod steering;
mod steering_places;
#[path = "../../../throng/tests/divided/threads.rs"]
#[allow(dead_code, reason = "other tests use more")]
mod threads;
mod tune;
