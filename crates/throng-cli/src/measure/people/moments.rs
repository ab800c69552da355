//! The figures of all moments as a table.

use throng_record::Table;
use throng_record::pedestrian::{Figures, Inside, Instant, Question, count};

/// The name of a column, and its value in an instant or an area.
type Value<T> = (&'static str, fn(&T) -> f64);

/// The columns of the whole recording.
const WHOLE: [Value<Instant>; 4] = [
    ("time", |at| at.time),
    ("people", |at| at.people as f64),
    ("speed", |at| at.speed),
    ("lane_order", |at| at.lane_order),
];
/// The columns of each area.
const AREA: [Value<Inside>; 4] = [
    ("density", |at| at.density),
    ("area_speed", |at| at.speed),
    ("voronoi_density", |at| at.voronoi_density),
    ("voronoi_speed", |at| at.voronoi_speed),
];

/// Returns the figures of all moments: those of the whole recording, of each area, and the number of people across
/// each line so far. Where there are several areas or lines, their columns are numbered from 1.
pub fn table(question: &Question, figures: &Figures) -> Table {
    let mut table = Table::default();
    for (name, value) in WHOLE {
        table.push(name, figures.instants.iter().map(value).collect());
    }
    for (k, inside) in figures.areas.iter().enumerate() {
        for (name, value) in AREA {
            table.push(numbered(name, "_", k, question.areas.len()), inside.iter().map(value).collect());
        }
    }
    for (k, crossings) in figures.crossings.iter().enumerate() {
        let crossed = figures.instants.iter().map(|at| count(crossings, at.time) as f64);
        table.push(numbered("crossed", "_", k, question.lines.len()), crossed.collect());
    }
    table
}

/// Returns a name, followed by its number (from 1) where there are several.
pub fn numbered(name: &str, between: &str, index: usize, of: usize) -> String {
    if of > 1 { format!("{name}{between}{}", index + 1) } else { name.to_owned() }
}
