//! Two-way corridors: flow, speed, lane formation.

use super::measure::{across, density_and_speed, mean, moments, steady};
use super::place::{WEIDMANN, rectangle, until_empty};
use super::{Case, Experiment, Figure, Run};
use crate::pedestrian::lanes::{Directions, order};
use crate::pedestrian::{Area, PeopleMoment, steady_flow};

/// The experiment.
pub const EXPERIMENT: Experiment = Experiment {
    name: "bidirectional",
    title: "Two-way corridor",
    about: "A corridor of 4 m, two blocks of 140 that walk through each other, each at half the density that names the case. J_s: both directions through the middle \
            over the width, from 5 to 95 % of the crossings; v and rho in 4 m round the middle over that time.",
    source: "Zhang, Klingsch, Schadschneider, Seyfried, J. Stat. Mech. P02002 (2012), experiments bo-* and bot-* of HERMES; lane order: Nowak, Schadschneider, Phys. Rev. E 85 (2012).",
    cases,
    overall: None,
};

/// Width of the corridor, m.
const WIDTH: f64 = 4.0;
/// Agents of each direction.
const AGENTS: u32 = 140;

/// Lane order is measured within this distance of the middle, m: the experiments' cameras covered about 8 m.
const LANES: f64 = 4.0;

fn cases() -> Vec<Case> {
    vec![
        case(
            1.5,
            [
                Figure::new("J_s", "1/(m s)", "flow of both directions over the width")
                    .within(1.0, 1.5)
                    .people("1.22–1.30")
                    .reference(1.18, 1.62),
                Figure::new("v", "m/s", "mean speed").people("0.83–0.97").reference(0.68, 1.22),
                Figure::new("phi", "", "lane order parameter")
                    .within(0.57, 0.99)
                    .people("0.57–0.99")
                    .reference(0.66, 0.82),
            ],
        ),
        case(
            3.0,
            [
                Figure::new("J_s", "1/(m s)", "flow of both directions over the width")
                    .within(1.0, 1.5)
                    .people("1.24–1.26")
                    .reference(f64::NAN, 1.94),
                Figure::new("v", "m/s", "mean speed").people("0.46").reference(0.24, 0.86),
                Figure::new("phi", "", "lane order parameter").people("0.35–0.91").reference(0.90, 0.44),
            ],
        ),
    ]
}

fn case(density: f64, [flow, speed, order]: [Figure; 3]) -> Case {
    let (length, half) = (f64::from(AGENTS) / (0.5 * density * WIDTH), 0.5 * WIDTH);
    let (near, end) = (2.0, 2.0 + length + 4.0);
    let block = |name: &str, from: f64, to: f64, exit: [f64; 2]| {
        format!(
            "\n[[group]]\nname = {name:?}\ncount = {AGENTS}\nplace.rectangle = {}\ngoal.exit.rectangle = {}\n{WEIDMANN}\n",
            rectangle([from, -half], [to, half]),
            rectangle([exit[0], -half], [exit[1], half])
        )
    };
    let rest = format!(
        "walkable.rectangle = {}\n{}{}",
        rectangle([-end, -half], [end, half]),
        block("eastward", -near - length, -near, [end - 2.0, end]),
        block("westward", near, near + length, [-end, 2.0 - end])
    );
    let figures = vec![flow, Figure::new("rho", "1/m²", "density of both directions"), speed, order, Figure::left()];
    Case::new(format!("{density} per m²"), until_empty("Two-way corridor", 300.0, &rest), figures, measure)
}

fn measure(run: &Run) -> Vec<f64> {
    let crossings = across(0.0, -0.5 * WIDTH, 0.5 * WIDTH).crossings(&run.people);
    let time = steady(&crossings);
    let area = Area::rectangle([-2.0, -0.5 * WIDTH, 4.0, WIDTH]);
    let (rho, v) = area.map_or((f64::NAN, f64::NAN), |area| density_and_speed(run, &area, &time));
    let directions = Directions::of(&run.people);
    let phi = mean(moments(run, &time).filter_map(|moment| {
        let here = moment.here.iter().copied().filter(|&here| run.people.place(here).x.abs() <= LANES);
        order(&run.people, &PeopleMoment { time: moment.time, here: here.collect() }, &directions)
    }));
    vec![steady_flow(&crossings) / WIDTH, rho, v, phi, run.left as f64]
}
