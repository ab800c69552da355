//! A closed loop wide enough to overtake: does the crowd keep walking?

use super::measure::{mean, speed_round};
use super::place::{WEIDMANN, until};
use super::{Case, Experiment, Figure, Run};

/// The experiment.
pub const EXPERIMENT: Experiment = Experiment {
    name: "loop",
    title: "Closed loop",
    about: "A ring 50 m round and 2.4 m wide, all agents the same way. Mean speed along the ring from 48 to 120 s; places across the width, 0 at the inner wall and 1 at the \
            outer one.",
    source: "Speeds that the open one-way corridor has at these densities: Zhang et al. (2011), Weidmann (1993).",
    cases,
    overall: None,
};

/// Length of the middle line, m.
const LENGTH: f64 = 50.0;
/// Width, m.
const WIDTH: f64 = 2.4;

fn cases() -> Vec<Case> {
    let speed = || Figure::new("v", "m/s", "mean speed along the ring");
    vec![
        case(0.5, speed().people("1.2–1.45")),
        case(1.0, speed().within(0.8, 1.4).people("1.0–1.24")),
        case(1.5, speed().people("0.8–1.11")).slow(),
        case(2.0, speed().within(0.4, 0.7).people("0.6–0.84")),
    ]
}

fn case(density: f64, speed: Figure) -> Case {
    let radius = LENGTH / std::f64::consts::TAU;
    let (inner, outer) = (radius - 0.5 * WIDTH, radius + 0.5 * WIDTH);
    let agents = (density * LENGTH * WIDTH).round();
    let rest = format!(
        "walkable.ring = {{ inner = {inner:.4}, outer = {outer:.4} }}\n\n\
         [[group]]\ncount = {agents}\nplace.walkable = {{}}\ngoal.lap = {{}}\n{WEIDMANN}\n"
    );
    let width = Figure::new("place", "", "mean place across the width, 0.5 in the middle");
    Case::new(format!("{density} per m²"), until("Closed loop", 120.0, &rest), vec![speed, width], move |run: &Run| {
        let time = 48.0..=120.0;
        let rows = run.people.walks.iter().flat_map(|walk| walk.times.iter().zip(&walk.places));
        let places = rows.filter(|(at, _)| time.contains(*at)).map(|(_, place)| (place.length() - inner) / WIDTH);
        vec![speed_round(run, &time), mean(places)]
    })
}
