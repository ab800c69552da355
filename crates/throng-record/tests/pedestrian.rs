//! Measures of recorded people beside PedPy 1.5.1's of the same files (`consumers/pedpy_reference.py` prints them) and beside what
//! shared/data/README.md says of them. Skipped where the data is not there.

mod shared;

use glam::DVec2;
use shared::{data, found};
use throng::Walkable;
use throng_record::pedestrian::{
    Area, Figures, Ground, Inside, Line, People, Question, count, flow, flows, median, steady_flow,
};
use throng_record::{Reading, Tracks};

fn people(name: &str) -> Option<People> {
    let tracks = Tracks::read_as(data(name)?, &Reading::default()).unwrap();
    Some(People::of(&tracks, |_| true))
}

fn question(area: [f64; 4], line: [f64; 4], ground: Ground) -> Question {
    let [x0, y0, x1, y1] = line;
    let line = Line { from: DVec2::new(x0, y0), to: DVec2::new(x1, y1) };
    Question { interval: 0.4, areas: Area::rectangle(area).into_iter().collect(), lines: vec![line], ground }
}

#[track_caller]
fn near(found: f64, want: f64, within: f64) {
    assert!((found / want - 1.0).abs() <= within, "{found}, not {want}");
}

/// The bottleneck of 3 m, and PedPy's figures of it.
fn bottleneck(people: &People) -> Figures {
    let ground = Ground { walkable: vec![], cut_off: Some(0.8) };
    Figures::of(people, &question([-1.0, -2.0, 2.0, 2.0], [-2.5, 0.0, 2.5, 0.0], ground))
}

#[test]
fn a_bottleneck_is_as_pedpy_measures_it() {
    let Some(people) = people("juelich/AO_300_bottleneck.txt") else { return };
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

#[test]
fn a_ground_with_walls_is_as_pedpy_measures_it() {
    let Some(people) = people("juelich/00_01a.h5") else { return };
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

/// Numbers of a line, of all files of a folder whose names begin so; what is no number ends a line.
fn points(folder: &str, begins: &str) -> Option<Vec<[f64; 2]>> {
    let mut files: Vec<_> = std::fs::read_dir(found(folder)?).unwrap().map(|file| file.unwrap().path()).collect();
    files.retain(|path| path.file_name().unwrap().to_string_lossy().starts_with(begins));
    files.sort();
    let text: String = files.iter().map(|path| std::fs::read_to_string(path).unwrap() + "\n").collect();
    let pair = |line: &str| {
        let mut numbers = line.split_whitespace().map_while(|word| word.parse().ok());
        Some([numbers.next()?, numbers.next()?])
    };
    Some(text.lines().filter_map(pair).collect())
}

/// The median speed of the points whose density is within a quarter of one.
fn speed_at(points: &[[f64; 2]], density: f64) -> f64 {
    median(points.iter().filter(|[at, _]| (at - density).abs() < 0.25).map(|[_, speed]| *speed).collect())
}

/// What was measured elsewhere is what shared/data/README.md says of it, and what we measure of the trajectories of the same experiments.
#[test]
fn the_fundamental_diagram_is_the_one_that_is_known() {
    let known: [(&str, &str, &[f64]); 3] = [
        ("3test_UO", "uo", &[1.45, 1.24, 1.11, 0.84, 0.44, 0.31, 0.17, 0.13]),
        ("7test_BO", "bot", &[1.43, 1.17, 0.85, 0.68, 0.51, 0.43]),
        ("1test_1D", "n", &[0.91, 0.82, 0.31, 0.12, 0.05]),
    ];
    for (folder, begins, speeds) in known {
        let Some(points) = points(&format!("fundamental_diagram/{folder}"), begins) else { return };
        for (k, speed) in speeds.iter().enumerate() {
            // as many digits as are said
            assert!((speed_at(&points, 0.5 + 0.5 * k as f64) - speed).abs() <= 0.0055, "{folder}: {k}");
        }
    }
    let (Some(one_way), Some(people)) =
        (points("fundamental_diagram/3test_UO", "uo"), people("juelich/traj_UNI_CORR_500_01.txt"))
    else {
        return;
    };
    let ground = Ground { walkable: vec![], cut_off: Some(1.0) };
    let found = Figures::of(&people, &question([-2.0, 0.5, 4.0, 4.0], [0.0, 0.0, 0.0, 5.0], ground));
    let found = Inside::fundamental_diagram(&found.areas[0]);
    near(speed_at(&found, 0.5), speed_at(&one_way, 0.5), 0.02);
}

/// The flow through a bottleneck of 3 m as the group that measured it first says it.
#[test]
fn the_flow_of_a_bottleneck_is_the_one_that_is_known() {
    let (Some(known), Some(people)) =
        (points("fundamental_diagram/bottleneck_flow", "2009AO"), people("juelich/AO_300_bottleneck.txt"))
    else {
        return;
    };
    let known = known.iter().find(|[width, _]| *width == 3.0).unwrap()[1];
    near(flow(&bottleneck(&people).crossings[0]), known, 0.02);
}

#[test]
fn flow_and_lanes_are_those_that_are_known_of_them() {
    if let Some(people) = people("juelich/AO_300_bottleneck.txt") {
        near(steady_flow(&bottleneck(&people).crossings[0]) / 3.0, 2.34, 0.02);
    }
    if let Some(people) = people("juelich/bi_corr_400_b_03.txt") {
        let found = Figures::of(&people, &Question::default());
        near(found.steady_lane_order(), 0.76, 0.02);
    }
}

#[test]
fn cells_share_out_the_ground() {
    // whatever the area, all of it is somebody's where there is no cut-off; a point of it is whose is nearest
    let mut draw = 5u64;
    let mut next = || {
        draw = draw.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (draw >> 11) as f64 / (1u64 << 53) as f64
    };
    for count in [1, 2, 3, 10, 60] {
        let text: String = (0..count).map(|k| format!("{k},0,{},{}\n", 10.0 * next(), 10.0 * next())).collect();
        let tracks =
            Tracks::of_file("a.csv", format!("number,time,x,y\n{text}").as_bytes(), &Reading::default()).unwrap();
        let people = People::of(&tracks, |_| true);
        let area = Area::rectangle([2.0, 3.0, 4.0, 5.0]).unwrap();
        let moment = &people.moments[0];
        let cells = throng_record::pedestrian::voronoi::cells(&people, moment, &Ground::default(), &area);
        near(cells.iter().map(|cell| cell.inside).sum(), 20.0, 1e-6);
        // Monte Carlo
        let mut hits = vec![0u32; count];
        for _ in 0..20000 {
            let place = DVec2::new(2.0 + 4.0 * next(), 3.0 + 5.0 * next());
            let nearest = (0..count).min_by(|&a, &b| {
                let away = |k: usize| people.walks[k].places[0].distance(place);
                away(a).total_cmp(&away(b))
            });
            hits[nearest.unwrap()] += 1;
        }
        for (walk, &hits) in hits.iter().enumerate() {
            let inside = cells.iter().find(|cell| cell.here.walk == walk).map_or(0.0, |cell| cell.inside);
            assert!((inside - f64::from(hits) / 1000.0).abs() < 0.3, "{count}: {inside}, not {hits} of 20000");
        }
    }
}
