//! The summary of a run: what happened, then how well agents moved and what steps cost, folded.

use super::words;
use crate::play::RunMoment;
use eframe::egui::{CollapsingHeader, Grid, ProgressBar, RichText, ScrollArea, Ui};
use throng::{Stage, Status};

/// A figure: its name, its value, and its meaning.
type Row = (&'static str, String, &'static str);

/// Shows the summary of the run.
pub fn summary(ui: &mut Ui, shown: &RunMoment) {
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        ui.label(RichText::new(&shown.setting.title).heading());
        figures(ui, "run", run(shown));
        if !shown.frame.standing.is_empty() {
            ui.label(&shown.frame.standing);
        }
        if shown.reel.is_none() {
            ui.add_space(4.0);
            CollapsingHeader::new("quality of motion").show(ui, |ui| figures(ui, "quality", quality(shown)));
            CollapsingHeader::new("computation").show(ui, |ui| computation(ui, shown));
        }
        ui.add_space(6.0);
        words(ui, &shown.scene.about, &["see", "look_for", "why", "try", "source"]);
    });
}

/// Returns what happened so far.
fn run(shown: &RunMoment) -> Vec<Row> {
    let (frame, summary) = (&shown.frame, &shown.summary);
    let unknown = shown.reel.as_ref().is_some_and(|reel| !reel.has_arrivals());
    let arrived = if unknown { "–".into() } else { format!("{} of {}", frame.arrived, frame.total) };
    let mut rows = vec![
        ("time", format!("{:.2} s", frame.time), "since the start"),
        ("agents", format!("{}", frame.total), "present, gone, and yet to enter"),
        ("arrived", arrived, "at the end of their journeys; –: the file of trajectories does not tell"),
        ("mean speed", speed(shown), "of the agents that are present and have not arrived"),
    ];
    // a file of trajectories has no more figures
    if shown.reel.is_none() {
        rows.extend([
            (
                "overlaps",
                format!("{}", summary.overlaps),
                "bodies and walls that overlapped by more than 1e-4 of a radius",
            ),
            ("queueing", format!("{}", summary.hindered.queueing), "behind other agents in a moving queue"),
            ("waiting", format!("{}", summary.hindered.waiting_for_room), "outside an area without a free place"),
            ("stuck", format!("{}", summary.stuck), "cannot reach their goal, are blocked, or make no progress"),
        ]);
    }
    rows
}

/// Returns the mean speed of the agents that have not arrived.
fn speed(shown: &RunMoment) -> String {
    let moving = shown.frame.bodies.iter().filter(|body| body.status != Status::Arrived);
    let (sum, count) = moving.fold((0.0, 0), |(sum, count), body| {
        (sum + f64::from(body.velocity.extend(body.vertical_velocity).length()), count + 1)
    });
    if count == 0 { "–".into() } else { format!("{:.2} m/s", sum / f64::from(count)) }
}

/// Returns how well agents moved.
fn quality(shown: &RunMoment) -> Vec<Row> {
    let summary = &shown.summary;
    let percent = |share: f64| format!("{:.1} %", 100.0 * share);
    let ratio = |ratio: f64| if ratio.is_finite() && ratio > 0.0 { format!("{ratio:.3}") } else { "–".into() };
    vec![
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
    ]
}

/// Shows the cost of steps, and the state.
fn computation(ui: &mut Ui, shown: &RunMoment) {
    let cost = &shown.cost;
    ui.add(ProgressBar::new(cost.usage.min(1.0) as f32).text(format!("usage {:.0} %", 100.0 * cost.usage)))
        .on_hover_text("share of real time that steps take at this speed");
    let micros = |seconds: f64| format!("{:.0} µs", 1e6 * seconds);
    let stages = Stage::ALL
        .into_iter()
        .map(|stage| (stage.name(), micros(cost.stages[stage as usize]), "time per step in this stage"));
    let mut rows: Vec<Row> = stages.collect();
    rows.extend([
        ("a step", micros(cost.step), "all stages together"),
        ("step", format!("{}", shown.step), "steps made"),
        ("state", format!("{:016x}", shown.hash), "hash of the state: the same for the same bits"),
        ("kept", format!("{:.1} MB", shown.kept as f64 / 1e6), "saved states for stepping back"),
    ]);
    figures(ui, "computation", rows);
}

fn figures(ui: &mut Ui, name: &str, rows: Vec<Row>) {
    Grid::new(name).num_columns(2).spacing([16.0, 2.0]).show(ui, |ui| {
        for (name, value, says) in rows {
            ui.label(RichText::new(name).weak()).on_hover_text(says);
            ui.label(RichText::new(value).monospace());
            ui.end_row();
        }
    });
}
