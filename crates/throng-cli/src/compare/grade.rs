//! Grades: which runs are within their bounds.

use super::bounds::{Bounds, Check};
use super::figures::CompareResults;
use serde_json::{Value, json};
use std::fmt::Write;

/// The grades of a comparison.
pub struct Grades<'a> {
    bounds: &'a Bounds,
    /// The models, in order: the label, and the runs by seed.
    pub models: Vec<(&'a str, Vec<GradedRun>)>,
}

/// A run and its checks.
pub struct GradedRun {
    /// The seed.
    pub seed: u64,
    /// The measures and their bounds.
    pub checks: Vec<Check>,
}

impl GradedRun {
    /// Whether all measures are within their bounds.
    pub fn passed(&self) -> bool {
        self.checks.iter().all(Check::passed)
    }
}

impl<'a> Grades<'a> {
    /// Grades all runs.
    pub fn new(bounds: &'a Bounds, results: &'a CompareResults) -> Self {
        let models = results.models.iter().map(|(model, runs)| {
            let graded = runs.iter().map(|run| GradedRun { seed: run.seed, checks: bounds.checks(run) });
            (model.as_str(), graded.collect())
        });
        Self { bounds, models: models.collect() }
    }

    /// Whether all runs passed.
    pub fn passed(&self) -> bool {
        self.models.iter().all(|(_, runs)| runs.iter().all(GradedRun::passed))
    }

    /// Returns the grades as a JSON object. `throng compare --help` describes its keys.
    pub fn json(&self) -> Value {
        let run = |run: &GradedRun| {
            let checks: Vec<Value> = run.checks.iter().map(Check::json).collect();
            json!({ "seed": run.seed, "passed": run.passed(), "checks": checks })
        };
        let model = |(model, runs): &(&str, Vec<GradedRun>)| {
            let passed = runs.iter().all(GradedRun::passed);
            json!({ "model": model, "passed": passed, "runs": runs.iter().map(run).collect::<Vec<_>>() })
        };
        json!({
            "bounds": self.bounds.path.to_string_lossy(),
            "passed": self.passed(),
            "models": self.models.iter().map(model).collect::<Vec<_>>(),
        })
    }

    /// Returns the grades as text: a line for each model, and one for each measure outside its bounds.
    pub fn text(&self) -> String {
        let mut out = format!("bounds of {}\n", self.bounds.path.display());
        for (model, runs) in &self.models {
            let (passed, all) = (runs.iter().filter(|run| run.passed()).count(), runs.len());
            let verdict = if passed == all { "passed" } else { "FAILED" };
            let _ = writeln!(out, "  {model} {verdict}: {passed} of {all} runs within the bounds");
            for run in runs {
                for check in run.checks.iter().filter(|check| !check.passed()) {
                    let _ = writeln!(out, "    seed {}: {check}", run.seed);
                }
            }
        }
        out
    }
}
