//! Flocks on the SIMD path: the same bits as on the scalar path.

use glam::DVec2;
use proptest::prelude::*;
use throng::motion::{Integrator, Locomotion, Vehicle};
use throng::parameters::Angle;
use throng::perceive::SimdLevel;
use throng::steer::{BoxedBehaviour, GroupFilter};
use throng::{Agent, Group, Settings, SubSteps, World};
use throng_steer::{Flocking, Rule, Separation, WeightedSum};

type One = ((f64, f64, f32), f32);

fn rule() -> impl Strategy<Value = Rule> {
    (0.0f32..1.0, 0.5f32..9.0, prop_oneof![0.0f32..3.1, Just(std::f32::consts::PI)])
        .prop_map(|(weight, distance, angle)| Rule { weight, distance, angle: Angle::from_radians(angle) })
}

fn flocking() -> impl Strategy<Value = Flocking> {
    (rule(), rule(), rule(), 0.0f32..4.0, prop_oneof![Just(GroupFilter::OwnGroup), Just(GroupFilter::All)]).prop_map(
        |(separation, alignment, cohesion, always, groups)| Flocking {
            separation,
            alignment,
            cohesion,
            always,
            groups,
        },
    )
}

fn vehicle() -> impl Strategy<Value = Vehicle> {
    let locomotion = prop_oneof![Just(Locomotion::Ground), Just(Locomotion::Level), Just(Locomotion::Banking)];
    let integrator = prop_oneof![Just(Integrator::SemiImplicit), Just(Integrator::Euler)];
    (locomotion, integrator, 0.0f32..1.0, prop_oneof![Just(0.0f32), 0.0f32..4.0], 0.5f32..3.0).prop_map(
        |(locomotion, integrator, smoothing, min_speed, mass)| Vehicle {
            locomotion,
            integrator,
            smoothing,
            min_speed,
            mass,
            max_speed: 5.0,
            max_force: 20.0,
            ..Vehicle::default()
        },
    )
}

fn group(flocking: Flocking) -> Group {
    Group { neighbours: Group::ALL_NEIGHBOURS, neighbour_distance: 8.0, ..Group::steered(flocking) }
}

fn world(groups: &[(Group, Vehicle)], all: &[One], instructions: SimdLevel) -> World {
    let settings = Settings { step: 0.05, sub_steps: SubSteps::Fixed(1), ..Settings::default() };
    let mut world = World::new(settings).unwrap();
    world.set_simd_level(instructions);
    let groups: Vec<_> =
        groups.iter().map(|(group, vehicle)| (world.add_group(group.clone()).unwrap(), vehicle)).collect();
    for (index, &((x, y, z), heading)) in all.iter().enumerate() {
        let (group, vehicle) = groups[index % groups.len()];
        let altitude = if vehicle.locomotion == Locomotion::Ground { 0.0 } else { z };
        let agent = Agent {
            position: DVec2::new(x, y).extend(f64::from(altitude)),
            heading: Some(heading),
            group,
            preferred_speed: 5.0,
            motor: (*vehicle).into(),
            ..Agent::default()
        };
        world.add_agent(agent).unwrap();
    }
    world
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn simd_and_scalar_flights_are_equal(
        all in prop::collection::vec(((-9.0..9.0, -9.0..9.0, 0.1f32..9.0), -3.0f32..3.0), 1..150),
        first in (flocking(), vehicle()), second in prop::option::of((flocking(), vehicle())), coarse: bool,
    ) {
        // some agents at exactly one place
        let coarse = |x: f64| if coarse { x.round() } else { x };
        let all: Vec<One> = all
            .into_iter()
            .map(|((x, y, z), heading): One| ((coarse(x), coarse(y), coarse(z.into()) as f32), heading))
            .collect();
        let groups: Vec<(Group, Vehicle)> = [Some(first), second].into_iter().flatten().map(|(f, v)| (group(f), v)).collect();
        let mut plain = world(&groups, &all, SimdLevel::Plain);
        let mut fast: Vec<World> = SimdLevel::ALL.map(|level| world(&groups, &all, level)).into();
        for step in 0..30 {
            plain.step();
            for fast in &mut fast {
                fast.step();
                for row in 0..all.len() {
                    prop_assert_eq!(fast.relative_columns().position[row], plain.relative_columns().position[row], "step {} row {}", step, row);
                }
                prop_assert!(fast.save() == plain.save(), "step {}", step);
            }
        }
    }
}

/// OpenSteer's birds in a ball, in some order, each with its number.
fn birds(
    count: u32,
    order: impl Iterator<Item = u32>,
    steering: impl Into<BoxedBehaviour>,
    neighbours: usize,
) -> World {
    let settings = Settings { step: 0.04, sub_steps: SubSteps::Fixed(1), ..Settings::default() };
    let mut world = World::new(settings).unwrap();
    let vehicle = Vehicle { max_speed: 9.0, max_force: 27.0, locomotion: Locomotion::Banking, ..Vehicle::default() };
    let group = Group { neighbours, neighbour_distance: 9.0, ..Group::steered(steering) };
    let group = world.add_group(group).unwrap();
    for number in order {
        // the same place for the same number: a spiral through the ball
        let part = f64::from(number) / f64::from(count);
        let (height, turn) = (2.0 * part - 1.0, 2.4 * f64::from(number));
        let across = (1.0 - height * height).sqrt() * (0.3 + 0.7 * (7.0 * part).fract());
        let agent = Agent {
            number: Some(number),
            position: (DVec2::from_angle(turn) * across * 20.0).extend(height * 20.0 + 30.0),
            heading: Some((turn % 6.0 - 3.0) as f32),
            group,
            radius: 0.5,
            preferred_speed: 9.0,
            motor: vehicle.into(),
            ..Agent::default()
        };
        world.add_agent(agent).unwrap();
    }
    world
}

#[test]
fn neither_the_order_of_birds_nor_threads_nor_a_saved_state_matter() {
    let count = 3000;
    let flock = |order: Vec<u32>| birds(count, order.into_iter(), Flocking::default(), Group::ALL_NEIGHBOURS);
    let mut world = flock((0..count).collect());
    let mut shuffled = flock((0..count).map(|k| k * 1777 % count).collect());
    let threads = |count| rayon::ThreadPoolBuilder::new().num_threads(count).build().unwrap();
    threads(1).install(|| (0..40).for_each(|_| world.step()));
    threads(3).install(|| (0..40).for_each(|_| shuffled.step()));
    assert_eq!(world.state_hash(), shuffled.state_hash());
    let mut loaded = flock((0..count).collect());
    loaded.load(&world.save()).unwrap();
    (0..10).for_each(|_| (world.step(), loaded.step()).0);
    assert!(world.save() == loaded.save());
    let order = (0..count as usize)
        .fold(glam::Vec3::ZERO, |sum, row| sum + world.relative_columns().attitude[row].basis.forward);
    assert!(order.length() > 1.0 && world.relative_columns().vertical_velocity.uniform().is_none(), "they fly");
}

#[test]
fn all_neighbours_are_the_same_as_very_many() {
    // not a plain flock: it uses the scalar path, with neighbours in order of distance
    let steering = || WeightedSum(vec![(1.0, Flocking::default().into()), (0.3, Separation::default().into())]);
    let mut all = birds(400, 0..400, steering(), Group::ALL_NEIGHBOURS);
    let mut many = birds(400, 0..400, steering(), 1000);
    for _ in 0..30 {
        all.step();
        many.step();
    }
    assert_eq!(all.state_hash(), many.state_hash());
    let (all, many) = (all.summary(), many.summary());
    assert_eq!((all.least_separation, all.overlaps), (many.least_separation, many.overlaps));
    assert!(all.overlaps > 0, "some come too near");
}

#[test]
fn agents_with_avoidance_use_the_nearest() {
    let mut world = World::new(Settings::default()).unwrap();
    let error = world.add_group(Group { neighbours: Group::ALL_NEIGHBOURS, ..Group::default() }).unwrap_err();
    assert!(error.to_string().contains("all for agents that avoid no other agent"), "{error}");
}
