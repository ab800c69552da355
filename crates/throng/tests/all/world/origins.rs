//! The origins of groups: fields, behaviours, wrapping and solids in world coordinates, or relative to any other place.

use glam::{DVec2, DVec3, Vec3};
use proptest::prelude::*;
use std::sync::Arc;
use throng::agent::Guidance;
use throng::field::Governed;
use throng::motion::{Locomotion, Vehicle, WrapAround};
use throng::parameters::Angle;
use throng::space::surface::{SeenFrom, Sphere};
use throng::steer::{Barriers, BoxedBehaviour, SteeringReason, Target};
use throng::{Agent, Error, Group, Settings, SubSteps, TraceRequest, World};
use throng_field::{Brush, Destination, Map, RoundJams, Sampled, Terrain, TerrainSettings, ToGoal};
use throng_steer::{Contain, Dock, Fear, Seek, Tether, Wander, WeightedSum};

/// A world in which every place of a group is moved by `offset` and given relative to `group_origin`.
fn scene(offset: DVec2, origin: DVec2, group_origin: DVec2, seed: u64) -> World {
    let mut world = World::new(Settings { step: 0.1, sub_steps: SubSteps::Fixed(2), origin, seed }).unwrap();
    let flat = |x: f64, y: f64| offset - group_origin + DVec2::new(x, y);
    let at = |x: f64, y: f64, z: f32| flat(x, y).as_vec2().extend(z);
    let base = Group { origin: group_origin, ..Group::default() };

    // a painted field with a painted ratio
    let mut sampled = Sampled::over(flat(-20.0, -20.0), flat(20.0, 20.0), 0.5).unwrap();
    let brush = Brush { radius: 4.0, ..Brush::default() };
    sampled.paint(&brush, &[flat(-15.0, 0.0), flat(15.0, 4.0)], 1.2).unwrap();
    let mut map = Map::over(flat(-20.0, -20.0), flat(20.0, 20.0), 0.5).unwrap();
    map.paint(&brush, &[flat(-15.0, 0.0), flat(8.0, 2.0)], 0.8).unwrap();
    let field = Governed { map: Some(Arc::new(map)), ..Governed::new(sampled, 1.0) };
    let painted = world
        .add_group(Group { name: "painted".into(), guidance: Guidance::JOURNEY.governed(field), ..base.clone() })
        .unwrap();
    for k in 0..5 {
        let start = offset + DVec2::new(-9.0, f64::from(k) - 2.0);
        world.add_agent(Agent::at(start).goal(offset + DVec2::new(9.0, -9.0)).group(painted)).unwrap();
    }

    // a flow to a goal that adapts to the crowd
    let survey = TerrainSettings { low: flat(-12.0, 18.0), high: flat(12.0, 42.0), ..TerrainSettings::default() };
    let ground = Terrain::of_place(world.place(), group_origin, survey).unwrap();
    let to = Destination::Point { at: flat(9.0, 30.0), tolerance: 0.2 };
    let flow = RoundJams::new(ToGoal::new(Arc::new(ground), vec![to], 1.3).unwrap());
    let led = world.add_group(base.clone()).unwrap();
    world.set_guidance(led, Guidance::JOURNEY.governed(Governed::new(flow, 1.0))).unwrap();
    for k in 0..6 {
        let start = offset + DVec2::new(-6.0, 28.0 + 0.6 * f64::from(k));
        world.add_agent(Agent::at(start).group(led)).unwrap();
    }

    // behaviours with places, an agent to follow, stimuli and a cage
    let pursue: BoxedBehaviour = Tether { to: Target::Agent(0), length: 50.0 }.into();
    let steering = WeightedSum(vec![
        (1.0, Seek { target: Target::Point(at(60.0, 5.0, 0.0)) }.into()),
        (0.5, Contain::inside(Sphere::new(at(60.0, 0.0, 0.0), 12.0).unwrap()).into()),
        (0.3, Wander::default().into()),
        (0.5, Fear { range: 30.0, fades: 20.0 }.into()),
        (0.2, pursue),
    ]);
    let cage = Barriers::default()
        .with(Sphere::new(at(60.0, 0.0, 0.0), 9.0).unwrap(), SeenFrom::Inside)
        .with(Sphere::new(at(60.0, 2.0, 0.0), 1.0).unwrap(), SeenFrom::Outside);
    let steered = world
        .add_group(Group { name: "steered".into(), origin: group_origin, solid: cage, ..Group::steered(steering) })
        .unwrap();
    world.notify((offset + DVec2::new(55.0, 0.0)).extend(0.0), 0.0).unwrap();
    for k in 0..4 {
        let agent = Agent::at(offset + DVec2::new(56.0, f64::from(k)));
        world.add_agent(agent.group(steered).motor(Vehicle::default())).unwrap();
    }

    // flight in a space that wraps around
    let vehicle = Vehicle { locomotion: Locomotion::Level, ..Vehicle::default() };
    let fly = Dock { speed: 1.0, ..Dock::new(at(0.0, -60.0, 30.0), Angle::default()) };
    let ball = WrapAround { center: at(0.0, -60.0, 20.0), radius: 6.0 };
    let flying =
        world.add_group(Group { origin: group_origin, wrap_around: Some(ball), ..Group::steered(fly) }).unwrap();
    let up = |k: u32| (offset + DVec2::new(f64::from(k), -60.0)).extend(24.0);
    for k in 0..3 {
        world.add_agent(Agent::at(up(k)).group(flying).motor(vehicle)).unwrap();
    }
    world
}

fn run(mut world: World, offset: DVec2, steps: usize) -> Vec<DVec3> {
    (0..steps).for_each(|_| world.step());
    world.agents().map(|agent| agent.position() - offset.extend(0.0)).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(6))]
    /// A translated scene gives the translated run: to the bit if its groups have the origin of the world, and up to
    /// the rounding of `f32` in world coordinates.
    #[test]
    fn groups_may_be_given_relative_to_any_origin(seed in 0u64..1000) {
        let far = DVec2::new(5000.0, -3000.0);
        let here = |steps| run(scene(DVec2::ZERO, DVec2::ZERO, DVec2::ZERO, seed), DVec2::ZERO, steps);
        prop_assert_eq!(run(scene(far, far, far, seed), far, 50), here(50));
        // rounding grows as agents turn, so that only a short run stays close
        let here = here(15);
        // positions 5 km from the origin of the world are rounded to 0.5 mm in each sub-step
        let all = [(far, DVec2::ZERO, 0.02), (far, far - DVec2::splat(64.0), 0.02), (DVec2::ZERO, far, 0.1)];
        for (origin, group_origin, most) in all {
            let there = run(scene(far, origin, group_origin, seed), far, 15);
            for (a, b) in here.iter().zip(&there) {
                prop_assert!(a.distance(*b) < most, "{} {} {} {}", origin, group_origin, a, b);
            }
        }
    }
}

/// A world remembers groups as they were given; so a group that is read and set again stays the same.
#[test]
fn a_group_that_is_set_again_stays_where_it_is() {
    let far = DVec2::new(512.0, -256.0);
    let (mut plain, mut again) = (scene(far, far, DVec2::ZERO, 3), scene(far, far, DVec2::ZERO, 3));
    for name in ["painted", "steered"] {
        let id = again.group_named(name).unwrap();
        assert_eq!(again.group(id).origin, DVec2::ZERO);
        again.set_group(id, again.group(id).clone()).unwrap();
        plain.set_group(id, plain.group(id).clone()).unwrap();
        again.set_group(id, again.group(id).clone()).unwrap();
    }
    assert_eq!(run(again, far, 50), run(plain, far, 50));
}

/// Traces are in local coordinates, wherever the group has its origin.
#[test]
fn traces_are_relative_to_the_origin_of_the_world() {
    let far = DVec2::new(512.0, -256.0);
    let reasons = |group_origin: DVec2| {
        let mut world = World::new(Settings { origin: far, ..Settings::default() }).unwrap();
        let target = Target::Point((far + DVec2::new(9.0, 2.0) - group_origin).as_vec2().extend(0.0));
        let group = Group { origin: group_origin, ..Group::steered(Seek { target }) };
        let group = world.add_group(group).unwrap();
        world.add_agent(Agent::at(far).group(group).motor(Vehicle::default())).unwrap();
        world.request_traces(TraceRequest::All);
        world.step();
        world.relative_traces()[0].entries.clone()
    };
    assert_eq!(reasons(DVec2::ZERO)[0].reason, SteeringReason::Aim(Vec3::new(9.0, 2.0, 0.0)));
    assert_eq!(reasons(DVec2::ZERO), reasons(far));
}

/// Only a group with places needs an origin near the world's.
#[test]
fn an_origin_that_is_too_far_away_is_refused() {
    let mut world = World::new(Settings { origin: DVec2::new(500_000.0, 4_000_000.0), ..Settings::default() }).unwrap();
    world.add_group(Group::default()).unwrap();
    let error = world.add_group(Group::steered(Wander::default())).unwrap_err();
    assert!(matches!(&error, Error::Limit { .. }) && error.to_string().contains("origin of the group"), "{error}");
    let origin = world.settings().origin;
    world.add_group(Group { origin, ..Group::steered(Wander::default()) }).unwrap();
}
