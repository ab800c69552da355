//! The results of the runs.

use serde_json::{Value, json};
use std::time::Duration;
use throng_record::validate::{Experiment, Figure};

/// A figure of a case with its value for each seed.
#[derive(Clone, Debug)]
pub struct ValidationRow {
    /// The case; `all` for figures of all cases together.
    pub case: String,
    /// The figure.
    pub figure: Figure,
    /// The value of this engine before its interaction rules were rebuilt.
    pub before: f64,
    /// The values, by seed.
    pub values: Vec<f64>,
}

impl ValidationRow {
    /// Returns the mean over the seeds.
    pub fn mean(&self) -> f64 {
        self.values.iter().sum::<f64>() / self.values.len() as f64
    }

    /// Returns the sample standard deviation over the seeds; NaN for one seed.
    pub fn deviation(&self) -> f64 {
        let mean = self.mean();
        let squares: f64 = self.values.iter().map(|value| (value - mean).powi(2)).sum();
        (squares / (self.values.len() as f64 - 1.0)).sqrt()
    }

    /// Whether the mean is within the tolerance; `None` without a tolerance.
    pub fn is_met(&self) -> Option<bool> {
        self.figure.is_met(self.mean())
    }
}

/// The figures of an experiment.
#[derive(Clone, Debug)]
pub struct Validated {
    /// The experiment.
    pub experiment: &'static Experiment,
    /// The figures, case by case.
    pub rows: Vec<ValidationRow>,
}

/// The figures of all experiments that ran.
#[derive(Debug)]
pub struct ValidateResults {
    /// The given model.
    pub model: Option<String>,
    /// The given changes.
    pub set: Vec<(String, String)>,
    /// The seeds.
    pub seeds: Vec<u64>,
    /// Whether only the quick selection ran.
    pub quick: bool,
    /// The figures, by experiment.
    pub experiments: Vec<Validated>,
    /// Whether the runs were interrupted. If so, only complete cases have figures.
    pub interrupted: bool,
}

impl ValidateResults {
    /// Returns the number of figures with a tolerance, and the number of those within it.
    pub fn required_and_met(&self) -> (usize, usize) {
        let all = self.experiments.iter().flat_map(|validated| &validated.rows).filter_map(ValidationRow::is_met);
        all.fold((0, 0), |(required, met), is_met| (required + 1, met + usize::from(is_met)))
    }

    /// Returns the results as JSON.
    pub fn json(&self, wall: Duration) -> Value {
        let row = |row: &ValidationRow| {
            let Figure { name, unit, tolerance, people, reference, .. } = &row.figure;
            let values: Vec<Value> = row.values.iter().map(|value| number(*value)).collect();
            json!({
                "case": row.case,
                "name": name,
                "unit": unit,
                "mean": number(row.mean()),
                "deviation": number(row.deviation()),
                "values": values,
                "people": people,
                "jupedsim": number(reference.jupedsim),
                "rvo2": number(reference.rvo2),
                "before": number(row.before),
                "tolerance": tolerance,
                "ok": row.is_met(),
            })
        };
        let experiment = |validated: &Validated| {
            let Experiment { name, title, source, .. } = validated.experiment;
            let figures: Vec<Value> = validated.rows.iter().map(row).collect();
            json!({ "name": name, "title": title, "source": source, "figures": figures })
        };
        let (required, met) = self.required_and_met();
        let set: Vec<String> = self.set.iter().map(|(key, value)| format!("{key}={value}")).collect();
        json!({
            "version": env!("CARGO_PKG_VERSION"),
            "model": self.model,
            "set": set,
            "seeds": self.seeds,
            "quick": self.quick,
            "experiments": self.experiments.iter().map(experiment).collect::<Vec<_>>(),
            "required": required,
            "met": met,
            "wall_seconds": wall.as_secs_f64(),
            "interrupted": self.interrupted,
        })
    }
}

/// Returns a number as JSON; null if it is not finite.
fn number(value: f64) -> Value {
    if value.is_finite() { json!(value) } else { Value::Null }
}
