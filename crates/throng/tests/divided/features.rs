//! What a division must carry, one feature at a time.

use crate::common::{journey_to, rectangle, with_settings};
use crate::cuts::{across, random_cuts};
use crate::draw::Draw;
use crate::{Part, Work, compare};
use glam::{DVec2, Vec2, Vec3};
use std::sync::Arc;
use throng::agent::Guidance;
use throng::field::{Adaptive, Field, Governed, Interaction};
use throng::{Agent, Error, Goal, Group, GroupId, Obstacle, SubSteps, Walkable, World};

/// A world with a group that can be divided.
fn plain(step: f64) -> (World, GroupId) {
    let mut world = with_settings(step, SubSteps::Auto, DVec2::ZERO);
    let group = Group { neighbour_distance: 3.0, ..Group::default() };
    let group = world.add_group(group).unwrap();
    (world, group)
}

fn assert_same(world: World, places: &[f32], steps: u64) -> Work {
    compare(world, |_| across(places), steps, |_, _| ()).unwrap_or_else(|why| panic!("{why}"))
}

/// Walls around a rectangle, and a wall across it with a door at y = 0.
fn rooms(world: &mut World, size: DVec2, walls: &[f64], door: f64) {
    let outer = rectangle(DVec2::ZERO, size);
    world.set_walkable(vec![Walkable { outer, holes: vec![] }]).unwrap();
    for &x in walls {
        for side in [-1.0, 1.0] {
            let points = vec![DVec2::new(x, side * 0.5 * size.y), DVec2::new(x, side * 0.5 * door)];
            world.add_obstacle(Obstacle::Wall { points }).unwrap();
        }
    }
}

/// A route leads through worlds in which no agent has ever planned a path.
#[test]
fn a_route_goes_on_in_a_world_without_agents() {
    let (mut world, group) = plain(0.1);
    rooms(&mut world, DVec2::new(40.0, 10.0), &[-6.0, 0.0, 6.0], 1.2);
    for y in [-3.0, 0.0, 3.0] {
        let agent = Agent::at([-18.0, y]).goal([18.0, -y]).group(group);
        world.add_agent(agent).unwrap();
    }
    let work = assert_same(world, &[-12.0, -6.0, -1.0, 3.0, 10.0], 400);
    assert_eq!(work.migrants, 15, "each agent walks through all worlds");
}

/// The least radius of all bodies decides which bodies are in a pile.
#[test]
fn a_small_agent_far_away_matters_to_a_pile() {
    let (mut world, group) = plain(0.1);
    let mut draw = Draw::new(3);
    for _ in 0..60 {
        let at = draw.point(DVec2::splat(-0.5), DVec2::splat(0.5));
        world.add_agent(Agent::at(at).goal(at * 20.0).radius(0.25).group(group)).unwrap();
    }
    world.add_agent(Agent::at([300.0, 0.0]).goal([290.0, 0.0]).radius(0.02).group(group)).unwrap();
    assert_same(world, &[0.1, 150.0], 80);
}

/// A crowd gathers at a point on a border: arrivals in all worlds count.
#[test]
fn a_crowd_gathers_on_a_border() {
    let (mut world, group) = plain(0.1);
    let journey = journey_to(&mut world, DVec2::new(0.05, 0.0));
    let mut draw = Draw::new(5);
    for _ in 0..60 {
        let at = draw.point(DVec2::splat(-9.0), DVec2::splat(9.0));
        world.add_agent(Agent { journey, group, ..Agent::at(at) }).unwrap();
    }
    assert_same(world, &[-0.3, 0.0], 300);
}

/// Far from the origin positions are rounded, and what rounding takes goes from world to world. Agents cross the coordinate
/// from which it counts.
#[test]
fn a_crowd_crosses_a_border_far_from_the_origin() {
    for center in [DVec2::new(4096.0, -300.0), DVec2::new(-15_000.0, 19_000.0)] {
        let (mut world, group) = plain(0.1);
        let mut draw = Draw::new(8);
        for _ in 0..60 {
            let at = draw.point(DVec2::splat(-9.0), DVec2::splat(9.0));
            world.add_agent(Agent::at(center + at).goal(center - at).speed(0.4).group(group)).unwrap();
        }
        let x = center.x as f32;
        let work = assert_same(world, &[x - 1.5, x, x + 2.5], 300);
        assert!(work.migrants > 100, "{} migrants", work.migrants);
    }
}

/// Clamping spreads through a crush on both sides of a border for more rounds than a batch has.
#[test]
fn a_crush_leaves_through_a_door_on_a_border() {
    let (mut world, group) = plain(0.25);
    rooms(&mut world, DVec2::new(16.0, 8.0), &[2.0], 1.0);
    let corners = rectangle(DVec2::new(7.0, 0.0), DVec2::new(1.0, 6.0));
    let journey = journey_to(&mut world, Goal::Exit { corners });
    for k in 0..220 {
        let at = DVec2::new(-7.6 + 0.42 * f64::from(k % 22), -3.6 + 0.74 * f64::from(k / 22));
        // some places are too near to the wall
        let _ = world.add_agent(Agent { journey, group, ..Agent::at(at).radius(0.2) });
    }
    assert_same(world, &[-3.0, 0.5, 1.5], 200);
}

/// A door closes and opens while agents are on their way, in all worlds at once.
#[test]
fn a_door_closes_and_opens() {
    let (mut world, group) = plain(0.1);
    rooms(&mut world, DVec2::new(24.0, 8.0), &[0.0], 1.4);
    for k in 0..24 {
        let at = [-10.0 + 0.8 * f64::from(k % 8), -2.0 + 2.0 * f64::from(k / 8)];
        world.add_agent(Agent::at(at).goal([10.0, at[1]]).group(group)).unwrap();
    }
    let door = || Obstacle::Wall { points: vec![DVec2::new(0.0, -0.7), DVec2::new(0.0, 0.7)] };
    let add = |step: u64, part: Part<'_>| {
        let id = |part: &World| part.find_obstacle(&door());
        match (step, part) {
            (30, Part::Whole(world)) => _ = world.add_obstacle(door()).unwrap(),
            (30, Part::Divided(part)) => _ = part.add_obstacle(door()).unwrap(),
            (90, Part::Whole(world)) => assert!(world.remove_obstacle(id(world).unwrap())),
            (90, Part::Divided(part)) => assert!(part.remove_obstacle(id(part.world()).unwrap())),
            _ => {}
        }
    };
    let work = compare(world, |_| across(&[-4.0, 0.5, 5.0]), 300, add).unwrap();
    assert!(work.migrants > 40, "{work:?}");
}

/// An obstacle that stands on an agent of one world is refused by all.
#[test]
fn an_obstacle_on_an_agent_is_refused_by_all_worlds() {
    let (mut world, group) = plain(0.1);
    rooms(&mut world, DVec2::new(24.0, 8.0), &[], 1.4);
    world.add_agent(Agent::at([-5.0, 0.0]).group(group)).unwrap();
    let add = |step: u64, part: Part<'_>| {
        let on_agent = Obstacle::Circle { center: DVec2::new(-5.0, 0.0), radius: 0.5 };
        if step == 1
            && let Part::Divided(part) = part
        {
            let owns = part.world().agents().len() == 1;
            let why = part.add_obstacle(on_agent).unwrap_err().to_string();
            let expected = if owns { "it is inside an obstacle" } else { "another world has refused the obstacle" };
            assert!(why.contains(expected), "{why}");
        }
    };
    compare(world, |_| across(&[-1.0, 1.0]), 5, add).unwrap();
}

/// Agents enter one after the other at places on a border that other agents still occupy.
#[test]
fn agents_enter_where_other_worlds_have_agents() {
    let (mut world, group) = plain(0.1);
    for k in 0..120 {
        let at = [0.2 * f64::from(k % 5) - 0.4, 0.3 * f64::from(k % 3)];
        let agent = Agent::at(at).goal([if k % 2 == 0 { -15.0 } else { 15.0 }, 0.0]).group(group);
        world.schedule_agent(0.05 * f64::from(k), agent).unwrap();
    }
    assert_same(world, &[-0.25, 0.0, 0.1], 250);
}

/// A field follows agents within a reach that is greater than the neighbour distance.
#[test]
fn a_field_follows_agents_of_other_worlds() {
    let (mut world, leaders) = plain(0.1);
    let mut governed = Governed::new(|_: Vec3, _: f64| Vec3::ZERO, 0.8);
    let towards = |place: Vec3, _: f64| -place.normalize_or_zero();
    governed.around.push(Interaction { reach: 12.0, ..Interaction::new(leaders.index(), towards) });
    let guidance = Guidance::JOURNEY.governed(governed);
    let followers = world.add_group(Group { guidance, neighbour_distance: 2.0, ..Group::default() }).unwrap();
    world.add_agent(Agent::at([-10.0, 0.0]).goal([20.0, 5.0]).group(leaders)).unwrap();
    let mut draw = Draw::new(8);
    for _ in 0..40 {
        let at = draw.point(DVec2::splat(-12.0), DVec2::splat(12.0));
        world.add_agent(Agent::at(at).group(followers)).unwrap();
    }
    assert_same(world, &[-6.0, 0.0, 6.0], 150);
}

/// Large crowds sort their rows from time to time.
#[test]
fn a_large_crowd_sorts_its_rows() {
    let (mut world, group) = plain(0.1);
    let journeys: Vec<_> = (0..8).map(|k| journey_to(&mut world, DVec2::from_angle(f64::from(k)) * 90.0)).collect();
    for k in 0..6000u32 {
        let mixed = k * 7919 % 6000;
        let at = DVec2::new(f64::from(mixed % 77), f64::from(mixed / 77)) * 1.5 - DVec2::splat(58.0);
        let journey = journeys[mixed as usize % 8];
        world.add_agent(Agent { group, journey, ..Agent::at(at) }).unwrap();
    }
    let cuts = |step: u64| {
        let mut draw = Draw::new(step / 10);
        random_cuts(&mut draw, 3, Vec2::splat(-5.0), Vec2::splat(5.0))
    };
    let work = compare(world, cuts, 34, |_, _| ()).unwrap();
    assert!(work.migrants > 100, "{work:?}");
}

/// Agents that meet in narrow passages agree which of them step aside, in several worlds.
#[test]
fn standoffs_on_both_sides_of_a_border() {
    let (mut world, group) = plain(0.1);
    let outer = rectangle(DVec2::ZERO, DVec2::new(40.0, 30.0));
    world.set_walkable(vec![Walkable { outer, holes: vec![] }]).unwrap();
    let mut draw = Draw::new(4);
    // a wall with three passages, each wide enough for one agent
    let ends = [-15.0, -8.2, -7.8, -0.2, 0.2, 7.8, 8.2, 15.0];
    for pair in ends.chunks(2) {
        let corners = [(-2.0, pair[0]), (2.0, pair[0]), (2.0, pair[1]), (-2.0, pair[1])].map(DVec2::from);
        world.add_obstacle(Obstacle::Polygon { corners: corners.to_vec() }).unwrap();
    }
    for k in 0..54 {
        let side = if k % 2 == 0 { 1.0 } else { -1.0 };
        let lane = 8.0 * f64::from(k % 3 - 1);
        let at = DVec2::new(side * draw.between(2.5, 14.0), lane + draw.between(-3.0, 3.0));
        let goal = DVec2::new(-side * draw.between(6.0, 14.0), lane + draw.between(-3.0, 3.0));
        world.add_agent(Agent::at(at).goal(goal).radius(0.14).group(group)).unwrap();
    }
    let mut alone = world.clone();
    (0..300).for_each(|_| alone.step());
    assert!(alone.summary().standoffs > 5, "{:?}", alone.summary());
    assert_same(world, &[-3.0, -0.5, 1.0], 300);
}

/// Random passages, each too narrow for two, in three places so far from each other that their standoffs do not depend on each
/// other. The cuts change often, so that agreements are made by other worlds than those of the agents.
#[test]
fn standoffs_in_random_passages() {
    let mut standoffs = 0;
    for seed in 0..6 {
        let mut draw = Draw::new(100 + seed);
        let (mut world, group) = plain(0.1);
        let turn = DVec2::from_angle(draw.between(0.0, 6.3));
        let middles = [-130.0, 0.0, 130.0].map(|x| turn.rotate(DVec2::new(x, 0.0)));
        let outer = rectangle(DVec2::ZERO, DVec2::splat(400.0));
        world.set_walkable(vec![Walkable { outer, holes: vec![] }]).unwrap();
        for middle in middles {
            let place = |x: f64, y: f64| middle + turn.rotate(DVec2::new(x, y));
            let (radius, thick) = (draw.between(0.13, 0.22), draw.between(0.6, 4.0));
            let (lanes, width) = (1 + draw.index(3), radius * draw.between(2.3, 3.2));
            let lane = |k: usize| 5.0 * (k as f64 - 0.5 * (lanes - 1) as f64);
            let mut ends = vec![-14.0];
            ends.extend((0..lanes).flat_map(|k| [lane(k) - 0.5 * width, lane(k) + 0.5 * width]));
            ends.push(14.0);
            for pair in ends.chunks(2) {
                let corners = [(-thick, pair[0]), (thick, pair[0]), (thick, pair[1]), (-thick, pair[1])];
                let corners = corners.map(|(x, y)| place(0.5 * x, y)).to_vec();
                world.add_obstacle(Obstacle::Polygon { corners }).unwrap();
            }
            for k in 0..8 * lanes {
                let side = if k % 2 == 0 { 1.0 } else { -1.0 };
                let from = 0.5 * thick + 1.0 + 0.6 * (k / (2 * lanes)) as f64;
                let along = lane(k / 2 % lanes);
                let (at, to) = (place(side * from, along), place(-side * draw.between(4.0, 9.0), along));
                world.add_agent(Agent::at(at).goal(to).radius(radius as f32).group(group)).unwrap();
            }
        }
        let mut alone = world.clone();
        (0..200).for_each(|_| alone.step());
        standoffs += alone.summary().standoffs;
        let worlds = 2 + draw.index(6);
        let cuts = |step: u64| {
            let mut draw = Draw::new(1000 * seed + step / 7);
            let middle = middles[draw.index(3)].as_vec2();
            random_cuts(&mut draw, worlds, middle - 4.0, middle + 4.0)
        };
        compare(world, cuts, 200, |_, _| ()).unwrap_or_else(|why| panic!("seed {seed}: {why}"));
    }
    assert!(standoffs > 30, "{standoffs}");
}

/// A field that leads to the place where the agents were on average.
#[derive(Clone)]
struct ToMiddle(Vec2);

impl Field for ToMiddle {
    fn velocity(&self, place: Vec3, _: f64) -> Vec3 {
        (self.0.extend(0.0) - place).normalize_or_zero()
    }

    fn adaptive(&self) -> Option<&dyn Adaptive> {
        Some(self)
    }
}

impl Adaptive for ToMiddle {
    fn check(&self) -> Result<(), Error> {
        Ok(())
    }

    fn interval(&self) -> f64 {
        0.5
    }

    fn memory(&self) -> Vec<f32> {
        vec![0.0; 2]
    }

    fn notice(&self, memory: &mut [f32], people: &[Vec2]) {
        // the sum depends on the order of the agents
        let middle = people.iter().fold(Vec2::ZERO, |sum, &at| sum * 0.99 + at) * 0.01;
        memory.copy_from_slice(&middle.to_array());
    }

    fn adapted(&self, memory: &[f32]) -> Arc<dyn Field> {
        Arc::new(Self(Vec2::from_slice(memory)))
    }
}

/// A field adapts to the positions of the agents of all worlds.
#[test]
fn a_field_adapts_to_all_agents() {
    let (mut world, _) = plain(0.1);
    let guidance = Guidance::JOURNEY.governed(Governed::new(ToMiddle(Vec2::ZERO), 0.7));
    let group = world.add_group(Group { guidance, ..Group::default() }).unwrap();
    let journey = journey_to(&mut world, DVec2::new(30.0, 0.0));
    let mut draw = Draw::new(12);
    for _ in 0..80 {
        let at = draw.point(DVec2::splat(-12.0), DVec2::splat(12.0));
        world.add_agent(Agent { journey, group, ..Agent::at(at) }).unwrap();
    }
    assert_same(world, &[-6.0, 0.0, 6.0], 100);
}

/// Agents walk off the ground on which paths were planned, and obstacles come, without a walkable area.
#[test]
fn the_ground_of_paths_grows_with_the_crowd() {
    let (mut world, group) = plain(0.1);
    world.add_obstacle(Obstacle::Circle { center: DVec2::new(1.0, 0.3), radius: 1.0 }).unwrap();
    for k in 0..30 {
        let at = DVec2::new(-4.0 + f64::from(k % 6), -2.0 + f64::from(k / 6));
        // the last agents enter far away, off the ground of the first paths
        let far = DVec2::new(if k % 2 == 0 { 60.0 } else { -50.0 }, 3.0 * f64::from(k));
        if world.add_agent(Agent::at(at).goal(at * -2.0).group(group)).is_err() {
            continue;
        }
        let entering = Agent::at(at + far).goal(at * 3.0).group(group);
        world.schedule_agent(1.0 + 0.3 * f64::from(k), entering).unwrap();
    }
    let wall = || Obstacle::Wall { points: vec![DVec2::new(9.0, -3.0), DVec2::new(9.0, 3.0)] };
    let add = |step: u64, part: Part<'_>| match (step, part) {
        (40, Part::Whole(world)) => _ = world.add_obstacle(wall()).unwrap(),
        (40, Part::Divided(part)) => _ = part.add_obstacle(wall()).unwrap(),
        _ => {}
    };
    compare(world, |_| across(&[-20.0, 0.0, 4.0, 30.0]), 200, add).unwrap();
}
