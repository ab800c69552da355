//! Worlds to which only a part of the crowd has been added.

use crate::Snapshot;
use crate::common::{journey_to, rectangle, with_settings};
use crate::cuts::across;
use crate::draw::Draw;
use crate::threads::{Threads, halos};
use glam::{DVec2, Vec3};
use std::thread;
use throng::halo::DividedWorld;
use throng::motion::WrapAround;
use throng::{Agent, Error, Group, JourneyId, Obstacle, SubSteps, Walkable, World};

const WORLDS: usize = 3;

/// A world with walls and journeys, without agents.
fn place() -> (World, Vec<JourneyId>) {
    let mut world = with_settings(0.1, SubSteps::Auto, DVec2::new(40.0, 5.0));
    let middle = world.settings().origin;
    let outer = rectangle(middle, DVec2::splat(40.0));
    world.set_walkable(vec![Walkable { outer, holes: vec![] }]).unwrap();
    world.add_obstacle(Obstacle::Circle { center: middle, radius: 2.0 }).unwrap();
    let journeys = (0..6).map(|k| journey_to(&mut world, middle + DVec2::from_angle(f64::from(k)) * 15.0)).collect();
    world.add_group(Group { name: "walkers".into(), neighbour_distance: 3.0, ..Group::default() }).unwrap();
    (world, journeys)
}

/// The world of the agents with these numbers. Some agents are scheduled in every world.
fn crowd(has: impl Fn(u32) -> bool) -> World {
    let (mut world, journeys) = place();
    let group = world.group_named("walkers").unwrap();
    let mut draw = Draw::new(9);
    for number in 0..150 {
        let journey = draw.one_of(&journeys);
        let at = world.settings().origin + draw.point(DVec2::splat(-14.0), DVec2::splat(14.0));
        let agent = Agent { number: Some(number), journey, group, ..Agent::at(at) };
        // places in the obstacle are refused
        if number % 10 == 0 {
            let _ = world.schedule_agent(draw.between(0.0, 3.0), agent);
        } else if has(number) {
            let _ = world.add_agent(agent);
        }
    }
    world
}

/// Steps the worlds of a division, and returns the parts.
fn parts(worlds: Vec<World>, steps: u32) -> Vec<Result<Snapshot, Error>> {
    let halos = halos(across(&[-4.0, 3.0]));
    thread::scope(|scope| {
        let step = |(world, halo): (World, Threads)| {
            scope.spawn(move || {
                let mut part = DividedWorld::of_part(world, halo)?;
                (0..steps).for_each(|_| part.step());
                Ok::<Snapshot, Error>(Snapshot::of(part.world()))
            })
        };
        let threads: Vec<_> = worlds.into_iter().zip(halos).map(step).collect();
        threads.into_iter().map(|thread| thread.join().unwrap()).collect()
    })
}

#[test]
fn parts_in_any_world_have_the_bits_of_one_world() {
    for steps in [1, 70] {
        let mut whole = crowd(|_| true);
        (0..steps).for_each(|_| whole.step());
        let worlds = (0..WORLDS).map(|part| crowd(|number| number as usize % WORLDS == part)).collect();
        let parts = parts(worlds, steps).into_iter().map(Result::unwrap);
        let difference = Snapshot::of(&whole).sorted().difference(&Snapshot::join(parts));
        assert_eq!(difference, None, "{steps} steps");
    }
}

#[test]
fn parts_that_differ_in_their_places_are_refused() {
    let mut worlds: Vec<World> = (0..WORLDS).map(|part| crowd(|number| number as usize % WORLDS == part)).collect();
    let id = worlds[1].find_obstacle(&circle(&worlds[1])).unwrap();
    worlds[1].remove_obstacle(id);
    for part in parts(worlds, 1) {
        let why = part.unwrap_err().to_string();
        assert!(why.contains("the worlds differ in more than their agents"), "{why}");
    }
}

fn circle(world: &World) -> Obstacle {
    Obstacle::Circle { center: world.settings().origin, radius: 2.0 }
}

#[test]
fn a_part_that_cannot_be_divided_is_refused_by_all_worlds() {
    let mut worlds: Vec<World> = (0..WORLDS).map(|_| crowd(|_| false)).collect();
    for world in &mut worlds {
        world
            .add_group(Group {
                wrap_around: Some(WrapAround { center: Vec3::ZERO, radius: 90.0 }),
                name: "odd".into(),
                ..Group::default()
            })
            .unwrap();
    }
    let group = worlds[2].group_named("odd").unwrap();
    worlds[2].add_agent(Agent { number: Some(7), group, ..Agent::at([45.0, 9.0]) }).unwrap();
    let refusals: Vec<String> = parts(worlds, 1).into_iter().map(|part| part.unwrap_err().to_string()).collect();
    assert!(refusals[2].contains("group `odd`"), "{refusals:?}");
    assert!(refusals[0].contains("another world") && refusals[1].contains("another world"), "{refusals:?}");
}
