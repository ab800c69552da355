//! Flows to goals, compared with exact shortest paths.

use crate::oracle::{Dice, Scene, VisibilityGraph, clearance};
use glam::{DVec2, Vec2, Vec3};
use proptest::prelude::*;
use std::sync::Arc;
use throng::field::Field;
use throng::space::{Place, Raster, is_inside};
use throng::{Error, Obstacle, Walkable};
use throng_field::{Density, Destination, Terrain, TerrainSettings, ToGoal};

fn with_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(work)
}

/// Settings for shortest paths: no extra cost close to walls.
fn survey(size: f64, cell: f64, radius: f64) -> TerrainSettings {
    TerrainSettings {
        high: DVec2::splat(size),
        cell,
        radius,
        clearance: 0.0,
        dearest: 0.0,
        ..TerrainSettings::default()
    }
}

fn place(obstacles: Vec<Obstacle>) -> Place {
    Place { areas: vec![], obstacles: obstacles.into_iter().map(Some).collect() }
}

fn ground(place: &Place, survey: TerrainSettings) -> Arc<Terrain> {
    Arc::new(Terrain::of_place(place, DVec2::ZERO, survey).unwrap())
}

fn point(at: DVec2) -> Destination {
    Destination::Point { at, tolerance: 1e-3 }
}

/// Full speed up to the goal.
fn flow(ground: &Arc<Terrain>, goals: Vec<Destination>) -> ToGoal {
    ToGoal::new(ground.clone(), goals, 1.0).unwrap().slowing(0.0).unwrap()
}

fn velocity(flow: &ToGoal, at: DVec2) -> DVec2 {
    flow.velocity(at.as_vec2().extend(0.0), 0.0).truncate().as_dvec2()
}

/// Degrees between two directions.
fn degrees(a: DVec2, b: DVec2) -> f64 {
    a.angle_to(b).abs().to_degrees()
}

#[test]
fn on_open_ground_all_ways_are_straight() {
    let mut rng = Dice(1);
    for cell in [0.1, 0.25, 0.7] {
        let size = 60.0 * cell + 0.03;
        let ground = ground(&place(vec![]), survey(size, cell, 0.25));
        for goal in [DVec2::new(0.31, 0.47), DVec2::new(0.5, 0.5), DVec2::new(0.02, 0.96), DVec2::new(0.66, 0.1)] {
            let goal = goal * size;
            let flow = flow(&ground, vec![point(goal)]);
            let (mut sum, mut worst, mut on_rim) = (0.0, 0.0f64, 0.0f64);
            for _ in 0..3000 {
                let at = rng.point(DVec2::ZERO, DVec2::splat(size));
                let velocity = velocity(&flow, at);
                assert!((velocity.length() - 1.0).abs() < 1e-5, "{velocity} at {at}");
                let error = degrees(velocity, goal - at);
                // beyond the centres of the outermost cells the field is extrapolated
                let within = at.min(size - at).min_element() > cell;
                let worst = if within { &mut worst } else { &mut on_rim };
                (sum, *worst) = (sum + error, worst.max(error));
                let time = f64::from(flow.time_to_goal(at).unwrap());
                assert!((time - goal.distance(at)).abs() < 0.15 * cell, "{time} for {}", goal.distance(at));
            }
            let mean = sum / 3000.0;
            let all = format!("cell {cell} goal {goal}: mean {mean}, worst {worst}, on the rim {on_rim}");
            assert!(worst <= 2.0 && mean < 0.5 && on_rim < 5.0, "{all}");
        }
    }
}

/// Length of the shortest path between two points round a disc, and its first direction.
fn round_disc(radius: f64, from: DVec2, to: DVec2) -> (f64, DVec2) {
    let straight = to - from;
    let part = (-from.dot(straight) / straight.length_squared()).clamp(0.0, 1.0);
    if (from + straight * part).length() >= radius {
        return (straight.length(), straight.normalize());
    }
    let tangent = |p: DVec2| (p.length_squared() - radius * radius).max(0.0).sqrt();
    let (a, b) = (tangent(from), tangent(to));
    let between = from.angle_to(to);
    let arc = between.abs() - (radius / from.length()).min(1.0).acos() - (radius / to.length()).min(1.0).acos();
    // tangent to the disc, on the side of the goal
    let side = -(radius / from.length()).min(1.0).asin() * between.signum();
    (a + b + radius * arc, DVec2::from_angle(side).rotate(-from.normalize()))
}

#[test]
fn ways_round_a_pillar_are_the_shortest() {
    let mut rng = Dice(2);
    let mut before = (f64::INFINITY, f64::INFINITY);
    for cell in [0.4, 0.2, 0.1, 0.05] {
        let pillar = Obstacle::Circle { center: DVec2::splat(10.0), radius: 2.75 };
        let ground = ground(&place(vec![pillar]), survey(20.0, cell, 0.25));
        let goal = DVec2::new(15.03, 11.21);
        let flow = flow(&ground, vec![point(goal)]);
        let (mut errors, mut late) = (Vec::new(), 0.0f64);
        for _ in 0..3000 {
            let at = rng.point(DVec2::ZERO, DVec2::splat(20.0));
            let away = at - 10.0;
            if away.length() < 3.0 || goal.distance(at) < 0.1 {
                continue;
            }
            let (length, direction) = round_disc(3.0, away, goal - 10.0);
            let time = f64::from(flow.time_to_goal(at).unwrap());
            late = late.max((time - length).abs());
            // behind the pillar both ways round are equally long
            let behind = (away.angle_to(10.0 - goal)).abs() < 2.0 * cell / away.length();
            if away.length() > 3.0 + cell && !behind {
                errors.push(degrees(velocity(&flow, at), direction));
            }
        }
        errors.sort_by(f64::total_cmp);
        let mean = errors.iter().sum::<f64>() / errors.len() as f64;
        let most = errors[errors.len() * 99 / 100];
        assert!(late < 2.3 * cell && late < before.0, "cell {cell}: {late} m off, {} with wider cells", before.0);
        assert!(mean < 1.25 && mean < before.1 && most < 8.0, "cell {cell}: mean {mean}, 99 % below {most}");
        before = (late, mean);
    }
}

/// A rotated room with boxes, as rings and as a place.
fn boxes(rng: &mut Dice, turn: f64) -> (Vec<Vec<DVec2>>, Place) {
    let put = |p: DVec2| DVec2::splat(10.0) + DVec2::from_angle(turn).rotate(p);
    let rectangle = |center: DVec2, half: DVec2| {
        let corner = |x: f64, y: f64| put(center + half * DVec2::new(x, y));
        vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)]
    };
    let outer = rectangle(DVec2::ZERO, DVec2::splat(6.5));
    let mut rings = vec![outer.clone()];
    let mut obstacles = Vec::new();
    for slot in
        [DVec2::new(-3.5, -3.0), DVec2::new(-3.0, 3.0), DVec2::new(3.0, -3.2), DVec2::new(3.2, 3.3), DVec2::ZERO]
    {
        let center = slot + rng.point(DVec2::splat(-0.4), DVec2::splat(0.4));
        let corners = rectangle(center, rng.point(DVec2::splat(0.2), DVec2::splat(1.0)));
        obstacles.push(Obstacle::Polygon { corners: corners.clone() });
        rings.push(corners.into_iter().rev().collect());
    }
    let areas = vec![Walkable { outer, holes: vec![] }];
    (rings, Place { areas, obstacles: obstacles.into_iter().map(Some).collect() })
}

#[test]
fn ways_among_boxes_are_the_shortest() {
    let mut rng = Dice(3);
    let (mut all, mut latest) = (Vec::new(), 0.0f64);
    let cell = 0.1;
    for turn in [0.0, 0.3, 0.78, 1.1] {
        let (rings, place) = boxes(&mut rng, turn);
        let graph = VisibilityGraph::new(&rings);
        let free = |at: DVec2| crate::oracle::inside(&rings, at) && crate::oracle::to_edges(&rings, at) > 2.0 * cell;
        let ground = ground(&place, survey(20.0, cell, 0.0));
        let mut any = || loop {
            let at = rng.point(DVec2::ZERO, DVec2::splat(20.0));
            if free(at) {
                return at;
            }
        };
        let goal = any();
        let flow = flow(&ground, vec![point(goal)]);
        for _ in 0..150 {
            let at = any();
            let exact = |at: DVec2| graph.distance(at, goal);
            let length = exact(at);
            let time = f64::from(flow.time_to_goal(at).unwrap());
            latest = latest.max((time - length).abs());
            let step = 1e-5;
            let slope = |along: DVec2| (exact(at + along * step) - exact(at - along * step)) / (2.0 * step);
            let downhill = -DVec2::new(slope(DVec2::X), slope(DVec2::Y));
            // where fronts meet, two ways are equally good
            let same = [DVec2::X, -DVec2::X, DVec2::Y, -DVec2::Y].map(|along| exact(at + along * 1.5 * cell) - length);
            let bend = (same[0] + same[1]).min(same[2] + same[3]);
            if (downhill.length() - 1.0).abs() < 1e-3 && bend > -0.1 * cell && goal.distance(at) > cell {
                all.push(degrees(velocity(&flow, at), downhill));
            }
        }
    }
    all.sort_by(f64::total_cmp);
    let mean = all.iter().sum::<f64>() / all.len() as f64;
    assert!(latest < 2.0 * cell, "{latest} m longer or shorter");
    assert!(mean < 1.5 && all[all.len() * 95 / 100] < 5.0, "mean {mean}");
}

/// A path through two kinds of ground is refracted: the least sum over the points of the border.
#[test]
fn painted_ground_refracts_ways() {
    let mut ground = Terrain::of_place(&Place::default(), DVec2::ZERO, survey(20.0, 0.1, 0.25)).unwrap();
    ground.paint(|at| if at.x < 10.0 { 1.0 } else { 3.0 }).unwrap();
    let goal = DVec2::new(4.03, 8.21);
    let flow = flow(&Arc::new(ground), vec![point(goal)]);
    let mut rng = Dice(4);
    for _ in 0..200 {
        let at = rng.point(DVec2::new(10.5, 0.5), DVec2::new(19.5, 19.5));
        let cost = |y: f64| DVec2::new(10.0, y).distance(goal) + 3.0 * DVec2::new(10.0, y).distance(at);
        let (mut low, mut high) = (0.0, 20.0);
        for _ in 0..200 {
            let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            if cost(a) < cost(b) { high = b } else { low = a }
        }
        let time = f64::from(flow.time_to_goal(at).unwrap());
        assert!((time - cost(low)).abs() < 0.15, "{time} instead of {} at {at}", cost(low));
        let error = degrees(velocity(&flow, at), DVec2::new(10.0, low) - at);
        assert!(error < 3.0, "{error} degrees at {at}");
    }
}

/// Follows a flow in steps of a part of a cell. Returns the path, which ends where the flow does.
fn follow(flow: &ToGoal, from: DVec2, step: f64) -> Vec<DVec2> {
    let mut way = vec![from];
    for _ in 0..20_000 {
        let at = way[way.len() - 1];
        let velocity = velocity(flow, at);
        if velocity == DVec2::ZERO {
            break;
        }
        way.push((at + velocity * step).as_vec2().as_dvec2());
    }
    way
}

#[test]
fn painted_ground_makes_detours() {
    let mut ground = Terrain::of_place(&Place::default(), DVec2::ZERO, survey(20.0, 0.25, 0.25)).unwrap();
    let mud = |at: DVec2| (at - 10.0).abs().max_element() < 3.0;
    ground.paint(|at| if mud(at) { 5.0 } else { 1.0 }).unwrap();
    let flow = flow(&Arc::new(ground), vec![point(DVec2::new(18.0, 10.3))]);
    let way = follow(&flow, DVec2::new(2.0, 9.9), 0.1);
    assert!(way[way.len() - 1].distance(DVec2::new(18.0, 10.3)) < 0.2);
    let wet = way.iter().filter(|at| (*at - 10.0).abs().max_element() < 2.7).count();
    assert_eq!(wet, 0, "round it is {} m, through it 6 m cost 30", 2.0 * 8.5f64.hypot(3.0));
}

#[test]
fn clearance_keeps_off_walls() {
    let walls = vec![
        Obstacle::Polygon { corners: [(8.0, -1.0), (12.0, -1.0), (12.0, 9.0), (8.0, 9.0)].map(DVec2::from).to_vec() },
        Obstacle::Polygon { corners: [(8.0, 12.0), (12.0, 12.0), (12.0, 21.0), (8.0, 21.0)].map(DVec2::from).to_vec() },
    ];
    let place = place(walls);
    let nearest = |clearance: f32| {
        let survey = TerrainSettings { clearance, dearest: 10.0, ..survey(20.0, 0.2, 0.25) };
        let flow = flow(&ground(&place, survey), vec![point(DVec2::new(17.0, 4.0))]);
        let way = follow(&flow, DVec2::new(3.0, 4.1), 0.05);
        assert!(way[way.len() - 1].distance(DVec2::new(17.0, 4.0)) < 0.1, "{:?}", way[way.len() - 1]);
        let obstacles: Vec<Obstacle> = place.obstacles().cloned().collect();
        way.iter().map(|&at| clearance_of(&obstacles, at)).fold(f64::INFINITY, f64::min)
    };
    let [none, some, much] = [0.0, 0.05, 1.0].map(nearest);
    assert!(none < 0.4 && some > none + 0.2 && much > some + 0.2 && much < 1.5, "{none} {some} {much}");
}

fn clearance_of(obstacles: &[Obstacle], at: DVec2) -> f64 {
    clearance(&[], obstacles, at)
}

/// Two doors: a crowd before the nearer door makes the other door the better one.
#[test]
fn crowds_are_led_round() {
    let wall = |from: f64, to: f64| Obstacle::Wall { points: vec![DVec2::new(10.0, from), DVec2::new(10.0, to)] };
    let place = place(vec![wall(-1.0, 7.0), wall(8.5, 14.0), wall(15.5, 21.0)]);
    let ground = ground(&place, survey(20.0, 0.25, 0.25));
    let goal =
        Destination::Area { corners: [(15.0, 7.0), (18.0, 7.0), (18.0, 9.0), (15.0, 9.0)].map(DVec2::from).to_vec() };
    let flow = flow(&ground, vec![goal]);
    let from = DVec2::new(3.1, 9.0);
    let crossed = |flow: &ToGoal| {
        let way = follow(flow, from, 0.1);
        let after = way.iter().position(|at| at.x > 10.0).expect("through a door");
        way[after].y
    };
    assert!((7.0..8.5).contains(&crossed(&flow)));
    let crowd = (0..60).map(|k| Vec2::new(9.8 - 0.4 * (k % 6) as f32, 5.8 + 0.4 * (k / 6) as f32));
    let mut density = Density::empty(&ground);
    let now = Density::of(&ground, crowd, 0.8).unwrap();
    density.follow(&now, 1.0);
    assert_eq!(density, now);
    let led = flow.with_density(density.cells(), 1.0).unwrap();
    assert!((14.0..15.5).contains(&crossed(&led)));
    // without the crowd the flow is the original one
    let empty = Density::empty(&ground);
    let back = led.with_density(empty.cells(), 1.0).unwrap();
    assert_eq!((back.lengths(), crossed(&back)), (flow.lengths(), crossed(&flow)));
}

#[test]
fn the_nearest_goal_wins_and_areas_are_entered() {
    let ground = ground(&place(vec![]), survey(20.0, 0.25, 0.25));
    let triangle = [(2.0, 2.0), (5.0, 2.5), (3.0, 5.0)].map(DVec2::from).to_vec();
    let disc = (DVec2::new(15.0, 14.0), 2.0);
    let goals = vec![
        Destination::Area { corners: triangle.clone() },
        Destination::Disc { center: disc.0, radius: disc.1 },
        point(DVec2::new(3.0, 17.0)),
    ];
    let flow = flow(&ground, goals.clone());
    let mut rng = Dice(6);
    for _ in 0..2000 {
        let at = rng.point(DVec2::ZERO, DVec2::splat(20.0));
        let ring = [triangle.clone()];
        let to_triangle = if is_inside(&triangle, at) { 0.0 } else { crate::oracle::to_edges(&ring, at) };
        let all = [to_triangle, (at.distance(disc.0) - disc.1).max(0.0), at.distance(DVec2::new(3.0, 17.0))];
        let least = all.into_iter().fold(f64::INFINITY, f64::min);
        let time = f64::from(flow.time_to_goal(at).unwrap());
        assert!((time - least).abs() < 0.1, "{time} instead of {least} at {at}");
        let is_there = all[0] == 0.0 || all[1] == 0.0;
        assert_eq!(velocity(&flow, at) == DVec2::ZERO, is_there, "at {at}");
    }
}

#[test]
fn it_slows_down_at_a_point_and_stops_there() {
    let ground = ground(&place(vec![]), survey(10.0, 0.25, 0.25));
    let goal = Destination::Point { at: DVec2::new(5.1, 5.2), tolerance: 0.2 };
    let flow = ToGoal::new(ground, vec![goal], 1.4).unwrap().slowing(2.0).unwrap();
    let speed = |far: f64| velocity(&flow, DVec2::new(5.1 + far, 5.2)).length();
    assert!((speed(3.0) - 1.4).abs() < 1e-5 && (speed(1.0) - 0.7).abs() < 1e-4);
    assert_eq!(speed(0.19), 0.0);
    assert_eq!(flow.time_to_goal(DVec2::new(5.1, 5.3)), Some(0.0));
    assert!((flow.time_to_goal(DVec2::new(9.1, 5.2)).unwrap() - 4.0 / 1.4).abs() < 0.02);
}

#[test]
fn pockets_that_cannot_be_left_are_told() {
    let ring = [(4.0, 4.0), (7.0, 4.0), (7.0, 7.0), (4.0, 7.0), (4.0, 4.0)].map(DVec2::from).to_vec();
    for (radius, cell) in [(0.25, 0.25), (0.0, 0.3), (0.1, 0.5)] {
        let place = place(vec![Obstacle::Wall { points: ring.clone() }]);
        let ground = ground(&place, survey(10.0, cell, radius));
        let flow = flow(&ground, vec![point(DVec2::new(1.1, 1.3))]);
        let inside = |at: DVec2| at.cmpgt(DVec2::splat(4.0)).all() && at.cmplt(DVec2::splat(7.0)).all();
        let cells = ground.columns() * ground.rows();
        let expected: Vec<usize> = (0..cells).filter(|&at| ground.is_open(at) && inside(ground.middle(at))).collect();
        assert_eq!(flow.unreachable().collect::<Vec<_>>(), expected);
        assert!(expected.len() > 20);
        for at in [DVec2::splat(5.5), DVec2::new(4.01, 5.0), DVec2::new(6.95, 6.95)] {
            assert_eq!((velocity(&flow, at), flow.time_to_goal(at)), (DVec2::ZERO, None), "at {at}");
        }
        for at in [DVec2::splat(11.0), DVec2::new(-0.1, 5.0), DVec2::NAN] {
            assert_eq!((velocity(&flow, at), flow.time_to_goal(at)), (DVec2::ZERO, None), "at {at}");
        }
    }
}

/// In rooms with obstacles of all kinds no follower comes nearer to a wall than its radius, and all followers with a
/// known path arrive.
#[test]
fn no_follower_enters_a_wall_and_all_arrive() {
    let mut followed = 0;
    for seed in 0..200 {
        let mut rng = Dice(seed + 100);
        let scene = Scene::random(seed);
        let origin = scene.place(DVec2::ZERO).round();
        let radius = [0.2, 0.25, 0.1][seed as usize % 3];
        let cell = [0.2, 0.15, 0.3][seed as usize / 3 % 3];
        let place =
            Place { areas: scene.walkable.clone(), obstacles: scene.obstacles.iter().cloned().map(Some).collect() };
        let corners = &scene.walkable[0].outer;
        let low = corners.iter().fold(DVec2::INFINITY, |low, &corner| low.min(corner)) - origin;
        let high = corners.iter().fold(DVec2::NEG_INFINITY, |high, &corner| high.max(corner)) - origin;
        let clearance_at = |at: DVec2| clearance(&scene.walkable, &scene.obstacles, at + origin);
        let survey = TerrainSettings {
            low,
            high,
            cell,
            radius,
            clearance: 0.02 * (seed % 2) as f32,
            ..TerrainSettings::default()
        };
        let ground = Arc::new(Terrain::of_place(&place, origin, survey).unwrap());
        let mut any = || loop {
            let at = (scene.point(&mut rng) - origin).as_vec2().as_dvec2();
            if clearance_at(at) > radius {
                return at;
            }
        };
        let goal = any();
        let point = Destination::Point { at: goal, tolerance: 0.15 };
        let Ok(flow) = ToGoal::new(ground, vec![point], 1.3) else { continue };
        for _ in 0..40 {
            let from = any();
            let Some(seconds) = flow.time_to_goal(from) else { continue };
            let step = 0.5 * cell / 1.3;
            let way = follow(&flow, from, step);
            let least = way.iter().map(|&at| clearance_at(at)).fold(f64::INFINITY, f64::min);
            assert!(least > radius - 1e-4, "seed {seed}: {least} from {from}");
            let last = way[way.len() - 1];
            assert!(last.distance(goal) < 0.16, "seed {seed}: from {from} to {last} instead of {goal}");
            let took = way.len() as f64 * step;
            assert!(took < 2.0 * f64::from(seconds) + 5.0, "seed {seed}: {took} s instead of {seconds}");
            followed += 1;
        }
    }
    assert!(followed > 4000, "{followed}");
}

/// A gap wider than two radii and 1.5 cells is found at any angle.
#[test]
fn gaps_are_found() {
    let mut rng = Dice(8);
    for case in 0..200 {
        let (cell, radius) = (rng.between(0.1, 0.5), rng.between(0.0, 0.6));
        let gap = 2.0 * radius + 1.5 * cell + 1e-6;
        let along = DVec2::from_angle(rng.between(0.0, std::f64::consts::TAU));
        let middle = rng.point(DVec2::splat(4.5), DVec2::splat(5.5));
        let wall = |side: f64| Obstacle::Wall {
            points: vec![middle + along * (side * 0.5 * gap), middle + along * (side * 20.0)],
        };
        let ground = ground(&place(vec![wall(-1.0), wall(1.0)]), survey(10.0, cell, radius));
        let through = along.perp() * (2.0 + radius);
        let flow = flow(&ground, vec![point(middle + through)]);
        let way = follow(&flow, middle - through, 0.5 * cell);
        assert!(way[way.len() - 1].distance(middle + through) < cell, "case {case}: cell {cell}, radius {radius}");
    }
}

/// An agent that is closer to a wall than its radius is led away from it.
#[test]
fn an_agent_too_close_to_a_wall_is_led_away() {
    let wall = Obstacle::Wall { points: vec![DVec2::new(-1.0, 5.0), DVec2::new(8.0, 5.0)] };
    let ground = ground(&place(vec![wall]), survey(10.0, 0.1, 0.4));
    let flow = flow(&ground, vec![point(DVec2::new(4.0, 8.0))]);
    for below in [0.02, 0.1, 0.3] {
        let from = DVec2::new(3.0, 5.0 - below);
        let way = follow(&flow, from, 0.05);
        assert!(way.windows(2).all(|pair| pair[0].y > 5.0 || pair[1].y < 5.0 || pair[1].x > 8.0), "through the wall");
        assert!(way[way.len() - 1].distance(DVec2::new(4.0, 8.0)) < 0.1, "{:?}", way[way.len() - 1]);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    /// The solid cells and the distance of walls, cell by cell.
    #[test]
    fn cells_are_what_their_middles_are(seed in 0u64..1000, cell in 0.15f64..0.6, radius in 0.0f64..0.5) {
        let scene = Scene::random(seed);
        let origin = scene.place(DVec2::ZERO);
        let obstacles: Vec<_> = scene.obstacles.iter().cloned().map(Some).collect();
        let place = Place { areas: scene.walkable.clone(), obstacles };
        let survey = TerrainSettings { low: DVec2::splat(-8.0), high: DVec2::splat(8.0), cell, radius, clearance: 0.0, ..TerrainSettings::default() };
        let ground = Terrain::of_place(&place, origin, survey).unwrap();
        for index in 0..ground.columns() * ground.rows() {
            let at = ground.middle(index) + origin;
            let (distance, exact) = (f64::from(ground.distances()[index]), clearance(&scene.walkable, &scene.obstacles, at));
            if exact.abs() > 1e-6 {
                prop_assert_eq!(ground.is_solid(index), place.blocked(at).is_some(), "at {}", at);
                prop_assert_eq!(ground.is_solid(index), exact < 0.0, "at {}", at);
            }
            if exact >= 0.0 {
                let known = radius + 2.0 * cell;
                prop_assert!((distance - exact).abs() < 1e-5 || distance.is_infinite() && exact > known - 1e-6);
            }
        }
    }

    #[test]
    fn every_agent_counts_as_one(people in prop::collection::vec((0.0f32..10.0, 0.0f32..10.0), 0..200), radius in 0.01f64..3.0) {
        let pillar = Obstacle::Circle { center: DVec2::splat(5.0), radius: 1.0 };
        let ground = ground(&place(vec![pillar]), survey(10.0, 0.3, 0.2));
        let mut people: Vec<Vec2> = people.into_iter().map(Vec2::from).collect();
        let density = Density::of(&ground, people.iter().copied(), radius).unwrap();
        let sum: f64 = density.cells().iter().map(|&density| f64::from(density) * 0.09).sum();
        prop_assert!((sum - people.len() as f64).abs() < 1e-3 * people.len() as f64 + 1e-9);
        people.reverse();
        prop_assert_eq!(&density, &Density::of(&ground, people, radius).unwrap());
        let wrong = Density::of(&ground, [Vec2::NAN, Vec2::splat(50.0)], radius).unwrap();
        prop_assert!(wrong.cells().iter().all(|&density| density == 0.0));
    }
}

/// A single agent has the density of the kernel, `3 / (pi r^2) (1 - (d / r)^2)^2` in the plane, and none beyond the
/// radius.
#[test]
fn an_agent_is_spread_over_the_radius() {
    let ground = ground(&place(vec![]), survey(10.0, 0.1, 0.2));
    let at = DVec2::new(4.7, 5.2);
    for radius in [0.8, 1.5, 2.5_f64] {
        let density = Density::of(&ground, [at.as_vec2()], radius).unwrap();
        for distance in [0.0, 0.3, 0.6, 0.9].map(|part| part * radius) {
            let found = density.cells()[ground.cell_at(at + DVec2::from_angle(distance) * distance).unwrap()];
            let kernel = 3.0 / (std::f64::consts::PI * radius * radius) * (1.0 - (distance / radius).powi(2)).powi(2);
            // a cell is 0.1 m wide
            assert!((f64::from(found) - kernel).abs() < 0.15 / radius.powi(3), "{found} at {distance}, not {kernel}");
        }
        let beyond = ground.cell_at(at + DVec2::X * (radius + 0.1)).unwrap();
        assert_eq!(density.cells()[beyond], 0.0);
    }
}

/// The rim belongs to the outermost cells.
#[test]
fn a_place_at_the_rim_is_in_the_last_cell() {
    let ground = ground(&place(vec![]), survey(10.0, 0.5, 0.2));
    let (columns, rows) = (ground.columns(), ground.rows());
    let high = DVec2::new(columns as f64, rows as f64) * 0.5 + (ground.middle(0) - 0.25);
    assert_eq!(ground.cell_at(high), Some(columns * rows - 1));
    assert_eq!(ground.cell_at(high - DVec2::X * 0.7), Some(columns * rows - 2));
    assert_eq!(ground.cell_at(high - DVec2::Y * 0.7), Some(columns * (rows - 1) - 1));
    assert_eq!(ground.cell_at(high + DVec2::X * 1e-3), None);
}

#[test]
fn rasters_and_functions_are_grounds() {
    let solid = |at: DVec2| (at - 5.0).abs().max_element() < 1.5;
    let raster = Raster::of(Vec2::ZERO, Vec2::splat(10.0), 0.5, |at| solid(at.as_dvec2())).unwrap();
    let survey = TerrainSettings { clearance: 0.05, ..survey(10.0, 0.5, 0.2) };
    let ground = Terrain::of(|at| raster.is_solid(at.as_vec2()), survey).unwrap();
    let of_place = {
        let corners = [(3.5, 3.5), (6.5, 3.5), (6.5, 6.5), (3.5, 6.5)].map(DVec2::from).to_vec();
        Terrain::of_place(&place(vec![Obstacle::Polygon { corners }]), DVec2::ZERO, survey).unwrap()
    };
    assert_eq!(ground.distances(), of_place.distances());
    assert_eq!(ground.cost(), of_place.cost());
    let flow = flow(&Arc::new(ground), vec![point(DVec2::new(9.0, 5.1))]);
    for at in follow(&flow, DVec2::new(1.0, 5.0), 0.1) {
        assert!((at - 5.0).abs().max_element() > 1.7 - 1e-4, "{at}");
    }
    assert!(flow.velocity(Vec3::new(1.0, 5.0, 0.0), 0.0).x > 0.5);
}

#[test]
fn the_bits_do_not_depend_on_threads() {
    let scene = Scene::random(3);
    let obstacles: Vec<_> = scene.obstacles.iter().cloned().map(Some).collect();
    let place = Place { areas: scene.walkable.clone(), obstacles };
    let make = || {
        let survey = TerrainSettings {
            low: DVec2::splat(-2.0),
            high: DVec2::splat(20.0),
            cell: 0.1,
            radius: 0.2,
            ..TerrainSettings::default()
        };
        let ground = ground(&place, survey);
        let open = (0..ground.cost().len()).find(|&cell| ground.is_open(cell)).unwrap();
        let flow = flow(&ground, vec![point(ground.middle(open))]);
        let mut rng = Dice(9);
        let places: Vec<DVec2> = (0..2000).map(|_| rng.point(DVec2::ZERO, DVec2::splat(12.0))).collect();
        let bits = |v: DVec2| v.to_array().map(f64::to_bits);
        let velocities: Vec<_> = places.iter().map(|&at| bits(velocity(&flow, at))).collect();
        let lengths: Vec<u32> = flow.lengths().iter().map(|length| length.to_bits()).collect();
        (lengths, velocities, ground.cost().to_vec())
    };
    let one = with_threads(1, make);
    for threads in [2, 3, 8] {
        assert!(with_threads(threads, make) == one);
    }
}

#[test]
fn wrong_grounds_and_goals_are_told() {
    let good = survey(10.0, 0.25, 0.25);
    let surveys = [
        (TerrainSettings { cell: 0.0, ..good }, "width of a terrain's cell is 0"),
        (TerrainSettings { cell: f64::NAN, ..good }, "width of a terrain's cell is NaN"),
        (TerrainSettings { high: DVec2::new(f64::INFINITY, 1.0), ..good }, "corner of a terrain is inf"),
        (TerrainSettings { high: DVec2::ZERO, ..good }, "is empty"),
        (TerrainSettings { cell: 1e-4, ..good }, "100000 by 100000 cells are more than 16777216: make them wider"),
        (TerrainSettings { cell: 1e-300, ..good }, "make them wider"),
        (TerrainSettings { radius: -1.0, ..good }, "radius of bodies on a terrain is -1"),
        (TerrainSettings { clearance: f32::NAN, ..good }, "clearance of a terrain is NaN"),
        (TerrainSettings { dearest: f32::INFINITY, ..good }, "greatest cost close to walls is inf"),
    ];
    let says = |error: Error, what: &str| assert!(error.to_string().contains(what), "{error}: {what}");
    for (survey, what) in surveys {
        says(Terrain::of_place(&Place::default(), DVec2::ZERO, survey).unwrap_err(), what);
        says(Terrain::of(|_| false, survey).unwrap_err(), what);
    }
    let walls = vec![
        Obstacle::Circle { center: DVec2::splat(5.0), radius: 2.0 },
        Obstacle::Polygon { corners: [(8.0, 0.0), (9.0, 0.0), (9.0, 1.0)].map(DVec2::from).to_vec() },
    ];
    let ground = ground(&place(walls), good);
    let goals = [
        (vec![], "there are none"),
        (vec![point(DVec2::new(11.0, 5.0))], "goal 1 at (11.000, 5.000): it is beyond the terrain"),
        (vec![point(DVec2::ONE), point(DVec2::splat(4.0))], "goal 2 at (4.000, 4.000): it is inside an obstacle"),
        (vec![point(DVec2::new(8.9, 0.5))], "inside an obstacle"),
        (vec![point(DVec2::NAN)], "place of a goal is NaN"),
        (vec![Destination::Point { at: DVec2::ONE, tolerance: -1.0 }], "tolerance of a goal is -1"),
        (vec![Destination::Disc { center: DVec2::ONE, radius: 0.0 }], "radius of a goal is 0"),
        (vec![Destination::Area { corners: vec![DVec2::ZERO, DVec2::X] }], "the area of a goal: a polygon needs"),
    ];
    for (goals, what) in goals {
        says(ToGoal::new(ground.clone(), goals, 1.0).unwrap_err(), what);
    }
    says(ToGoal::new(ground.clone(), vec![point(DVec2::ONE)], 0.0).unwrap_err(), "speed of a flow to a goal is 0");
    let mut flow = flow(&ground, vec![point(DVec2::ONE)]);
    let lengths = flow.lengths().to_vec();
    says(flow.avoid_crowds(&[0.0; 3], 1.0).unwrap_err(), "3 densities are given for 1600 cells");
    let mut density = vec![0.0; 1600];
    says(flow.avoid_crowds(&density, 0.0).unwrap_err(), "density at which ground costs twice as much is 0");
    density[41] = f32::NAN;
    says(flow.avoid_crowds(&density, 1.0).unwrap_err(), "the density at (0.375, 0.375) is NaN");
    assert_eq!(flow.lengths(), lengths);
    says(flow.slowing(-1.0).unwrap_err(), "slowing distance of a flow to a goal is -1");
    says(Density::of(&ground, [], f64::NAN).unwrap_err(), "radius of a density is NaN");
    let mut ground = Arc::unwrap_or_clone(ground);
    says(ground.paint(|at| if at.x < 1.0 { 0.0 } else { 1.0 }).unwrap_err(), "the cost at (0.125, 0.125) is 0");
    says(ground.paint_cells(&[1.0; 7]).unwrap_err(), "7 costs are given for 1600 cells");
}
