//! The figures of people as JSON; `throng measure --help` describes the keys.

use super::People;
use super::moments::table;
use crate::measure::json::{POINTS, distribution};
use crate::report::number;
use serde_json::{Map, Value, json};
use throng_record::pedestrian::{Figures, Inside, Question};
use throng_record::{Cell, Table};

/// Returns the figures as one JSON object.
pub fn json(People { question, figures, .. }: &People) -> Value {
    object(question, figures)
}

/// Returns figures that another command measured as one JSON object.
pub fn object(question: &Question, figures: &Figures) -> Value {
    let areas = question.areas.iter().zip(&figures.areas).map(|(area, inside)| {
        let diagram = Inside::fundamental_diagram(inside);
        let mut all = Map::from_iter([("size".to_owned(), number(area.size()))]);
        all.extend(named(&Inside::cells(inside)));
        let diagram: Vec<_> = diagram.iter().map(|pair| pair.map(number)).collect();
        all.insert("fundamental_diagram".into(), json!(diagram));
        Value::Object(all)
    });
    let lines = question.lines.iter().zip(&figures.crossings);
    let lines = lines.map(|(line, crossings)| Value::Object(named(&line.cells(crossings)).collect()));
    let (motion, ways) = (&figures.motion, &figures.ways);
    let thin = figures.instants.len().div_ceil(POINTS).max(1);
    let Table { names, columns } = table(question, figures);
    let rows = (0..figures.instants.len()).step_by(thin);
    let rows = rows.map(|row| columns.iter().map(|column| number(column[row])).collect::<Vec<_>>());
    let mut all = json!({
        "people": figures.people,
        "frame_rate": number(1.0 / figures.interval),
        "moments": figures.instants.len(),
        "interval": figures.rows,
        "speed": distribution(&motion.speed),
        "turning": distribution(&motion.turning),
        "acceleration": distribution(&motion.acceleration),
        "effort": distribution(&motion.effort),
        "travel_time": distribution(&ways.time),
        "path_length": distribution(&ways.length),
        "path_ratio": distribution(&ways.ratio),
        "left": { "half": ways.left(0.5), "most": ways.left(0.95), "all": ways.left(1.0) },
        "directions": figures.directions,
        "areas": areas.collect::<Vec<_>>(),
        "lines": lines.collect::<Vec<_>>(),
        "over_time": { "columns": names, "rows": rows.collect::<Vec<_>>() },
    });
    if let Some(all) = all.as_object_mut() {
        all.extend(named(&figures.cells()));
    }
    all
}

/// Returns figures as the entries of a JSON object.
fn named<'c>(cells: &'c [(&'static str, Cell)]) -> impl Iterator<Item = (String, Value)> + 'c {
    cells.iter().map(|(name, cell)| ((*name).to_owned(), cell.json()))
}
