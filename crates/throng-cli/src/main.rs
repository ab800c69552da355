//! The program `throng`: runs scenes, writes video, pictures and trajectories.

mod annotate;
mod args;
mod bench;
mod check;
mod choice;
mod columns;
mod compare;
mod completions;
mod explain;
mod failure;
mod field;
mod files;
mod info;
mod interrupt;
mod list;
mod look;
mod map;
mod measure;
mod models;
mod options;
mod out;
mod progress;
mod recorded;
mod replay;
mod report;
mod run;
mod schema;
mod seeds;
mod sheet;
mod show;
mod source;
mod swarms;
mod sweep;
mod threads;
mod tracks;
mod validate;

use args::{Arguments, Command};
use clap::Parser;
use out::Out;
use stats_alloc::{INSTRUMENTED_SYSTEM, StatsAlloc};
use std::alloc::System;
use std::process::ExitCode;

/// Counts allocations, so that `throng bench` can report bytes per agent.
#[global_allocator]
static MEMORY: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

fn main() -> ExitCode {
    throng_scene::hush();
    let arguments = Arguments::parse();
    let mut out = Out::new();
    let result = match &arguments.command {
        Command::Run(args) => run::run(args, &mut out),
        Command::Bench(args) => bench::bench(args, &mut out),
        Command::Compare(args) => compare::compare(args, &mut out),
        Command::Sweep(args) => sweep::sweep(args, &mut out),
        Command::List(args) => list::list(args, &mut out),
        Command::Check(args) => check::check(args, &mut out),
        Command::Show(args) => show::show(args, &mut out),
        Command::Sheet(args) => sheet::sheet(args, &mut out),
        Command::Info(args) => info::info(args, &mut out),
        Command::Measure(args) => measure::measure(args, &mut out),
        Command::Convert(args) => recorded::convert(args, &mut out),
        Command::Render(args) => recorded::render(args, &mut out),
        Command::Replay(args) => replay::replay(args, &mut out),
        Command::Validate(args) => validate::validate(args, &mut out),
        Command::Explain(args) => explain::explain(args, &mut out),
        #[cfg(feature = "studio")]
        Command::Studio(args) => {
            throng_studio::window::open(args.clone(), throng_scene::Plugins::new()).map_err(failure::Failure::Error)
        }
        Command::Schema => schema::schema(&mut out),
        Command::Completions(args) => completions::completions(args, &mut out),
    };
    let result = result.and_then(|()| out.flush());
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            if let Some(text) = failure.text() {
                out::complain(&format!("error: {text}"));
            }
            ExitCode::from(failure.code())
        }
    }
}
