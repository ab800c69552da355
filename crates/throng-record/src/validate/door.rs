//! Doors: the flow by the width, and the density before the door.

use super::measure::{across, mean, steady, voronoi_density};
use super::place::{HERMES, rectangle, until_empty};
use super::{Case, Experiment, Figure, Overall, Run};
use crate::pedestrian::{Area, Crossing, steady_flow};
use std::ops::RangeInclusive;

/// The experiment.
pub const EXPERIMENT: Experiment = Experiment {
    name: "door",
    title: "Doors",
    about: "A room 8 m wide with 150 agents at 3 per m², a passage of 1 m length. J: agents that come through from 5 to 95 % of them; rho: Voronoi density of the \
            square metre before the door while half of the crowd is still before it.",
    source: "Kretz, Grünebohm, Schreckenberg, J. Stat. Mech. P10014 (2006); Seyfried et al., Transp. Sci. 43 (2009); Nagai et al., Physica A 367 (2006); Müller (1981); \
             Daamen, Hoogendoorn (2010); experiments AO and EG of HERMES. Densities: recordings h- and h0 of Adrian et al. (2020).",
    cases,
    overall: Some(Overall { figures: overall_figures, measure: overall }),
};

fn cases() -> Vec<Case> {
    let none = f64::NAN;
    let flow = |people, [jupedsim, rvo2]: [f64; 2]| {
        Figure::new("J/b", "1/(m s)", "flow over the width").people(people).reference(jupedsim, rvo2)
    };
    vec![
        case(0.6, flow("1.87–2.47", [none, none])).slow(),
        case(0.8, flow("1.61–2.17", [1.46, 1.72]).within(1.5, 2.4)),
        case(1.0, flow("1.71–2.65", [none, none]).within(1.5, 2.4)).slow(),
        case(1.2, flow("1.69–2.15", [1.80, 3.76]).within(1.5, 2.4)),
        case(1.6, flow("1.78–2.04", [none, none]).within(1.5, 2.4)).slow(),
        case(2.0, flow("1.77–1.94", [1.84, 4.51]).within(1.5, 2.4)),
        case(2.4, flow("2.42", [none, none]).within(1.5, 2.4)).slow(),
    ]
}

fn case(width: f64, flow: Figure) -> Case {
    let half = 0.5 * width;
    let required = flow.tolerance.is_some();
    let rho = Figure::new("rho", "1/m²", "Voronoi density before the door").people("4–8.3").reference(3.7, 4.3);
    let figures = vec![
        flow,
        if required { rho.within(4.0, 10.0) } else { rho },
        Figure::new("cv", "", "standard deviation over mean of the gaps between consecutive crossings")
            .people("0.52–0.78 (0.5 m)"),
        Figure::new("gaps > 3 s", "", "share of the gaps that are longer than 3 s").people("0 (0.5 m)"),
        Figure::new("longest", "s", "the longest gap").people("2.7 (0.5 m)"),
        Figure::left(),
    ];
    let parts = [
        rectangle([-6.25, -4.0], [0.0, 4.0]),
        rectangle([-0.01, -half], [1.01, half]),
        rectangle([1.0, -4.0], [8.0, 4.0]),
    ];
    let rest = format!(
        "walkable.rectangles = [\n    {},\n]\n\n[[group]]\ncount = 150\nplace.rectangle = {}\ngoal.exit.rectangle = {}\n{HERMES}\n",
        parts.join(",\n    "),
        rectangle([-6.25, -4.0], [0.0, 4.0]),
        rectangle([6.0, -4.0], [8.0, 4.0]),
    );
    Case::new(format!("{width} m"), until_empty("Door", 240.0, &rest), figures, move |run| measure(run, width))
}

fn measure(run: &Run, width: f64) -> Vec<f64> {
    let crossings = across(0.5, -0.5 * width, 0.5 * width).crossings(&run.people);
    let before = Area::rectangle([-1.0, -0.5, 1.0, 1.0])
        .map_or(f64::NAN, |area| voronoi_density(run, &area, &crowded(&crossings)));
    let gaps: Vec<f64> = crossings.windows(2).map(|pair| pair[1].time - pair[0].time).collect();
    let average = mean(gaps.iter().copied());
    let deviation = mean(gaps.iter().map(|gap| (gap - average).powi(2))).sqrt();
    let long = mean(gaps.iter().map(|&gap| f64::from(u8::from(gap > 3.0))));
    let longest = gaps.iter().copied().fold(f64::NAN, f64::max);
    vec![steady_flow(&crossings) / width, before, deviation / average, long, longest, run.left as f64]
}

/// Returns the time from the crossing of the first 5 % until half of the crowd has crossed, seconds.
fn crowded(crossings: &[Crossing]) -> RangeInclusive<f64> {
    let half = crossings.get(crossings.len() / 2).map_or(0.0, |at| at.time);
    *steady(crossings).start()..=half
}

fn overall_figures() -> Vec<Figure> {
    vec![
        Figure::new(
            "J/b most/least",
            "",
            "largest over least specific flow of the doors of 0.8 m and wider: flat in the width",
        )
        .within(1.0, 1.35)
        .people("1.2"),
    ]
}

fn overall(cases: &[Vec<f64>]) -> Vec<f64> {
    let flows = cases.iter().skip(1).filter_map(|values| values.first()).copied().filter(|flow| flow.is_finite());
    let (least, most) = flows.fold((f64::INFINITY, 0.0_f64), |(least, most), flow| (least.min(flow), most.max(flow)));
    vec![if least > 0.0 { most / least } else { f64::NAN }]
}
