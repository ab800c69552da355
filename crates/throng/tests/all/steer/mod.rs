//! Steering: each behaviour compared with its definition, and the motion of steered vehicles.

mod combine;
mod cures;
mod group;
mod harness;
mod kept;
mod map;
mod place;
mod rates;
mod reasons;
mod single;
mod slip;
mod turned;
mod vehicle;
mod wander;
