//! Hashes of the answers of navigation for random places on grounds of all kinds, and of small crowds on these grounds.

use crate::draw::Draw;
use crate::results::Results;
use glam::{DVec2, DVec3};
use std::sync::Arc;
use throng::avoid::Orca3d;
use throng::motion::Holonomic;
use throng::navigate::{Heading, NavMesh, PathSearch, Route};
use throng::{
    Agent, Body, Goal, Group, Journey, JourneyId, Keyframe, Obstacle, Script, Settings, Stop, SubSteps, Walkable, World,
};

fn ring(corners: &[(f64, f64)]) -> Vec<DVec2> {
    corners.iter().map(|&corner| corner.into()).collect()
}

fn rectangle(low: (f64, f64), high: (f64, f64)) -> Vec<DVec2> {
    ring(&[low, (high.0, low.1), high, (low.0, high.1)])
}

fn room(width: f64, height: f64) -> Walkable {
    Walkable { outer: rectangle((0.0, 0.0), (width, height)), holes: vec![] }
}

fn wall(points: &[(f64, f64)]) -> Obstacle {
    Obstacle::Wall { points: ring(points) }
}

fn block(low: (f64, f64), high: (f64, f64)) -> Obstacle {
    Obstacle::Polygon { corners: rectangle(low, high) }
}

/// Ground between the origin and a corner, before it is rotated and moved.
struct Ground {
    name: &'static str,
    walkable: Vec<Walkable>,
    obstacles: Vec<Obstacle>,
    size: DVec2,
    /// The direction of the x axis, and the origin.
    pose: (DVec2, DVec2),
}

impl Ground {
    fn new(name: &'static str, walkable: Vec<Walkable>, obstacles: Vec<Obstacle>, size: (f64, f64)) -> Self {
        Self { name, walkable, obstacles, size: size.into(), pose: (DVec2::X, DVec2::ZERO) }
    }

    fn at(&self, place: DVec2) -> DVec2 {
        self.pose.0.rotate(place) + self.pose.1
    }

    /// Rotates and moves the ground.
    fn posed(mut self, name: &'static str, along: DVec2, origin: DVec2) -> Self {
        (self.name, self.pose) = (name, (along, origin));
        let put = |points: &[DVec2]| points.iter().map(|&point| self.at(point)).collect::<Vec<_>>();
        let walkable = self.walkable.iter().map(|ground| Walkable {
            outer: put(&ground.outer),
            holes: ground.holes.iter().map(|hole| put(hole)).collect(),
        });
        let obstacles = self.obstacles.iter().map(|obstacle| match obstacle {
            Obstacle::Wall { points } => Obstacle::Wall { points: put(points) },
            Obstacle::Polygon { corners } => Obstacle::Polygon { corners: put(corners) },
            Obstacle::Circle { center, radius } => Obstacle::Circle { center: self.at(*center), radius: *radius },
        });
        let (walkable, obstacles) = (walkable.collect(), obstacles.collect());
        Self { walkable, obstacles, ..self }
    }

    fn mesh(&self, radius: f64) -> Result<NavMesh, throng::navigate::NavError> {
        NavMesh::build(&self.walkable, &self.obstacles, radius, (self.at(DVec2::ZERO), self.at(self.size)))
    }
}

/// Random obstacles of all kinds.
fn anything(draw: &mut Draw, count: usize, size: DVec2, most: f64) -> Vec<Obstacle> {
    let obstacle = |k: usize| {
        let (at, to) = (draw.point(DVec2::ZERO, size), DVec2::splat(most));
        let aside = draw.point(-to, to);
        match k % 4 {
            0 => Obstacle::Circle { center: at, radius: draw.between(0.1, 0.5 * most) },
            1 => Obstacle::rectangle(at, draw.point(0.1 * to, to), draw.between(0.0, 3.0)),
            2 => Obstacle::Wall { points: vec![at, at + aside, at + 0.7 * aside.perp()] },
            _ => Obstacle::Polygon { corners: vec![at, at + aside, at + 0.3 * aside.perp(), at - 0.8 * aside] },
        }
    };
    (0..count).map(obstacle).collect()
}

fn hall(seed: u64) -> Ground {
    let (mut draw, size) = (Draw::new(seed), DVec2::new(13.0, 9.0));
    let holes = vec![rectangle((2.0, 2.0), (3.1, 3.4)), ring(&[(9.0, 6.0), (11.0, 5.5), (10.2, 7.9)])];
    let ground = Walkable { outer: rectangle((0.0, 0.0), size.into()), holes };
    Ground::new("hall", vec![ground], anything(&mut draw, 9, size, 2.2), size.into())
}

/// Three rooms behind each other, with doors of 1.5, 0.7 and 0.4 m, and a pillar in the widest.
fn doors() -> Ground {
    let obstacles = vec![
        block((4.0, -1.0), (4.2, 2.0)),
        block((4.0, 3.5), (4.2, 10.0)),
        Obstacle::Circle { center: DVec2::new(4.1, 2.3), radius: 0.1 },
        wall(&[(8.0, -1.0), (8.0, 6.0)]),
        wall(&[(8.0, 6.7), (8.0, 9.5)]),
        wall(&[(8.0, 2.0), (10.0, 2.0)]),
        wall(&[(10.4, 2.0), (12.5, 2.0)]),
    ];
    Ground::new("doors", vec![room(12.0, 9.0)], obstacles, (12.0, 9.0))
}

fn united() -> Ground {
    let west = Walkable { outer: rectangle((0.0, 0.0), (5.0, 5.0)), holes: vec![rectangle((1.5, 1.5), (2.5, 3.0))] };
    let east = Walkable { outer: ring(&[(4.0, 1.0), (4.5, 4.0), (9.0, 4.5), (9.5, 0.5)]), holes: vec![] };
    let touching = Walkable { outer: rectangle((0.0, 5.0), (3.0, 8.0)), holes: vec![] };
    let alone = Walkable { outer: rectangle((6.0, 6.0), (9.0, 8.0)), holes: vec![] };
    Ground::new("united", vec![west, east, touching, alone], vec![wall(&[(6.0, 2.0), (7.5, 3.2)])], (10.0, 8.0))
}

/// Lines of sight graze several corners at once.
fn blocks() -> Ground {
    let block = |k: u32| block_at(DVec2::new(f64::from(k % 3), f64::from(k / 3)) * 2.0 + 1.0);
    Ground::new("blocks", vec![room(8.0, 8.0)], (0..9).map(block).collect(), (8.0, 8.0))
}

fn block_at(low: DVec2) -> Obstacle {
    block(low.into(), (low + 1.0).into())
}

fn open() -> Ground {
    Ground::new("open", vec![], anything(&mut Draw::new(4), 6, DVec2::splat(8.0), 2.0), (9.0, 9.0))
}

fn pinched() -> Ground {
    let outer = ring(&[(0.0, 0.0), (6.0, 0.0), (3.0, 3.0), (6.0, 6.0), (0.0, 6.0), (3.0, 3.0)]);
    let obstacles = vec![
        Obstacle::Polygon { corners: ring(&[(1.0, 1.0), (3.0, 1.0), (2.0, 1.0)]) },
        wall(&[(4.0, 5.0), (4.0, 5.0), (2.5, 5.2), (3.0, 4.6)]),
    ];
    let beside = Walkable { outer: ring(&[(5.0, -1.0), (8.0, -1.0), (8.0, 7.0), (5.0, 7.0)]), holes: vec![] };
    Ground::new("pinched", vec![Walkable { outer, holes: vec![] }, beside], obstacles, (8.0, 6.0))
}

/// Enough obstacles that they are united before they are subtracted from the ground.
fn crowded() -> Ground {
    let obstacles = anything(&mut Draw::new(6), 66, DVec2::splat(12.0), 1.0);
    Ground::new("crowded", vec![room(12.0, 12.0)], obstacles, (12.0, 12.0))
}

/// A boundary so long that it is cut into pieces.
fn toothed() -> Ground {
    let sides = [(DVec2::ZERO, DVec2::X), (DVec2::X, DVec2::Y), (DVec2::ONE, -DVec2::X), (DVec2::Y, -DVec2::Y)];
    let corner = |(from, along): (DVec2, DVec2), k: u32| {
        from * 20.0 + along * (f64::from(k) * 20.0 / 1030.0) + along.perp() * (0.01 * f64::from(k % 2))
    };
    let outer = sides.into_iter().flat_map(|side| (0..1030).map(move |k| corner(side, k))).collect();
    let obstacles = vec![block((6.0, 5.0), (12.0, 15.0))];
    Ground::new("toothed", vec![Walkable { outer, holes: vec![] }], obstacles, (20.0, 20.0))
}

fn describe(results: &mut Results, name: &str, mesh: &NavMesh) {
    results.add(name, &(mesh.vertices(), mesh.triangles(), mesh.outline(), mesh.area_size(), mesh.island_count()));
    let count = mesh.triangles().len() as u32;
    let neighbours: Vec<_> = (0..count).map(|triangle| [0, 1, 2].map(|edge| mesh.neighbour(triangle, edge))).collect();
    results.add(name, &(neighbours, mesh.radius()));
}

/// Adds the mesh and its answers.
fn ask(results: &mut Results, ground: &Ground, radius: f64, efforts: &mut Vec<u32>) {
    let name = &format!("{}, for {radius} m", ground.name);
    let mesh = match ground.mesh(radius) {
        Ok(mesh) => mesh,
        Err(error) => return results.add(name, &error),
    };
    describe(results, name, &mesh);
    let mut draw = Draw::new(21);
    let anywhere = |draw: &mut Draw| ground.at(draw.point(DVec2::splat(-1.0), ground.size + 1.0));
    let whole = |draw: &mut Draw| ground.at((draw.point(DVec2::ZERO, ground.size) * 2.0).round() * 0.5);
    // on the ground, on its corners, where walls begin, and beyond
    let place = |draw: &mut Draw| match draw.index(8) {
        0 => anywhere(draw),
        1 => whole(draw),
        2 => mesh.vertices()[draw.index(mesh.vertices().len())],
        3 => mesh.vertices()[draw.index(mesh.vertices().len())].lerp(mesh.nearest(anywhere(draw)), 1e-7),
        _ => mesh.nearest(anywhere(draw)),
    };
    let mut search = PathSearch::new();
    for _ in 0..80 {
        let (a, b) = (place(&mut draw), place(&mut draw));
        results.add(name, &(mesh.locate(a), mesh.nearest(a), mesh.island(a), mesh.visible(a, b)));
        results.add(name, &mesh.path(&mut search, a, b));
        efforts.push(search.expanded());
        let far = a + (a - ground.at(0.5 * ground.size)) * draw.between(0.0, 30.0);
        results.add(name, &mesh.nearest(far));
    }
    let places: Vec<DVec2> = (0..14).map(|_| place(&mut draw)).collect();
    for _ in 0..4 {
        let to = place(&mut draw);
        results.add(name, &(mesh.paths(&places, to), mesh.paths(&places[..2], to), mesh.paths(&places[2..6], to)));
    }
    for k in 0..10 {
        let (at, size) = (place(&mut draw), draw.one_of(&[0.05, 0.4, 1.0, 3.0]));
        let corner = |(x, y): (f64, f64)| at + ground.pose.0.rotate(DVec2::new(x, y)) * size;
        let forms = [&[(-0.8, -0.6), (0.9, -0.4), (0.1, 0.0), (0.7, 0.8)][..], &[(0.0, 0.0), (0.3, 1.0), (-1.0, 0.1)]];
        let corners: Vec<DVec2> = forms[k % 2].iter().map(|&form| corner(form)).collect();
        let area = mesh.area(&corners).unwrap();
        results.add(name, &(area.is_empty(), area.gap(), area.islands()));
        results.add(name, &places.iter().map(|&place| area.nearest(place)).collect::<Vec<_>>());
        for &from in &places[..5] {
            results.add(name, &mesh.path_to(&mut search, from, &area));
            efforts.push(search.expanded());
        }
        results.add(name, &(mesh.paths_to(&places, &area), mesh.paths_to(&places[..3], &area)));
    }
    // areas before, at and behind the four sides
    for (off, side) in [-0.5 * radius, 0.0, 0.009].into_iter().flat_map(|off| [0, 1, 2, 3].map(|side| (off, side))) {
        let corner = |(off, along): (f64, f64)| match side {
            0 => ground.at(DVec2::new(ground.size.x + off, along)),
            1 => ground.at(DVec2::new(-off, along)),
            2 => ground.at(DVec2::new(along, ground.size.y + off)),
            _ => ground.at(DVec2::new(along, -off)),
        };
        let area = mesh.area(&[(off, 1.0), (off + 0.5, 1.0), (off + 0.5, 3.0), (off, 3.0)].map(corner)).unwrap();
        results.add(name, &(area.gap(), mesh.paths_to(&places[..2], &area)));
    }
    for from in places {
        walk(results, name, &mesh, (from, mesh.nearest(anywhere(&mut draw))), &mut draw);
    }
}

/// Walks along a route with pushes; in the end far off.
fn walk(results: &mut Results, name: &str, mesh: &NavMesh, (from, to): (DVec2, DVec2), draw: &mut Draw) {
    let Ok(path) = mesh.path(&mut PathSearch::new(), from, to) else { return };
    let (mut route, mut at) = (Route::new(&path), path.start);
    let push = draw.one_of(&[0.0, 0.04, 0.15]);
    for step in 0..90 {
        let heading = route.advance(mesh, at);
        results.add(name, &(heading, route.remaining(at), route.corners().len()));
        let aim = match heading {
            Heading::Corner(aim) | Heading::End(aim) => aim,
            Heading::Lost => break,
        };
        at += (aim - at).clamp_length_max(0.12) + draw.point(DVec2::splat(-push), DVec2::splat(push));
        at = if step == 80 { path.start } else { mesh.nearest(at) };
    }
    results.add(name, &(route.end(), route));
}

fn errors(results: &mut Results) {
    let nowhere = (DVec2::ZERO, DVec2::ZERO);
    let mut add = |walkable: &[Walkable], obstacles: &[Obstacle], radius: f64| {
        let found = NavMesh::build(walkable, obstacles, radius, nowhere);
        results.add("refused", &found.map(|mesh| mesh.area_size()).map_err(|error| (error.to_string(), error)));
    };
    let hall = [room(9.0, 9.0)];
    let outer = ring(&[(0.0, 0.0), (4.0, 4.0), (4.0, 1.0), (0.0, 4.0)]);
    let bow = Walkable { outer: outer.clone(), holes: vec![] };
    let holes = vec![rectangle((1.0, 1.0), (2.0, 2.0)), outer.clone()];
    add(&[hall[0].clone(), bow], &[], 0.2);
    add(&[Walkable { holes, ..hall[0].clone() }], &[], 0.2);
    add(&hall, &[Obstacle::Polygon { corners: outer }], 0.2);
    for points in [&[(1.0, 1.0), (1.0, 1.0)][..], &[(1.0, f64::NAN), (2.0, 2.0)], &[(1.0, 1.0), (2.0, 2.0), (1.0, 1.0)]]
    {
        add(&hall, &[wall(points)], 0.2);
        add(&hall, &[Obstacle::Polygon { corners: ring(points) }], 0.2);
        add(&[Walkable { outer: ring(points), holes: vec![] }], &[], 0.2);
    }
    for radius in [0.0, -1.0, 0.1, 4.4, 4.6, 1e6, f64::NAN] {
        add(&hall, &[], radius);
        add(&hall, &[Obstacle::Circle { center: DVec2::ONE, radius }], 0.2);
    }
    for size in [999_990.0, 1_000_010.0] {
        add(&[room(size, 9.0)], &[], 0.2);
    }
    add(&[], &[], 0.3);
    let mesh = NavMesh::build(&hall, &[block((4.0, -1.0), (5.0, 10.0))], 0.25, nowhere).unwrap();
    for (from, to) in [
        ((1.0, 1.0), (8.0, 1.0)),
        ((8.0, 1.0), (1.0, 2.0)),
        ((-1.0, 1.0), (3.9, 4.0)),
        ((-1.4, 1.0), (3.9, 4.0)),
        ((1.0, 1.0), (4.0, 1.0)),
        ((1.0, 1.0), (4.02, 1.0)),
        ((f64::NAN, 1.0), (1.0, 1.0)),
        ((1.0, 1.0), (1.0, f64::INFINITY)),
    ] {
        let found = mesh.path(&mut PathSearch::new(), from.into(), to.into());
        results.add("unreachable", &found.map_err(|why| (why.to_string(), why)));
    }
    for corners in [&[(4.3, 1.0), (4.6, 1.0), (4.4, 2.0)][..], &[(1.0, 1.0), (2.0, 1.0)], &[(0.0, f64::NAN); 3]] {
        let area = mesh.area(&ring(corners));
        results.add("unreachable", &area.map(|area| mesh.path_to(&mut PathSearch::new(), DVec2::ONE, &area)));
    }
}

fn goals_and_scripts(results: &mut Results) {
    let (mut draw, corners) = (Draw::new(31), ring(&[(1.0, 1.0), (4.0, 0.5), (2.0, 2.0), (3.0, 5.0)]));
    for goal in [
        Goal::Point { at: DVec2::new(2.0, 1.5), tolerance: 1.5 },
        Goal::Air { at: DVec3::new(2.0, 1.5, 2.0), tolerance: 1.8 },
        Goal::Area { corners: corners.clone() },
        Goal::Exit { corners },
    ] {
        results.add("goals", &(goal.middle(), goal.corners(), goal.altitude(), goal.tolerance()));
        for _ in 0..60 {
            let place = draw.point(DVec2::ZERO, DVec2::splat(5.0)).extend(draw.between(0.0, 3.0));
            results.add("goals", &(goal.holds(place), goal.offset(place)));
        }
    }
    for (count, first) in [(0, 0.0), (1, 2.0), (2, 0.0), (5, 1.3)] {
        let keyframe = |k: usize| Keyframe {
            time: first + (k * k + k) as f64 * 0.7,
            at: draw.point(DVec2::ZERO, DVec2::splat(9.0)),
            heading: draw.between(-4.0, 4.0),
        };
        let keyframes: Vec<Keyframe> = (0..count).map(keyframe).collect();
        for repeat in [false, count > 1] {
            let script = Script { keyframes: keyframes.clone(), repeat };
            (0..80).for_each(|_| results.add("scripts", &script.at(draw.between(0.0, 60.0))));
            keyframes.iter().for_each(|keyframe| results.add("scripts", &script.at(keyframe.time)));
            results.add("scripts", &world().add_script(script));
        }
    }
    for (times, repeat, heading) in [
        (&[1.0][..], true, 0.0),
        (&[-0.1], false, 0.0),
        (&[0.0], false, 1e6),
        (&[0.0], false, 1.1e6),
        (&[1.0, 1.0], false, 0.0),
    ] {
        let keyframes = times.iter().map(|&time| Keyframe { time, at: DVec2::ONE, heading }).collect();
        results.add("scripts", &world().add_script(Script { keyframes, repeat }));
    }
}

/// Origin of the worlds, far from zero.
const ORIGIN: DVec2 = DVec2::new(-310.0, 94.0);

fn world() -> World {
    World::new(Settings { step: 0.1, sub_steps: SubSteps::Auto, seed: 5, origin: ORIGIN }).unwrap()
}

/// A world on some ground.
fn on(ground: Ground) -> World {
    let mut world = world();
    let ground = ground.posed("", DVec2::new(0.8, 0.6), ORIGIN);
    world.set_walkable(ground.walkable).unwrap();
    for obstacle in ground.obstacles {
        world.add_obstacle(obstacle).unwrap();
    }
    world
}

fn at(x: f64, y: f64) -> DVec2 {
    ORIGIN + DVec2::new(0.8, 0.6).rotate(DVec2::new(x, y))
}

fn there(x: f64, y: f64) -> Goal {
    Goal::Point { at: at(x, y), tolerance: 0.25 }
}

fn corners(low: (f64, f64), high: (f64, f64)) -> Vec<DVec2> {
    rectangle(low, high).into_iter().map(|corner| at(corner.x, corner.y)).collect()
}

fn journey(world: &mut World, goals: &[(Goal, f32)], repeat: bool) -> JourneyId {
    let stop = |(goal, wait): &(Goal, f32)| Stop { goal: world.add_goal(goal.clone()).unwrap(), wait: *wait };
    let stops = goals.iter().map(stop).collect();
    world.add_journey(Journey { stops, repeat }).unwrap()
}

/// Agents on a grid between two corners where there is room.
fn fill(world: &mut World, (low, high): ((f64, f64), (f64, f64)), apart: f64, like: &Agent) {
    let (low, size) = (DVec2::from(low), DVec2::from(high) - DVec2::from(low));
    let [columns, rows] = (size / apart).floor().to_array().map(|count| count as u32 + 1);
    for k in 0..columns * rows {
        let place = low + DVec2::new(f64::from(k % columns), f64::from(k / columns)) * apart;
        let position = at(place.x, place.y);
        if world.is_free(position.extend(0.0), like.radius * 1.05) {
            world.add_agent(Agent { position: position.extend(0.0), ..like.clone() }).unwrap();
        }
    }
}

fn journeys() -> World {
    let mut world = on(hall(3));
    let plain = world.add_group(Group { look_ahead: false, ..Group::default() }).unwrap();
    let area = Goal::Area { corners: corners((11.0, 0.5), (12.5, 2.0)) };
    let exit = Goal::Exit { corners: corners((12.0, 3.0), (13.0, 5.0)) };
    let round = journey(&mut world, &[(there(1.0, 8.0), 0.7), (area.clone(), 0.4), (there(7.0, 1.0), 0.0)], true);
    let once = journey(&mut world, &[(area, 0.3), (there(6.0, 8.2), 1.0), (exit, 0.0)], false);
    let shared = journey(&mut world, &[(there(6.0, 4.5), 0.0)], false);
    for (k, journey) in [round, once, shared].into_iter().enumerate() {
        let y = 0.4 + 2.9 * k as f64;
        for (group, x) in [(plain, 0.4), (Agent::default().group, 5.4)] {
            fill(&mut world, ((x, y), (x + 2.6, y + 1.9)), 0.9, &Agent { journey, group, ..Agent::default() });
        }
    }
    world
}

/// Two exits of two widths.
fn choice() -> World {
    let outer = ring(&[
        (0.0, 0.0),
        (12.0, 0.0),
        (12.0, 2.0),
        (14.0, 2.0),
        (14.0, 3.6),
        (12.0, 3.6),
        (12.0, 6.0),
        (0.0, 6.0),
        (0.0, 3.4),
        (-2.0, 3.4),
        (-2.0, 2.6),
        (0.0, 2.6),
    ]);
    let mut world = on(Ground::new("", vec![Walkable { outer, holes: vec![] }], vec![], (12.0, 6.0)));
    let exits = [corners((-2.0, 2.6), (-1.5, 3.4)), corners((13.5, 2.0), (14.0, 3.6))];
    let exits = exits.map(|corners| journey(&mut world, &[(Goal::Exit { corners }, 0.0)], false));
    world.add_choice(&exits).unwrap();
    fill(&mut world, ((0.4, 0.4), (6.5, 5.6)), 0.6, &Agent { journey: exits[0], ..Agent::default() });
    fill(&mut world, ((9.0, 0.4), (11.0, 5.6)), 1.0, &Agent { journey: exits[1], ..Agent::default() });
    world
}

/// Through doors. A leaf opens and closes a door.
fn through_doors() -> World {
    let mut world = on(doors());
    let area = Goal::Area { corners: corners((9.0, 3.0), (11.5, 6.0)) };
    let right = journey(&mut world, &[(there(6.0, 3.0), 0.0), (area, 0.0)], false);
    let left = journey(&mut world, &[(there(5.0, 8.0), 0.5), (there(1.0, 1.0), 0.0)], false);
    let keyframe = |time: f64, y: f64| Keyframe { time, at: at(8.0, y), heading: 0.643_501_108_793_284_4 };
    let keyframes = vec![keyframe(0.0, 6.35), keyframe(4.0, 5.6), keyframe(9.0, 5.6), keyframe(11.0, 6.35)];
    let script = Some(world.add_script(Script { keyframes, repeat: true }).unwrap());
    let leaf = Agent {
        position: at(8.0, 6.35).extend(0.0),
        script,
        heading: Some(0.643_501_1),
        avoids: 0,
        ..Agent::default()
    };
    world
        .add_agent(
            Agent { motor: Holonomic { max_turn_rate: 2.0, ..Holonomic::default() }.into(), ..leaf }
                .with_body(Body::rectangle(0.3, 0.5)),
        )
        .unwrap();
    fill(&mut world, ((0.5, 0.5), (3.4, 4.0)), 0.9, &Agent { journey: right, ..Agent::default() });
    fill(&mut world, ((5.0, 1.0), (7.0, 5.0)), 1.1, &Agent { journey: left, radius: 0.2, ..Agent::default() });
    world
}

/// Into an area round a corner that has room for all agents, and into another that has not.
fn filling() -> World {
    let outer = ring(&[(0.0, 0.0), (9.0, 0.0), (9.0, 5.0), (6.5, 5.0), (6.5, 2.5), (0.0, 2.5)]);
    let pillar = Obstacle::Circle { center: DVec2::new(7.5, 3.0), radius: 0.3 };
    let mut world = on(Ground::new("", vec![Walkable { outer, holes: vec![] }], vec![pillar], (9.0, 5.0)));
    let bend = ring(&[(5.6, 0.0), (9.0, 0.0), (9.0, 5.0), (7.0, 5.0), (7.0, 1.5), (5.6, 1.5)]);
    let wide = Goal::Area { corners: bend.into_iter().map(|corner| at(corner.x, corner.y)).collect() };
    let [wide, small] = [wide, Goal::Area { corners: corners((4.6, 1.8), (5.6, 2.5)) }]
        .map(|goal| journey(&mut world, &[(goal, 0.0)], false));
    fill(&mut world, ((0.3, 0.3), (2.6, 2.2)), 0.5, &Agent { journey: wide, radius: 0.2, ..Agent::default() });
    fill(&mut world, ((3.0, 0.3), (4.4, 1.6)), 0.5, &Agent { journey: small, ..Agent::default() });
    world
}

/// From both sides into a passage as wide as a body, with a bay.
fn narrow() -> World {
    let sides = [
        wall(&[(-4.0, 4.0), (0.0, 0.2), (2.0, 0.2), (2.0, 0.7), (2.6, 0.7), (2.6, 0.2), (5.0, 0.2), (8.0, 4.0)]),
        wall(&[(-4.0, -4.0), (0.0, -0.2), (5.0, -0.2), (8.0, -4.0)]),
    ];
    let mut world = on(Ground::new("", vec![], sides.to_vec(), (5.0, 1.0)));
    for (x, to) in [(-1.0, 6.5), (-1.8, 7.5), (6.0, -1.5), (6.8, -2.5)] {
        let journey = journey(&mut world, &[(there(to, 0.1), 0.0)], false);
        let position = at(x, 0.05 * x);
        world.add_agent(Agent { position: position.extend(0.0), journey, radius: 0.14, ..Agent::default() }).unwrap();
    }
    world
}

/// Goals in walls and behind walls, and a later stop that cannot be reached.
fn stranded() -> World {
    let mut world = on(doors());
    for goals in [
        vec![(there(11.0, 1.0), 0.0)],
        vec![(there(4.1, 6.0), 0.0)],
        vec![(there(20.0, 20.0), 0.0)],
        vec![(there(6.0, 2.0), 0.2), (there(11.0, 1.5), 0.0)],
        vec![(Goal::Area { corners: corners((4.05, 7.0), (4.15, 8.0)) }, 0.0)],
        vec![(Goal::Exit { corners: corners((11.9, 4.0), (12.4, 5.0)) }, 0.0)],
    ] {
        let journey = journey(&mut world, &goals, false);
        let row = world.relative_columns().len() as f64;
        for (x, radius) in [(1.0, 0.15), (2.0, 0.36)] {
            let position = at(x, 1.0 + row * 0.55);
            world.add_agent(Agent { position: position.extend(0.0), journey, radius, ..Agent::default() }).unwrap();
        }
    }
    world
}

fn in_the_air() -> World {
    let mut world = on(doors());
    let model = Arc::new(Orca3d::default());
    let group = world.add_group(Group { model, ..Group::default() }).unwrap();
    let up = |x: f64, y: f64, z: f64| Goal::Air { at: at(x, y).extend(z), tolerance: 0.3 };
    let over = [(up(6.0, 3.0, 2.0), 0.3), (there(11.0, 7.0), 0.0), (up(7.0, 7.0, 4.0), 0.0)];
    let over = journey(&mut world, &over, true);
    let down = journey(&mut world, &[(up(2.0, 7.0, 1.0), 0.0)], false);
    for k in 0..8 {
        let (x, y, journey) = if k % 2 == 0 { (1.0, 1.0, over) } else { (6.0, 5.0, down) };
        let position = at(x, y + 0.4 * f64::from(k));
        let agent =
            Agent { position: position.extend(0.5 * f64::from(k)), group, journey, radius: 0.2, ..Agent::default() };
        world.add_agent(agent).unwrap();
    }
    world
}

fn crowds(results: &mut Results) {
    for (name, mut world, steps) in [
        ("world of journeys", journeys(), 180),
        ("world with a choice", choice(), 90),
        ("world of doors", through_doors(), 200),
        ("world with areas that fill", filling(), 240),
        ("world of a narrow passage", narrow(), 260),
        ("world of the stranded", stranded(), 80),
        ("world in the air", in_the_air(), 120),
    ] {
        for _ in 0..steps {
            world.step();
            results.add(name, &world.state_hash());
        }
        results.add(name, &world.stranded());
        results.add(name, &(world.counts(), world.relative_columns().travel.to_vec()));
    }
}

#[test]
fn what_navigation_answers_is_as_kept() {
    let (mut results, mut efforts) = (Results::default(), vec![]);
    for ground in [
        hall(1),
        hall(2).posed("hall, turned", DVec2::new(0.8, 0.6), DVec2::new(-1800.0, 900.5)),
        doors(),
        united(),
        blocks(),
        open().posed("open, turned", DVec2::new(-0.6, 0.8), DVec2::new(5.25, -3.0)),
        pinched(),
    ] {
        for radius in [0.12, 0.3] {
            ask(&mut results, &ground, radius, &mut efforts);
        }
    }
    ask(&mut results, &crowded(), 0.12, &mut efforts);
    let mesh = toothed().mesh(0.2).unwrap();
    describe(&mut results, "toothed", &mesh);
    let across = mesh.path(&mut PathSearch::new(), DVec2::new(3.0, 8.0), DVec2::new(17.0, 11.0));
    results.add("toothed", &across);
    // these change where a search finds the same path in another way
    results.add("nodes that searches expand", &efforts);
    errors(&mut results);
    goals_and_scripts(&mut results);
    crowds(&mut results);
    results.assert_kept("all/navigation/kept.txt");
}
