//! One-way corridors between an entrance and an exit: flow, density and speed.

use super::measure::{across, density_and_speed, steady};
use super::place::{HERMES, rectangle, until_empty};
use super::{Case, Experiment, Figure};
use crate::pedestrian::{Area, steady_flow};

/// The experiment.
pub const EXPERIMENT: Experiment = Experiment {
    name: "corridor",
    title: "One-way corridor",
    about: "A room at 3 per m², an entrance, 4 m, a corridor of 8 m, an exit; widths of entrance, corridor and exit name the case. J: agents that cross \
            the middle of the corridor from 5 to 95 % of them; rho and v: 2 m of the corridor over that time.",
    source: "Zhang, Klingsch, Schadschneider, Seyfried, J. Stat. Mech. P06004 (2011), experiments uo-* of HERMES; measured on the recordings with the same \
             measures.",
    cases,
    overall: None,
};

/// Agents in the room.
const AGENTS: u32 = 180;
/// Length of the constriction at the entrance and at the exit, m.
const DOOR: f64 = 0.2;

/// Measurements of experiments and simulators: flow, density and speed.
struct Known {
    people: [&'static str; 3],
    jupedsim: [f64; 3],
    rvo2: [f64; 3],
}

const NONE: f64 = f64::NAN;
const UNKNOWN: [f64; 3] = [NONE; 3];

fn cases() -> Vec<Case> {
    let known = |people, jupedsim, rvo2| Known { people, jupedsim, rvo2 };
    let only = |people| known(people, UNKNOWN, UNKNOWN);
    vec![
        case([0.95, 2.4, 2.4], None, &only(["2.19", "0.69", "1.37"])).slow(),
        case([1.45, 2.4, 2.4], None, &known(["3.29", "1.05", "1.31"], [2.63, 0.88, 1.27], [6.87, 1.77, 1.49])).slow(),
        case(
            [2.4, 2.4, 2.4],
            Some([3.3, 4.6]),
            &known(["3.95", "1.88", "0.86"], [4.37, 1.49, 1.21], [11.9, 3.28, 1.51]),
        ),
        case([2.4, 2.4, 1.6], None, &only(["3.21", "2.18", "0.60"])).slow(),
        case(
            [2.4, 2.4, 1.3],
            Some([2.5, 3.4]),
            &known(["2.93", "2.41", "0.48"], [2.85, 3.06, 0.35], [8.70, 4.83, 0.70]),
        ),
        case([2.4, 2.4, 1.0], None, &only(["1.91 (1.8 m corridor)", "2.49", "0.43"])).slow(),
    ]
}

fn figures(flow: Option<[f64; 2]>, open: bool, known: &Known) -> Vec<Figure> {
    let of = |figure: Figure, k: usize| figure.people(known.people[k]).reference(known.jupedsim[k], known.rvo2[k]);
    let side = Figure::new("mean y/b", "", "mean place of the crossings aside of the middle, over the width");
    let flow = Figure { tolerance: flow, ..Figure::new("J", "1/s", "flow") };
    vec![
        of(flow, 0),
        of(Figure::new("rho", "1/m²", "density in 2 m of the corridor"), 1),
        of(Figure::new("v", "m/s", "mean speed there"), 2),
        if open { side.within(-0.05, 0.05).people("-0.01–0.01") } else { side },
        Figure::left(),
    ]
}

fn case([entrance, corridor, exit]: [f64; 3], flow: Option<[f64; 2]>, known: &Known) -> Case {
    let (room, half) = ([-4.0 - DOOR - 7.5, -4.0 - DOOR], 0.5 * corridor);
    let parts = [
        rectangle([room[0], -4.0], [room[1], 4.0]),
        rectangle([room[1] - 0.01, -0.5 * entrance], [-3.99, 0.5 * entrance]),
        rectangle([-4.0, -half], [8.0, half]),
        rectangle([7.99, -0.5 * exit], [8.01 + DOOR, 0.5 * exit]),
        rectangle([8.0 + DOOR, -4.0], [16.0, 4.0]),
    ];
    let rest = format!(
        "walkable.rectangles = [\n    {},\n]\n\n[[group]]\ncount = {AGENTS}\nplace.rectangle = {}\ngoal.exit.rectangle = {}\n{HERMES}\n",
        parts.join(",\n    "),
        rectangle([room[0], -4.0], [room[1], 4.0]),
        rectangle([14.0, -4.0], [16.0, 4.0]),
    );
    let name = format!("{entrance}-{corridor}-{exit} m");
    let figures = figures(flow, [entrance, exit] == [corridor; 2], known);
    Case::new(name, until_empty("One-way corridor", 240.0, &rest), figures, move |run| {
        let crossings = across(4.0, -half, half).crossings(&run.people);
        let time = steady(&crossings);
        let (rho, v) = Area::rectangle([3.0, -half, 2.0, corridor])
            .map_or((f64::NAN, f64::NAN), |area| density_and_speed(run, &area, &time));
        let side = crossings.iter().map(|crossing| crossing.share - 0.5).sum::<f64>() / crossings.len() as f64;
        vec![steady_flow(&crossings), rho, v, side, run.left as f64]
    })
}
