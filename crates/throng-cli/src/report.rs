//! The summary of a run, as text and as JSON.

use crate::failure::Failure;
use crate::measure::Measured;
use crate::out::Out;
use crate::swarms;
use serde_json::{Map, Value, json};
use std::path::PathBuf;
use std::time::Duration;
use throng::Summary;
use throng_record::summary_cells;
use throng_scene::Outcome;

/// The summary of a run.
pub struct Report {
    /// The name of the scene.
    pub scene: String,
    /// The figures of the world.
    pub summary: Summary,
    /// The figures of the game's rules, by name.
    pub figures: Vec<(String, f64)>,
    /// The last error that the world returned to the rules.
    pub refused: Option<String>,
    /// The agents that cannot reach their goals, by number, with the reasons.
    pub stranded: Vec<(u32, String)>,
    /// The outcome of `[expect]`.
    pub verdict: Outcome,
    /// The hash of the last state.
    pub state_hash: u64,
    /// The figures of the swarms.
    pub swarms: Vec<Measured>,
    /// The wall-clock time of the whole run.
    pub wall: Duration,
    /// The wall-clock time of the steps.
    pub stepping: Duration,
    /// The processor time of the whole run, where it is known.
    pub cpu: Option<Duration>,
    /// Whether the run was interrupted.
    pub interrupted: bool,
    /// The files written.
    pub files: Vec<PathBuf>,
}

impl Report {
    fn cpu_per_simulated_second(&self) -> Option<f64> {
        self.cpu.map(|cpu| cpu.as_secs_f64() / self.summary.time).filter(|share| share.is_finite())
    }

    /// Returns the summary as one JSON object. `throng run --help` describes its keys.
    pub fn json(&self) -> Value {
        let s = &self.summary;
        let mut all = Map::from_iter([("scene".to_owned(), json!(self.scene))]);
        all.extend(figures(s, self.stepping));
        let counted = self.figures.iter().map(|(name, value)| (name.clone(), number(*value)));
        let rest = json!({
            "figures": Map::from_iter(counted),
            "expect": self.verdict,
            "sub_steps": s.sub_steps,
            "least_wall_separation": number(s.least_wall_separation),
            "state_hash": format!("{:016x}", self.state_hash),
            "swarms": self.swarms.iter().map(swarms::json).collect::<Vec<_>>(),
            "wall_seconds": self.wall.as_secs_f64(),
            "step_seconds": self.stepping.as_secs_f64(),
            "cpu_per_simulated_second": self.cpu_per_simulated_second(),
            "interrupted": self.interrupted,
            "files": self.files.iter().map(|path| path.to_string_lossy()).collect::<Vec<_>>(),
        });
        all.extend(rest.as_object().cloned().unwrap_or_default());
        Value::Object(all)
    }

    /// Writes the summary as text.
    ///
    /// # Errors
    /// Standard output cannot be written.
    pub fn print(&self, out: &mut Out) -> Result<(), Failure> {
        let s = &self.summary;
        let ended = if self.interrupted { ", interrupted" } else { "" };
        out.line(format_args!("{}: {:.2} s simulated in {} steps{ended}", self.scene, s.time, s.steps))?;
        let counts = [
            (s.removed, "left by exits"),
            (s.resting, "resting"),
            (s.hindered.queueing, "queueing"),
            (s.hindered.waiting_for_room, "waiting for room"),
            (s.stuck, "stuck"),
            (s.hindered.blocked, "blocked"),
            (s.hindered.oscillating, "oscillating"),
        ];
        let counts: Vec<String> =
            counts.iter().filter(|(n, _)| *n > 0).map(|(n, what)| format!(", {n} {what}")).collect();
        out.line(format_args!("  agents     {} of {} arrived{}", s.arrived, s.agents, counts.concat()))?;
        if s.arrived > 0 && s.time_ratio > 0.0 {
            let (time, path) = (s.time_ratio, s.path_ratio);
            out.line(format_args!("  ways       {time:.3} times the shortest time, {path:.3} times the shortest way"))?;
        }
        if !self.figures.is_empty() {
            let figures: Vec<String> = self.figures.iter().map(|(name, value)| format!("{name} {value}")).collect();
            out.line(format_args!("  rules      {}", figures.join(", ")))?;
        }
        if let Some(refused) = &self.refused {
            out.line(format_args!("  rules      could not do everything: {refused}"))?;
        }
        for (number, why) in self.stranded.iter().take(3) {
            out.line(format_args!("  stuck      agent {number} cannot reach its goal: {why}"))?;
        }
        if s.without_progress_30s > 0 {
            let times = s.without_progress_30s;
            out.line(format_args!("  stuck      {times} times an agent walked for 30 s without progress"))?;
        }
        let apart = |least: f64| match least.is_finite() {
            true => format!("{least:.4}"),
            false => "far".to_owned(),
        };
        let (bodies, walls) = (apart(s.least_separation), apart(s.least_wall_separation));
        let overlaps = s.overlaps;
        out.line(format_args!("  distance   bodies {bodies}, walls {walls} (1: they touched); {overlaps} overlaps"))?;
        let (guard, turning, course) = (s.guard_share * 100.0, s.heading_change_deg_per_s, s.course_change_deg_per_s);
        out.line(format_args!(
            "  motion     the guard changed {guard:.2} % of the moves; headings turn {turning:.1} °/s, courses {course:.1} °/s"
        ))?;
        let (pushed, backwards) = (s.pushed_share * 100.0, s.backwards_share * 100.0);
        out.line(format_args!(
            "  limits     {pushed:.2} % of the moves accelerate beyond them; agents move backwards {backwards:.2} % of the time"
        ))?;
        for swarm in &self.swarms {
            out.line(format_args!("  swarm      {}", swarms::line(swarm)))?;
        }
        let cpu = self.cpu_per_simulated_second().map(|c| format!(", {c:.4} CPU s/simulated s")).unwrap_or_default();
        let rate = rate(s, self.stepping);
        let wall = self.wall.as_secs_f64();
        out.line(format_args!("  computing  {wall:.2} s{cpu}; {rate:.3e} agent steps/s ({} sub-steps)", s.sub_steps))?;
        for check in &self.verdict.checks {
            out.line(format_args!("  expect     {check}"))?;
        }
        for file in &self.files {
            out.line(format_args!("  wrote      {}", file.display()))?;
        }
        Ok(())
    }
}

/// Returns the figures of a run under the names that `throng run --help` describes; `stepping` is the time of the
/// steps.
pub fn figures(s: &Summary, stepping: Duration) -> Map<String, Value> {
    let mut figures: Map<String, Value> =
        summary_cells(s).iter().map(|(name, cell)| ((*name).to_owned(), cell.json())).collect();
    figures.insert("agent_steps_per_second".into(), number(rate(s, stepping)));
    figures
}

/// Returns the moves of one agent by one sub-step per second of computing the steps.
fn rate(summary: &Summary, stepping: Duration) -> f64 {
    summary.agent_steps as f64 / stepping.as_secs_f64()
}

/// Returns a number as JSON; null if it is infinite or NaN.
pub fn number(value: f64) -> Value {
    if value.is_finite() { json!(value) } else { Value::Null }
}
