//! What a run says at its end.

use crate::args::RunArgs;
use crate::failure::Failure;
use crate::run::VERSION;
use serde_json::json;
use std::io::Write;
use std::time::Duration;
use throng::Summary;
use throng_record::{Output, OutputError};

/// What a run has cost: seconds, means over the ranks; bytes sent by all ranks; how often the ground was divided; and
/// the peak of the memory of the largest rank and of all ranks, bytes.
pub struct Figures {
    pub stepping: f64,
    pub computing: f64,
    pub waiting: f64,
    pub sent: u64,
    pub divisions: u32,
    pub largest: u64,
    pub memory: u64,
}

/// Prints the summary.
pub fn print(summary: &Summary, hash: u64, ranks: usize, figures: &Figures, wall: Duration) {
    let Summary { agents, arrived, removed, time, steps, agent_steps, .. } = summary;
    let per_step = figures.computing * ranks as f64 * 1e9 / (*agent_steps).max(1) as f64;
    println!("{time:.2} s simulated in {steps} steps by {ranks} ranks");
    println!("  agents     {arrived} of {agents} arrived, {removed} left by exits, {} overlaps", summary.overlaps);
    println!("  state      {hash:016x}");
    println!(
        "  computing  {:.1} s in all; a rank computes {:.1} s and waits {:.1} s; {per_step:.0} ns an agent-step; {:.1} MB sent",
        wall.as_secs_f64(),
        figures.computing,
        figures.waiting,
        figures.sent as f64 / 1e6,
    );
    println!("  ground     divided {} times", figures.divisions);
    println!(
        "  memory     {:.2} GB on the largest rank, {:.2} GB in all; {} bytes an agent",
        figures.largest as f64 / 1e9,
        figures.memory as f64 / 1e9,
        figures.memory / (*agents).max(1) as u64,
    );
}

/// Writes `run.json`.
///
/// # Errors
/// The file cannot be written.
pub fn write(args: &RunArgs, summary: &Summary, hash: u64, ranks: usize, figures: &Figures) -> Result<(), Failure> {
    let Figures { stepping, computing, waiting, sent, divisions, largest, memory } = figures;
    let result = json!({
        "version": VERSION,
        "scene": args.scene.display().to_string(),
        "ranks": ranks,
        "state_hash": format!("{hash:016x}"),
        "summary": summary,
        "step_seconds": stepping,
        "computing_seconds": computing,
        "waiting_seconds": waiting,
        "bytes_sent": sent,
        "divisions": divisions,
        "largest_rank_bytes": largest,
        "memory_bytes": memory,
    });
    let path = args.output.join("run.json");
    let mut output = Output::create(&path)?;
    let written = output.write_all(format!("{result:#}\n").as_bytes());
    written.map_err(|error| OutputError::new(&path, error))?;
    Ok(output.finish()?)
}
