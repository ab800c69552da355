//! Single file: the speed of agents that cannot overtake, by their density.

use super::measure::speed_round;
use super::place::until;
use super::{Case, Experiment, Figure};

/// The experiment.
pub const EXPERIMENT: Experiment = Experiment {
    name: "single-file",
    title: "Single file",
    about: "A ring of 26.84 m, 0.8 m wide, the agents evenly spaced, free speed 1.24 ± 0.05 m/s; mean speed along the ring from 25 to 60 s. The people were told to walk one behind \
            the other: the agents' `shoulders` are as broad as the ring.",
    source: "Seyfried, Steffen, Klingsch, Boltes, J. Stat. Mech. P10002 (2005); points of the Jülich single file experiments.",
    cases,
    overall: None,
};

/// Length of the ring, m.
const LENGTH: f64 = 26.84;
/// Width of the ring, m.
const WIDTH: f64 = 0.8;

fn cases() -> Vec<Case> {
    let speed = || Figure::new("v", "m/s", "mean speed along the ring");
    vec![
        case(14, speed().people("1.17 (at 0.58 per m)").reference(1.19, 1.24)),
        case(20, speed().people("0.85–1.0")).slow(),
        case(28, speed().within(0.43, 0.73).people("0.58").reference(0.53, 1.23)),
        case(39, speed().within(0.23, 0.53).people("0.38 (at 1.36)").reference(0.31, 1.25)),
        case(49, speed().people("0.17–0.2")).slow(),
        case(60, speed().within(0.0, 0.25).people("0.14 (1.95), 0.04 (2.44)").reference(0.15, 1.26)),
    ]
}

fn case(agents: u32, speed: Figure) -> Case {
    let radius = LENGTH / std::f64::consts::TAU;
    let (inner, outer) = (radius - 0.5 * WIDTH, radius + 0.5 * WIDTH);
    let rest = format!(
        "walkable.ring = {{ inner = {inner:.4}, outer = {outer:.4} }}\n\n\
         [[group]]\ncount = {agents}\nplace.ring = {{ radius = {radius:.4} }}\ngoal.lap = {{}}\nshoulders = {WIDTH}\n\
         speed.preferred = {{ normal = {{ mean = 1.24, deviation = 0.05 }} }}\n"
    );
    let density = f64::from(agents) / LENGTH;
    let name = format!("{density:.2} per m");
    Case::new(name, until("Single file", 60.0, &rest), vec![speed], |run| vec![speed_round(run, &(25.0..=60.0))])
}
