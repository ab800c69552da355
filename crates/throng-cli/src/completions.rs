//! `throng completions`: completion scripts for shells.

use crate::args::{Arguments, CompletionsArgs};
use crate::failure::Failure;
use crate::out::Out;
use clap::CommandFactory;

/// Writes the completion script of a shell to standard output.
///
/// # Errors
/// Standard output cannot be written.
pub fn completions(args: &CompletionsArgs, out: &mut Out) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Arguments::command(), "throng", &mut script);
    out.text(&script)
}
