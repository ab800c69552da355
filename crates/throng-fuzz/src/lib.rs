//! Fuzzing: malformed inputs for every reader of throng. A reader may reject an input. It may not panic, abort, or
//! exceed a limit of time or memory.
//!
//! | part | where |
//! |---|---|
//! | targets: a function over bytes for each kind of input | [`targets`] |
//! | seed inputs, in `corpus/TARGET` and elsewhere in the repository | [`corpus`] |
//! | mutants: functions of corpus, seed and number | [`mutate`] |
//! | a target in a process of its own | [`worker`] |
//! | all targets: limits, inputs that broke a limit, the table | [`driver`] |
//!
//! The worker measures heap memory with the allocator of the crate `cap`, which refuses allocations beyond the limit.
//! It reads resident memory, which includes that of C libraries, from the system. Time is processor time, so that other
//! programs do not count.

pub mod corpus;
pub mod driver;
pub mod memory;
pub mod mutate;
pub mod options;
mod progress;
mod rng;
pub mod targets;
pub mod worker;

pub use targets::{TARGETS, Target};
