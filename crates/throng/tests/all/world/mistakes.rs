//! Bad input gives an error that names the parameter; the world is unchanged, and nothing panics.

use crate::world::common::{journey_to, world};
use glam::{DVec2, Vec2};
use throng::avoid::Orca;
use throng::motion::Holonomic;
use throng::{Agent, Error, Goal, Group, Journey, Obstacle, Settings, Stop, SubSteps, Walkable, World};

const NAN: f64 = f64::NAN;
const INFINITE: f64 = f64::INFINITY;

/// Checks that the result is an error with all of `words` in its message.
fn assert_names<T: std::fmt::Debug>(result: Result<T, Error>, words: &[&str]) {
    let message = result.expect_err(&format!("should be refused: {words:?}")).to_string();
    assert!(words.iter().all(|word| message.contains(word)), "{message:?} should say {words:?}");
}

fn corners(points: &[(f64, f64)]) -> Vec<DVec2> {
    points.iter().map(|&p| DVec2::from(p)).collect()
}

#[test]
fn settings_out_of_range() {
    let settings = Settings::default();
    for step in [0.0, -1.0, NAN, INFINITE, 11.0] {
        assert_names(World::new(Settings { step, ..settings }), &["time step"]);
    }
    for parts in [0, 10_001, u32::MAX] {
        assert_names(World::new(Settings { sub_steps: SubSteps::Fixed(parts), ..settings }), &["sub-steps"]);
    }
    for origin in [DVec2::new(NAN, 0.0), DVec2::new(0.0, -INFINITE), DVec2::new(INFINITE, -INFINITE)] {
        assert_names(World::new(Settings { origin, ..settings }), &["origin"]);
    }
}

#[test]
fn agents_out_of_range() {
    let mut world = world(0.05, DVec2::ZERO);
    let good = Agent::default();
    let nan = f32::NAN;
    let bad = [
        ("position", Agent { position: DVec2::new(NAN, 0.0).extend(0.0), ..good.clone() }),
        ("position", Agent { position: DVec2::new(INFINITE, -INFINITE).extend(0.0), ..good.clone() }),
        ("position", Agent { position: DVec2::new(1e7, 0.0).extend(0.0), ..good.clone() }),
        ("velocity", Agent { velocity: Vec2::new(0.0, nan), ..good.clone() }),
        ("velocity", Agent { velocity: Vec2::new(f32::INFINITY, f32::NEG_INFINITY), ..good.clone() }),
        ("heading", Agent { heading: Some(nan), ..good.clone() }),
        ("radius", Agent { radius: nan, ..good.clone() }),
        ("radius", Agent { radius: 0.0, ..good.clone() }),
        ("radius", Agent { radius: -1.0, ..good.clone() }),
        ("radius", Agent { radius: f32::INFINITY, ..good.clone() }),
        ("preferred speed", Agent { preferred_speed: nan, ..good.clone() }),
        ("preferred speed", Agent { preferred_speed: -0.1, ..good.clone() }),
        ("max speed", Agent { motor: Holonomic { max_speed: 1.0, ..Holonomic::default() }.into(), ..good.clone() }),
        ("max speed", Agent { motor: Holonomic { max_speed: nan, ..Holonomic::default() }.into(), ..good.clone() }),
        (
            "max speed",
            Agent { motor: Holonomic { max_speed: f32::INFINITY, ..Holonomic::default() }.into(), ..good.clone() },
        ),
        (
            "max acceleration",
            Agent { motor: Holonomic { max_acceleration: 0.0, ..Holonomic::default() }.into(), ..good.clone() },
        ),
        (
            "max acceleration",
            Agent { motor: Holonomic { max_acceleration: nan, ..Holonomic::default() }.into(), ..good.clone() },
        ),
        (
            "max turn rate",
            Agent { motor: Holonomic { max_turn_rate: -2.0, ..Holonomic::default() }.into(), ..good.clone() },
        ),
        (
            "max turn rate",
            Agent { motor: Holonomic { max_turn_rate: nan, ..Holonomic::default() }.into(), ..good.clone() },
        ),
        ("priority", Agent { priority: nan, ..good.clone() }),
    ];
    for (what, agent) in bad {
        assert_names(world.add_agent(agent.clone()), &[what]);
        assert_names(world.schedule_agent(1.0, agent), &[what]);
    }
    assert_names(world.schedule_agent(NAN, good.clone()), &["time of entry"]);
    assert_names(world.schedule_agent(INFINITE, good), &["time of entry"]);
    assert!(world.relative_columns().is_empty() && world.finished(), "nothing is left of what was refused");
}

/// Large, but finite numbers are refused or do no harm.
#[test]
fn huge_numbers_do_no_harm() {
    let mut world = world(0.05, DVec2::ZERO);
    let journey = journey_to(&mut world, DVec2::new(5.0, 1.0));
    let position = DVec2::new(-2.0, 0.0);
    for huge in [f32::MAX, 1e30, 1e12] {
        let plain = Agent { journey, position: position.extend(0.0), ..Agent::default() };
        let _ = world.add_agent(Agent { velocity: Vec2::new(huge, -huge), ..plain.clone() });
        let _ = world.add_agent(Agent { heading: Some(huge), ..plain.clone() });
        let _ = world.add_agent(Agent {
            heading: Some(-huge),
            motor: Holonomic { max_turn_rate: 1.0, ..Holonomic::default() }.into(),
            ..plain.clone()
        });
        let _ = world.add_agent(Agent { priority: huge, ..plain.clone() });
        let _ = world.add_agent(Agent { priority: -huge, ..plain.clone() });
        let _ = world.add_agent(Agent {
            motor: Holonomic { max_acceleration: huge, max_turn_rate: huge, ..Holonomic::default() }.into(),
            ..plain
        });
    }
    let mut farthest: f32 = 0.0;
    for _ in 0..200 {
        world.step();
        let agents = world.relative_columns();
        assert!(agents.position.iter().all(|p| p.is_finite()) && agents.velocity.iter().all(|v| v.is_finite()));
        assert!(agents.heading.iter().all(|h| h.abs() <= std::f32::consts::PI + 1e-5), "{:?}", agents.heading);
        farthest = agents.position.iter().map(|p| p.length()).fold(farthest, f32::max);
    }
    assert!(farthest < 30.0, "{farthest}");
}

#[test]
fn what_is_not_there_is_named() {
    let mut small = world(0.05, DVec2::ZERO);
    let mut large = world(0.05, DVec2::ZERO);
    let group = large.add_group(Group::default()).unwrap();
    let journey = journey_to(&mut large, DVec2::ONE);
    let goal = large.add_goal(Goal::Point { at: DVec2::ZERO, tolerance: 0.1 }).unwrap();
    assert_names(small.add_agent(Agent { group, ..Agent::default() }), &["group", "1"]);
    assert_names(small.add_agent(Agent { journey, ..Agent::default() }), &["journey", "1"]);
    let stops = vec![Stop { goal, wait: 0.0 }];
    assert_names(small.add_journey(Journey { stops, repeat: false }), &["goal", "1"]);
    let theirs = large.add_obstacle(Obstacle::Circle { center: DVec2::ZERO, radius: 1.0 }).unwrap();
    assert!(!small.remove_obstacle(theirs));
    let agent = large.add_agent(Agent::at(DVec2::new(4.0, 4.0))).unwrap();
    assert!(!small.remove_agent(agent));
    assert_eq!((small.row(agent), small.position(agent)), (None, None));
}

#[test]
fn goals_journeys_and_groups_out_of_range() {
    let mut world = world(0.05, DVec2::new(9e6, 0.0));
    let near = DVec2::new(9e6, 1.0);
    assert_names(world.add_goal(Goal::Point { at: DVec2::new(9e6, NAN), tolerance: 0.1 }), &["goal"]);
    assert_names(world.add_goal(Goal::Point { at: DVec2::ZERO, tolerance: 0.1 }), &["goal", "20 km"]);
    for tolerance in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        assert_names(world.add_goal(Goal::Point { at: near, tolerance }), &["tolerance"]);
    }
    for ring in [&[(0.0, 0.0), (1.0, 0.0)][..], &[(0.0, 0.0), (1.0, 1.0), (2.0, 2.0)], &[], &[(0.0, 0.0); 5]] {
        assert_names(world.add_goal(Goal::Area { corners: corners(ring) }), &["goal area"]);
        assert_names(world.add_goal(Goal::Exit { corners: corners(ring) }), &["goal area"]);
    }
    let goal = world.add_goal(Goal::Point { at: near, tolerance: 0.1 }).unwrap();
    for wait in [-1.0, f32::NAN, f32::INFINITY] {
        assert_names(world.add_journey(Journey { stops: vec![Stop { goal, wait }], repeat: true }), &["wait"]);
    }
    let group = Group::default;
    for distance in [0.0, f32::NAN, f32::INFINITY] {
        assert_names(world.add_group(Group { neighbour_distance: distance, ..group() }), &["neighbour distance"]);
        let orca = Orca { time_horizon: distance, ..Orca::default() };
        assert_names(world.add_group(Group { model: std::sync::Arc::new(orca), ..group() }), &["time_horizon"]);
    }
    assert_names(world.add_group(Group { neighbours: 0, ..group() }), &["neighbours"]);
    assert_names(world.add_group(Group { keep_right: f32::NAN, ..group() }), &["keep right"]);
    assert_names(world.add_group(Group { keep_right: 2.0, ..group() }), &["keep right"]);
}

#[test]
fn shapes_that_are_none() {
    let mut world = world(0.05, DVec2::ZERO);
    let bow = corners(&[(0.0, 0.0), (2.0, 2.0), (2.0, 0.0), (0.0, 2.0)]);
    let square = corners(&[(-9.0, -9.0), (9.0, -9.0), (9.0, 9.0), (-9.0, 9.0)]);
    assert_names(world.add_obstacle(Obstacle::Polygon { corners: bow.clone() }), &["obstacle", "crosses", "1.000"]);
    let bad = corners(&[(0.0, 0.0), (1.0, 0.0), (NAN, 1.0)]);
    assert_names(world.add_obstacle(Obstacle::Polygon { corners: bad.clone() }), &["obstacle", "NaN"]);
    for radius in [0.0, -1.0, NAN, INFINITE] {
        assert_names(world.add_obstacle(Obstacle::Circle { center: DVec2::ZERO, radius }), &["radius of the obstacle"]);
    }
    let center = DVec2::new(NAN, 0.0);
    assert_names(world.add_obstacle(Obstacle::Circle { center, radius: 1.0 }), &["centre of the obstacle"]);
    for points in [corners(&[]), corners(&[(1.0, 1.0)]), corners(&[(1.0, 1.0), (1.0, 1.0)])] {
        assert_names(world.add_obstacle(Obstacle::Wall { points }), &["wall", "two different points"]);
    }
    assert_names(world.add_obstacle(Obstacle::Wall { points: bad.clone() }), &["point of the wall"]);
    let area = |outer: &[DVec2], hole: &[DVec2]| Walkable { outer: outer.to_vec(), holes: vec![hole.to_vec()] };
    let hole = corners(&[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)]);
    assert_names(world.set_walkable(vec![area(&square, &hole), area(&bow, &hole)]), &["walkable area 2"]);
    assert_names(world.set_walkable(vec![area(&square, &bad)]), &["hole 1 of walkable area 1"]);
    assert_eq!(*world.place(), throng::space::Place::default(), "nothing is left of what was refused");
}

#[test]
fn no_room_says_where_and_why() {
    let mut world = world(0.05, DVec2::new(200.0, 0.0));
    let outer = corners(&[(190.0, -5.0), (210.0, -5.0), (210.0, 5.0), (190.0, 5.0)]);
    world.set_walkable(vec![Walkable { outer, holes: vec![] }]).unwrap();
    world.add_obstacle(Obstacle::Circle { center: DVec2::new(200.0, 0.0), radius: 1.0 }).unwrap();
    for (x, why) in
        [(200.5, "inside an obstacle"), (201.1, "overlap a wall"), (209.9, "overlap a wall"), (250.0, "outside")]
    {
        let agent = Agent::at(DVec2::new(x, 0.0));
        let at = x.to_string();
        assert_names(world.add_agent(agent.clone()), &[why, &at, "0.13"]);
        assert_names(world.schedule_agent(1.0, agent), &[why, &at]);
    }
    assert_eq!(world.no_room(DVec2::new(205.0, 0.0), 0.17), None);
}
