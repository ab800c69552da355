//! The figures as a table for the terminal, in Markdown and as CSV.

use super::figures::{CompareResults, FIGURES, Figure, Spread, spread};
use super::race::{ComparePlan, RunOutcome};
use crate::columns::aligned;
use std::fmt::Write;

/// A row: a name and one cell for each of [`FIGURES`].
pub struct ComparisonRow {
    /// The name of the model, or the seed where the row is one run.
    pub name: String,
    /// The values.
    pub cells: Vec<Cell>,
    /// Whether the row is one run of the model above.
    pub single: bool,
}

/// A cell of the table.
pub struct Cell {
    /// The value, or the median.
    pub value: String,
    /// The least and the greatest value, where they differ.
    pub range: Option<String>,
}

/// Returns the rows: the medians of each model, followed by its runs if `all`.
pub fn rows(results: &CompareResults, all: bool) -> Vec<ComparisonRow> {
    let mut rows = Vec::new();
    for (name, runs) in &results.models {
        rows.push(ComparisonRow { name: name.clone(), cells: cells(runs), single: false });
        let each = if all && results.seeds.len() > 1 { &runs[..] } else { &[] };
        rows.extend(each.iter().map(|run| ComparisonRow {
            name: format!("seed {}", run.seed),
            cells: cells(std::slice::from_ref(run)),
            single: true,
        }));
    }
    rows
}

fn cells(runs: &[RunOutcome]) -> Vec<Cell> {
    let cell = |figure: &Figure| {
        let Spread { median, least, most } = spread(runs, figure.key);
        let mut value = written(median, figure);
        if let Some(of) = figure.of {
            let _ = write!(value, "/{}", written(spread(runs, of).median, figure));
        }
        let (least, most) = (written(least, figure), written(most, figure));
        Cell { value, range: (least != most).then(|| format!("{least}–{most}")) }
    };
    FIGURES.iter().map(cell).collect()
}

fn written(value: f64, figure: &Figure) -> String {
    let value = value * figure.scale;
    // The median of an even number of counts can be fractional.
    let digits = if figure.digits == 0 && value.fract() != 0.0 { 1 } else { figure.digits };
    if value.is_finite() { format!("{value:.digits$}") } else { "–".into() }
}

/// Returns the caption of the table.
pub fn caption(plan: &ComparePlan, results: &CompareResults) -> String {
    let seeds: Vec<String> = results.seeds.iter().map(u64::to_string).collect();
    let consecutive = results.seeds.windows(2).all(|pair| pair[1] == pair[0] + 1);
    let seeds = match &seeds[..] {
        [seed] => format!("seed {seed}"),
        [first, .., last] if consecutive => format!("seeds {first} to {last}, medians"),
        all => format!("seeds {}, medians", all.join(", ")),
    };
    format!("{seeds}, step {} s", plan.loaded.scene.time.step)
}

/// Returns the table for the terminal; ranges stand under the medians.
pub fn text(plan: &ComparePlan, results: &CompareResults, all: bool) -> String {
    let mut lines: Vec<Vec<String>> =
        vec![std::iter::once("").chain(FIGURES.iter().map(|f| f.head)).map(String::from).collect()];
    for row in rows(results, all) {
        let name = if row.single { format!("  {}", row.name) } else { row.name };
        let ranges: Vec<String> = row.cells.iter().map(|cell| cell.range.clone().unwrap_or_default()).collect();
        lines.push(std::iter::once(name).chain(row.cells.into_iter().map(|cell| cell.value)).collect());
        if !all && ranges.iter().any(|range| !range.is_empty()) {
            lines.push(std::iter::once(String::new()).chain(ranges).collect());
        }
    }
    format!("{}: {}\n{}", results.scene, caption(plan, results), aligned(&lines))
}

/// Returns the table in Markdown; ranges stand behind the medians.
pub fn markdown(plan: &ComparePlan, results: &CompareResults, all: bool) -> String {
    let plain = |text: &str| text.replace('\\', "\\\\").replace('|', "\\|").replace('<', "&lt;");
    let mut out = format!("{}: {}\n\n| model |", plain(plan.loaded.title()), caption(plan, results));
    FIGURES.iter().for_each(|figure| out.push_str(&format!(" {} |", figure.head)));
    out.push_str("\n|---|");
    FIGURES.iter().for_each(|_| out.push_str("---:|"));
    for row in rows(results, all) {
        let name = plain(&row.name);
        out.push_str(&if row.single { format!("\n| {name} |") } else { format!("\n| **{name}** |") });
        for Cell { value, range } in row.cells {
            let range = range.map(|range| format!(" ({range})")).unwrap_or_default();
            out.push_str(&format!(" {value}{range} |"));
        }
    }
    out.push('\n');
    out
}

/// Returns all runs as CSV: one line per model and seed, with the names of the figures as headings.
pub fn csv(results: &CompareResults) -> String {
    let quoted = |text: &str| match text.contains(['"', ',', '\n']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_owned(),
    };
    let runs: Vec<(&str, &RunOutcome)> =
        results.models.iter().flat_map(|(name, runs)| runs.iter().map(move |run| (name.as_str(), run))).collect();
    let mut out = String::from("model,seed");
    if let Some((_, run)) = runs.first() {
        run.figures.keys().for_each(|key| out.push_str(&format!(",{key}")));
    }
    out.push('\n');
    for (name, run) in runs {
        let _ = write!(out, "{},{}", quoted(name), run.seed);
        for value in run.figures.values() {
            // Unknown values are empty cells.
            let value = if value.is_null() { String::new() } else { value.to_string() };
            out.push_str(&format!(",{}", quoted(&value)));
        }
        out.push('\n');
    }
    out
}
