//! The page: one self-contained file with the tables and the measured points of the experiments.

use super::results::{ValidateResults, Validated, ValidationRow};
use super::table::{HEADS, rows, verdict};
use crate::failure::Failure;
use std::fmt::Write;
use std::time::Duration;
use throng_draw::page::{Dots, Height, Plot, document, escape, swatch};
use throng_record::validate::points;

/// A plot of an experiment.
struct Chart {
    title: &'static str,
    unit: &'static str,
    axis: &'static str,
    ends: [f64; 2],
    dots: Vec<Dots>,
}

/// Returns the page of the results.
///
/// # Errors
/// None; the return type is that of all functions that format results.
pub fn page(results: &ValidateResults, wall: Duration) -> Result<String, Failure> {
    let mut body = format!(
        "<h1>Validation</h1>\n<p class=\"lead\">{}; {:.0} s of computing. Tolerances, measures and sources: docs/validation.md.</p>\n",
        escape(&verdict(results)),
        wall.as_secs_f64()
    );
    for validated in &results.experiments {
        let experiment = validated.experiment;
        let _ = write!(
            body,
            "<section>\n<h2>{}</h2>\n<p class=\"note\">{}</p>\n<div class=\"wide\">{}</div>\n<p class=\"note\">{}</p>\n",
            escape(experiment.title),
            escape(experiment.about),
            table(validated),
            escape(experiment.source)
        );
        if let Some(chart) = chart(validated) {
            body.push_str(&chart.html());
        }
        body.push_str("</section>\n");
    }
    Ok(document("Validation of throng", &body, ""))
}

/// Returns the table of an experiment; figures outside their tolerances are highlighted.
fn table(validated: &Validated) -> String {
    let heads: String = HEADS.iter().map(|head| format!("<th>{head}</th>")).collect();
    let row = |(cells, row): (Vec<String>, &ValidationRow)| {
        let class = if row.is_met() == Some(false) { " class=\"outside\"" } else { "" };
        let cell = |(k, cell): (usize, &String)| {
            let cell = escape(cell);
            match k {
                0 => format!("<th>{cell}</th>"),
                1 => format!("<td title=\"{}\">{cell}</td>", escape(row.figure.meaning)),
                _ => format!("<td>{cell}</td>"),
            }
        };
        format!("<tr{class}>{}</tr>\n", cells.iter().enumerate().map(cell).collect::<String>())
    };
    let rows: String = rows(validated).into_iter().zip(&validated.rows).map(row).collect();
    format!("<table>\n<thead><tr>{heads}</tr></thead>\n<tbody>\n{rows}</tbody>\n</table>\n")
}

/// Returns the mean of a figure for each case that has it.
fn means<'v>(validated: &'v Validated, name: &str) -> Vec<(&'v ValidationRow, f64)> {
    validated.rows.iter().filter(|row| row.figure.name == name).map(|row| (row, row.mean())).collect()
}

/// Returns the number at the start of the case's name.
fn leading(row: &ValidationRow) -> f64 {
    row.case.split(' ').next().and_then(|number| number.parse().ok()).unwrap_or(f64::NAN)
}

/// Returns the plot of an experiment, if it has one.
fn chart(validated: &Validated) -> Option<Chart> {
    let pairs = |x: &str, y: &str| {
        let xs = means(validated, x).into_iter().map(|(_, x)| x);
        xs.zip(means(validated, y)).map(|(x, (_, y))| (x, y)).collect::<Vec<_>>()
    };
    let by_density = || means(validated, "v").into_iter().map(|(row, v)| (leading(row), v)).collect();
    let people = |experiment| points::of(experiment).map(|point| (point.x, point.y)).collect();
    let ours = |points| Dots { name: "ours", colour: 1, width: 9.0, points };
    let measured = |points| Dots { name: "people", colour: 0, width: 3.5, points };
    let speeds = |title, axis, ends, dots| Chart { title, unit: "m/s", axis, ends, dots };
    Some(match validated.experiment.name {
        "single-file" => speeds(
            "Speed over density",
            "agents per m",
            [2.8, 1.4],
            vec![measured(people("single-file")), ours(by_density())],
        ),
        "corridor" => speeds(
            "Speed over density",
            "agents per m²",
            [4.5, 1.8],
            vec![measured(people("corridor")), ours(pairs("rho", "v"))],
        ),
        "bidirectional" => speeds(
            "Speed over density",
            "agents per m²",
            [4.5, 1.8],
            vec![measured(people("bidirectional")), ours(pairs("rho", "v"))],
        ),
        "loop" => speeds(
            "Speed over density; people: in the open corridor",
            "agents per m²",
            [4.5, 1.8],
            vec![measured(people("corridor")), ours(by_density())],
        ),
        "door" => {
            let all = means(validated, "J/b");
            let of = |value: fn(&ValidationRow, f64) -> f64| {
                all.iter().map(|&(row, mean)| (leading(row), leading(row) * value(row, mean))).collect()
            };
            let dots = vec![
                measured(people("door")),
                Dots {
                    name: "JuPedSim's best",
                    colour: 2,
                    width: 6.0,
                    points: of(|row, _| row.figure.reference.jupedsim),
                },
                Dots { name: "RVO2", colour: 3, width: 6.0, points: of(|row, _| row.figure.reference.rvo2) },
                Dots { name: "before", colour: 5, width: 6.0, points: of(|row, _| row.before) },
                ours(of(|_, mean| mean)),
            ];
            Chart { title: "Flow over width", unit: "1/s", axis: "width, m", ends: [4.0, 10.0], dots }
        }
        "gate" => {
            let flow = |(row, flow): (&ValidationRow, f64)| (leading(row), flow * leading(row));
            let ours = ours(means(validated, "J/b").into_iter().map(flow).collect());
            Chart {
                title: "Flow over width; people: doors",
                unit: "1/s",
                axis: "width, m",
                ends: [7.0, 16.0],
                dots: vec![measured(people("door")), ours],
            }
        }
        _ => return None,
    })
}

impl Chart {
    fn html(&self) -> String {
        let plot = Plot {
            title: self.title.into(),
            unit: self.unit,
            lines: vec![],
            height: Height::Between([0.0, self.ends[1]]),
            mark: None,
            axis: self.axis,
            span: [0.0, self.ends[0]],
        };
        let legend: String =
            self.dots.iter().map(|dots| format!("<span>{}{}</span>\n", swatch(dots.colour), dots.name)).collect();
        format!("<p class=\"legend\">{legend}</p>\n<div class=\"plots\">{}</div>\n", plot.svg_with_dots(&self.dots))
    }
}
