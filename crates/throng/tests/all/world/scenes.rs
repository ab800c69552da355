//! Random places and crowds, rotated and moved: untuned scenes.

use crate::world::common::{Draw, journey_into, journey_to, rectangle};
use crate::world::oracle::{distance_to, obstacles};
use glam::DVec2;
use throng::avoid::Orca;
use throng::motion::Holonomic;
use throng::{Agent, Goal, Group, GroupId, Journey, JourneyId, Obstacle, Settings, Stop, SubSteps, World};

/// A room of walls, at any angle, with discs, blocks, triangles and bent walls in it.
pub fn clutter(draw: &mut Draw, center: DVec2, half: f64, things: usize) -> Vec<Obstacle> {
    let angle = draw.between(0.0, 6.0);
    let mut walls = rectangle(center, DVec2::splat(2.0 * half), angle);
    walls.push(walls[0]);
    let mut all = vec![Obstacle::Wall { points: walls }];
    let spread = DVec2::splat(0.8 * half);
    for _ in 0..things {
        let at = draw.point(center - spread, center + spread);
        let size = draw.point(DVec2::splat(0.3), DVec2::splat(0.35 * half));
        let angle = draw.between(0.0, 6.0);
        let corners = rectangle(at, size, angle);
        all.push(match draw.index(4) {
            0 => Obstacle::Circle { center: at, radius: 0.5 * size.x },
            1 => Obstacle::Polygon { corners },
            2 => Obstacle::Polygon { corners: corners[..3].to_vec() },
            _ => Obstacle::Wall { points: corners[..3].to_vec() },
        });
    }
    all
}

/// A point where a body of this radius is free of all obstacles and all given bodies, if one is found.
pub fn free_spot(
    draw: &mut Draw,
    obstacles: &[Obstacle],
    taken: &[(DVec2, f64)],
    (low, high): (DVec2, DVec2),
    radius: f64,
) -> Option<DVec2> {
    let free = |p: &DVec2| {
        taken.iter().all(|&(at, size)| p.distance(at) > 1.01 * (size + radius))
            && obstacles.iter().all(|obstacle| distance_to(obstacle, *p) > 1.01 * radius)
    };
    (0..200).map(|_| draw.point(low, high)).find(free)
}

/// Fills a box with agents of all sizes and speeds with random goals. `limits`: acceleration, turn rate.
pub fn populate(world: &mut World, draw: &mut Draw, area: (DVec2, DVec2), count: usize, kind: &Kind) {
    let obstacles = obstacles(world);
    let mut taken = Vec::new();
    for _ in 0..count {
        let radius = draw.one_of(kind.radii);
        let Some(position) = free_spot(draw, &obstacles, &taken, area, f64::from(radius)) else { continue };
        let Some(goal) = free_spot(draw, &obstacles, &[], area, 0.7) else { continue };
        let journey = journey_to(world, goal);
        let preferred_speed = draw.between(0.3, 2.5) as f32;
        let agent = Agent {
            position: position.extend(0.0),
            journey,
            radius,
            preferred_speed,
            group: kind.group,
            motor: Holonomic {
                max_speed: preferred_speed * draw.between(1.0, 1.8) as f32,
                max_acceleration: draw.one_of(kind.accelerations),
                max_turn_rate: draw.one_of(kind.turn_rates),
            }
            .into(),
            ..Agent::default()
        };
        // a rotated room does not fill its box: a place outside the room is in another part of the ground
        if world.add_agent(agent).is_ok() {
            taken.push((position, f64::from(radius)));
        }
    }
}

/// The settings of a crowd.
pub struct Kind<'a> {
    pub radii: &'a [f32],
    pub accelerations: &'a [f32],
    pub turn_rates: &'a [f32],
    pub group: GroupId,
}

impl Default for Kind<'_> {
    fn default() -> Self {
        Self {
            radii: &[0.1, 0.17, 0.23, 0.4, 0.6],
            accelerations: &[0.8, 5.0, f32::INFINITY],
            turn_rates: &[1.0, 4.0, f32::INFINITY],
            group: GroupId::DEFAULT,
        }
    }
}

/// A world with all features: clutter, groups, points, areas, exits, waits, endless rounds, agents that enter later.
/// `order` shuffles the order in which the agents are added; they keep their numbers.
pub fn busy(order: u64) -> World {
    let origin = DVec2::new(4321.5, -2750.25);
    let mut draw = Draw::new(2024);
    let mut world = World::new(Settings { step: 0.05, seed: 5, origin, ..Settings::default() }).unwrap();
    let far = Group {
        name: "far-sighted".into(),
        model: std::sync::Arc::new(Orca { time_horizon: 4.0, ..Orca::default() }),
        neighbours: 6,
        ..Group::default()
    };
    let groups = [GroupId::DEFAULT, world.add_group(far).unwrap()];
    for obstacle in clutter(&mut draw, origin, 11.0, 9) {
        world.add_obstacle(obstacle).unwrap();
    }
    let obstacles = obstacles(&world);
    let area = (origin - DVec2::splat(8.0), origin + DVec2::splat(8.0));
    let journeys = journeys(&mut world, &mut draw, &obstacles, area);
    let mut taken = Vec::new();
    let mut agents = Vec::new();
    for number in 0..260 {
        let radius = draw.one_of(&[0.14f32, 0.2, 0.27]);
        let Some(position) = free_spot(&mut draw, &obstacles, &taken, area, f64::from(radius)) else { continue };
        taken.push((position, f64::from(radius)));
        let agent = Agent {
            position: position.extend(0.0),
            radius,
            group: groups[draw.index(2)],
            journey: journeys[draw.index(journeys.len())],
            preferred_speed: draw.between(0.7, 1.7) as f32,
            number: Some(number * 3),
            motor: Holonomic {
                max_acceleration: draw.one_of(&[2.0, 5.0, f32::INFINITY]),
                max_turn_rate: draw.one_of(&[3.0, f32::INFINITY]),
                ..Holonomic::default()
            }
            .into(),
            ..Agent::default()
        };
        let later = (number % 4 == 3).then(|| draw.between(0.1, 9.0));
        agents.push((later, agent));
    }
    if order > 0 {
        Draw::new(order).shuffle(&mut agents);
    }
    for (later, agent) in agents {
        match later {
            Some(time) => world.schedule_agent(time, agent).unwrap(),
            None => drop(world.add_agent(agent).unwrap()),
        }
    }
    world
}

/// A crush: two hundred agents in a small room, with crossing ways, at a coarse step; some at exactly the place of
/// another. The guard has work at every step.
pub fn packed(order: u64) -> World {
    let origin = DVec2::new(-1250.5, 640.0);
    let mut draw = Draw::new(777);
    let settings = Settings { step: 0.1, sub_steps: SubSteps::Fixed(1), seed: 3, origin };
    let mut world = World::new(settings).unwrap();
    for obstacle in clutter(&mut draw, origin, 5.5, 2) {
        world.add_obstacle(obstacle).unwrap();
    }
    let obstacles = obstacles(&world);
    let area = (origin - DVec2::splat(3.6), origin + DVec2::splat(3.6));
    let mut agents = Vec::new();
    for number in 0..200 {
        let radius = draw.one_of(&[0.15f32, 0.2, 0.25]);
        let spot = free_spot(&mut draw, &obstacles, &[], area, f64::from(radius)).unwrap();
        let journey = journey_to(&mut world, origin * 2.0 - spot);
        agents.push(Agent { position: spot.extend(0.0), radius, journey, number: Some(number), ..Agent::default() });
        if number % 10 == 9 {
            let twin = Agent { number: Some(1000 + number), ..agents[agents.len() - 1].clone() };
            agents.push(twin);
        }
    }
    if order > 0 {
        Draw::new(order).shuffle(&mut agents);
    }
    for agent in agents {
        world.add_agent(agent).unwrap();
    }
    world
}

fn journeys(world: &mut World, draw: &mut Draw, obstacles: &[Obstacle], area: (DVec2, DVec2)) -> Vec<JourneyId> {
    let mut spot = || free_spot(draw, obstacles, &[], area, 1.0).unwrap();
    let square = |at: DVec2| rectangle(at, DVec2::splat(1.6), 0.4);
    let mut all: Vec<JourneyId> = (0..4).map(|_| journey_to(world, spot())).collect();
    all.push(journey_into(world, Goal::Area { corners: square(spot()) }));
    all.push(journey_into(world, Goal::Exit { corners: square(spot()) }));
    all.push(journey_into(world, Goal::Exit { corners: square(spot()) }));
    let mut stops = Vec::new();
    for wait in [0.0, 0.7, 1.9] {
        let goal = world.add_goal(Goal::Point { at: spot(), tolerance: 0.5 }).unwrap();
        stops.push(Stop { goal, wait });
    }
    all.push(world.add_journey(Journey { stops: stops.clone(), repeat: true }).unwrap());
    all.push(world.add_journey(Journey { stops, repeat: false }).unwrap());
    all
}
