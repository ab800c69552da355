//! Tests of the program `throng`, as a user runs it.

mod bench;
mod commands;
mod compare;
#[cfg(target_os = "linux")]
mod errors;
mod explain;
mod figures;
#[cfg(unix)]
mod interrupt;
mod measure;
mod mistakes;
#[cfg(target_os = "linux")]
mod pages;
#[cfg(target_os = "linux")]
mod pictures;
mod recorded;
mod reference;
mod replay;
mod run;
mod shared;
mod sheet;
mod sweep;
mod validate;
