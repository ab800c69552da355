//! The figures of people as JSON; `throng measure --help` describes the keys.

use super::People;
use super::moments::table;
use crate::measure::json::{POINTS, distribution};
use crate::report::number;
use serde_json::{Value, json};
use throng_record::Table;
use throng_record::pedestrian::{Figures, Inside, Question, flow, steady_flow};

/// Returns the figures as one JSON object.
pub fn json(People { question, figures, .. }: &People) -> Value {
    object(question, figures)
}

/// Returns figures that another command measured as one JSON object.
pub fn object(question: &Question, figures: &Figures) -> Value {
    let areas = question.areas.iter().zip(&figures.areas).map(|(area, inside)| {
        let diagram = Inside::fundamental_diagram(inside);
        json!({
            "size": area.size(),
            "density": number(Inside::mean(inside, |at| at.density)),
            "speed": number(Inside::mean(inside, |at| at.speed)),
            "voronoi_density": number(Inside::mean(inside, |at| at.voronoi_density)),
            "voronoi_speed": number(Inside::mean(inside, |at| at.voronoi_speed)),
            "fundamental_diagram": diagram.iter().map(|pair| pair.map(number)).collect::<Vec<_>>(),
        })
    });
    let lines = question.lines.iter().zip(&figures.crossings).map(|(line, crossings)| {
        json!({
            "length": line.length(),
            "crossed": crossings.len(),
            "leftwards": crossings.iter().filter(|crossing| crossing.leftwards).count(),
            "first": crossings.first().map(|crossing| crossing.time),
            "last": crossings.last().map(|crossing| crossing.time),
            "flow": number(flow(crossings)),
            "steady_flow": number(steady_flow(crossings)),
            "specific_flow": number(flow(crossings) / line.length()),
            "steady_specific_flow": number(steady_flow(crossings) / line.length()),
        })
    });
    let (motion, ways, contacts) = (&figures.motion, &figures.ways, &figures.contacts);
    let thin = figures.instants.len().div_ceil(POINTS).max(1);
    let Table { names, columns } = table(question, figures);
    let rows = (0..figures.instants.len()).step_by(thin);
    let rows = rows.map(|row| columns.iter().map(|column| number(column[row])).collect::<Vec<_>>());
    json!({
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
        "nearest": number(contacts.least),
        "separation": number(contacts.separation),
        "collisions": contacts.collisions,
        "near_misses": contacts.near_misses,
        "time_to_collision": number(contacts.least_time),
        "directions": figures.directions,
        "lane_order": number(figures.mean(|at| at.lane_order)),
        "steady_lane_order": number(figures.steady_lane_order()),
        "areas": areas.collect::<Vec<_>>(),
        "lines": lines.collect::<Vec<_>>(),
        "over_time": { "columns": names, "rows": rows.collect::<Vec<_>>() },
    })
}
