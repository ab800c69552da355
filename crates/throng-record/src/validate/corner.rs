//! A corner: the distance at which agents pass the inner corner.

use super::measure::{across, density_and_speed, quantile, steady};
use super::place::{HERMES, rectangle, until_empty};
use super::{Case, Experiment, Figure, Run};
use crate::pedestrian::{Area, Line, steady_flow};
use glam::DVec2;

/// The experiment.
pub const EXPERIMENT: Experiment = Experiment {
    name: "corner",
    title: "Corner",
    about: "A corridor of 2.4 m with a corner of 90 degrees, 137 agents that enter at 3.3 per s. The distance to the inner corner is the least of each agent's path.",
    source: "Zhang, Klingsch, Schadschneider, Seyfried, J. Stat. Mech. P06004 (2011), experiment EO/corner of HERMES; measured on the recording.",
    cases,
    overall: None,
};

/// Width of the corridor, m.
const WIDTH: f64 = 2.4;

fn cases() -> Vec<Case> {
    let parts = [rectangle([-10.0, -WIDTH], [WIDTH, 0.0]), rectangle([0.0, -WIDTH], [WIDTH, 10.0])];
    let rest = format!(
        "walkable.rectangles = [\n    {},\n]\n\n[[group]]\nplace.rectangle = {}\nsource = {{ rate = 3.3, count = 137 }}\ngoal.exit.rectangle = {}\n{HERMES}\n",
        parts.join(",\n    "),
        rectangle([-9.8, 0.25 - WIDTH], [-8.8, -0.25]),
        rectangle([0.0, 9.0], [WIDTH, 10.0]),
    );
    let distance = |name, meaning| Figure::new(name, "m", meaning);
    let figures = vec![
        Figure::new("J/b", "1/(m s)", "flow over the width behind the corner").people("1.31–1.33"),
        distance("p25", "distance to the inner corner, a quarter is nearer").people("0.37"),
        distance("p50", "distance to the inner corner, median").within(0.5, 1.4).people("0.94"),
        distance("p75", "distance to the inner corner, a quarter is farther").people("1.51"),
        Figure::new("rho", "1/m²", "density in the 2 m before the corner").people("1.16"),
        Figure::new("v", "m/s", "mean speed there").people("1.10"),
        Figure::left(),
    ];
    vec![Case::new("2.4 m", until_empty("Corner", 240.0, &rest), figures, measure)]
}

fn measure(run: &Run) -> Vec<f64> {
    let behind = Line { from: DVec2::new(0.0, 3.0), to: DVec2::new(WIDTH, 3.0) }.crossings(&run.people);
    let before = across(-1.0, -WIDTH, 0.0).crossings(&run.people);
    let area = Area::rectangle([-2.0, -WIDTH, 2.0, WIDTH]);
    let (rho, v) = area.map_or((f64::NAN, f64::NAN), |area| density_and_speed(run, &area, &steady(&before)));
    let least = |places: &Vec<DVec2>| places.iter().map(|place| place.length()).fold(f64::INFINITY, f64::min);
    let distances: Vec<f64> = run.people.walks.iter().map(|walk| least(&walk.places)).collect();
    let [p25, p50, p75] = [0.25, 0.5, 0.75].map(|share| quantile(distances.clone(), share));
    vec![steady_flow(&behind) / WIDTH, p25, p50, p75, rho, v, run.left as f64]
}
