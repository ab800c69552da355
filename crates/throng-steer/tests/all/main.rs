//! Steering: each behaviour compared with its definition, alone and together.

mod combine;
mod cures;
#[path = "../../../throng/tests/shared/draw.rs"]
mod draw;
mod group;
mod harness;
mod kept;
mod map;
mod place;
mod rates;
mod reasons;
#[path = "../../../throng/tests/shared/kept.rs"]
mod results;
mod single;
mod slip;
mod swarm;
mod turned;
#[path = "../../../throng/tests/shared/vehicles.rs"]
mod vehicles;
mod wander;
