//! The workloads: crowds that never end, so that all steps are alike, and floors of rooms.

use glam::{DVec2, Vec2};
pub use throng::random::SplitMix64 as Dice;
use throng::{Agent, Goal, Journey, JourneyId, Obstacle, Settings, Stop, Walkable, World};

/// Returns places on a jittered grid round the origin, with a density per square metre; at 2 per m2 no two are nearer
/// than 0.43 m.
pub fn crowd(count: usize, density: f64) -> Vec<DVec2> {
    let mut rng = Dice(7);
    let spacing = density.sqrt().recip();
    let side = (count as f64).sqrt().ceil();
    let place = |k: usize| DVec2::new(k as f64 % side, (k as f64 / side).floor()) - 0.5 * (side - 1.0);
    (0..count).map(|k| (place(k) + rng.point(DVec2::splat(-0.19), DVec2::splat(0.19))) * spacing).collect()
}

/// Returns the same places in `f32`, with numbers.
pub fn points(count: usize, density: f64) -> (Vec<Vec2>, Vec<u32>) {
    (crowd(count, density).iter().map(|p| p.as_vec2()).collect(), (0..count as u32).collect())
}

/// Returns a world with steps of 1/60 s and automatic sub-steps.
fn world() -> World {
    World::new(Settings { step: 1.0 / 60.0, ..Settings::default() }).expect("these are valid")
}

/// Adds a journey through goals that repeats.
fn round(world: &mut World, goals: impl IntoIterator<Item = Goal>) -> JourneyId {
    let stops = goals.into_iter().map(|goal| Stop { goal: world.add_goal(goal).expect("a valid goal"), wait: 0.0 });
    let stops = stops.collect();
    world.add_journey(Journey { stops, repeat: true }).expect("goals that are there")
}

fn point(at: DVec2) -> Goal {
    Goal::Point { at, tolerance: 0.5 }
}

/// Returns agents in the open that go to and fro, each between two random places.
pub fn open(count: usize, density: f64) -> World {
    let (mut world, mut rng) = (world(), Dice(8));
    let half = DVec2::splat(0.5 * (count as f64 / density).sqrt());
    for position in crowd(count, density) {
        let goals = [0, 1].map(|_| point(rng.point(-half, half)));
        let journey = round(&mut world, goals);
        world.add_agent(Agent { position: position.extend(0.0), journey, ..Agent::default() }).expect("there is room");
    }
    settle(&mut world, 10.0);
    world
}

/// Returns agents on a ring, 0.65 m apart, that all go to the opposite side and back: measured while they meet in the
/// middle.
pub fn ring(count: usize) -> World {
    let mut world = world();
    let radius = 0.65 * count as f64 / std::f64::consts::TAU;
    for k in 0..count {
        let position = DVec2::from_angle(std::f64::consts::TAU * k as f64 / count as f64) * radius;
        let journey = round(&mut world, [point(-position), point(position)]);
        world.add_agent(Agent { position: position.extend(0.0), journey, ..Agent::default() }).expect("there is room");
    }
    settle(&mut world, radius / 1.3);
    world
}

/// Returns a corridor of 60 by 6 m with two streams of 200 agents.
pub fn corridor() -> World {
    let (mut world, mut rng) = (world(), Dice(9));
    let end = |x: f64| {
        let corners = [(x - 1.5, -3.0), (x + 1.5, -3.0), (x + 1.5, 3.0), (x - 1.5, 3.0)];
        Goal::Area { corners: corners.map(DVec2::from).to_vec() }
    };
    let points = [(-30.0, -3.0), (30.0, -3.0), (30.0, 3.0), (-30.0, 3.0), (-30.0, -3.0)].map(DVec2::from).to_vec();
    world.add_obstacle(Obstacle::Wall { points }).expect("a wall");
    for side in [-1.0, 1.0] {
        let journey = round(&mut world, [end(28.0 * side), end(-28.0 * side)]);
        for k in 0..200 {
            let at = DVec2::new(-side * (3.0 + 0.68 * f64::from(k / 8)), 0.7 * f64::from(k % 8) - 2.45);
            let position = at + rng.point(DVec2::splat(-0.1), DVec2::splat(0.1));
            world
                .add_agent(Agent { position: position.extend(0.0), journey, ..Agent::default() })
                .expect("there is room");
        }
    }
    settle(&mut world, 20.0);
    world
}

fn settle(world: &mut World, seconds: f64) {
    while world.time() < seconds {
        world.step();
    }
}

/// Returns a floor of `side` by `side` rooms, 5 by 4 m, with doors in four of five walls between rooms, and a desk and
/// a pillar in each room.
pub fn floor(side: u32) -> (Vec<Walkable>, Vec<Obstacle>) {
    let mut rng = Dice(u64::from(side));
    let (size, room) = (f64::from(side), DVec2::new(5.0, 4.0));
    let outer = [(0.0, 0.0), (size, 0.0), (size, size), (0.0, size)].map(|p| DVec2::from(p) * room).to_vec();
    let mut obstacles = Vec::new();
    let mut wall = |from: DVec2, to: DVec2, rng: &mut Dice| {
        let along = (to - from).normalize();
        if rng.between(0.0, 1.0) < 0.2 {
            obstacles.push(Obstacle::Wall { points: vec![from, to] });
        } else {
            let door = from + along * rng.between(0.3, from.distance(to) - 1.3);
            obstacles.push(Obstacle::Wall { points: vec![from, door] });
            obstacles.push(Obstacle::Wall { points: vec![door + along, to] });
        }
    };
    for (x, y) in (0..side).flat_map(|x| (0..side).map(move |y| (f64::from(x), f64::from(y)))) {
        let corner = |dx: f64, dy: f64| DVec2::new(x + dx, y + dy) * room;
        if x + 1.0 < size {
            wall(corner(1.0, 0.0), corner(1.0, 1.0), &mut rng);
        }
        if y + 1.0 < size {
            wall(corner(0.0, 1.0), corner(1.0, 1.0), &mut rng);
        }
    }
    for (x, y) in (0..side).flat_map(|x| (0..side).map(move |y| (f64::from(x), f64::from(y)))) {
        let inside = |rng: &mut Dice| (DVec2::new(x, y) + rng.point(DVec2::splat(0.3), DVec2::splat(0.7))) * room;
        let desk = DVec2::new(1.6, 0.8);
        obstacles.push(Obstacle::rectangle(inside(&mut rng), desk, rng.between(0.0, 3.0)));
        obstacles.push(Obstacle::Circle { center: inside(&mut rng), radius: 0.25 });
    }
    (vec![Walkable { outer, holes: vec![] }], obstacles)
}

/// Returns a random place on a floor.
pub fn on_floor(side: u32, rng: &mut Dice) -> DVec2 {
    rng.point(DVec2::splat(0.3), DVec2::new(5.0, 4.0) * f64::from(side) - 0.3)
}
