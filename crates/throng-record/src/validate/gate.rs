//! Gates in a long wall: is the whole width used?

use super::measure::{across, mean};
use super::place::{rectangle, until_empty};
use super::{Case, Experiment, Figure, Overall, Run};
use crate::pedestrian::steady_flow;

/// The experiment.
pub const EXPERIMENT: Experiment = Experiment {
    name: "gate",
    title: "Gates",
    about: "400 agents on 14 m by 36 m before a gate in a wall. J: agents that come through from 5 to 95 % of them; where on the width they cross; whether both sides of the crowd \
            empty alike.",
    source: "No experiment of its own: people pass in proportion to the width (doors), over its whole width (AO: J/b 2.35 at 3 m).",
    cases,
    overall: Some(Overall { figures: overall_figures, measure: overall }),
};

/// Widths, m.
const WIDTHS: [f64; 5] = [1.0, 2.0, 3.0, 4.0, 6.0];

fn cases() -> Vec<Case> {
    let quick = |width: f64| [2.0, 4.0].contains(&width);
    WIDTHS.iter().map(|&width| if quick(width) { case(width) } else { case(width).slow() }).collect()
}

fn case(width: f64) -> Case {
    let half = 0.5 * width;
    let rest = format!(
        "walkable.rectangle = {{ center = [0, 0], size = [40, 40] }}\n\n\
         [[obstacle]]\nshape.wall = [[0, -20], [0, {:.2}]]\n\n[[obstacle]]\nshape.wall = [[0, {half:.2}], [0, 20]]\n\n\
         [[group]]\ncount = 400\nplace.rectangle = {{ center = [-11, 0], size = [14, 36], gap = 0.1 }}\ngoal.exit.rectangle = {}\n\
         speed.preferred = {{ normal = {{ mean = 1.3, deviation = 0.2 }} }}\n",
        -half,
        rectangle([12.0, -6.0], [16.0, 6.0])
    );
    let middle = Figure::new(
        "middle half",
        "",
        "share of the crossings in the middle half of the gate; 0.5 if they are spread evenly",
    );
    let sides =
        Figure::new("side", "", "how much more of one side than of the other is among the first half that crosses")
            .within(0.0, 0.1);
    let figures = vec![
        Figure::new("J/b", "1/(m s)", "flow over the width").people("1.6–2.4"),
        if width >= 2.0 { middle.within(0.35, 0.75) } else { middle },
        sides,
        Figure::left(),
    ];
    Case::new(format!("{width} m"), until_empty("Gate", 400.0, &rest), figures, move |run| measure(run, width))
}

fn measure(run: &Run, width: f64) -> Vec<f64> {
    let crossings = across(0.0, -0.5 * width, 0.5 * width).crossings(&run.people);
    let middle = mean(crossings.iter().map(|crossing| f64::from(u8::from((crossing.share - 0.5).abs() <= 0.25))));
    let upper = |number: u32| {
        let walk = run.people.walks.iter().find(|walk| walk.number == number);
        walk.and_then(|walk| walk.places.first()).map_or(0.0, |place| f64::from(u8::from(place.y > 0.0)))
    };
    let share = |part: &[crate::pedestrian::Crossing]| mean(part.iter().map(|crossing| upper(crossing.number)));
    let sides = (share(&crossings[..crossings.len() / 2]) - share(&crossings)).abs();
    vec![steady_flow(&crossings) / width, middle, sides, run.left as f64]
}

fn overall_figures() -> Vec<Figure> {
    vec![
        Figure::new("least J/b", "", "least specific flow of the gates over their mean").within(0.8, 1.0),
        Figure::new("most J/b", "", "largest specific flow of the gates over their mean").within(1.0, 1.2),
    ]
}

fn overall(cases: &[Vec<f64>]) -> Vec<f64> {
    let flows: Vec<f64> =
        cases.iter().filter_map(|values| values.first()).copied().filter(|flow| flow.is_finite()).collect();
    let average = mean(flows.iter().copied());
    let least = flows.iter().copied().fold(f64::NAN, f64::min);
    let most = flows.iter().copied().fold(f64::NAN, f64::max);
    vec![least / average, most / average]
}
