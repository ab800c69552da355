//! Two streams that cross at a right angle: stripes, and agents that are swept away.

use super::measure::{across, density_and_speed, mean, moments, steady};
use super::place::{WEIDMANN, rectangle, until_empty};
use super::{Case, Experiment, Figure, Run};
use crate::pedestrian::{Area, PeopleMoment};
use glam::DVec2;

/// The experiment.
pub const EXPERIMENT: Experiment = Experiment {
    name: "crossing",
    title: "Crossing",
    about: "Two corridors of 4 m that cross at 90 degrees, 148 agents each at 1.25 per m². Stripes: the direction of the wave with which the two streams alternate most strongly \
            in the square of the crossing; swept: agents that get more than 1 m into an arm that is not on their way.",
    source: "Mullick, Fontaine, Appert-Rolland, Olivier, Warren, Pettré, PLoS Comp. Biol. 18 (2022): stripes at 45 degrees; Zhang, Seyfried, arXiv 1312.2475: speeds as in two-way corridors.",
    cases,
    overall: None,
};

/// Half the width of both corridors, m.
const HALF: f64 = 2.0;
/// Agents of each stream.
const AGENTS: u32 = 148;
/// Distance from the middle that is a metre into an arm.
const INTO_ARM: f64 = HALF + 1.0;

fn cases() -> Vec<Case> {
    let length = f64::from(AGENTS) / (1.25 * 2.0 * HALF);
    let (start, end) = (-HALF - length - 1.0, HALF + 10.0);
    let stream = |name: &str, from: [[f64; 2]; 2], exit: [[f64; 2]; 2]| {
        format!(
            "\n[[group]]\nname = {name:?}\ncount = {AGENTS}\nplace.rectangle = {}\ngoal.exit.rectangle = {}\n{WEIDMANN}\n",
            rectangle(from[0], from[1]),
            rectangle(exit[0], exit[1])
        )
    };
    let rest = format!(
        "walkable.rectangles = [\n    {},\n    {},\n]\n{}{}",
        rectangle([start, -HALF], [end, HALF]),
        rectangle([-HALF, start], [HALF, end]),
        stream("eastward", [[start, -HALF], [-HALF - 1.0, HALF]], [[end - 2.0, -HALF], [end, HALF]]),
        stream("northward", [[-HALF, start], [HALF, -HALF - 1.0]], [[-HALF, end - 2.0], [HALF, end]]),
    );
    let none = f64::NAN;
    let figures = vec![
        Figure::new("stripes", "deg", "direction of the wave of the strongest stripes")
            .within(40.0, 50.0)
            .people("45")
            .reference(none, 47.0),
        Figure::new("swept", "", "share of agents that get more than 1 m into an arm not on their way")
            .within(0.0, 0.01),
        Figure::new("v", "m/s", "mean speed in the crossing").people("0.6 (2 per m²)").reference(none, 1.22),
        Figure::new("rho", "1/m²", "density in the crossing"),
        Figure::left(),
    ];
    vec![Case::new("90 deg", until_empty("Crossing", 240.0, &rest), figures, measure)]
}

fn measure(run: &Run) -> Vec<f64> {
    let crossings = across(0.0, -HALF, HALF).crossings(&run.people);
    let eastward: Vec<_> = crossings.into_iter().filter(|crossing| run.group(crossing.number) == 0).collect();
    let time = steady(&eastward);
    let area = Area::rectangle([-HALF, -HALF, 2.0 * HALF, 2.0 * HALF]);
    let (rho, v) = area.map_or((f64::NAN, f64::NAN), |area| density_and_speed(run, &area, &time));
    let swept = mean(run.people.walks.iter().map(|walk| {
        let aside = |place: &DVec2| if run.group(walk.number) == 0 { place.y.abs() } else { place.x.abs() };
        f64::from(u8::from(walk.places.iter().map(aside).fold(0.0, f64::max) > INTO_ARM))
    }));
    let inside: Vec<Vec<(DVec2, f64)>> = moments(run, &time).step_by(6).map(|moment| streams(run, moment)).collect();
    vec![wave_direction(&inside), swept, v, rho, run.left as f64]
}

/// Returns the positions of agents in the crossing, with 1 for one stream and -1 for the other, less the mean.
fn streams(run: &Run, moment: &PeopleMoment) -> Vec<(DVec2, f64)> {
    let stream = |number: u32| if run.group(number) == 0 { 1.0 } else { -1.0 };
    let all = moment.here.iter().map(|&here| (run.people.place(here), stream(run.people.walks[here.walk].number)));
    let inside: Vec<(DVec2, f64)> = all.filter(|(place, _)| place.abs().max_element() <= HALF).collect();
    let average = mean(inside.iter().map(|(_, stream)| *stream));
    inside.into_iter().map(|(place, stream)| (place, stream - average)).collect()
}

/// Returns the direction of the plane wave that correlates most strongly with the alternation of two streams, in
/// degrees from +x, from -44 to 134: centred on the expected 45.
fn wave_direction(moments: &[Vec<(DVec2, f64)>]) -> f64 {
    // from 1.2 m, two files, to the width of the corridor
    let lengths = (0..15).map(|k| 1.2 + 0.2 * f64::from(k));
    let waves = lengths.flat_map(|length| (0..90).map(move |k| (2.0 * f64::from(k) - 44.0, length)));
    let strength = |(degrees, length): (f64, f64)| {
        let wave = std::f64::consts::TAU / length * DVec2::from_angle(degrees.to_radians());
        let of_moment = |all: &Vec<(DVec2, f64)>| {
            let sum: DVec2 = all.iter().map(|(place, stream)| *stream * DVec2::from_angle(wave.dot(*place))).sum();
            sum.length_squared() / all.len().max(1) as f64
        };
        (moments.iter().map(of_moment).sum::<f64>(), degrees)
    };
    let strongest = waves.map(strength).max_by(|a, b| a.0.total_cmp(&b.0));
    strongest.filter(|(strength, _)| *strength > 0.0).map_or(f64::NAN, |(_, degrees)| degrees)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stripes_are_found_in_their_direction() {
        for degrees in [20.0, 45.0, 110.0_f64] {
            let wave = std::f64::consts::TAU / 2.0 * DVec2::from_angle(degrees.to_radians());
            // a lattice; each agent belongs to the stream of its stripe
            let places = (0..400).map(|k| DVec2::new(f64::from(k % 20), f64::from(k / 20)) * 0.2 - 2.0);
            let stripes = places.map(|place| (place, wave.dot(place).cos().signum())).collect();
            assert!((wave_direction(&[stripes]) - degrees).abs() <= 4.0);
        }
        assert!(wave_direction(&[]).is_nan());
    }
}
