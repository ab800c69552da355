//! Steering: each behaviour against its definition, and what vehicles do that are steered by it.

mod combine;
mod cures;
mod group;
mod harness;
mod place;
mod rates;
mod single;
mod turned;
mod vehicle;
mod wander;
