//! Steering: each behaviour against its definition, and what vehicles do that are steered by it.

mod harness;
mod single;
mod vehicle;
