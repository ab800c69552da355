//! Crowds that fields govern.

use crate::world::common::{Draw, journey_to, run_for, with_settings};
use crate::world::oracle::Snapshot;
use glam::{DVec2, Vec2, Vec3};
use std::f64::consts::{FRAC_PI_4, TAU};
use std::sync::Arc;
use throng::agent::Guidance;
use throng::field::{Field, Governed, Interaction};
use throng::perceive::SimdLevel;
use throng::{Agent, AgentRef, Error, Group, GroupId, JourneyId, Status, SubSteps, World};
use throng_field::{Brush, Map, Sampled, Uniform};

fn led(world: &mut World, field: impl Field + 'static, ratio: f32) -> GroupId {
    let origin = world.settings().origin;
    world
        .add_group(Group {
            origin,
            guidance: Guidance::JOURNEY.governed(Governed::new(field, ratio)),
            look_ahead: false,
            keep_right: 0.0,
            ..Group::default()
        })
        .unwrap()
}

/// Round the origin, counter-clockwise, at 1.2 m/s.
fn whirl(place: Vec3, _: f64) -> Vec3 {
    Vec3::Z.cross(place).normalize_or_zero() * 1.2
}

/// The position, relative to the world's origin, and the velocity of the only agent.
fn only(world: &World) -> (Vec2, Vec2) {
    (world.relative_columns().position[0], world.relative_columns().velocity[0])
}

#[test]
fn agents_without_a_journey_follow_the_field() {
    for step in [1.0 / 60.0, 0.04, 0.1] {
        let origin = DVec2::new(-1800.0, 900.0);
        let mut world = with_settings(step, SubSteps::Auto, origin);
        let group = led(&mut world, whirl, 1.0);
        let position = origin + DVec2::X * 5.0;
        world
            .add_agent(Agent { position: position.extend(0.0), group, velocity: Vec2::Y * 1.2, ..Agent::default() })
            .unwrap();
        let around = TAU * 5.0 / 1.2;
        run_for(&mut world, around, |world| {
            let (place, velocity) = only(world);
            // a step leads along the tangent
            assert!((place.length() - 5.0).abs() < 0.05 + 1.2 * step as f32, "{place}");
            assert!((velocity.length() - 1.2).abs() < 0.02 && world.relative_columns().status[0] == Status::Walking);
        });
        assert!(only(&world).0.distance(Vec2::X * 5.0) < 0.3 + 1.5 * step as f32, "once round: {}", only(&world).0);
        assert!(!world.finished());
    }
}

/// A ratio of one half: half way between both directions, at the mean of both speeds.
#[test]
fn a_ratio_blends_directions_and_speeds() {
    for (ratio, angle, speed) in [(0.0, 0.0, 1.3), (0.25, 0.5, 1.225), (0.5, 1.0, 1.15), (1.0, 2.0, 1.0)] {
        let mut world = with_settings(0.05, SubSteps::Auto, DVec2::ZERO);
        let group = led(&mut world, |_: Vec3, _: f64| Vec3::new(0.0, 1.0, 0.0), ratio);
        let journey = journey_to(&mut world, DVec2::X * 1e4);
        let agent = Agent { group, journey, preferred_speed: 1.3, ..Agent::default() };
        world.add_agent(agent).unwrap();
        run_for(&mut world, 3.0, |_| {});
        let expected = Vec2::from_angle((angle * FRAC_PI_4) as f32) * speed;
        let (_, velocity) = only(&world);
        assert!(velocity.distance(expected) < 5e-3, "{velocity} and {expected} with {ratio}");
    }
}

#[test]
fn what_is_against_the_own_way_does_not_cancel_it_out() {
    let mut world = with_settings(0.05, SubSteps::Auto, DVec2::ZERO);
    let group = led(&mut world, |_: Vec3, _: f64| Vec3::NEG_X, 0.5);
    let journey = journey_to(&mut world, DVec2::X * 1e4);
    world.add_agent(Agent { group, journey, preferred_speed: 1.0, ..Agent::default() }).unwrap();
    run_for(&mut world, 3.0, |_| {});
    assert!((only(&world).1.length() - 1.0).abs() < 0.01, "{}", only(&world).1);
}

/// Where the field is 0, or not finite, the agent's own direction counts; arrived agents rest.
#[test]
fn a_field_with_nothing_to_say_leaves_the_own_way() {
    let field = |place: Vec3, _: f64| if place.x < 2.0 { Vec3::ZERO } else { Vec3::NAN };
    let mut world = with_settings(0.05, SubSteps::Auto, DVec2::ZERO);
    let group = led(&mut world, field, 1.0);
    let journey = journey_to(&mut world, DVec2::X * 6.0);
    world.add_agent(Agent { group, journey, ..Agent::default() }).unwrap();
    let idle = world.add_agent(Agent { group, position: (DVec2::Y * 9.0).extend(0.0), ..Agent::default() }).unwrap();
    run_for(&mut world, 8.0, |_| {});
    assert_eq!(world.relative_columns().status[0], Status::Arrived);
    assert!(only(&world).0.distance(Vec2::X * 6.0) < 0.3 && only(&world).1 == Vec2::ZERO);
    assert_eq!(world.agent(idle).map(AgentRef::to_agent).unwrap().position, (DVec2::Y * 9.0).extend(0.0));
}

#[test]
fn a_field_may_begin_to_flow_later() {
    let mut world = with_settings(0.1, SubSteps::Auto, DVec2::ZERO);
    let group = led(&mut world, |_: Vec3, time: f64| if time > 3.5 { Vec3::Y } else { Vec3::ZERO }, 1.0);
    world.add_agent(Agent { group, ..Agent::default() }).unwrap();
    run_for(&mut world, 3.0, |world| assert_eq!(only(world).0, Vec2::ZERO));
    run_for(&mut world, 5.5, |_| {});
    assert!((only(&world).0.y - 5.0).abs() < 0.3, "{}", only(&world).0);
}

/// A hundred and twenty agents in a converging rotation, and some that cross it on journeys: no two agents overlap, at
/// any SIMD level.
fn mill(instructions: SimdLevel) -> World {
    let mut world = with_settings(0.05, SubSteps::Auto, DVec2::ZERO);
    let narrowing = |place: Vec3, time: f64| whirl(place, time) - place * 0.04;
    let sampled = Sampled::of(&narrowing, DVec2::splat(-15.0), DVec2::splat(15.0), 0.5, 0.0).unwrap();
    let group = led(&mut world, sampled, 1.0);
    let mut draw = Draw::new(3);
    let mut taken: Vec<DVec2> = Vec::new();
    while taken.len() < 150 {
        let position = draw.point(DVec2::splat(-11.0), DVec2::splat(11.0));
        if taken.iter().any(|other| other.distance(position) < 0.55) {
            continue;
        }
        taken.push(position);
        let crosses = taken.len() > 120;
        let journey = if crosses { journey_to(&mut world, -position) } else { JourneyId::STAY };
        let group = if crosses { Agent::default().group } else { group };
        world.add_agent(Agent { position: position.extend(0.0), journey, group, ..Agent::default() }).unwrap();
    }
    world.set_simd_level(instructions);
    world
}

#[test]
fn no_two_agents_overlap_in_a_mill_at_any_simd_level() {
    let mut world = mill(SimdLevel::Best);
    run_for(&mut world, 12.0, |world| assert_eq!(world.overlapping(), []));
    let places = Snapshot::of(&world).positions;
    let around = places.iter().zip(&world.relative_columns().velocity).take(120);
    let turning = around.filter(|(place, v)| place.perp_dot(v.as_dvec2()) > 0.0).count();
    assert!(turning > 80, "{turning} of 120 go round");
    let mut plain = mill(SimdLevel::Plain);
    run_for(&mut plain, 12.0, |_| {});
    assert_eq!(world.state_hash(), plain.state_hash());
    let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build().unwrap();
    let mut threads = mill(SimdLevel::Best);
    pool.install(|| run_for(&mut threads, 12.0, |_| {}));
    assert_eq!(world.state_hash(), threads.state_hash());
}

#[test]
fn ratios_out_of_their_limits_are_refused() {
    let mut world = with_settings(0.1, SubSteps::Auto, DVec2::ZERO);
    for ratio in [-0.1, 1.1, f32::NAN] {
        let group = Group { guidance: Guidance::JOURNEY.governed(Governed::new(whirl, ratio)), ..Group::default() };
        assert!(matches!(world.add_group(group), Err(Error::Limit { what: "ratio of a field", .. })));
    }
}

/// A group with fields about other agents only.
fn around(world: &mut World, around: Interaction) -> GroupId {
    let field = Governed { around: vec![around], ..Governed::new(Uniform(Vec3::ZERO), 1.0) };
    world
        .add_group(Group {
            guidance: Guidance::JOURNEY.governed(field),
            look_ahead: false,
            keep_right: 0.0,
            ..Group::default()
        })
        .unwrap()
}

/// The ratio depends on the group, on the place, and on the agent.
#[test]
fn ratios_are_those_of_the_place_and_of_the_agent() {
    let mut map = Map::over(DVec2::new(-50.0, 0.0), DVec2::new(50.0, 20.0), 0.5).unwrap();
    let line = [DVec2::new(-50.0, 10.0), DVec2::new(50.0, 10.0)];
    map.paint(&Brush { radius: 12.0, hardness: 1.0, ..Brush::default() }, &line, 0.5).unwrap();
    for (y, governed, expected) in [(10.0, 1.0, 0.5), (10.0, 0.5, 0.25), (10.0, 0.0, 0.0), (-10.0, 1.0, 0.0)] {
        let mut world = with_settings(0.05, SubSteps::Auto, DVec2::ZERO);
        let field = Governed { map: Some(Arc::new(map.clone())), ..Governed::new(Uniform(Vec3::Y), 1.0) };
        let group = world
            .add_group(Group {
                guidance: Guidance::JOURNEY.governed(field),
                look_ahead: false,
                keep_right: 0.0,
                ..Group::default()
            })
            .unwrap();
        let position = DVec2::new(0.0, y);
        let journey = journey_to(&mut world, DVec2::new(1e4, y));
        world
            .add_agent(Agent {
                position: position.extend(0.0),
                group,
                journey,
                governed,
                preferred_speed: 1.0,
                ..Agent::default()
            })
            .unwrap();
        run_for(&mut world, 2.0, |_| {});
        let (_, velocity) = only(&world);
        let angle = expected as f32 * std::f32::consts::FRAC_PI_2;
        assert!(velocity.distance(Vec2::from_angle(angle)) < 5e-3, "{velocity} at {y} with {governed}");
    }
}

/// A field about an agent moves and turns with it.
#[test]
fn fields_go_with_their_sources() {
    // to a place 2 m behind
    let behind = |place: Vec3, _: f64| (Vec3::NEG_X * 2.0 - place).clamp_length_max(1.7);
    for heading in [0.0, 2.0, -3.0] {
        let origin = DVec2::new(400.0, -90.0);
        let mut world = with_settings(0.04, SubSteps::Auto, origin);
        let leaders = world.add_group(Group { look_ahead: false, keep_right: 0.0, ..Group::default() }).unwrap();
        let way = DVec2::from_angle(heading);
        let journey = journey_to(&mut world, origin + way * 1e4);
        world.add_agent(Agent { position: origin.extend(0.0), group: leaders, journey, ..Agent::default() }).unwrap();
        let followers = around(&mut world, Interaction { carried: 1.0, ..Interaction::new(leaders.index(), behind) });
        let position = origin + way.perp() * 4.0;
        let follower =
            world.add_agent(Agent { position: position.extend(0.0), group: followers, ..Agent::default() }).unwrap();
        run_for(&mut world, 20.0, |_| {});
        let leader = world.members(leaders)[0];
        let offset = world.position(follower).unwrap() - world.position(leader).unwrap();
        assert!(offset.distance((-2.0 * way).extend(0.0)) < 0.15, "{offset} is behind {way}");
    }
}

/// Sources beyond the reach do not count. Within, the result is the weighted mean of all sources and the group's own
/// field once.
#[test]
fn the_mean_of_all_that_is_said_counts() {
    let settled = |reach: f32, weight: f32, base: Vec3| {
        let mut world = with_settings(0.05, SubSteps::Auto, DVec2::ZERO);
        let posts = world.add_group(Group::default()).unwrap();
        for x in [-3.0, 6.0] {
            world
                .add_agent(Agent {
                    position: DVec2::new(x, 5.0).extend(0.0),
                    heading: Some(0.0),
                    group: posts,
                    ..Agent::default()
                })
                .unwrap();
        }
        let about = Interaction { reach, weight, ..Interaction::new(posts.index(), Uniform(Vec3::Y)) };
        let field = Governed { around: vec![about], ..Governed::new(Uniform(base), 1.0) };
        let group = world
            .add_group(Group {
                guidance: Guidance::JOURNEY.governed(field),
                look_ahead: false,
                keep_right: 0.0,
                ..Group::default()
            })
            .unwrap();
        let id = world.add_agent(Agent { group, ..Agent::default() }).unwrap();
        run_for(&mut world, 1.0, |_| {});
        world.relative_columns().velocity[world.row(id).unwrap()]
    };
    assert!(settled(100.0, 1.0, Vec3::ZERO).distance(Vec2::Y) < 1e-3);
    assert_eq!(settled(2.0, 1.0, Vec3::ZERO), Vec2::ZERO);
    assert!(settled(100.0, 2.0, Vec3::X).distance(Vec2::new(0.2, 0.8)) < 1e-3, "one of five parts is the field's");
    assert!(settled(6.0, 2.0, Vec3::X).distance(Vec2::new(1.0, 2.0) / 3.0) < 1e-3, "one of three, with one source");
}

/// Agents turn to the facing that a field gives, standing or walking.
#[test]
fn people_look_where_a_field_says() {
    for flow in [Vec3::ZERO, Vec3::X * 1.2] {
        let mut world = with_settings(0.05, SubSteps::Auto, DVec2::ZERO);
        let posts = world.add_group(Group::default()).unwrap();
        world
            .add_agent(Agent {
                position: DVec2::new(3.0, 40.0).extend(0.0),
                group: posts,
                heading: Some(1.0),
                ..Agent::default()
            })
            .unwrap();
        let to_it = |place: Vec3, _: f64| -place;
        let looks: Arc<dyn Field> = Arc::new(to_it);
        let about = Interaction { looks: Some(looks), ..Interaction::new(posts.index(), Uniform(Vec3::ZERO)) };
        let field = Governed { around: vec![about], ..Governed::new(Uniform(flow), 1.0) };
        let group = world
            .add_group(Group {
                guidance: Guidance::JOURNEY.governed(field),
                look_ahead: false,
                keep_right: 0.0,
                ..Group::default()
            })
            .unwrap();
        let id = world.add_agent(Agent { group, heading: Some(-1.0), ..Agent::default() }).unwrap();
        run_for(&mut world, 3.0, |_| {});
        let row = world.row(id).unwrap();
        let there = Vec2::new(3.0, 40.0) - world.relative_columns().position[row];
        let heading = world.relative_columns().heading[row];
        assert!((heading - there.to_angle()).abs() < 0.05, "{heading} with {flow}");
        assert!((world.relative_columns().position[row].x - 3.0 * flow.x).abs() < 0.5);
    }
}

/// A field is replaced while the world runs.
#[test]
fn fields_can_be_changed_on_the_way() {
    let mut world = with_settings(0.05, SubSteps::Auto, DVec2::ZERO);
    let group = world.add_group(Group { look_ahead: false, keep_right: 0.0, ..Group::default() }).unwrap();
    world.add_agent(Agent { group, ..Agent::default() }).unwrap();
    run_for(&mut world, 1.0, |_| {});
    assert_eq!(only(&world).0, Vec2::ZERO);
    world.set_guidance(group, Guidance::JOURNEY.governed(Governed::new(Uniform(Vec3::X), 1.0))).unwrap();
    run_for(&mut world, 5.0, |_| {});
    assert!(only(&world).0.x > 4.5 && !world.finished());
    world.set_guidance(group, Guidance::JOURNEY.governed(Governed::new(Uniform(Vec3::Y), 1.0))).unwrap();
    run_for(&mut world, 5.0, |_| {});
    assert!(only(&world).0.y > 4.5);
    world.set_guidance(group, Guidance::JOURNEY).unwrap();
    run_for(&mut world, 2.0, |_| {});
    assert!(only(&world).1 == Vec2::ZERO && world.finished());
    let bad = Governed::new(Uniform(Vec3::X), 2.0);
    assert!(matches!(
        world.set_guidance(group, Guidance::JOURNEY.governed(bad)),
        Err(Error::Limit { what: "ratio of a field", .. })
    ));
}

#[test]
fn interactions_out_of_their_limits_are_refused() {
    let mut world = with_settings(0.1, SubSteps::Auto, DVec2::ZERO);
    let fine = || Interaction::new(0, Uniform(Vec3::X));
    let wrong = [
        (Interaction { weight: 0.0, ..fine() }, "weight of an interaction"),
        (Interaction { carried: f32::NAN, ..fine() }, "carried part of an interaction"),
        (Interaction { reach: -1.0, ..fine() }, "reach of an interaction"),
    ];
    for (interaction, expected) in wrong {
        let field = Governed { around: vec![interaction], ..Governed::new(whirl, 1.0) };
        let group = Group { guidance: Guidance::JOURNEY.governed(field), ..Group::default() };
        assert!(matches!(world.add_group(group), Err(Error::Limit { what, .. }) if what == expected));
    }
    let governed = Agent { governed: 1.5, ..Agent::default() };
    assert!(matches!(world.add_agent(governed), Err(Error::Limit { what: "governed", .. })));
}
