//! Bounds of measures, by which runs are graded.

use super::race::RunOutcome;
use crate::failure::Failure;
use serde::Deserialize;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fmt;
use std::path::{Path, PathBuf};
use throng_record::Cell;
use throng_scene::{Kind, TomlFile};

/// A measure: the name, and the value of a run.
type Measure = (&'static str, fn(&RunOutcome) -> f64);

/// The measures that every run has.
const MEASURES: [Measure; 25] = [
    ("arrived", |run| run.figure("arrived")),
    ("arrived_share", |run| run.figure("arrived") / run.figure("agents")),
    ("removed", |run| run.figure("removed")),
    ("resting", |run| run.figure("resting")),
    ("queueing", |run| run.figure("queueing")),
    ("waiting_for_room", |run| run.figure("waiting_for_room")),
    ("blocked", |run| run.figure("blocked")),
    ("oscillating", |run| run.figure("oscillating")),
    ("stranded", |run| run.figure("stranded")),
    ("stuck", |run| run.figure("stuck")),
    ("without_progress_30s", |run| run.figure("without_progress_30s")),
    ("time", |run| run.figure("time")),
    ("time_ratio", |run| run.figure("time_ratio")),
    ("path_ratio", |run| run.figure("path_ratio")),
    ("overlaps", |run| run.figure("overlaps")),
    ("overlap_depth", |run| depth(run.least_separation)),
    ("wall_overlap_depth", |run| depth(run.least_wall_separation)),
    ("guard_share", |run| run.figure("guard_share")),
    ("pushed_share", |run| run.figure("pushed_share")),
    ("backwards_share", |run| run.figure("backwards_share")),
    ("heading_change_deg_per_s", |run| run.figure("heading_change_deg_per_s")),
    ("course_change_deg_per_s", |run| run.figure("course_change_deg_per_s")),
    ("mean_speed", |run| run.series.mean(|point| point.speed)),
    ("mean_turning", |run| run.series.mean(|point| point.turning)),
    ("mean_swing", |run| run.series.mean(|point| point.swing)),
];

/// Returns the deepest overlap as a share of the sum of the radii; 0 without an overlap.
fn depth(least_separation: f64) -> f64 {
    (1.0 - least_separation).max(0.0)
}

/// The file of bounds.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct BoundsFile {
    bounds: BTreeMap<String, Bound>,
}

/// Bounds of a measure.
#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Bound {
    /// The least acceptable value.
    pub at_least: Option<f64>,
    /// The greatest acceptable value.
    pub at_most: Option<f64>,
}

/// Bounds of measures, in the order of their names.
pub struct Bounds {
    /// The file.
    pub path: PathBuf,
    file: TomlFile,
    bounds: BTreeMap<String, Bound>,
}

/// A measure of a run and its bounds.
#[derive(Clone, Debug)]
pub struct Check {
    /// The measure.
    pub measure: String,
    /// The bounds.
    pub bound: Bound,
    /// The measured value; NaN if it is unknown.
    pub found: f64,
}

impl Bounds {
    /// Reads a file of bounds.
    ///
    /// # Errors
    /// The file cannot be read or has no bounds, or a bound has no number.
    pub fn open(path: &Path) -> Result<Self, Failure> {
        let file = TomlFile::open(path)?;
        let BoundsFile { bounds } = file.read()?;
        let wrong = |kind, place: &[&str], message: String| {
            let hint = "write [bounds] and below it lines such as overlap_depth = { at_most = 0.01 }";
            Err(Failure::from(file.error(kind, place.iter().copied(), message, hint)))
        };
        if bounds.is_empty() {
            return wrong(Kind::Count, &["bounds"], "there are no bounds".into());
        }
        for (name, Bound { at_least, at_most }) in &bounds {
            let place = ["bounds", name];
            match (at_least, at_most) {
                (None, None) => {
                    return wrong(Kind::MissingKey, &place, format!("`{name}` has neither at_least nor at_most"));
                }
                (Some(least), Some(most)) if least > most => {
                    return wrong(Kind::Conflict, &place, format!("{name} is at least {least} and at most {most}"));
                }
                (least, most) if !least.iter().chain(most).all(|bound| bound.is_finite()) => {
                    return wrong(Kind::OutOfRange, &place, format!("a bound of `{name}` is not finite"));
                }
                _ => {}
            }
        }
        Ok(Self { path: path.to_path_buf(), file, bounds })
    }

    /// Checks that all measures exist; `figures` are the names of what the rules of the scene count.
    ///
    /// # Errors
    /// A measure does not exist.
    pub fn check_names<'f>(&self, figures: impl Iterator<Item = &'f str>) -> Result<(), Failure> {
        let figures: Vec<String> = figures.map(figure_name).collect();
        let names = MEASURES.iter().map(|(name, _)| *name).chain(figures.iter().map(String::as_str));
        let names: Vec<&str> = names.collect();
        match self.bounds.keys().find(|name| !names.contains(&name.as_str())) {
            Some(unknown) => {
                let hint = format!("the measures are: {}", names.join(", "));
                let message = format!("there is no measure `{unknown}`");
                Err(self.file.error(Kind::UnknownKey, ["bounds", unknown], message, hint).into())
            }
            None => Ok(()),
        }
    }

    /// Returns the measures of a run that have bounds, in the order of their names.
    pub fn checks(&self, run: &RunOutcome) -> Vec<Check> {
        let found = |name: &String| {
            let measure = MEASURES.iter().find(|(known, _)| known == name);
            measure.map_or_else(|| run.figure(name), |(_, measure)| measure(run))
        };
        let check =
            |(name, bound): (&String, &Bound)| Check { measure: name.clone(), bound: *bound, found: found(name) };
        self.bounds.iter().map(check).collect()
    }
}

/// Returns the name of a figure of rules among the measures.
pub fn figure_name(figure: &str) -> String {
    format!("figures.{figure}")
}

impl Check {
    /// Whether the value is within its bounds. An unknown value is not. Bounds are written in decimals: the tolerance of
    /// 1e-9 absorbs their rounding.
    pub fn passed(&self) -> bool {
        let Bound { at_least, at_most } = self.bound;
        let least = at_least.is_none_or(|least| self.found >= least - 1e-9);
        let most = at_most.is_none_or(|most| self.found <= most + 1e-9);
        self.found.is_finite() && least && most
    }

    /// Returns the check as a JSON object.
    pub fn json(&self) -> Value {
        let Bound { at_least, at_most } = self.bound;
        let found = Cell::Number(self.found).json();
        json!({ "measure": self.measure, "at_least": at_least, "at_most": at_most, "found": found, "passed": self.passed() })
    }
}

impl fmt::Display for Bound {
    /// Writes `at most 0.01`, or `at least 1 and at most 2`.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match (self.at_least, self.at_most) {
            (Some(least), Some(most)) => write!(f, "at least {least} and at most {most}"),
            (Some(least), None) => write!(f, "at least {least}"),
            (None, Some(most)) => write!(f, "at most {most}"),
            (None, None) => f.write_str("anything"),
        }
    }
}

impl fmt::Display for Check {
    /// Writes `overlap_depth is 0.0312, and not at most 0.01`.
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Self { measure, bound, found } = self;
        let not = if self.passed() { "" } else { "not " };
        match found.is_finite() {
            true => write!(f, "{measure} is {}, {not}{bound}", (found * 1e4).round() / 1e4),
            false => write!(f, "{measure} is unknown, {not}{bound}"),
        }
    }
}
