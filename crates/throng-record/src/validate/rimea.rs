//! The tests of RiMEA's guideline that need one level.

use super::measure::{mean, voronoi_density};
use super::place::{WEIDMANN, rectangle, until_empty};
use super::{Case, Experiment, Figure, Overall, Run};
use crate::pedestrian::Area;
use std::fmt::Write;

/// The experiment.
pub const EXPERIMENT: Experiment = Experiment {
    name: "rimea",
    title: "RiMEA",
    about: "Tests of the guideline that need one level: 1 walking speed, 5 reaction times, 6 corner, 7 distribution of speeds, 9 four exits or two, 10 assigned exits, 11 choice of \
            exit, 12 bottlenecks, 15 wide bend. Test 4 is the experiments corridor and loop; 2, 3, 8, 13 and 14 need stairs or levels.",
    source: "RiMEA, Guideline for Microscopic Evacuation Analysis, version 3.0 (2016), chapter of tests.",
    cases,
    overall: Some(Overall { figures: overall_figures, measure: overall }),
};

fn cases() -> Vec<Case> {
    vec![
        walking_speed(),
        reaction_times(),
        corner(),
        speeds(),
        exits("9, 4 exits", &[0, 1, 2, 3]).slow(),
        exits("9, 2 exits", &[0, 1]).slow(),
        assigned_exits(),
        choice_of_exit().slow(),
        bottlenecks().slow(),
        bend("15, bend", true).slow(),
        bend("15, straight", false).slow(),
    ]
}

/// Indices of the [`cases`] that the overall figures compare.
const EXITS: [usize; 2] = [4, 5];
const BENDS: [usize; 2] = [9, 10];

fn overall_figures() -> Vec<Figure> {
    vec![
        Figure::new("9: T 2/4", "", "time with two exits over that with four").within(1.6, 2.4).people("2"),
        Figure::new("15: T bend", "", "time round the bend over that on the straight way of its outer wall")
            .within(0.8, 1.25)
            .people("1"),
    ]
}

fn overall(cases: &[Vec<f64>]) -> Vec<f64> {
    let time = |case: usize| cases.get(case).and_then(|values| values.first()).copied().unwrap_or(f64::NAN);
    vec![time(EXITS[1]) / time(EXITS[0]), time(BENDS[0]) / time(BENDS[1])]
}

/// The time at which the last agent left, s.
fn time() -> Figure {
    Figure::new("T", "s", "when the last agent left")
}

fn last_time(run: &Run) -> f64 {
    run.people.walks.iter().filter_map(|walk| walk.times.last()).copied().fold(f64::NAN, f64::max)
}

/// Test 1: an agent of 1.33 m/s in a corridor of 40 m by 2 m.
fn walking_speed() -> Case {
    let rest = "walkable.rectangle = { center = [20, 0], size = [42, 2] }\n\n[[group]]\nplace.point = [0, 0]\n\
                goal.exit.rectangle = { center = [40.5, 0], size = [1, 2] }\nspeed.preferred = 1.33\n";
    let figures = vec![time().within(26.0, 34.0), Figure::left()];
    Case::new("1, walking speed", until_empty("RiMEA 1", 60.0, rest), figures, |run| {
        vec![last_time(run), run.left as f64]
    })
}

/// Test 5: ten agents that start to walk after 10 to 100 s.
fn reaction_times() -> Case {
    let rest = "walkable.rectangles = [{ center = [4, 2.5], size = [8, 5] }, { center = [9, 2.5], size = [2.2, 1] }]\n\n[[group]]\ncount = 10\n\
                place.rectangle = { center = [4, 2.5], size = [7, 4] }\ngoal.exit.rectangle = { center = [9.5, 2.5], size = [1, 1] }\nwait = { uniform = [10, 100] }\n";
    let figures = vec![
        Figure::new("first", "s", "when the first agent sets off").within(10.0, 100.0),
        Figure::new("last", "s", "when the last agent sets off").within(10.0, 100.5),
        Figure::left(),
    ];
    Case::new("5, reaction times", until_empty("RiMEA 5", 200.0, rest), figures, |run| {
        let sets_off = |walk: &crate::pedestrian::Walk| {
            walk.places.iter().position(|place| place.distance(walk.places[0]) > 0.05).map(|row| walk.times[row])
        };
        let times: Vec<f64> = run.people.walks.iter().filter_map(sets_off).collect();
        let least = times.iter().copied().fold(f64::NAN, f64::min);
        vec![least, times.iter().copied().fold(f64::NAN, f64::max), run.left as f64]
    })
}

/// Test 6: twenty agents that walk around a corner of a corridor of 2 m.
fn corner() -> Case {
    let parts = [rectangle([0.0, 0.0], [12.0, 2.0]), rectangle([10.0, 0.0], [12.0, 12.0])];
    let rest = format!(
        "walkable.rectangles = [{}]\n\n[[group]]\ncount = 20\nplace.rectangle = {}\ngoal.exit.rectangle = {}\n{WEIDMANN}\n",
        parts.join(", "),
        rectangle([0.0, 0.0], [6.0, 2.0]),
        rectangle([10.0, 11.0], [12.0, 12.0])
    );
    let figures = vec![
        Figure::new("wall", "", "least distance of a centre to a wall over the radius").within(0.9999, f64::INFINITY),
        time(),
        Figure::left(),
    ];
    Case::new("6, corner", until_empty("RiMEA 6", 90.0, &rest), figures, |run| {
        vec![run.summary.least_wall_separation, last_time(run), run.left as f64]
    })
}

/// Test 7: fifty agents with distributed speeds, side by side.
fn speeds() -> Case {
    let mut rest = String::from("walkable.rectangle = { center = [15, 0], size = [32, 50] }\n");
    let _ = write!(
        rest,
        "\n[[group]]\ncount = 50\nplace.line = {{ from = [0, -24.5], to = [0, 24.5] }}\ngoal.shift = {{ by = [30, 0] }}\n{WEIDMANN}\n"
    );
    let figures = vec![
        Figure::new("mean", "m/s", "mean of the walked speeds, drawn from 1.34").within(1.25, 1.43).people("1.34"),
        Figure::new("sd", "m/s", "standard deviation of the walked speeds, drawn from 0.26")
            .within(0.18, 0.34)
            .people("0.26"),
        Figure::left(),
    ];
    Case::new("7, speeds", until_empty("RiMEA 7", 90.0, &rest), figures, |run| {
        let speed = |walk: &crate::pedestrian::Walk| {
            let reached = |x: f64| walk.places.iter().position(|place| place.x >= x).map(|row| walk.times[row]);
            Some(20.0 / (reached(25.0)? - reached(5.0)?))
        };
        let speeds: Vec<f64> = run.people.walks.iter().filter_map(speed).collect();
        let average = mean(speeds.iter().copied());
        let deviation = mean(speeds.iter().map(|speed| (speed - average).powi(2))).sqrt();
        vec![average, deviation, run.left as f64]
    })
}

/// Test 9: 1000 agents leave a room of 30 m by 20 m through exits of 1 m.
fn exits(name: &str, open: &[usize]) -> Case {
    let doors = [[7.5, 20.0], [22.5, 20.0], [7.5, 0.0], [22.5, 0.0]];
    let open: Vec<[f64; 2]> = open.iter().map(|&door| doors[door]).collect();
    let passage = |&[x, y]: &[f64; 2]| rectangle([x - 0.5, y - 1.0], [x + 0.5, y + 1.0]);
    let exit = |&[x, y]: &[f64; 2]| {
        let out = if y > 0.0 { [20.5, 21.0] } else { [-1.0, -0.5] };
        format!("{{ exit.rectangle = {} }}", rectangle([x - 0.5, out[0]], [x + 0.5, out[1]]))
    };
    let passages: Vec<String> = open.iter().map(passage).collect();
    let goals: Vec<String> = open.iter().map(exit).collect();
    let rest = format!(
        "walkable.rectangles = [{}, {}]\n\n[[group]]\ncount = 1000\nplace.rectangle = {}\ngoal.nearest = [{}]\n{WEIDMANN}\n",
        rectangle([0.0, 0.0], [30.0, 20.0]),
        passages.join(", "),
        rectangle([0.5, 0.5], [29.5, 19.5]),
        goals.join(", ")
    );
    Case::new(name, until_empty("RiMEA 9", 900.0, &rest), vec![time(), Figure::left()], |run| {
        vec![last_time(run), run.left as f64]
    })
}

/// Test 10: 23 agents in twelve rooms along a corridor; the agents of eight rooms are assigned the main exit.
fn assigned_exits() -> Case {
    let mut ground = vec![rectangle([-1.0, -1.0], [20.0, 1.0])];
    let mut places = [Vec::new(), Vec::new()];
    for room in 0..12 {
        let (x, up) = (f64::from(room % 6) * 3.2, room < 6);
        let (low, high) = if up { (1.2, 5.2) } else { (-5.2, -1.2) };
        let door = if up { (0.9, 1.3) } else { (-1.3, -0.9) };
        ground.push(rectangle([x, low], [x + 3.0, high]));
        ground.push(rectangle([x + 1.05, door.0], [x + 1.95, door.1]));
        // 23 agents: two in each room, but one in the last
        let stands = if room == 11 { vec![x + 1.5] } else { vec![x + 0.9, x + 2.1] };
        let assigned = usize::from(room % 6 >= 4);
        places[assigned].extend(stands.into_iter().map(|at| format!("[{at:.2}, {:.2}]", 0.5 * (low + high))));
    }
    let group = |name: &str, places: &[String], exit: [f64; 2]| {
        format!(
            "\n[[group]]\nname = {name:?}\nplace.points = [{}]\ngoal.exit.rectangle = {}\n{WEIDMANN}\n",
            places.join(", "),
            rectangle([exit[0], -1.0], [exit[1], 1.0])
        )
    };
    let rest = format!(
        "walkable.rectangles = [\n    {},\n]\n{}{}",
        ground.join(",\n    "),
        group("main", &places[0], [-1.0, -0.4]),
        group("secondary", &places[1], [19.4, 20.0])
    );
    let assigned = Figure::new("assigned", "", "share of the agents that leave by their exit").within(1.0, 1.0);
    Case::new(
        "10, assigned exits",
        until_empty("RiMEA 10", 120.0, &rest),
        vec![assigned, time(), Figure::left()],
        |run| {
            let by_own = run.people.walks.iter().map(|walk| {
                let x = walk.places.last().map_or(f64::NAN, |place| place.x);
                f64::from(u8::from(if run.group(walk.number) == 0 { x < 1.0 } else { x > 18.0 }))
            });
            vec![mean(by_own), last_time(run), run.left as f64]
        },
    )
}

/// Test 11: 500 agents before two exits, one nearer: some must take the farther exit.
fn choice_of_exit() -> Case {
    let exit = |y: f64| format!("{{ exit.rectangle = {} }}", rectangle([31.0, y - 0.5], [31.5, y + 0.5]));
    let passage = |y: f64| rectangle([29.0, y - 0.5], [31.5, y + 0.5]);
    let rest = format!(
        "walkable.rectangles = [{}, {}, {}]\n\n[[group]]\ncount = 500\nplace.rectangle = {}\ngoal.nearest = [{}, {}]\n{WEIDMANN}\n",
        rectangle([0.0, 0.0], [30.0, 20.0]),
        passage(5.0),
        passage(15.0),
        rectangle([10.0, 0.5], [29.0, 9.5]),
        exit(5.0),
        exit(15.0)
    );
    let other = Figure::new("other exit", "", "share of the agents that leave by the farther exit").within(0.02, 0.5);
    Case::new("11, choice of exit", until_empty("RiMEA 11", 600.0, &rest), vec![other, time(), Figure::left()], |run| {
        let other = run
            .people
            .walks
            .iter()
            .map(|walk| f64::from(u8::from(walk.places.last().is_some_and(|place| place.y > 10.0))));
        vec![mean(other), last_time(run), run.left as f64]
    })
}

/// Test 12: 150 agents walk through a corridor of 1 m into a second room with an exit of 1 m: a jam may form only
/// before the corridor.
fn bottlenecks() -> Case {
    let parts = [
        rectangle([-10.0, -5.0], [0.0, 5.0]),
        rectangle([-0.01, -0.5], [5.01, 0.5]),
        rectangle([5.0, -5.0], [15.0, 5.0]),
        rectangle([14.99, -0.5], [17.0, 0.5]),
    ];
    let rest = format!(
        "walkable.rectangles = [\n    {},\n]\n\n[[group]]\ncount = 150\nplace.rectangle = {}\ngoal.exit.rectangle = {}\n{WEIDMANN}\n",
        parts.join(",\n    "),
        rectangle([-10.0, -5.0], [-3.0, 5.0]),
        rectangle([16.0, -0.5], [17.0, 0.5])
    );
    let figures = vec![
        Figure::new("rho before", "1/m²", "Voronoi density before the corridor, from 20 to 60 s").people("jam"),
        Figure::new("rho exit", "1/m²", "Voronoi density before the exit of the second room")
            .within(0.0, 2.0)
            .people("no jam"),
        time(),
        Figure::left(),
    ];
    Case::new("12, bottlenecks", until_empty("RiMEA 12", 400.0, &rest), figures, |run| {
        let density = |x: f64| {
            Area::rectangle([x - 1.0, -0.5, 1.0, 1.0])
                .map_or(f64::NAN, |area| voronoi_density(run, &area, &(20.0..=60.0)))
        };
        vec![density(0.0), density(15.0), last_time(run), run.left as f64]
    })
}

/// Test 15: 250 agents around a bend of a corridor of 4 m, or straight on along the length of its outer wall.
fn bend(name: &str, bent: bool) -> Case {
    let (ground, exit) = if bent {
        ("[[0, 0], [30, 0], [30, 30], [26, 30], [26, 4], [0, 4]]", rectangle([26.0, 28.5], [30.0, 30.0]))
    } else {
        ("[[0, 0], [60, 0], [60, 4], [0, 4]]", rectangle([58.5, 0.0], [60.0, 4.0]))
    };
    let rest = format!(
        "walkable.polygon.outer = {ground}\n\n[[group]]\ncount = 250\nplace.rectangle = {}\ngoal.exit.rectangle = {exit}\n{WEIDMANN}\n",
        rectangle([0.3, 0.3], [25.0, 3.7])
    );
    Case::new(name, until_empty("RiMEA 15", 400.0, &rest), vec![time(), Figure::left()], |run| {
        vec![last_time(run), run.left as f64]
    })
}
