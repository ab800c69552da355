//! Reports the results as Markdown and as JSON.

use crate::contest::Outcome;
use serde_json::{Value, json};
use std::fmt::Write;

/// All results, by work.
#[derive(Default)]
pub struct Report {
    works: Vec<(String, usize, Vec<Outcome>)>,
}

impl Report {
    /// Adds the results of a work.
    pub fn add(&mut self, work: &str, agents: usize, outcomes: Vec<Outcome>) {
        self.works.push((work.to_owned(), agents, outcomes));
    }

    /// Returns a table with a row per contestant and work: medians, and the ratio to throng's, the first contestant of
    /// a work.
    pub fn markdown(&self) -> String {
        let mut out = String::from(
            "| work | agents | simulator | CPU ns per agent-step | least | times throng's | CPU s per simulated s |\n\
             |---|---:|---|---:|---:|---:|---:|\n",
        );
        for (work, agents, outcomes) in &self.works {
            for outcome in outcomes {
                let (ns, least) = (outcome.median(), least(outcome));
                let ratio = self.ratio(outcomes, outcome).map_or("–".into(), |ratio| format!("{ratio:.2}"));
                let (name, cpu) = (&outcome.name, outcome.cpu_per_second);
                let _ = writeln!(out, "| {work} | {agents} | {name} | {ns:.0} | {least:.0} | {ratio} | {cpu:.4} |");
            }
        }
        out
    }

    /// Returns the same for programs: a list of objects.
    pub fn json(&self) -> Value {
        let rows = self.works.iter().flat_map(|(work, agents, outcomes)| {
            outcomes.iter().map(move |outcome| {
                json!({
                    "work": work,
                    "agents": agents,
                    "simulator": outcome.name,
                    "cpu_ns_per_agent_step": outcome.median(),
                    "least_cpu_ns_per_agent_step": least(outcome),
                    "times_throng": self.ratio(outcomes, outcome),
                    "cpu_per_simulated_second": outcome.cpu_per_second,
                    "repeats": outcome.ns.len(),
                })
            })
        });
        rows.collect()
    }

    fn ratio(&self, outcomes: &[Outcome], outcome: &Outcome) -> Option<f64> {
        let throng = outcomes.first().filter(|first| first.name.starts_with("throng"))?;
        Some(outcome.median() / throng.median())
    }
}

fn least(outcome: &Outcome) -> f64 {
    outcome.ns.iter().copied().fold(f64::INFINITY, f64::min)
}
