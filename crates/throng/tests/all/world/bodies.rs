//! Bodies of all shapes: no two overlap, between steps either; all arrive; same bits.

use crate::polygons::apart;
use crate::world::common::{Draw, journey_to, run, with_settings};
use crate::world::determinism::{bits, history, with_threads};
use crate::world::scenes::{clutter, free_spot};
use glam::{DVec2, Vec2};
use std::sync::Arc;
use throng::avoid::{Hrvo, NoAvoidance, Orca, Rvo, Vo};
use throng::motion::Holonomic;
use throng::{Agent, Body, Group, GroupId, Keyframe, Obstacle, Script, SubSteps, World};

/// A body at one time.
#[derive(Clone, Copy)]
struct Placed {
    number: u32,
    at: DVec2,
    heading: f64,
    body: Body,
    guarded: bool,
    avoids: bool,
}

impl Placed {
    fn corners(&self) -> [DVec2; 4] {
        let (along, half) = (DVec2::from_angle(self.heading), self.body.core.as_dvec2());
        [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)]
            .map(|(x, y)| self.at + along * (x * half.x) + along.perp() * (y * half.y))
    }
}

fn all(world: &World) -> Vec<Placed> {
    let agents = world.relative_columns();
    let mut all: Vec<Placed> = (0..agents.len())
        .map(|row| Placed {
            number: agents.number[row],
            at: agents.position[row].as_dvec2(),
            heading: agents.heading[row].into(),
            body: agents.body(row),
            guarded: world.group(agents.group[row]).guard,
            avoids: agents.avoids[row] != 0,
        })
        .collect();
    all.sort_by_key(|placed| placed.number);
    all
}

/// Deepest penetration of two bodies, or of a body and a wall, over the smaller radius, for guarded bodies.
fn deepest(all: &[Placed], obstacles: &[Obstacle], origin: DVec2) -> f64 {
    let mut deepest = f64::NEG_INFINITY;
    for (i, a) in all.iter().enumerate() {
        let radius = f64::from(a.body.radius);
        for b in &all[..i] {
            let size = f64::from(b.body.radius);
            let far = a.at.distance(b.at) > f64::from(a.body.bounding_radius() + b.body.bounding_radius());
            if far || !(a.guarded || b.guarded) || !(a.avoids || b.avoids) {
                continue;
            }
            deepest = deepest.max((radius + size - apart(&a.corners(), &b.corners())) / radius.min(size));
        }
        let ring = |points: &[DVec2]| points.iter().map(|p| *p - origin).collect::<Vec<_>>();
        for obstacle in obstacles.iter().filter(|_| a.guarded) {
            let distance = match obstacle {
                Obstacle::Circle { center, radius } => apart(&a.corners(), &[*center - origin]) - radius,
                Obstacle::Polygon { corners } => apart(&a.corners(), &ring(corners)),
                Obstacle::Wall { points } => {
                    let sides = points.windows(2).map(|side| apart(&a.corners(), &ring(side)));
                    sides.fold(f64::INFINITY, f64::min)
                }
            };
            deepest = deepest.max((radius - distance) / radius);
        }
    }
    deepest
}

/// A room with clutter, with discs, capsules, rectangles and bars on endless rounds; one group has no guard.
fn mixed(case: u64, step: f64, sub_steps: SubSteps, order: u64) -> World {
    let mut draw = Draw::new(case + 77);
    let origin = draw.point(DVec2::splat(-4000.0), DVec2::splat(4000.0)).round();
    let mut world = with_settings(step, sub_steps, origin);
    for obstacle in clutter(&mut draw, origin, 7.0, case as usize % 5) {
        world.add_obstacle(obstacle).unwrap();
    }
    let models: [Arc<dyn throng::avoid::LocalModel>; 4] =
        [Arc::new(Orca::default()), Arc::new(Hrvo::default()), Arc::new(Rvo::default()), Arc::new(Vo::default())];
    let mut groups = vec![GroupId::DEFAULT];
    for model in models {
        let name = format!("{model:?}");
        groups.push(world.add_group(Group { name, model, ..Group::default() }).unwrap());
    }
    groups.push(world.add_group(Group { name: "unguarded".into(), guard: false, ..Group::default() }).unwrap());
    let area = (origin - DVec2::splat(6.0), origin + DVec2::splat(6.0));
    let obstacles = crate::world::oracle::obstacles(&world);
    let mut taken = Vec::new();
    let mut agents = Vec::new();
    for number in 0..40 {
        let width = draw.between(0.2, 0.6) as f32;
        let length = width * draw.between(1.0, 5.0) as f32;
        let body =
            draw.one_of(&[Body::disc(width * 0.5), Body::capsule(length, width), Body::rectangle(length, width)]);
        let Some(position) = free_spot(&mut draw, &obstacles, &taken, area, body.bounding_radius().into()) else {
            continue;
        };
        let Some(goal) = free_spot(&mut draw, &obstacles, &[], area, 0.7) else { continue };
        taken.push((position, body.bounding_radius().into()));
        let preferred_speed = draw.between(0.3, 2.0) as f32;
        let mut agent = Agent {
            position: position.extend(0.0),
            heading: Some(draw.between(-3.0, 3.0) as f32),
            journey: journey_to(&mut world, goal),
            preferred_speed,
            group: draw.one_of(&groups),
            number: Some(number),
            motor: Holonomic {
                max_speed: preferred_speed * 1.4,
                max_acceleration: draw.one_of(&[2.0, f32::INFINITY]),
                max_turn_rate: draw.one_of(&[0.7, 3.0, f32::INFINITY]),
            }
            .into(),
            ..Agent::default()
        };
        if number % 8 == 0 {
            let turned = |time, heading| Keyframe { time, at: position, heading };
            let keyframes = vec![turned(0.0, 0.0), turned(4.0, std::f64::consts::TAU)];
            let script = Some(world.add_script(Script { keyframes, repeat: true }).unwrap());
            agent = Agent {
                script,
                avoids: 0,
                group: GroupId::DEFAULT,
                motor: Holonomic { max_turn_rate: 3.0, ..Holonomic::default() }.into(),
                ..agent
            };
        }
        agents.push(agent.with_body(body));
    }
    Draw::new(order + 1).shuffle(&mut agents);
    for agent in agents {
        // the room is rotated, so a place beyond its wall may be refused: that agent is left out
        let _ = world.add_agent(agent);
    }
    world
}

#[test]
fn bodies_of_all_shapes_overlap_nothing_on_the_way_between_steps() {
    for case in 0..18 {
        let step = [1.0 / 60.0, 0.1, 0.5][case as usize % 3];
        let mut world = mixed(case, step, SubSteps::Fixed(1), 0);
        let (obstacles, origin) = (crate::world::oracle::obstacles(&world), world.settings().origin);
        let mut before = all(&world);
        assert!(before.len() > 12 && deepest(&before, &obstacles, origin) < 1e-4, "case {case}: a free start");
        for _ in 0..(6.0 / step) as usize {
            world.step();
            let after = all(&world);
            for moment in 1..=8 {
                let t = f64::from(moment) / 8.0;
                let between: Vec<Placed> = before
                    .iter()
                    .zip(&after)
                    .map(|(from, to)| {
                        let turn = (to.heading - from.heading + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU)
                            - std::f64::consts::PI;
                        Placed { at: from.at.lerp(to.at, t), heading: from.heading + turn * t, ..*from }
                    })
                    .collect();
                let deepest = deepest(&between, &obstacles, origin);
                assert!(deepest < 1e-4, "case {case} at {} s: {deepest} of a radius", world.time());
            }
            before = after;
        }
    }
}

#[test]
fn the_measure_sees_what_the_oracle_sees() {
    let mut world = mixed(3, 0.05, SubSteps::Auto, 0);
    for _ in 0..60 {
        world.step();
    }
    let everybody: Vec<Placed> = all(&world).iter().map(|placed| Placed { guarded: true, ..*placed }).collect();
    let overlapping = world.overlapping();
    for (i, a) in everybody.iter().enumerate() {
        for b in everybody[..i].iter().filter(|b| a.avoids || b.avoids) {
            let radii = f64::from(a.body.radius + b.body.radius);
            let overlaps = apart(&a.corners(), &b.corners()) < radii * (1.0 - 1e-4);
            let listed = overlapping.iter().any(|&(x, y, _)| (x, y) == (b.number, a.number));
            assert_eq!(overlaps, listed, "{} and {}", b.number, a.number);
        }
    }
}

#[test]
fn capsules_and_rectangles_get_where_they_want() {
    for body in [Body::capsule(0.6, 0.3), Body::rectangle(0.8, 0.5)] {
        let mut world = with_settings(0.04, SubSteps::Auto, DVec2::ZERO);
        for k in 0..16 {
            let position = DVec2::from_angle(f64::from(k) * std::f64::consts::TAU / 16.0) * 4.0;
            let journey = journey_to(&mut world, -position);
            let agent = Agent {
                position: position.extend(0.0),
                journey,
                motor: Holonomic { max_turn_rate: 3.0, ..Holonomic::default() }.into(),
                ..Agent::default()
            };
            world.add_agent(agent.with_body(body)).unwrap();
        }
        run(&mut world, 60.0, |_| ());
        let summary = world.summary();
        assert_eq!((summary.arrived, summary.overlaps), (16, 0), "{body:?}: {summary:?}");
        assert!(summary.least_separation >= 0.9999);
    }
}

/// A long body passes a door that is wider than its narrower side.
#[test]
fn a_long_body_passes_a_narrow_door() {
    let mut world = with_settings(0.04, SubSteps::Auto, DVec2::ZERO);
    for (from, to) in [(-6.0, -0.7), (0.7, 6.0)] {
        let wall = vec![DVec2::new(0.0, from), DVec2::new(0.0, to)];
        world.add_obstacle(Obstacle::Wall { points: wall }).unwrap();
    }
    let journey = journey_to(&mut world, DVec2::new(5.0, 1.0));
    let agent = Agent {
        position: DVec2::new(-4.0, 2.0).extend(0.0),
        journey,
        motor: Holonomic { max_turn_rate: 2.0, ..Holonomic::default() }.into(),
        ..Agent::default()
    };
    world.add_agent(agent.with_body(Body::capsule(2.0, 0.6))).unwrap();
    run(&mut world, 40.0, |_| ());
    let summary = world.summary();
    assert_eq!((summary.arrived, summary.overlaps), (1, 0), "{summary:?}");
}

#[test]
fn threads_and_order_change_no_bit() {
    let of = |threads, order| with_threads(threads, || history(mixed(1, 0.05, SubSteps::Auto, order)));
    let first = of(1, 0);
    assert!(first == of(3, 0), "threads");
    assert!(first == of(2, 9), "order of insertion");
}

#[test]
fn a_loaded_world_of_all_shapes_continues_with_the_same_bits() {
    let mut world = mixed(2, 0.1, SubSteps::Auto, 0);
    for _ in 0..30 {
        world.step();
    }
    let saved = world.save();
    let mut loaded = mixed(2, 0.1, SubSteps::Auto, 0);
    loaded.load(&saved).unwrap();
    for _ in 0..40 {
        world.step();
        loaded.step();
        assert_eq!(bits(&world), bits(&loaded));
    }
    assert_eq!(world.summary(), loaded.summary());
}

#[test]
fn the_unguarded_overlap_each_other_and_are_seen_to_the_guarded_are_not() {
    for guard in [false, true] {
        let mut world = with_settings(0.04, SubSteps::Auto, DVec2::ZERO);
        let model = Arc::new(NoAvoidance);
        let group = Group { guard: false, model, look_ahead: false, keep_right: 0.0, ..Group::default() };
        let ghosts = world.add_group(group.clone()).unwrap();
        let other = if guard { world.add_group(Group { guard: true, ..group }).unwrap() } else { ghosts };
        let wall = vec![DVec2::new(2.0, -3.0), DVec2::new(2.0, 3.0)];
        world.add_obstacle(Obstacle::Wall { points: wall }).unwrap();
        for (x, group) in [(-1.0, ghosts), (1.0, other)] {
            let journey = journey_to(&mut world, DVec2::new(-x, 0.0));
            world
                .add_agent(Agent { position: DVec2::new(x, 0.0).extend(0.0), journey, group, ..Agent::default() })
                .unwrap();
        }
        // nothing keeps an unguarded agent out of a wall, at the start either
        let at = DVec2::new(2.07, 2.0);
        world.add_agent(Agent { position: at.extend(0.0), group: ghosts, ..Agent::default() }).unwrap();
        run(&mut world, 5.0, |_| ());
        let summary = world.summary();
        assert_eq!(summary.least_separation < 0.5, !guard, "{summary:?}");
        assert!(summary.least_wall_separation < 0.6 && summary.overlaps > 0, "{summary:?}");
    }
}

#[test]
fn shapes_out_of_their_limits_are_refused() {
    let mut world = with_settings(0.04, SubSteps::Auto, DVec2::ZERO);
    for core in [Vec2::new(-1.0, 0.0), Vec2::new(f32::NAN, 0.0), Vec2::new(0.0, 2000.0)] {
        assert!(world.add_agent(Agent { core, ..Agent::default() }).is_err(), "{core}");
    }
    let wall = vec![DVec2::new(-3.0, 0.5), DVec2::new(3.0, 0.5)];
    world.add_obstacle(Obstacle::Wall { points: wall }).unwrap();
    for (heading, fits) in [(0.0, true), (1.5, false), (3.1, true)] {
        let agent = Agent { heading: Some(heading), ..Agent::default() }.with_body(Body::capsule(2.0, 0.4));
        assert_eq!(world.add_agent(agent).is_ok(), fits, "{heading}");
    }
}

/// A group without a neighbour search, alone and beside one that has it, of long bodies and discs.
#[test]
fn agents_that_look_for_no_neighbours() {
    for (alone, long) in [(true, true), (true, false), (false, true), (false, false)] {
        let mut world = with_settings(0.1, SubSteps::Auto, DVec2::ZERO);
        let blind = Group { neighbours: 0, model: Arc::new(NoAvoidance), ..Group::default() };
        let blind = world.add_group(blind).unwrap();
        for k in 0..8 {
            let at = DVec2::new(f64::from(k % 4), 1.5 * f64::from(k / 4));
            let agent = Agent::at(at).goal(at + DVec2::new(0.1 * f64::from(k), 6.0 + 0.3 * f64::from(k % 3)));
            let agent = if long { agent.with_body(Body::capsule(0.8, 0.3)) } else { agent };
            world.add_agent(if alone || k % 2 == 0 { agent.group(blind) } else { agent }).unwrap();
        }
        run(&mut world, 20.0, |_| ());
        let summary = world.summary();
        assert_eq!((summary.overlaps, world.counts().arrived), (0, 8), "{alone} {long} {summary:?}");
    }
}
