//! The program `throng-fuzz`: malformed inputs for every reader.

use clap::Parser;
use std::process::ExitCode;
use throng_fuzz::options::Options;
use throng_fuzz::{driver, worker};

fn main() -> ExitCode {
    let options = Options::parse();
    let result = if options.worker.is_some() { worker::run(&options) } else { driver::run(&options) };
    result.unwrap_or_else(|error| {
        eprintln!("error: {error}");
        ExitCode::from(2)
    })
}
