//! Flying agents: all arrive, no two overlap, the bits are the same, and agents below are not affected.

use crate::world::common::{journey_into, journey_to, run, run_for, with_settings, world};
use crate::world::determinism::{bits, with_threads};
use glam::{DVec2, DVec3, Vec2};
use throng::avoid::Orca3d;
use throng::{Agent, Body, Goal, Group, GroupId, Obstacle, Status, SubSteps, World};

fn drones(world: &mut World) -> GroupId {
    let model = std::sync::Arc::new(Orca3d::default());
    world.add_group(Group { name: "drones".into(), model, ..Group::default() }).unwrap()
}

fn fly(world: &mut World, group: GroupId, from: DVec3, to: DVec3) -> Agent {
    let journey = journey_into(world, Goal::Air { at: to, tolerance: 0.1 });
    Agent { position: from, group, journey, radius: 0.25, ..Agent::default() }
}

/// Places spread evenly over a sphere.
fn sphere(count: usize, radius: f64) -> Vec<DVec3> {
    let spot = |k: usize| {
        let z = 1.0 - (2 * k + 1) as f64 / count as f64;
        let around = DVec2::from_angle(k as f64 * 2.399_963_229_728_653) * (1.0 - z * z).sqrt();
        around.extend(z) * radius
    };
    (0..count).map(spot).collect()
}

/// This number of agents on a sphere, each on the way to the opposite side.
fn swap(count: usize, step: f64) -> World {
    let mut world = world(step, DVec2::ZERO);
    let group = drones(&mut world);
    let radius = 4.0 + (count as f64).sqrt() * 0.4;
    let middle = DVec3::Z * (radius + 1.0);
    for spot in sphere(count, radius) {
        // two agents exactly, not only nearly, above each other
        let spot = if count == 2 { DVec3::Z * radius * spot.z.signum() } else { spot };
        let agent = fly(&mut world, group, middle + spot, middle - spot);
        world.add_agent(agent).unwrap();
    }
    world
}

/// The least distance of two agents over the sum of their radii.
fn least(world: &World) -> f64 {
    let agents = world.relative_columns();
    let place = |row: usize| agents.position[row].as_dvec2().extend(f64::from(agents.altitude[row]));
    let radii = |a: usize, b: usize| f64::from(agents.radius[a]) + f64::from(agents.radius[b]);
    let pairs = (0..agents.len()).flat_map(|a| (0..a).map(move |b| (a, b)));
    pairs.map(|(a, b)| place(a).distance(place(b)) / radii(a, b)).fold(f64::INFINITY, f64::min)
}

#[test]
fn all_agents_change_places_across_a_sphere() {
    for count in [2, 8, 30, 100] {
        for step in [1.0 / 60.0, 0.04, 0.1] {
            let mut world = swap(count, step);
            let mut closest = f64::INFINITY;
            run(&mut world, 60.0, |world| closest = closest.min(least(world)));
            let summary = world.summary();
            assert!(world.finished(), "{count} with {step}: {summary:?}");
            assert!(closest > 1.0 - 1e-4, "{count} with {step}: {closest}");
            assert!((summary.least_separation.min(9.0) - closest.min(9.0)).abs() < 0.5, "{summary:?} {closest}");
        }
    }
}

fn in_space(world: &World) -> Vec<(u32, [u32; 2])> {
    let agents = world.relative_columns();
    let bits =
        |row: usize| (agents.number[row], [agents.altitude[row].to_bits(), agents.vertical_velocity[row].to_bits()]);
    let mut all: Vec<_> = (0..agents.len()).map(bits).collect();
    all.sort_unstable();
    all
}

#[test]
fn any_number_of_threads_gives_the_same_bits_in_space() {
    let fly = || {
        let mut world = swap(150, 0.05);
        run_for(&mut world, 6.0, |_| {});
        (world.state_hash(), bits(&world), in_space(&world))
    };
    let one = with_threads(1, fly);
    for threads in [2, 3] {
        assert!(one == with_threads(threads, fly), "{threads} threads");
    }
}

#[test]
fn a_saved_flight_goes_on_with_the_same_bits() {
    let mut world = swap(30, 0.05);
    run_for(&mut world, 2.0, |_| {});
    let mut again = swap(30, 0.05);
    again.load(&world.save()).unwrap();
    for world in [&mut world, &mut again] {
        run_for(world, 2.0, |_| {});
    }
    assert_eq!((world.state_hash(), in_space(&world)), (again.state_hash(), in_space(&again)));
}

#[test]
fn the_state_hash_knows_altitudes() {
    let hash = |altitude: f32| {
        let mut world = world(0.05, DVec2::ZERO);
        world.add_agent(Agent::at([0.0, 0.0, altitude.into()])).unwrap();
        world.state_hash()
    };
    assert!(hash(0.0) != hash(1.0) && hash(1.0) != hash(2.0));
}

/// Crossing walkers, optionally with drones above them that fly with the wind.
fn under(drones_too: bool) -> World {
    let mut world = with_settings(0.05, SubSteps::Fixed(3), DVec2::ZERO);
    let group = drones(&mut world);
    for k in 0..24 {
        let (side, y) = (if k % 2 == 0 { 1.0 } else { -1.0 }, f64::from(k / 2) * 0.7);
        let journey = journey_to(&mut world, DVec2::new(5.0 * side, y));
        let position = DVec2::new(-5.0 * side, y + 0.1 * side);
        world
            .add_agent(Agent { position: position.extend(0.0), journey, number: Some(k), ..Agent::default() })
            .unwrap();
    }
    for k in 0..if drones_too { 20 } else { 0 } {
        let (from, height) = (f64::from(k) * 0.4, 0.5 + f64::from(k % 5));
        let agent = fly(&mut world, group, DVec3::new(from - 4.0, -3.0, height), DVec3::new(4.0 - from, 10.0, height));
        world.add_agent(Agent { radius: 0.15, number: Some(100 + k as u32), ..agent }).unwrap();
    }
    world
}

#[test]
fn agents_below_drones_walk_on_with_the_same_bits() {
    let (mut alone, mut both) = (under(false), under(true));
    for _ in 0..300 {
        alone.step();
        both.step();
        let walkers: Vec<_> = bits(&both).into_iter().filter(|bits| bits[0] < 100).collect();
        assert_eq!(walkers, bits(&alone));
        assert!(least(&both) > 1.0 - 1e-4);
    }
    assert!(alone.finished());
}

#[test]
fn on_the_ground_a_model_of_space_walks() {
    let mut world = world(0.05, DVec2::ZERO);
    let group = drones(&mut world);
    for k in 0..16 {
        let along = DVec2::from_angle(f64::from(k) / 16.0 * std::f64::consts::TAU) * 6.0;
        let journey = journey_to(&mut world, -along);
        world.add_agent(Agent { position: along.extend(0.0), journey, group, ..Agent::default() }).unwrap();
    }
    run(&mut world, 40.0, |world| {
        assert!(
            [&world.relative_columns().altitude, &world.relative_columns().vertical_velocity]
                .into_iter()
                .all(|z| z.uniform() == Some(0.0))
        );
        assert!(least(world) > 1.0 - 1e-4);
    });
    assert!(world.finished(), "{:?}", world.summary());
}

#[test]
fn flying_agents_land_rise_and_keep_their_altitude_on_the_way_to_a_goal_on_the_ground() {
    let mut world = world(0.05, DVec2::ZERO);
    let group = drones(&mut world);
    let lands = fly(&mut world, group, DVec3::new(0.0, 0.0, 6.0), DVec3::new(4.0, 0.0, 0.0));
    let rises = fly(&mut world, group, DVec3::new(0.0, 5.0, 0.0), DVec3::new(0.0, 5.0, 4.0));
    let journey = journey_to(&mut world, DVec2::new(4.0, -5.0));
    let keeps = Agent { position: DVec2::new(0.0, -5.0).extend(3.0), journey, ..lands.clone() };
    for agent in [lands, rises, keeps] {
        world.add_agent(agent).unwrap();
    }
    let mut slopes = Vec::new();
    run(&mut world, 30.0, |world| {
        let agents = world.relative_columns();
        slopes.push((agents.altitude[0] - 6.0 + agents.position[0].x * 1.5).abs());
    });
    assert!(world.finished());
    let agents = world.relative_columns();
    assert!(agents.altitude[0] <= 0.1 && (agents.altitude[1] - 4.0).abs() <= 0.1, "{:?}", agents.altitude);
    assert_eq!(agents.altitude[2], 3.0);
    assert!(slopes.iter().all(|&off| off < 0.6), "both parts of the way come to an end together: {slopes:?}");
    let summary = world.summary();
    assert!(summary.path_ratio < 1.1, "{summary:?}");
}

#[test]
fn walls_and_oblong_bodies_stand_upright_without_end() {
    let mut world = world(0.05, DVec2::ZERO);
    let group = drones(&mut world);
    world.add_obstacle(Obstacle::Wall { points: vec![DVec2::new(0.0, -3.0), DVec2::new(0.0, 3.0)] }).unwrap();
    let car = Agent::at(DVec2::new(2.0, 3.5)).with_body(Body::rectangle(2.0, 1.0));
    world.add_agent(car).unwrap();
    let drone = fly(&mut world, group, DVec3::new(-3.0, 0.0, 5.0), DVec3::new(3.0, 0.0, 8.0));
    world.add_agent(drone).unwrap();
    let mut side = 0.0f32;
    run(&mut world, 40.0, |world| {
        let agents = world.relative_columns();
        let at = agents.position[1];
        let to_car = agents.offset_in_space(0, 1).length() / (agents.radius[0] + agents.radius[1]);
        let to_wall = (at - Vec2::new(0.0, at.y.clamp(-3.0, 3.0))).length();
        assert!(to_wall >= 0.25 * 0.9999 && to_car >= 0.9999);
        side = side.max(at.y.abs());
    });
    assert!(world.finished() && side > 3.2, "{side}");
}

#[test]
fn an_agent_pushed_off_its_point_in_the_air_comes_back() {
    let mut world = world(0.05, DVec2::ZERO);
    let group = drones(&mut world);
    let at = DVec3::new(0.0, 0.0, 5.0);
    let rests = fly(&mut world, group, at + DVec3::Z * 0.5, at);
    let rests = world.add_agent(rests).unwrap();
    run(&mut world, 10.0, |_| {});
    let passes = fly(&mut world, group, DVec3::new(-0.05, -4.0, 5.05), DVec3::new(0.1, 4.0, 4.95));
    world.add_agent(Agent { priority: 1.0, ..passes }).unwrap();
    let mut pushed = 0.0f64;
    let place = |world: &World| {
        let row = world.row(rests).unwrap();
        world.relative_columns().position[row].as_dvec2().extend(world.relative_columns().altitude[row].into())
    };
    run_for(&mut world, 15.0, |world| pushed = pushed.max(place(world).distance(at)));
    assert!(pushed > 0.15 && place(&world).distance(at) <= 0.12, "{pushed} {}", place(&world).distance(at));
    assert!(world.relative_columns().status.iter().all(|&status| status == Status::Arrived));
}

#[test]
fn an_agent_among_standing_agents_takes_off() {
    let mut world = world(0.05, DVec2::ZERO);
    let journey = journey_into(&mut world, Goal::Air { at: DVec3::new(0.0, 0.0, 6.0), tolerance: 0.2 });
    let flier = world.add_agent(Agent { journey, ..Agent::default() }).unwrap();
    for k in 0..30 {
        world.add_agent(Agent::at(DVec2::new(3.0 + f64::from(k), 1.0))).unwrap();
    }
    let arrived = (0..1200).any(|_| {
        world.step();
        world.relative_columns().status[world.row(flier).unwrap()] == Status::Arrived
    });
    assert!(arrived, "it is {} m high", world.relative_columns().altitude[world.row(flier).unwrap()]);
}
