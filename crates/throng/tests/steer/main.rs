//! Steering: each behaviour against its definition, and what vehicles do that are steered by it.

mod combine;
mod group;
mod harness;
mod place;
mod reasons;
mod single;
mod turned;
mod vehicle;
