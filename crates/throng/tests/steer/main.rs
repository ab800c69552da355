//! Steering: each behaviour against its definition, and what vehicles do that are steered by it.

mod combine;
mod cures;
mod group;
mod harness;
mod map;
mod place;
mod rates;
mod reasons;
mod single;
mod slip;
mod turned;
mod vehicle;
mod wander;
