//! Measures other crowd simulators and throng on throng's reference work, in turns in a single run.

mod bevy;
mod contest;
mod crossing;
mod dodgy;
mod grid;
mod places;
mod plans;
mod python;
mod report;

use clap::Parser;
use report::Report;
use std::error::Error;
use std::path::PathBuf;

/// Measure other crowd simulators and throng on throng's reference work, in turns in a single run
#[derive(Parser)]
struct Arguments {
    /// Numbers of agents in the crossings, sorted and shuffled, and up to 10000 in the works with walls; none: only floor
    /// plans
    #[arg(long, value_name = "N", num_args = 0.., value_delimiter = ',', default_values_t = [1_000, 10_000, 100_000])]
    agents: Vec<usize>,

    /// Number of repeats
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u32).range(1..=1000))]
    repeat: u32,

    /// The Python with pyrvo and jupedsim; without it they are left out
    #[arg(long, value_name = "FILE")]
    python: Option<PathBuf>,

    /// A floor plan for JuPedSim and throng, and the lower left corner, width and height of its exit; can be given
    /// several times
    #[arg(long, value_name = "FILE.wkt X,Y,W,H", num_args = 2, allow_hyphen_values = true)]
    plan: Vec<String>,

    /// Number of agents on the floor plans
    #[arg(long, value_name = "N", default_value_t = 500)]
    people: u64,

    /// Write the figures as JSON to this file
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments = Arguments::parse();
    let mut report = Report::default();
    for &agents in &arguments.agents {
        for name in ["crossing", "crossing-shuffled"] {
            eprintln!("{name}, {agents}");
            report.add(name, agents, crossing::measure(name, agents, arguments.repeat, arguments.python.as_deref())?);
        }
    }
    if let Some(python) = &arguments.python {
        for &agents in arguments.agents.iter().filter(|&&agents| agents <= 10_000) {
            for name in ["evacuation", "city"] {
                eprintln!("{name}, {agents}");
                report.add(name, agents, places::measure(name, agents, arguments.repeat, python)?);
            }
        }
        for &agents in arguments.agents.iter().filter(|&&agents| agents <= 10_000) {
            eprintln!("jupedsim's own work, {agents}");
            let contestant = plans::own_work(python, agents)?;
            report.add("jupedsim-hall", agents, contest::measure(vec![contestant], 20, arguments.repeat)?);
        }
    }
    for plan in arguments.plan.chunks_exact(2) {
        eprintln!("{}", plan[0]);
        let contestants = plans::evacuation(&plan[0], &plan[1], arguments.people, arguments.python.as_deref())?;
        let stem = PathBuf::from(&plan[0]).file_stem().unwrap_or_default().to_string_lossy().into_owned();
        report.add(&stem, arguments.people as usize, contest::measure(contestants, 20, arguments.repeat)?);
    }
    print!("{}", report.markdown());
    if let Some(path) = &arguments.json {
        std::fs::write(path, format!("{:#}\n", report.json()))?;
    }
    Ok(())
}
