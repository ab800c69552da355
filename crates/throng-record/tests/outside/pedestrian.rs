//! Tests of measures of recorded pedestrians against PedPy 1.5.1 on the same files (`consumers/pedpy_reference.py`
//! prints its results) and against published measurements.

use super::shared::{near, points, speed_at};
use super::trajectories;
use glam::DVec2;
use throng::Walkable;
use throng_record::pedestrian::{
    Area, Figures, Ground, Inside, Line, People, Question, count, flow, flows, steady_flow,
};
use throng_record::{Reading, Trajectories};

fn people(name: &str) -> People {
    let tracks = Trajectories::read_as(trajectories(name), &Reading::default()).unwrap();
    People::of(&tracks, |_| true)
}

fn question(area: [f64; 4], line: [f64; 4], ground: Ground) -> Question {
    let [x0, y0, x1, y1] = line;
    let line = Line { from: DVec2::new(x0, y0), to: DVec2::new(x1, y1) };
    Question { interval: 0.4, areas: Area::rectangle(area).into_iter().collect(), lines: vec![line], ground }
}

/// Returns the figures of the bottleneck of 3 m, measured as by PedPy.
fn bottleneck(people: &People) -> Figures {
    let ground = Ground { walkable: vec![], cut_off: Some(0.8) };
    Figures::of(people, &question([-1.0, -2.0, 2.0, 2.0], [-2.5, 0.0, 2.5, 0.0], ground))
}

pub fn a_bottleneck_is_as_pedpy_measures_it() {
    let people = people("juelich/AO_300_bottleneck.txt");
    let found = bottleneck(&people);
    near(found.motion.speed.mean(), 0.4962644212205205, 1e-6);
    near(found.motion.acceleration.mean(), 0.7999714164212164, 1e-6);
    near(Inside::mean(&found.areas[0], |at| at.density), 3.5302398331595413, 1e-6);
    near(Inside::mean(&found.areas[0], |at| at.speed.max(0.0)), 0.4126326968915901, 1e-6);
    near(Inside::mean(&found.areas[0], |at| at.voronoi_density), 3.3891118816304764, 1e-4);
    near(Inside::mean(&found.areas[0], |at| at.voronoi_speed), 0.4163920647359844, 1e-4);
    for (frame, density, speed, crossed) in [
        (200, 4.5385644366358235, 0.43891711766471386, 96),
        (400, 5.196535838797724, 0.4460856916204608, 186),
        (600, 3.9128615001925096, 0.47351647836162103, 274),
    ] {
        let at = &found.instants[frame];
        assert_eq!((at.time, count(&found.crossings[0], at.time)), (frame as f64 / 16.0, crossed));
        let at = &found.areas[0][frame];
        near(at.voronoi_density, density, 1e-4);
        near(at.voronoi_speed, speed, 1e-4);
    }
    let (first, last) = (found.crossings[0][0], found.crossings[0][347]);
    assert_eq!((found.crossings[0].len(), first.time * 16.0, last.time * 16.0), (348, 14.0, 844.0));
    let end = found.instants.last().unwrap().time;
    let windows = flows(&found.crossings[0], 100.0 / 16.0, found.interval, end);
    assert_eq!(windows.len(), 9);
    near(windows.iter().sum::<f64>() / 9.0, 6.379742717769176, 1e-6);
}

pub fn a_ground_with_walls_is_as_pedpy_measures_it() {
    let people = people("juelich/00_01a.h5");
    let ring = |corners: &[(f64, f64)]| corners.iter().map(|&corner| DVec2::from(corner)).collect::<Vec<_>>();
    let wall = |s: f64| ring(&[(s * 0.5, -0.2), (s * 2.39, -0.2), (s * 2.39, 0.2), (s * 0.5, 0.2)]);
    let outer = ring(&[(-4.0, -4.0), (4.0, -4.0), (4.0, 6.0), (-4.0, 6.0)]);
    let walkable = vec![Walkable { outer, holes: vec![wall(1.0), wall(-1.0)] }];
    let ground = Ground { walkable, cut_off: None };
    let found = Figures::of(&people, &question([-1.0, 0.5, 2.0, 2.0], [-0.4, 0.0, 0.4, 0.0], ground));
    near(found.motion.speed.mean(), 0.2833325483512421, 1e-6);
    near(found.motion.acceleration.mean(), 0.6916899575985208, 1e-6);
    near(Inside::mean(&found.areas[0], |at| at.density), 2.563361611876988, 1e-6);
    near(Inside::mean(&found.areas[0], |at| at.speed.max(0.0)), 0.21767319144607852, 1e-6);
    near(Inside::mean(&found.areas[0], |at| at.voronoi_density), 1.9697259569722319, 1e-4);
    near(Inside::mean(&found.areas[0], |at| at.voronoi_speed), 0.3298213097419225, 1e-4);
    near(found.areas[0][400].voronoi_density, 2.315628150092231, 1e-4);
    near(found.areas[0][600].voronoi_speed, 0.27070289566033695, 1e-4);
    let (first, last) = (found.crossings[0][0], found.crossings[0][45]);
    assert_eq!((found.crossings[0].len(), (first.time * 25.0).round(), (last.time * 25.0).round()), (46, 428.0, 861.0));
    let windows = flows(&found.crossings[0], 4.0, found.interval, found.instants.last().unwrap().time);
    assert_eq!(windows.len(), 5);
    near(windows.iter().sum::<f64>() / 5.0, 2.555978093283292, 1e-6);
}

/// Our measures of the trajectories of an experiment match the published measurements of the same experiment.
pub fn the_fundamental_diagram_matches_published_data() {
    let (one_way, people) = (points("3test_UO", "uo"), people("juelich/traj_UNI_CORR_500_01.txt"));
    let ground = Ground { walkable: vec![], cut_off: Some(1.0) };
    let found = Figures::of(&people, &question([-2.0, 0.5, 4.0, 4.0], [0.0, 0.0, 0.0, 5.0], ground));
    let found = Inside::fundamental_diagram(&found.areas[0]);
    near(speed_at(&found, 0.5), speed_at(&one_way, 0.5), 0.02);
}

/// The flow through a bottleneck of 3 m matches the value published by the group that measured it first.
pub fn the_flow_of_a_bottleneck_matches_published_data() {
    let (known, people) = (points("bottleneck_flow", "2009AO"), people("juelich/AO_300_bottleneck.txt"));
    let known = known.iter().find(|[width, _]| *width == 3.0).unwrap()[1];
    near(flow(&bottleneck(&people).crossings[0]), known, 0.02);
}

pub fn flow_and_lane_order_match_published_data() {
    let found = bottleneck(&people("juelich/AO_300_bottleneck.txt"));
    near(steady_flow(&found.crossings[0]) / 3.0, 2.34, 0.02);
    let found = Figures::of(&people("juelich/bi_corr_400_b_03.txt"), &Question::default());
    near(found.steady_lane_order(), 0.76, 0.02);
}
