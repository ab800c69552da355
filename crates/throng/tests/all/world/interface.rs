//! The interface for programs: agents by id, goals, velocities and places from outside, events, and world coordinates.

use glam::{DVec2, DVec3, Vec3};
use proptest::prelude::*;
use throng::{Agent, AgentId, Event, EventKind, Goal, Group, Obstacle, Settings, Status, SubSteps, Walkable, World};

fn settings(origin: DVec2) -> Settings {
    Settings { step: 0.1, sub_steps: SubSteps::Fixed(2), origin, ..Settings::default() }
}

/// A scene that uses every call that takes a place, moved by an offset.
fn scene(seed: u64, offset: DVec2, origin: DVec2) -> World {
    let mut world = World::new(settings(origin)).unwrap();
    let at = |x: f64, y: f64| offset + DVec2::new(x, y);
    let corners = |low: (f64, f64), high: (f64, f64)| {
        vec![at(low.0, low.1), at(high.0, low.1), at(high.0, high.1), at(low.0, high.1)]
    };
    world.set_walkable(vec![Walkable { outer: corners((-15.0, -10.0), (15.0, 10.0)), holes: vec![] }]).unwrap();
    world.add_obstacle(Obstacle::Circle { center: at(0.0, 3.0), radius: 1.0 }).unwrap();
    world.add_obstacle(Obstacle::Polygon { corners: corners((-1.0, -4.0), (1.0, -2.0)) }).unwrap();
    world.add_obstacle(Obstacle::Wall { points: vec![at(3.0, 6.0), at(3.0, 9.0)] }).unwrap();
    let group = world.add_group(Group { name: "walkers".into(), ..Group::default() }).unwrap();
    for k in 0..6 {
        let y = f64::from(k) * 1.7 - 4.5 + (seed % 7) as f64 * 0.05;
        world.add_agent(Agent::at(at(-9.0, y)).goal(at(9.0, -y)).group(group).radius(0.2)).unwrap();
        world
            .add_agent(Agent::at(at(9.0, y)).goal(Goal::Exit { corners: corners((-14.0, -9.0), (-11.0, 9.0)) }))
            .unwrap();
    }
    world.schedule_agent(1.0, Agent::at(at(-9.0, 7.0)).goal(at(9.0, 7.0))).unwrap();
    world
}

/// Runs the scene with changes from outside; returns what the world tells, with the offset taken away.
fn run(mut world: World, offset: DVec2) -> (Vec<DVec3>, Vec<Event>, Vec<Option<DVec3>>) {
    let ids: Vec<AgentId> = world.agents().map(|agent| agent.id()).collect();
    let mut events = Vec::new();
    for step in 0..60 {
        match step {
            10 => world.set_goal(ids[0], offset + DVec2::new(-5.0, -8.0)).unwrap(),
            15 => world.set_position(ids[2], offset + DVec2::new(-12.0, 8.0)).unwrap(),
            20 => world.set_preferred_velocity(ids[4], Vec3::NEG_Y).unwrap(),
            30 => world.set_preferred_velocity(ids[4], None).unwrap(),
            _ => {}
        }
        world.step();
        events.extend_from_slice(world.events());
    }
    let positions = world.agents().map(|agent| agent.position() - offset.extend(0.0)).collect();
    let by_id = ids.iter().map(|&id| world.position(id).map(|at| at - offset.extend(0.0))).collect();
    (positions, events, by_id)
}

/// The crate's page lists every call of the world, and nothing else.
#[test]
fn the_page_of_the_crate_lists_every_call() {
    let source = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = vec![source.join("world.rs")];
    files.extend(std::fs::read_dir(source.join("world")).unwrap().map(|entry| entry.unwrap().path()));
    let mut calls = std::collections::BTreeSet::new();
    for file in files {
        let text = std::fs::read_to_string(&file).unwrap();
        let blocks = text.split("\nimpl World {").skip(1).map(|rest| rest.split("\n}").next().unwrap());
        let functions = blocks.flat_map(|block| block.split("\n    pub fn ").skip(1));
        calls.extend(
            functions.map(|rest| rest.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap().to_owned()),
        );
    }
    assert!(calls.len() > 60, "{calls:?}");
    let page = std::fs::read_to_string(source.join("lib.rs")).unwrap();
    let table = page.split("# The interface on one page").nth(1).unwrap().split("A program of its own").next().unwrap();
    let listed: std::collections::BTreeSet<String> =
        table.split("(World::").skip(1).map(|rest| rest.split(')').next().unwrap().to_owned()).collect();
    assert_eq!(listed, calls);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(8))]
    #[test]
    fn a_translated_scene_gives_the_translated_run(seed in 0u64..100) {
        let far = DVec2::new(5000.0, -3000.0);
        let here = run(scene(seed, DVec2::ZERO, DVec2::ZERO), DVec2::ZERO);
        let there = run(scene(seed, far, far), far);
        prop_assert_eq!(here.1.len(), there.1.len());
        for (a, b) in here.1.iter().zip(&there.1) {
            prop_assert_eq!((a.agent, a.number, a.kind), (b.agent, b.number, b.kind));
        }
        prop_assert_eq!(here.0.len(), there.0.len());
        for (a, b) in here.0.iter().zip(&there.0) {
            prop_assert!(a.distance(*b) < 1e-3, "{} {}", a, b);
        }
        for (a, b) in here.2.iter().zip(&there.2) {
            prop_assert!(a.zip(*b).is_none_or(|(a, b)| a.distance(b) < 1e-3) && a.is_some() == b.is_some());
        }
    }
}

#[test]
fn agents_come_in_the_order_of_their_ids_whatever_the_rows() {
    let mut world = scene(0, DVec2::ZERO, DVec2::ZERO);
    let removed = world.agents().nth(3).unwrap().id();
    for _ in 0..30 {
        world.step();
    }
    assert!(world.remove_agent(removed));
    let ids: Vec<AgentId> = world.agents().map(|agent| agent.id()).collect();
    assert!(ids.is_sorted() && !ids.contains(&removed));
    assert_eq!(world.agents().len(), world.relative_columns().len());
    let mut positions = vec![DVec3::ONE];
    world.positions_into(&mut positions);
    for (agent, &position) in world.agents().zip(&positions) {
        let row = world.row(agent.id()).unwrap();
        let columns = world.relative_columns();
        assert_eq!(agent.position(), position);
        assert_eq!(agent.position().truncate(), world.position(agent.id()).unwrap().truncate());
        assert_eq!(agent.velocity().truncate(), columns.velocity[row]);
        assert_eq!((agent.number(), agent.heading()), (columns.number[row], columns.heading[row]));
        assert_eq!(
            (agent.status(), agent.group(), agent.radius()),
            (columns.status[row], columns.group[row], columns.radius[row])
        );
        assert_eq!(agent.to_agent().number, Some(agent.number()));
    }
    assert!(world.agent(removed).is_none());
}

#[test]
fn goals_that_change_all_the_time_take_no_more_memory() {
    let mut world = World::new(settings(DVec2::ZERO)).unwrap();
    let ids: Vec<AgentId> =
        (0..20).map(|k| world.add_agent(Agent::at([0.0, f64::from(k)]).goal([9.0, f64::from(k)])).unwrap()).collect();
    for step in 0..400 {
        for (k, &id) in ids.iter().enumerate() {
            world.set_goal(id, [9.0 + 0.01 * f64::from(step), k as f64]).unwrap();
        }
        world.step();
    }
    assert!(world.goals().len() <= 250, "{} goals", world.goals().len());
    for (k, agent) in world.agents().enumerate() {
        assert_eq!(agent.goal(), Some(&Goal::Point { at: DVec2::new(9.0 + 0.01 * 399.0, k as f64), tolerance: 0.1 }));
    }
    // equal goals share one
    let before = world.goals().len();
    ids.iter().for_each(|&id| world.set_goal(id, [50.0, 50.0]).unwrap());
    assert!(world.goals().len() <= before + 1);
}

#[test]
fn a_new_goal_is_reached_also_after_an_end_and_after_loading() {
    let mut world = World::new(settings(DVec2::ZERO)).unwrap();
    let id = world.add_agent(Agent::at([0.0, 0.0]).goal([2.0, 0.0])).unwrap();
    let arrive = |world: &mut World| {
        let mut arrivals = 0;
        for _ in 0..100 {
            world.step();
            arrivals += world.events().iter().filter(|event| event.kind == EventKind::Arrived).count();
        }
        assert_eq!((arrivals, world.agent(id).unwrap().status()), (1, Status::Arrived));
    };
    arrive(&mut world);
    world.set_goal(id, [2.0, 3.0]).unwrap();
    let saved = world.save();
    arrive(&mut world);
    assert!(world.position(id).unwrap().distance(DVec2::new(2.0, 3.0).extend(0.0)) < 0.2);
    let mut other = World::new(settings(DVec2::ZERO)).unwrap();
    other.load(&saved).unwrap();
    arrive(&mut other);
    assert_eq!(other.state_hash(), world.state_hash());
}

#[test]
fn a_commanded_agent_goes_as_the_program_says_and_keeps_clear() {
    let mut world = World::new(settings(DVec2::ZERO)).unwrap();
    let driven = world.add_agent(Agent::at([0.0, 0.0])).unwrap();
    world.add_agent(Agent::at([3.0, 0.0])).unwrap();
    world.set_preferred_velocity(driven, Vec3::X * 9.0).unwrap();
    let mut fastest: f32 = 0.0;
    for _ in 0..80 {
        world.step();
        fastest = fastest.max(world.agent(driven).unwrap().velocity().length());
    }
    let agent = world.agent(driven).unwrap();
    assert!(agent.position().x > 5.0, "{}", agent.position());
    assert!(fastest > 1.5 && fastest <= 1.8 + 1e-3, "the top speed holds: {fastest}");
    assert!(world.summary().least_separation >= 0.9999);
    assert!(!world.finished());
    world.set_preferred_velocity(driven, None).unwrap();
    let at = world.position(driven).unwrap();
    (0..30).for_each(|_| world.step());
    assert!(world.position(driven).unwrap().distance(at) < 1.0 && world.finished());
}

#[test]
fn a_commanded_agent_may_rise() {
    let mut world = World::new(settings(DVec2::ZERO)).unwrap();
    let id = world.add_agent(Agent::at([0.0, 0.0, 2.0])).unwrap();
    world.set_preferred_velocity(id, Vec3::Z).unwrap();
    (0..30).for_each(|_| world.step());
    assert!(world.agent(id).unwrap().position().z > 3.0, "{}", world.agent(id).unwrap().position());
}

#[test]
fn set_positions_are_where_agents_are_and_refused_ones_change_nothing() {
    let mut world = scene(0, DVec2::ZERO, DVec2::ZERO);
    let ids: Vec<AgentId> = world.agents().map(|agent| agent.id()).collect();
    (0..5).for_each(|_| world.step());
    world.set_position(ids[1], [-3.0, -8.0]).unwrap();
    assert_eq!(world.position(ids[1]), Some(DVec3::new(-3.0, -8.0, 0.0)));
    let before = world.state_hash();
    for wrong in [[0.0, 3.0], [40.0, 0.0], [f64::NAN, 0.0], [1e9, 0.0]] {
        assert!(world.set_position(ids[1], wrong).is_err(), "{wrong:?}");
    }
    assert!(world.set_goal(ids[1], [f64::INFINITY, 0.0]).is_err());
    assert!(world.set_preferred_velocity(ids[1], Vec3::splat(f32::NAN)).is_err());
    assert_eq!(world.state_hash(), before);
    world.remove_agent(ids[1]);
    assert!(world.set_position(ids[1], [0.0, 0.0]).is_err() && world.set_goal(ids[1], [0.0, 0.0]).is_err());
    assert!(world.set_user_data(ids[1], 1).is_err() && world.set_preferred_velocity(ids[1], None).is_err());
}

#[test]
fn events_tell_of_entries_exits_and_new_routes() {
    let mut world = scene(0, DVec2::ZERO, DVec2::ZERO);
    let obstacle = world.add_obstacle(Obstacle::Circle { center: DVec2::new(13.0, -9.0), radius: 0.3 }).unwrap();
    let mut kinds = Vec::new();
    for step in 0..200 {
        if step == 20 {
            world.move_obstacle(obstacle, DVec2::X).unwrap();
        }
        world.step();
        let order = |event: &Event| (event.time.to_bits(), event.number, event.kind);
        assert!(world.events().is_sorted_by_key(order));
        kinds.extend(world.events().iter().map(|event| event.kind));
    }
    let count = |kind: EventKind| kinds.iter().filter(|&&other| other == kind).count();
    assert_eq!((count(EventKind::Entered), count(EventKind::Left)), (1, 6));
    assert!(count(EventKind::Replanned) >= 7, "{kinds:?}");
    assert_eq!(count(EventKind::Arrived), 13, "six leave, seven stay: {kinds:?}");
    assert_eq!(count(EventKind::Stranded), 0);
}

#[test]
fn goals_behind_walls_are_told() {
    let mut world = World::new(settings(DVec2::ZERO)).unwrap();
    let ring = [[4.0, -1.0], [6.0, -1.0], [6.0, 1.0], [4.0, 1.0], [4.0, -1.0]].map(DVec2::from);
    let cage = world.add_obstacle(Obstacle::Wall { points: ring.to_vec() }).unwrap();
    let id = world.add_agent(Agent::at([0.0, 0.0]).goal([5.0, 0.0]).user_data(77)).unwrap();
    world.step();
    let kinds: Vec<(AgentId, EventKind)> = world.events().iter().map(|event| (event.agent, event.kind)).collect();
    assert_eq!(kinds, [(id, EventKind::Stranded)]);
    assert_eq!(world.agent(id).unwrap().user_data(), 77);
    // the obstacle moves away
    world.set_obstacle(cage, Obstacle::Circle { center: DVec2::new(20.0, 20.0), radius: 1.0 }).unwrap();
    (0..200).for_each(|_| world.step());
    assert_eq!(world.agent(id).unwrap().status(), Status::Arrived);
}

#[test]
fn a_copied_agent_keeps_its_goal() {
    let mut world = World::new(settings(DVec2::ZERO)).unwrap();
    let id = world.add_agent(Agent::at([0.0, 0.0]).goal([3.0, 0.0])).unwrap();
    let copy = world.agent(id).unwrap().to_agent();
    assert!(world.remove_agent(id));
    let other = world.add_agent(Agent::at([0.0, 5.0])).unwrap();
    // the journey of the removed agent is used again
    (0..300).for_each(|k| world.set_goal(other, [f64::from(k), 9.0]).unwrap());
    let again = world.add_agent(Agent { number: None, ..copy }).unwrap();
    assert_eq!(world.agent(again).unwrap().goal(), Some(&Goal::from(DVec2::new(3.0, 0.0))));
    assert_eq!(world.agent(other).unwrap().goal(), Some(&Goal::from(DVec2::new(299.0, 9.0))));
}

#[test]
fn positions_from_outside_keep_routes_that_lead_on() {
    let mut world = scene(0, DVec2::ZERO, DVec2::ZERO);
    let mut replanned = 0;
    for _ in 0..100 {
        world.step();
        replanned += world.events().iter().filter(|event| event.kind == EventKind::Replanned).count();
        let moved: Vec<_> = world.agents().map(|agent| (agent.id(), agent.position())).collect();
        for (id, at) in moved {
            world.set_position(id, at + DVec3::Y * 1e-4).unwrap_or_default();
        }
    }
    assert!(replanned < 20, "{replanned} new routes");
}

#[test]
fn a_stranded_agent_that_is_moved_out_goes_to_its_goal() {
    let mut world = World::new(settings(DVec2::ZERO)).unwrap();
    let ring = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]].map(DVec2::from);
    world.add_obstacle(Obstacle::Wall { points: ring.to_vec() }).unwrap();
    let id = world.add_agent(Agent::at([0.0, 0.0]).goal([5.0, 0.0])).unwrap();
    world.step();
    assert_eq!((world.agent(id).unwrap().status(), world.stranded().len()), (Status::Stranded, 1));
    world.set_position(id, [2.0, 0.0]).unwrap();
    (0..100).for_each(|_| world.step());
    assert_eq!((world.agent(id).unwrap().status(), world.stranded().len()), (Status::Arrived, 0));
}

#[test]
fn the_first_example_is_short_and_is_the_readmes() {
    let hello = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/hello.rs"));
    assert!(hello.lines().count() <= 25);
    assert!(
        include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../README.md")).contains(hello),
        "README.md shows examples/hello.rs"
    );
}
