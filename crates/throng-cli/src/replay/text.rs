//! The figures for the terminal.

use super::outputs;
use super::report::{Pauses, ReplayReport};
use super::tables::{Grid, tables};
use crate::columns::aligned;
use crate::files::title;
use std::fmt::Write;

/// Returns the figures of a replay as text.
pub fn of(report: &ReplayReport) -> String {
    let setup = report.setup;
    let mut out = format!("{}: {}\n", setup.args.data.display(), facts(report).join("\n  "));
    for Grid { title, head, rows } in tables(report) {
        let lines: Vec<Vec<String>> = std::iter::once(head).chain(rows).collect();
        // Writing to a string does not fail.
        let _ = write!(out, "\n{title}\n{}", aligned(&lines));
    }
    let files = outputs::paths(setup);
    for file in files.iter().chain(&setup.args.table) {
        let _ = writeln!(out, "wrote {}", file.display());
    }
    out
}

/// Describes the recording, the ground and the groups.
pub fn facts(report: &ReplayReport) -> Vec<String> {
    let setup = report.setup;
    let (cast, stage, [from, until]) = (&setup.cast, &setup.stages[0], setup.span());
    let count = cast.people.walks.len();
    let mut facts = vec![format!("{count} people, {from:.2} to {until:.2} s, step {} s", stage.settings.step)];
    if cast.seen_once > 0 {
        facts.push(format!("{} people have only one sample", cast.seen_once));
    }
    let pauses = Pauses::of(cast);
    if pauses.count > 0 {
        facts.push(format!("pauses: {}, of {} people, {:.0} s together", pauses.count, pauses.people, pauses.seconds));
    }
    let (areas, walls) = (stage.walkable.len(), stage.obstacles.len());
    if areas + walls > 0 {
        let of = setup.map.as_ref().map_or_else(|| "the recording".to_owned(), |path| title(path));
        let through = report.through;
        facts.push(format!(
            "map of {of}: {areas} areas, {walls} obstacles, {through} recorded people walk through solids"
        ));
    }
    if let Some(groups) = &setup.groups {
        facts.push(format!("{} groups", groups.iter().filter(|group| group.len() > 1).count()));
    }
    let solid = report.models.iter().map(|came| came.replayed.goals_moved).max().unwrap_or(0);
    if solid > 0 {
        facts.push(format!("{solid} goals are inside solids"));
    }
    facts
}
