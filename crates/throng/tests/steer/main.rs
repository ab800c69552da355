//! Steering: each behaviour against its definition, and what vehicles do that are steered by it.

mod combine;
mod harness;
mod single;
mod vehicle;
