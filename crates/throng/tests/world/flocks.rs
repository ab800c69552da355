//! Flocks, many birds at once: the same bits as one by one.

use glam::DVec2;
use proptest::prelude::*;
use throng::motion::{Integrator, Locomotion, Vehicle};
use throng::perceive::Instructions;
use throng::steer::{Flocking, Rule, Who};
use throng::{Agent, Group, Settings, SubSteps, World};

type One = ((f64, f64, f32), f32);

fn rule() -> impl Strategy<Value = Rule> {
    (0.0f32..1.0, 0.5f32..9.0, prop_oneof![0.0f32..3.1, Just(std::f32::consts::PI)])
        .prop_map(|(weight, distance, angle)| Rule { weight, distance, angle })
}

fn flocking() -> impl Strategy<Value = Flocking> {
    (rule(), rule(), rule(), 0.0f32..4.0, prop_oneof![Just(Who::OwnGroup), Just(Who::Anybody)]).prop_map(
        |(separation, alignment, cohesion, always, who)| Flocking { separation, alignment, cohesion, always, who },
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

fn group(flocking: Flocking, vehicle: Vehicle) -> Group {
    Group { neighbours: Group::EVERYBODY, neighbour_distance: 8.0, ..Group::vehicles(flocking, vehicle) }
}

fn world(groups: &[Group], all: &[One], instructions: Instructions) -> World {
    let settings = Settings { step: 0.05, sub_steps: SubSteps::Fixed(1), ..Settings::default() };
    let mut world = World::new(settings).unwrap();
    world.use_instructions(instructions);
    let groups: Vec<_> = groups.iter().map(|group| (world.add_group(group.clone()).unwrap(), &group.vehicle)).collect();
    for (index, &((x, y, z), heading)) in all.iter().enumerate() {
        let (group, vehicle) = groups[index % groups.len()];
        let altitude = if vehicle.locomotion == Locomotion::Ground { 0.0 } else { z };
        let agent = Agent {
            position: DVec2::new(x, y),
            altitude,
            heading: Some(heading),
            group,
            preferred_speed: 5.0,
            max_speed: 5.0,
            ..Agent::default()
        };
        world.add_agent(agent).unwrap();
    }
    world
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn many_at_once_fly_as_one_by_one(
        all in prop::collection::vec(((-9.0..9.0, -9.0..9.0, 0.1f32..9.0), -3.0f32..3.0), 1..150),
        first in (flocking(), vehicle()), second in prop::option::of((flocking(), vehicle())), coarse: bool,
    ) {
        // some in exactly one place
        let coarse = |x: f64| if coarse { x.round() } else { x };
        let all: Vec<One> = all
            .into_iter()
            .map(|((x, y, z), heading): One| ((coarse(x), coarse(y), coarse(z.into()) as f32), heading))
            .collect();
        let groups: Vec<Group> = [Some(first), second].into_iter().flatten().map(|(f, v)| group(f, v)).collect();
        let mut plain = world(&groups, &all, Instructions::Plain);
        let mut fast: Vec<World> = Instructions::ALL.map(|level| world(&groups, &all, level)).into();
        for step in 0..30 {
            plain.step();
            for fast in &mut fast {
                fast.step();
                for row in 0..all.len() {
                    prop_assert_eq!(fast.agents().position[row], plain.agents().position[row], "step {} row {}", step, row);
                }
                prop_assert!(fast.save() == plain.save(), "step {}", step);
            }
        }
    }
}
