//! Two agents that meet head on, and a single agent.

use super::place::until_empty;
use super::{Case, Experiment, Figure, Run};

/// Two agents that meet.
pub const PAIR: Experiment = Experiment {
    name: "head-on",
    title: "Head-on pair",
    about: "Two agents 24 m apart that walk towards each other at 1.3 m/s, exactly or with an offset; their distance when avoidance begins (0.1 m aside), and the least distance of their centres.",
    source: "Least distances of recorded head-on pairs: ETH 1.17, hotel 1.10, zara 0.98 m (median), measured on the recordings; avoidance begins at 5 to 8 m.",
    cases: pair,
    overall: None,
};

/// A single agent.
pub const LONE: Experiment = Experiment {
    name: "lone-walker",
    title: "Lone walker",
    about: "An agent that walks 24 m straight ahead: its greatest lateral displacement.",
    source: "There is no reason to leave the straight line.",
    cases: lone,
    overall: None,
};

/// Lateral displacement that counts as the start of avoidance, m.
const ASIDE: f64 = 0.1;

fn pair() -> Vec<Case> {
    [0.0, 0.2].map(meeting).into()
}

fn meeting(offset: f64) -> Case {
    let walker = |name: &str, from: f64, y: f64| {
        format!(
            "\n[[group]]\nname = {name:?}\nplace.point = [{from}, {y}]\ngoal.exit.rectangle = {{ center = [{}, 0], size = [2, 6] }}\nspeed.preferred = 1.3\n",
            -from - from.signum()
        )
    };
    let rest = walker("east", -12.0, 0.0) + &walker("west", 12.0, offset);
    let figures = vec![
        Figure::new("begins", "m", "distance of the two when the first is 0.1 m aside").within(5.0, 20.0).people("5–8"),
        Figure::new("passes", "m", "least distance of the centres")
            .within(0.7, 1.2)
            .people("0.98–1.17")
            .reference(1.45, 0.40),
        Figure::left(),
    ];
    Case::new(format!("offset {offset} m"), until_empty("Head-on pair", 60.0, &rest), figures, measure)
}

fn measure(run: &Run) -> Vec<f64> {
    let [a, b] = &run.people.walks[..] else { return vec![f64::NAN, f64::NAN, run.left as f64] };
    let moments = a.places.iter().zip(&b.places);
    let least = moments.clone().map(|(a, b)| a.distance(*b)).fold(f64::INFINITY, f64::min);
    let aside = |walk: &crate::pedestrian::Walk, at: usize| (walk.places[at].y - walk.places[0].y).abs();
    let first = (0..a.places.len().min(b.places.len())).find(|&at| aside(a, at).max(aside(b, at)) > ASIDE);
    // agents that have already passed each other do not start to avoid
    let begins = first.filter(|&at| a.places[at].x < b.places[at].x).map(|at| a.places[at].distance(b.places[at]));
    vec![begins.unwrap_or(f64::NAN), least, run.left as f64]
}

fn lone() -> Vec<Case> {
    let rest = "\n[[group]]\nplace.point = [-12, 0]\ngoal.exit.rectangle = { center = [13, 0], size = [2, 6] }\nspeed.preferred = 1.3\n";
    let figures = vec![
        Figure::new("aside", "m", "greatest distance from the straight line")
            .within(0.0, 0.05)
            .reference(f64::NAN, 0.0),
        Figure::left(),
    ];
    let measure = |run: &Run| {
        let places = run.people.walks.iter().flat_map(|walk| &walk.places);
        vec![places.map(|place| place.y.abs()).fold(0.0, f64::max), run.left as f64]
    };
    vec![Case::new("24 m", until_empty("Lone walker", 60.0, rest), figures, measure)]
}
