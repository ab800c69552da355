//! Behaviours and vehicles in a division: flocks, leaders, formations, pursuit.

use crate::common::{journey_to, rectangle, with_settings};
use crate::cuts::across;
use crate::draw::Draw;
use crate::{Part, Work, compare};
use glam::{DVec2, DVec3};
use proptest::prelude::*;
use std::sync::Arc;
use throng::agent::Guidance;
use throng::avoid::NoAvoidance;
use throng::motion::{Locomotion, Vehicle};
use throng::steer::{Behaviour, BoxedBehaviour, GroupFilter, SteeringInput, Target, TraceRecorder};
use throng::{Agent, Body, Goal, Group, GroupId, SubSteps, World};
use throng_steer::{
    Alignment, Boids, Cohesion, Fear, Flocking, FollowLeader, KeepFormation, Pattern, Priority, Pursue, Separation,
    Wander,
};

fn empty() -> World {
    with_settings(0.1, SubSteps::Auto, DVec2::new(30.0, -7.0))
}

/// A group steered by a behaviour, without avoidance and guard.
fn steered(behaviour: impl Into<BoxedBehaviour>) -> Group {
    let behaviour = Some(behaviour.into());
    Group {
        guidance: Guidance { behaviour, field: None },
        model: Arc::new(NoAvoidance),
        guard: false,
        ..Group::default()
    }
}

/// A flock: its agents see all others within a distance.
fn flock(behaviour: impl Into<BoxedBehaviour>, range: f32) -> Group {
    Group { neighbours: Group::ALL_NEIGHBOURS, neighbour_distance: range, ..steered(behaviour) }
}

fn bird(locomotion: Locomotion) -> Vehicle {
    Vehicle { locomotion, max_speed: 6.0, max_force: 12.0, ..Vehicle::default() }
}

fn add_birds(world: &mut World, group: GroupId, count: usize, size: DVec3, draw: &mut Draw) {
    let middle = world.settings().origin.extend(3.0);
    for _ in 0..count {
        let part = |draw: &mut Draw| draw.between(-0.5, 0.5);
        let at = middle + size * DVec3::new(part(draw), part(draw), part(draw));
        let velocity = draw.point(-DVec2::ONE, DVec2::ONE).as_vec2() * 4.0;
        let motor = bird(draw.one_of(&[Locomotion::Level, Locomotion::Banking])).into();
        world.add_agent(Agent { velocity, motor, group, ..Agent::at(at) }).unwrap();
    }
}

fn assert_same(world: World, places: &[f32], steps: u64) -> Work {
    compare(world, |_| across(places), steps, |_, _| ()).unwrap_or_else(|why| panic!("{why}"))
}

/// Sums over the birds that an agent sees run in the order of cells, which are those of all birds.
#[test]
fn a_flock_over_several_worlds() {
    for (seed, guard) in [(1, false), (2, true)] {
        let (mut world, mut draw) = (empty(), Draw::new(seed));
        let group = world.add_group(Group { guard, ..flock(Flocking::default(), 6.0) }).unwrap();
        add_birds(&mut world, group, 300, DVec3::new(40.0, 30.0, 5.0), &mut draw);
        let work = assert_same(world, &[-14.0, -3.0, 0.0, 8.0], 120);
        assert!(work.migrants > 200, "{work:?}");
    }
}

/// Two flocks with different ranges, one of them in one world only, and walkers beside them.
#[test]
fn flocks_beside_walkers() {
    let (mut world, mut draw) = (empty(), Draw::new(3));
    let near = world.add_group(flock(Flocking::default(), 4.0)).unwrap();
    let boids = world.add_group(flock(Boids { migration: Some(Target::Agent(0)), ..Boids::default() }, 9.0)).unwrap();
    let walkers = world.add_group(Group { neighbour_distance: 3.0, ..Group::default() }).unwrap();
    let middle = world.settings().origin;
    for _ in 0..30 {
        let at = draw.point(DVec2::splat(-15.0), DVec2::splat(15.0));
        let _ = world.add_agent(Agent::at(middle + at).goal(middle - at).group(walkers));
    }
    add_birds(&mut world, boids, 60, DVec3::new(30.0, 30.0, 4.0), &mut draw);
    add_birds(&mut world, near, 12, DVec3::new(3.0, 3.0, 2.0), &mut draw);
    assert_same(world, &[-10.0, 5.0, 12.0], 150);
}

/// Leader, file and wedge, with the leader worlds away. The leader leaves, and an agent enters between the others.
#[test]
fn leaders_and_formations_far_away() {
    let mut world = empty();
    let middle = world.settings().origin;
    let corners = rectangle(middle + DVec2::new(12.0, 0.0), DVec2::ONE);
    let journey = journey_to(&mut world, Goal::Exit { corners });
    let leaders = world.add_group(Group { neighbour_distance: 2.0, ..Group::default() }).unwrap();
    let near = |behaviour: BoxedBehaviour| Group { neighbours: 4, neighbour_distance: 2.0, ..steered(behaviour) };
    let leader = Target::Agent(0);
    let wedge = KeepFormation { count: Some(6), ..KeepFormation::new(leader, Pattern::Wedge, 1.5_f32) };
    let wedge = world.add_group(near(wedge.into())).unwrap();
    let file = FollowLeader { single_file: true, ..FollowLeader::new(leader) };
    let file = world.add_group(near(file.into())).unwrap();
    world.add_agent(Agent { journey, group: leaders, ..Agent::at(middle + DVec2::new(-2.0, 0.0)) }).unwrap();
    for k in 0..10 {
        let at = middle + DVec2::new(-40.0 + 4.0 * f64::from(k), 3.0);
        let group = if k % 2 == 0 { wedge } else { file };
        let motor = Vehicle::default().into();
        world.add_agent(Agent { motor, group, ..Agent::at(at) }).unwrap();
    }
    // it enters far from the others, with a number between theirs
    let late = Agent { motor: Vehicle::default().into(), group: wedge, ..Agent::at(middle + DVec2::new(30.0, 9.0)) };
    world.schedule_agent(3.0, late.clone()).unwrap();
    world.schedule_agent(4.0, Agent { group: file, ..late }).unwrap();
    let mut alone = world.clone();
    (0..250).for_each(|_| alone.step());
    assert_eq!((alone.counts().present, alone.counts().removed), (12, 1), "the leader has left");
    assert_same(world, &[-25.0, -10.0, 0.0, 10.0], 250);
}

/// Each agent pursues another one, in any world.
#[test]
fn a_chain_of_pursuit() {
    let (mut world, mut draw) = (empty(), Draw::new(5));
    let middle = world.settings().origin;
    for number in 0..20 {
        // the last ones pursue agents that do not exist
        let pursue = Pursue::new(Target::Agent((number * 7 + 3) % 23));
        let behaviour = Priority::new(vec![Fear { range: 40.0, fades: 5.0 }.into(), pursue.into()]);
        let group = world.add_group(Group { neighbours: 0, ..steered(behaviour) }).unwrap();
        let at = middle + draw.point(DVec2::splat(-30.0), DVec2::splat(30.0));
        // odd ones have no vehicle
        let agent = Agent { group, ..Agent::at(at) };
        let agent = if number % 2 == 0 { agent.motor(Vehicle::default()) } else { agent };
        world.add_agent(agent).unwrap();
    }
    let bang = |step: u64, part: Part<'_>| match (step, part) {
        (40, Part::Whole(world)) => world.notify(middle, 4.0).unwrap(),
        (40, Part::Divided(part)) => part.notify(middle, 4.0).unwrap(),
        _ => {}
    };
    compare(world, |step| across(&[-20.0 + step as f32 * 0.1, 0.0, 12.0]), 120, bang).unwrap();
}

/// Long vehicles on journeys turn as the guard lets them, near the vehicles of other worlds.
#[test]
fn long_vehicles_pass_each_other() {
    let (mut world, mut draw) = (empty(), Draw::new(7));
    let middle = world.settings().origin;
    let group = world.add_group(Group { neighbour_distance: 8.0, ..Group::default() }).unwrap();
    let steered =
        Group { guidance: Guidance::behaviour(Wander::default()), neighbour_distance: 8.0, ..Group::default() };
    let wanderers = world.add_group(steered).unwrap();
    for k in 0..40 {
        let at = draw.point(DVec2::splat(-12.0), DVec2::splat(12.0));
        let agent = Agent::at(middle + at).goal(middle - at).group(if k % 4 == 0 { wanderers } else { group });
        let body = draw.one_of(&[Body::capsule(1.6, 0.5), Body::rectangle(2.0, 0.8), Body::disc(0.3)]);
        let vehicle = Vehicle { max_speed: draw.between(1.0, 3.0) as f32, ..Vehicle::default() };
        let agent = if k % 3 == 0 { agent } else { agent.motor(vehicle) };
        let _ = world.add_agent(agent.with_body(body));
    }
    let work = assert_same(world, &[-5.0, 0.0, 4.0], 200);
    assert!(work.migrants > 10, "{work:?}");
}

/// Asks for another agent of its neighbours' in each step, so that questions never end, and remembers how often it was steered.
#[derive(Debug)]
struct Curious;

impl Behaviour for Curious {
    fn memory(&self) -> usize {
        2
    }

    fn steer(
        &self,
        view: &SteeringInput<'_>,
        memory: &mut [f32],
        _: &mut TraceRecorder<'_>,
    ) -> Option<throng::motion::Steering> {
        memory[0] += 1.0;
        let number = (view.rng.number + 1 + (view.time * 10.0) as u32) % 40;
        let other = view.others.find(number);
        // the next question depends on the answer
        let next = other.map_or(0, |other| (other.position.x.abs() as u32) % 40);
        memory[1] = view.slot() as f32 + next as f32;
        view.go(view.others.find(next)?.position - view.position())
    }
}

/// Questions that follow from answers are asked in the same sub-step, and memory counts each sub-step once.
#[test]
fn questions_that_follow_from_answers() {
    let (mut world, mut draw) = (empty(), Draw::new(9));
    let middle = world.settings().origin;
    let group = world.add_group(Group { neighbour_distance: 1.0, ..steered(Curious) }).unwrap();
    for _ in 0..36 {
        let at = middle + draw.point(DVec2::splat(-40.0), DVec2::splat(40.0));
        world.add_agent(Agent::at(at).group(group)).unwrap();
    }
    assert_same(world, &[-20.0, 0.0, 20.0], 60);
}

/// A random steering world.
fn random_world(seed: u64, count: usize, flies: bool, guard: bool) -> World {
    let (mut world, mut draw) = (empty(), Draw::new(seed));
    let middle = world.settings().origin;
    let half = DVec2::splat((count as f64).sqrt() * draw.between(0.5, 2.0));
    let sums = |draw: &mut Draw| -> BoxedBehaviour {
        let leader = Target::Agent(draw.index(count) as u32);
        match draw.index(7) {
            0 => Flocking::default().into(),
            1 => Boids { migration: Some(leader), ..Boids::default() }.into(),
            2 => Priority::new(vec![Separation::default().into(), Wander::default().into()]).into(),
            3 => FollowLeader { single_file: true, ..FollowLeader::new(leader) }.into(),
            4 => KeepFormation { count: Some(count), ..KeepFormation::new(leader, Pattern::Grid, 1.2_f32) }.into(),
            5 => Priority::new(vec![Cohesion::default().into(), Alignment::default().into()]).into(),
            _ => Pursue::new(Target::Nearest(GroupFilter::OtherGroups)).into(),
        }
    };
    let mut groups = Vec::new();
    for _ in 0..1 + draw.index(4) {
        let behaviour = sums(&mut draw);
        let neighbours = draw.one_of(&[0, 4, Group::ALL_NEIGHBOURS, Group::ALL_NEIGHBOURS]);
        let group = Group { neighbours, neighbour_distance: draw.between(1.0, 9.0) as f32, ..steered(behaviour) };
        // avoidance and the guard need the nearest neighbours
        let group = if guard && neighbours == 4 {
            Group { guard: true, model: Group::default().model, ..group }
        } else {
            group
        };
        groups.push(world.add_group(group).unwrap());
    }
    groups.push(world.add_group(Group { neighbour_distance: 2.0, guard, ..Group::default() }).unwrap());
    for _ in 0..count {
        let at = middle + draw.point(-half, half);
        let group = draw.one_of(&groups);
        let mut agent = Agent { group, ..Agent::at(at) }.goal(middle + draw.point(-half, half));
        if draw.index(4) > 0 {
            let air = [Locomotion::Ground, Locomotion::Level, Locomotion::Banking];
            let locomotion = if flies { draw.one_of(&air) } else { Locomotion::Ground };
            agent = agent.motor(bird(locomotion));
            if locomotion != Locomotion::Ground {
                agent.position.z = draw.between(0.0, 6.0);
            }
        }
        if draw.index(12) == 0 {
            agent = agent.with_body(Body::capsule(1.0, 0.4));
        }
        if draw.index(5) == 0 {
            let _ = world.schedule_agent(draw.between(0.0, 3.0), agent);
        } else {
            let _ = world.add_agent(agent);
        }
    }
    world
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn any_behaviours_give_the_bits_of_one_world(
        seed: u64, count in 1usize..160, flies: bool, guard: bool, cuts: u64, worlds in 1usize..8, every in 1u64..20,
    ) {
        let half = glam::Vec2::splat((count as f32).sqrt());
        let cut = |step: u64| crate::cuts::random_cuts(&mut Draw::new(cuts.wrapping_add(step / every)), worlds, -half, half);
        let work = compare(random_world(seed, count, flies, guard), cut, 40, |_, _| ());
        prop_assert!(work.is_ok(), "{:?}", work);
    }
}

#[test]
fn random_worlds_move_and_see() {
    let mut world = random_world(4, 100, true, true);
    let before: Vec<_> = world.agents().map(|agent| agent.position()).collect();
    (0..40).for_each(|_| world.step());
    let moved = world.agents().zip(before).filter(|(agent, before)| agent.position().distance(*before) > 0.5);
    assert!(moved.count() > 50);
}
