//! The figures as a table for the terminal and for the page.

use super::results::{ValidateResults, Validated, ValidationRow};
use crate::columns::aligned;
use std::fmt::Write;

/// The headings of the columns.
pub const HEADS: [&str; 9] = ["case", "figure", "ours", "people", "JuPedSim", "RVO2", "before", "tolerance", ""];

/// Returns the table of an experiment without headings. Only the first row of a case names it.
pub fn rows<'v>(validated: &'v Validated) -> Vec<Vec<String>> {
    let mut last = "";
    let mut row = |row: &'v ValidationRow| {
        let ValidationRow { case, figure, .. } = row;
        let name = if case == last { String::new() } else { case.clone() };
        last = case;
        let unit = if figure.unit.is_empty() { String::new() } else { format!(" {}", figure.unit) };
        let known = |value: f64| if value.is_nan() { String::new() } else { written(value) };
        let people = if figure.people.is_empty() { String::new() } else { figure.people.to_owned() };
        let tolerance = figure.tolerance.map_or(String::new(), tolerated);
        let met = row.is_met().map_or("", |met| if met { "ok" } else { "OUTSIDE" });
        vec![
            name,
            format!("{}{unit}", figure.name),
            ours(row),
            people,
            known(figure.reference.jupedsim),
            known(figure.reference.rvo2),
            known(row.before),
            tolerance,
            met.to_owned(),
        ]
    };
    validated.rows.iter().map(&mut row).collect()
}

/// Returns mean and standard deviation of a figure as text.
fn ours(row: &ValidationRow) -> String {
    let (mean, deviation) = (row.mean(), row.deviation());
    if deviation.is_nan() { written(mean) } else { format!("{} ± {}", written(mean), written(deviation)) }
}

/// Formats a value with two decimals, from ten on with one.
pub fn written(value: f64) -> String {
    match value.abs() {
        _ if !value.is_finite() => "–".into(),
        size if size >= 9.995 => format!("{value:.1}"),
        // Adding 0 turns -0 into 0.
        _ => format!("{:.2}", value + 0.0).replace("-0.00", "0.00"),
    }
}

/// Formats a tolerance without trailing zeros.
fn tolerated([low, high]: [f64; 2]) -> String {
    if high.is_finite() { format!("{low}–{high}") } else { format!("≥ {low}") }
}

/// Returns all tables as text.
pub fn text(results: &ValidateResults) -> String {
    let mut out = String::new();
    for validated in &results.experiments {
        let heads = HEADS.map(str::to_owned).to_vec();
        let lines: Vec<Vec<String>> = std::iter::once(heads).chain(rows(validated)).collect();
        let _ = writeln!(out, "{}\n{}", validated.experiment.title, aligned(&lines));
    }
    let _ = writeln!(out, "{}", verdict(results));
    out
}

/// Returns how many figures are within their tolerances, with the seeds and the model.
pub fn verdict(results: &ValidateResults) -> String {
    let (required, met) = results.required_and_met();
    let seeds: Vec<String> = results.seeds.iter().map(u64::to_string).collect();
    let model = results.model.as_deref().map_or(String::new(), |model| format!(", model {model}"));
    format!("{met} of {required} figures within their tolerances; seeds {}{model}", seeds.join(", "))
}
