//! The figures of people as JSON; `throng measure --help` describes the keys.

use super::{People, columns};
use crate::measure::json::{POINTS, distribution};
use crate::report::number;
use serde_json::{Value, json};
use throng_record::pedestrian::{Figures, Question, flow, steady_flow};

/// The figures as one object.
pub fn json(People { question, figures }: &People) -> Value {
    object(question, figures)
}

/// The same of figures that were measured elsewhere.
pub fn object(question: &Question, figures: &Figures) -> Value {
    let area = question.area.as_ref().map(|area| {
        let diagram = figures.fundamental_diagram();
        json!({
            "size": area.size(),
            "density": number(figures.mean(|at| at.density)),
            "speed": number(figures.mean(|at| at.area_speed)),
            "voronoi_density": number(figures.mean(|at| at.voronoi_density)),
            "voronoi_speed": number(figures.mean(|at| at.voronoi_speed)),
            "fundamental_diagram": diagram.iter().map(|pair| pair.map(number)).collect::<Vec<_>>(),
        })
    });
    let crossings = &figures.crossings;
    let line = question.line.map(|line| {
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
    let over_time = figures.instants.iter().step_by(thin).map(|at| columns(at).map(number));
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
        "area": area,
        "line": line,
        "over_time": over_time.collect::<Vec<_>>(),
    })
}
