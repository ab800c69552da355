//! Runs one crowd on many machines over MPI, with the bits of one machine.
//!
//! The engine divides the crowd and computes ([`throng::halo`]). This program is the transport: [`ranks`] carries packets,
//! [`run`] sets up and steps, [`clocks`] measure and balance, [`parts`] and [`checkpoint`] write files, [`people`] reads a crowd that no single machine
//! has to hold, and [`city`] makes one.

mod args;
mod checkpoint;
mod city;
mod clocks;
mod failure;
mod memory;
mod parts;
mod people;
mod ranks;
mod report;
mod run;
mod signals;
mod threads;

use args::{Command, Program};
use clap::Parser;
use failure::Failure;
use mpi::Threading;
use mpi::traits::Communicator;
use ranks::Ranks;
use std::process::ExitCode;

fn main() -> ExitCode {
    let Some((universe, _)) = mpi::initialize_with_threading(Threading::Funneled) else {
        eprintln!("throng-mpi: MPI is initialised already");
        return ExitCode::from(2);
    };
    let all = universe.world();
    // a rank that panics ends the job: else it would wait for the others at its end
    let report = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        report(panic);
        std::process::abort();
    }));
    let first = all.rank() == 0;
    let program = match Program::try_parse() {
        Ok(program) => program,
        Err(error) => {
            if first {
                // an error that cannot be printed has no reader
                let _ = error.print();
            }
            return ExitCode::from(error.exit_code() as u8);
        }
    };
    let rank = all.rank();
    let result = match program.command {
        Command::Run(args) => run::run(&args, Ranks::new(all)),
        Command::City(args) if first => city::write(&args),
        Command::City(_) => Ok(()),
    };
    let Err(failure) = result else { return ExitCode::SUCCESS };
    match &failure {
        Failure::Here(text) => eprintln!("throng-mpi: rank {rank}: {text}"),
        Failure::Interrupted if first => eprintln!("throng-mpi: interrupted; --resume goes on from here"),
        Failure::Interrupted | Failure::Elsewhere => {}
    }
    ExitCode::from(failure.code())
}
