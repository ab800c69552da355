//! The measurements as a table and as JSON.

use super::machine::{Machine, profile};
use super::measure::MeasuredRun;
use crate::columns::aligned;
use crate::report::number;
use serde_json::{Map, Value, json};
use throng::Stage;

const HEADS: [&str; 8] = ["work", "agents", "threads", "guard", "ns/agent-step", "least", "cpu", "bytes/agent"];

fn heads() -> Vec<String> {
    let (left, bytes) = HEADS.split_at(7);
    let stages = Stage::ALL.map(Stage::name);
    left.iter().chain(&stages).chain(bytes).map(|head| (*head).to_owned()).collect()
}

fn cells(run: &MeasuredRun) -> Vec<String> {
    let shown = |value: f64| match value.is_finite() {
        true => format!("{value:.*}", if value < 10.0 { 1 } else { 0 }),
        false => "–".to_owned(),
    };
    let mut cells = vec![run.work.clone(), run.agents.to_string(), run.threads.to_string(), run.guard.to_owned()];
    cells.extend([run.ns(|lap| lap.wall), run.least_ns(), run.cpu_ns()].map(shown));
    cells.extend(Stage::ALL.map(|stage| shown(run.ns(|lap| lap.stages[stage as usize]))));
    cells.push(shown(run.bytes));
    cells
}

/// Returns the table for the terminal.
pub fn text(machine: &Machine, runs: &[MeasuredRun]) -> String {
    let lines: Vec<Vec<String>> = std::iter::once(heads()).chain(runs.iter().map(cells)).collect();
    format!("{}\n{}", machine.line(), aligned(&lines))
}

/// Returns the table in Markdown.
pub fn markdown(machine: &Machine, runs: &[MeasuredRun]) -> String {
    let row = |cells: Vec<String>| format!("| {} |\n", cells.join(" | ").replace('<', "&lt;"));
    let rule = format!("|---|{}\n", "---:|".repeat(heads().len() - 1));
    let rows: String = runs.iter().map(|run| row(cells(run))).collect();
    format!("{}\n\n{}{rule}{rows}", machine.line(), row(heads()))
}

/// Returns the runs as JSON. `throng bench --help` describes the keys.
pub fn json(machine: &Machine, runs: &[MeasuredRun]) -> Value {
    let run = |run: &MeasuredRun| {
        let stage = |stage: Stage| (stage.name().to_owned(), number(run.ns(|lap| lap.stages[stage as usize])));
        json!({
            "work": run.work,
            "agents": run.agents,
            "threads": run.threads,
            "guard": run.guard,
            "ns_per_agent_step": number(run.ns(|lap| lap.wall)),
            "least_ns_per_agent_step": number(run.least_ns()),
            "cpu_ns_per_agent_step": number(run.cpu_ns()),
            "stages": Map::from_iter(Stage::ALL.map(stage)),
            "cpu_per_simulated_second": number(run.cpu_per_second()),
            "bytes_per_agent": number(run.bytes),
            "warm_up": run.warm_up,
            "steps": run.laps[0].steps,
            "repeats": run.laps.len(),
            "step_seconds": run.step,
            "agent_steps": run.laps[0].agent_steps,
            "version": env!("CARGO_PKG_VERSION"),
            "profile": profile(),
            "machine": machine.json(),
        })
    };
    runs.iter().map(run).collect()
}
