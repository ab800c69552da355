//! The figures of all runs, and their medians and ranges over the seeds.

use super::grade::Grades;
use super::race::{ComparePlan, RunOutcome};
use serde_json::{Map, Value, json};
use std::path::PathBuf;
use std::time::Duration;

/// A figure of the table.
pub struct Figure {
    /// The key in JSON and CSV.
    pub key: &'static str,
    /// The heading of the column.
    pub head: &'static str,
    /// The number of decimals shown.
    pub digits: usize,
    /// The factor by which shown values are multiplied.
    pub scale: f64,
    /// The key of the figure that this figure is a count out of; shown behind the value.
    pub of: Option<&'static str>,
    /// The meaning, shown when the mouse is over the heading.
    pub meaning: &'static str,
}

const fn figure(key: &'static str, head: &'static str, digits: usize, meaning: &'static str) -> Figure {
    Figure { key, head, digits, scale: 1.0, of: None, meaning }
}

/// The figures of the table, in order.
pub const FIGURES: [Figure; 13] = [
    Figure { of: Some("agents"), ..figure("arrived", "arrived", 0, "agents at the end of their journeys, of all") },
    figure("stuck", "stuck", 0, "agents that cannot arrive, are blocked, or walk without progress"),
    figure("time", "time s", 2, "seconds simulated: until all agents have arrived, or to the limit"),
    figure("time_ratio", "time ratio", 3, "agents that arrived: time over that of the shortest way, mean"),
    figure("path_ratio", "path ratio", 3, "agents that arrived: length of the way over that of the shortest way, mean"),
    figure(
        "least_separation",
        "separation",
        3,
        "least distance of two centres over the sum of their radii; 1: they touched",
    ),
    figure("overlaps", "overlaps", 0, "overlaps of bodies with bodies and walls, counted every sub-step"),
    Figure {
        scale: 100.0,
        ..figure("guard_share", "guard %", 2, "share of the moves that the guard changed by more than 1 %")
    },
    Figure {
        scale: 100.0,
        ..figure("pushed_share", "pushed %", 2, "share of the moves that accelerate an agent beyond its limit")
    },
    Figure {
        scale: 100.0,
        ..figure("backwards_share", "back %", 2, "share of time that agents move against the direction of their way")
    },
    figure("heading_change_deg_per_s", "turning °/s", 1, "turning of the headings of walking agents, mean"),
    figure(
        "course_change_deg_per_s",
        "course °/s",
        1,
        "turning of their directions of motion: trembling, which headings smooth out",
    ),
    figure("us_per_agent_step", "µs/step", 2, "microseconds of processor time per move of one agent by one sub-step"),
];

/// The spread of a figure over the seeds. All three values are NaN where no run has the figure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// The median; for an even number of values, the mean of the two in the middle.
    pub median: f64,
    /// The least value.
    pub least: f64,
    /// The greatest value.
    pub most: f64,
}

impl Spread {
    fn of(mut values: Vec<f64>) -> Self {
        values.sort_by(f64::total_cmp);
        let n = values.len();
        let (Some(&least), Some(&most)) = (values.first(), values.last()) else {
            return Self { median: f64::NAN, least: f64::NAN, most: f64::NAN };
        };
        Self { median: 0.5 * (values[(n - 1) / 2] + values[n / 2]), least, most }
    }
}

/// The results of all runs.
pub struct CompareResults {
    /// The name of the scene.
    pub scene: String,
    /// The seeds.
    pub seeds: Vec<u64>,
    /// The labels of the models, in order, and their runs by seed.
    pub models: Vec<(String, Vec<RunOutcome>)>,
    /// Whether the comparison was interrupted.
    pub interrupted: bool,
}

impl CompareResults {
    /// Groups the runs by model.
    pub fn new(plan: &ComparePlan, runs: Vec<RunOutcome>, interrupted: bool) -> Self {
        let mut models: Vec<_> = plan.models.iter().map(|model| (model.label().to_owned(), Vec::new())).collect();
        for run in runs {
            models[run.model].1.push(run);
        }
        Self { scene: plan.loaded.name.clone(), seeds: plan.seeds.clone(), models, interrupted }
    }

    /// Returns the results as one JSON object. `throng compare --help` describes its keys.
    pub fn json(&self, files: &[PathBuf], grades: Option<&Grades>, wall: Duration) -> Value {
        let models = self.models.iter().map(|(model, runs)| {
            let over = |pick: fn(&Spread) -> f64| {
                let keys = runs.iter().flat_map(|run| run.figures.keys()).filter(|key| *key != "interrupted");
                let figures = keys.map(|key| (key.clone(), json!(pick(&spread(runs, key)))));
                Value::Object(figures.collect())
            };
            let runs = runs.iter().map(|run| {
                let mut all = Map::from_iter([("seed".to_owned(), json!(run.seed))]);
                all.extend(run.figures.clone());
                Value::Object(all)
            });
            json!({
                "model": model,
                "median": over(|spread| spread.median),
                "least": over(|spread| spread.least),
                "most": over(|spread| spread.most),
                "runs": runs.collect::<Vec<_>>(),
            })
        });
        json!({
            "scene": self.scene,
            "seeds": self.seeds,
            "models": models.collect::<Vec<_>>(),
            "grades": grades.map(Grades::json),
            "wall_seconds": wall.as_secs_f64(),
            "interrupted": self.interrupted,
            "files": files.iter().map(|path| path.to_string_lossy()).collect::<Vec<_>>(),
        })
    }
}

/// Returns the spread of a figure over runs.
pub fn spread(runs: &[RunOutcome], key: &str) -> Spread {
    Spread::of(runs.iter().filter_map(|run| run.figures[key].as_f64()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_in_the_middle() {
        let spread = |values: &[f64]| Spread::of(values.to_vec());
        assert_eq!(spread(&[3.0, 1.0, 2.0]), Spread { median: 2.0, least: 1.0, most: 3.0 });
        assert_eq!(spread(&[4.0, 1.0, 2.0, 9.0]).median, 3.0);
        assert!(spread(&[]).median.is_nan());
    }
}
