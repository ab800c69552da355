//! The summary of a run: counts, statistics, and the cost of steps.

use super::words;
use crate::play::RunMoment;
use eframe::egui::{Grid, ProgressBar, RichText, Ui};
use throng::Stage;

/// Shows the summary of the run.
pub fn summary(ui: &mut Ui, shown: &RunMoment) {
    ui.label(RichText::new(&shown.setting.title).heading());
    words(ui, &shown.scene.about, &["see", "look_for", "why", "try", "source"]);
    ui.add_space(6.0);
    let summary = &shown.summary;
    let percent = |share: f64| format!("{:.1} %", 100.0 * share);
    let ratio = |ratio: f64| if ratio.is_finite() && ratio > 0.0 { format!("{ratio:.3}") } else { "–".into() };
    let rows = [
        ("agents", format!("{}", shown.frame.total), "present, gone, and yet to enter"),
        ("arrived", format!("{}", shown.frame.arrived), "at the end of their journeys"),
        ("stuck", format!("{}", summary.stuck), "cannot reach their goal, are blocked, or make no progress"),
        ("queueing", format!("{}", summary.hindered.queueing), "behind other agents in a moving queue"),
        ("waiting", format!("{}", summary.hindered.waiting_for_room), "outside an area without a free place"),
        ("overlaps", format!("{}", summary.overlaps), "bodies and walls that overlapped by more than 1e-4 of a radius"),
        (
            "least separation",
            ratio(summary.least_separation),
            "distance of two centres over the sum of their radii; 1: they touched",
        ),
        ("time ratio", ratio(summary.time_ratio), "travel time over the time of the shortest path at preferred speed"),
        ("path ratio", ratio(summary.path_ratio), "walked distance over the length of the shortest path"),
        (
            "guard acted",
            percent(summary.guard_share),
            "share of agent-steps that the guard changed by more than a hundredth",
        ),
        ("pushed", percent(summary.pushed_share), "share of agent-steps that accelerate an agent beyond its limit"),
        (
            "backwards",
            percent(summary.backwards_share),
            "share of the time that agents move against the direction of their path",
        ),
        ("heading change", format!("{:.1} °/s", summary.heading_change_deg_per_s), "mean turning of headings"),
    ];
    // a file of trajectories has only the numbers of agents
    let known = if shown.reel.is_some() { 2 } else { rows.len() };
    figures(ui, "figures", rows.into_iter().take(known));
    if !shown.frame.standing.is_empty() {
        ui.label(&shown.frame.standing);
    }
    if shown.reel.is_some() {
        return;
    }
    ui.add_space(8.0);
    ui.label(RichText::new("Steps").strong());
    let cost = &shown.cost;
    ui.add(ProgressBar::new(cost.usage.min(1.0) as f32).text(format!("usage {:.0} %", 100.0 * cost.usage)))
        .on_hover_text("share of real time that steps take at this speed");
    let micros = |seconds: f64| format!("{:.0} µs", 1e6 * seconds);
    let stages = Stage::ALL
        .into_iter()
        .map(|stage| (stage.name(), micros(cost.stages[stage as usize]), "time per step in this stage"));
    figures(ui, "stages", stages.chain([("a step", micros(cost.step), "all stages together")]));
    ui.add_space(8.0);
    let rows = [
        ("step", format!("{}", shown.step), "steps made"),
        ("state", format!("{:016x}", shown.hash), "hash of the state: the same for the same bits"),
        ("kept", format!("{:.1} MB", shown.kept as f64 / 1e6), "saved states for stepping back"),
    ];
    figures(ui, "state", rows.into_iter());
}

fn figures<'a>(ui: &mut Ui, name: &str, rows: impl Iterator<Item = (&'a str, String, &'a str)>) {
    Grid::new(name).num_columns(2).spacing([16.0, 2.0]).show(ui, |ui| {
        for (name, value, says) in rows {
            ui.label(RichText::new(name).weak()).on_hover_text(says);
            ui.label(RichText::new(value).monospace());
            ui.end_row();
        }
    });
}
