//! Tests of the program `throng`, as a user runs it.

mod commands;
#[cfg(unix)]
mod interrupt;
mod mistakes;
mod run;
mod shared;
