//! No agent is stuck: symmetric meetings, rings, traps, doors, and agents with very different speeds.

use crate::world::common::{Draw, journey_into, journey_to, rectangle, run, walker, world};
use crate::world::oracle::assert_free;
use glam::DVec2;
use throng::motion::Holonomic;
use throng::{Agent, Goal, Group, GroupId, Journey, Obstacle, Stop, World};

/// Runs until all agents have arrived, without overlaps; fails after `limit` seconds.
fn assert_all_arrive(world: &mut World, limit: f64, label: &str) {
    run(world, limit, assert_free);
    let left: Vec<_> = (0..world.relative_columns().len())
        .filter(|&row| world.relative_columns().trip(row).arrived.is_none())
        .map(|row| (world.relative_columns().number[row], world.relative_columns().position[row]))
        .collect();
    assert!(left.is_empty() && world.finished(), "{label}: not there after {limit} s: {left:?}");
}

/// Exactly symmetric, up to the rounding of a rotated axis.
#[test]
fn two_agents_that_meet_head_on_pass() {
    for angle in [0.0, 0.5, 1.9, 3.3, 5.0] {
        for speeds in [(1.3, 1.3), (0.4, 1.7)] {
            let mut world = world(0.04, DVec2::new(6000.0, -250.0));
            let origin = world.settings().origin;
            let along = DVec2::from_angle(angle);
            for (side, speed) in [(1.0, speeds.0), (-1.0, speeds.1)] {
                let plain = walker(&mut world, origin - along * (5.0 * side), origin + along * (5.0 * side));
                world.add_agent(Agent { preferred_speed: speed, ..plain }).unwrap();
            }
            assert_all_arrive(&mut world, 40.0, &format!("{speeds:?} at {angle} rad"));
        }
    }
}

/// Without keep-right only the detour breaks the symmetry.
#[test]
fn two_agents_without_a_preferred_side_pass_too() {
    for keep_right in [0.0, -0.1] {
        let mut world = world(0.05, DVec2::ZERO);
        let group = world.add_group(Group { keep_right, ..Group::default() }).unwrap();
        for side in [1.0, -1.0] {
            let plain = walker(&mut world, DVec2::new(-4.0 * side, 0.0), DVec2::new(4.0 * side, 0.0));
            world.add_agent(Agent { group, ..plain }).unwrap();
        }
        assert_all_arrive(&mut world, 30.0, &format!("keep right {keep_right}"));
    }
}

#[test]
fn rings_of_odd_sizes_at_odd_angles_pass_through_their_middle() {
    for (count, radius, angle) in [(3, 3.0, 0.1), (7, 4.0, 0.77), (13, 5.0, 2.3), (25, 6.0, 1.234), (51, 9.0, 0.4)] {
        let mut world = world(1.0 / 30.0, DVec2::new(-1200.0, 8800.0));
        let origin = world.settings().origin;
        for k in 0..count {
            let spoke = DVec2::from_angle(angle + std::f64::consts::TAU * f64::from(k) / f64::from(count)) * radius;
            let agent = walker(&mut world, origin + spoke, origin - spoke);
            world.add_agent(agent).unwrap();
        }
        assert_all_arrive(&mut world, 60.0, &format!("a ring of {count}"));
    }
}

#[test]
fn a_ring_of_all_sizes_and_speeds_passes_too() {
    let mut draw = Draw::new(17);
    let mut world = world(0.05, DVec2::new(40.0, 40.0));
    let origin = world.settings().origin;
    for k in 0..21 {
        let spoke = DVec2::from_angle(0.3 * f64::from(k)) * (5.0 + 0.15 * f64::from(k));
        let plain = walker(&mut world, origin + spoke, origin - spoke);
        let preferred_speed = draw.between(0.3, 1.8) as f32;
        let radius = draw.between(0.1, 0.5) as f32;
        world.add_agent(Agent { preferred_speed, radius, ..plain }).unwrap();
    }
    assert_all_arrive(&mut world, 120.0, "mixed ring");
}

/// A trap open towards the approaching agents, with the goals behind its bottom.
#[test]
fn out_of_a_trap_all_agents_find_the_way() {
    for angle in [0.0, 1.1, 4.0] {
        let mut world = world(0.05, DVec2::new(-7000.0, -7000.0));
        let origin = world.settings().origin;
        let turn = |x: f64, y: f64| origin + DVec2::from_angle(angle).rotate(DVec2::new(x, y));
        let points = vec![turn(-4.0, 2.5), turn(2.0, 2.5), turn(2.0, -2.5), turn(-4.0, -2.5)];
        world.add_obstacle(Obstacle::Wall { points }).unwrap();
        for k in 0..12 {
            let (x, y) = (f64::from(k % 4), f64::from(k / 4) - 1.0);
            let agent = walker(&mut world, turn(x - 2.0, y), turn(5.0 + x, 1.5 * y));
            world.add_agent(agent).unwrap();
        }
        assert_all_arrive(&mut world, 90.0, &format!("a trap at {angle} rad"));
    }
}

/// A wall with one door, agents on both sides, all with goals on the other side.
#[test]
fn a_door_is_used_both_ways() {
    for (width, each, angle, seed) in [(1.2, 6, 0.6, 1), (1.6, 15, 2.0, 2), (0.9, 3, 3.6, 3)] {
        let mut draw = Draw::new(seed);
        let mut world = world(0.05, DVec2::new(310.0, -4600.0));
        let origin = world.settings().origin;
        let turn = |x: f64, y: f64| origin + DVec2::from_angle(angle).rotate(DVec2::new(x, y));
        for side in [-1.0, 1.0] {
            let points = vec![turn(0.0, 0.5 * width * side), turn(0.0, 40.0 * side)];
            world.add_obstacle(Obstacle::Wall { points }).unwrap();
        }
        for side in [-1.0, 1.0] {
            for k in 0..each {
                let (x, y) = (3.0 + f64::from(k / 5), f64::from(k % 5) - 2.0);
                let to = turn(side * (3.0 + f64::from(k / 5)), -y);
                let off = draw.between(-0.1, 0.1);
                let agent = walker(&mut world, turn(-side * x, y + off), to);
                world.add_agent(agent).unwrap();
            }
        }
        assert_all_arrive(&mut world, 120.0, &format!("a door of {width} m, {each} from each side"));
    }
}

/// Two dense crowds in a corridor, four abreast: agents that touch slide past each other; otherwise all would stand.
#[test]
fn crowds_that_meet_in_a_corridor_squeeze_past_each_other() {
    for (width, each, angle, seed) in [(2.0, 60, 0.7, 1), (1.7, 40, 2.9, 2)] {
        let mut draw = Draw::new(seed);
        let mut world = world(0.05, DVec2::new(720.0, 80.0));
        let origin = world.settings().origin;
        let turn = |x: f64, y: f64| origin + DVec2::from_angle(angle).rotate(DVec2::new(x, y));
        let (half, length) = (0.5 * width, f64::from(each) / (1.9 * width));
        for side in [-1.0, 1.0] {
            let points = vec![turn(-length - 9.0, half * side), turn(length + 9.0, half * side)];
            world.add_obstacle(Obstacle::Wall { points }).unwrap();
        }
        for side in [-1.0, 1.0] {
            let corners = rectangle(turn(-side * (length + 6.0), 0.0), DVec2::new(3.0, width), angle);
            let journey = journey_into(&mut world, Goal::Exit { corners });
            let lanes = 4;
            for k in 0..each {
                let (x, y) =
                    (2.5 + length * f64::from(k) / f64::from(each), f64::from(k % lanes) / f64::from(lanes - 1));
                let place = turn(side * x + draw.between(-0.02, 0.02), (half - 0.22) * (2.0 * y - 1.0));
                let preferred_speed = draw.between(1.1, 1.6) as f32;
                let agent =
                    Agent { radius: 0.2, preferred_speed, position: place.extend(0.0), journey, ..Agent::default() };
                world.add_agent(agent).unwrap();
            }
        }
        assert_all_arrive(&mut world, 200.0, &format!("{width} m, {each} from each side"));
    }
}

#[test]
fn the_fast_get_past_the_slow() {
    let mut world = world(0.04, DVec2::ZERO);
    let group = GroupId::DEFAULT;
    for k in 0..10 {
        let (speed, x) = if k % 2 == 0 { (0.2, 0.0) } else { (2.0, -3.0 - f64::from(k)) };
        let y = 0.45 * f64::from(k / 2);
        let plain = walker(&mut world, DVec2::new(x, y), DVec2::new(8.0 + f64::from(k), y));
        world
            .add_agent(Agent {
                preferred_speed: speed,
                group,
                motor: Holonomic { max_speed: 1.3 * speed, ..Holonomic::default() }.into(),
                ..plain
            })
            .unwrap();
    }
    run(&mut world, 25.0, assert_free);
    let fast_arrived =
        (0..10).filter(|&row| row % 2 == 1 && world.relative_columns().trip(row).arrived.is_some()).count();
    assert_eq!(fast_arrived, 5, "25 s are plenty for 20 m at 2 m/s");
    assert_all_arrive(&mut world, 160.0, "fast and slow");
}

/// The goal of each agent is occupied by an agent that stays.
#[test]
fn occupied_goals_count_as_reached_next_to_their_occupants() {
    let mut world = world(0.05, DVec2::new(2.0, -3000.0));
    let origin = world.settings().origin;
    let journey = journey_to(&mut world, origin);
    for k in 0..9 {
        let spoke = DVec2::from_angle(0.2 + 0.7 * f64::from(k)) * if k == 0 { 0.05 } else { 3.0 + 0.3 * f64::from(k) };
        world.add_agent(Agent { position: (origin + spoke).extend(0.0), journey, ..Agent::default() }).unwrap();
    }
    assert_all_arrive(&mut world, 30.0, "one goal");
}

/// The way leads round the end of a wall on the right, and right there stands an agent that does not give way. Detours
/// to the right lead into the wall: only the left is free.
#[test]
fn an_agent_with_a_wall_on_the_right_gets_by_on_the_left() {
    for (case, angle) in [0.0, 0.9, 2.2, 3.8, 5.1].into_iter().enumerate() {
        let mut world = world(0.05, DVec2::new(1300.0, -900.0));
        let origin = world.settings().origin;
        let turn = |x: f64, y: f64| origin + DVec2::from_angle(angle).rotate(DVec2::new(x, y));
        world.add_obstacle(Obstacle::Wall { points: vec![turn(0.0, 0.0), turn(0.0, -30.0)] }).unwrap();
        // 1 cm off the wall's end, on the way
        let off = DVec2::from_angle(2.2 + 0.1 * case as f64) * 0.21;
        world.add_agent(Agent { position: turn(off.x, off.y).extend(0.0), avoids: 0, ..Agent::default() }).unwrap();
        let agent = walker(&mut world, turn(-4.0, -1.0), turn(4.0, -1.0));
        world.add_agent(agent).unwrap();
        assert_all_arrive(&mut world, 60.0, &format!("an end of a wall at {angle} rad"));
    }
}

/// A crowd that gathers at the end of a passage, three abreast: most agents cannot come as near as in an open place.
#[test]
fn a_crowd_arrives_in_a_dead_end_too() {
    for (angle, width, seed) in [(0.0, 1.3, 1), (0.8, 1.7, 2), (2.6, 1.0, 3)] {
        let mut draw = Draw::new(seed);
        let mut world = world(0.05, DVec2::new(-40.0, 5500.0));
        let origin = world.settings().origin;
        let turn = |x: f64, y: f64| origin + DVec2::from_angle(angle).rotate(DVec2::new(x, y));
        let half = 0.5 * width;
        let points = vec![turn(-40.0, half), turn(0.5, half), turn(0.5, -half), turn(-40.0, -half)];
        world.add_obstacle(Obstacle::Wall { points }).unwrap();
        let journey = journey_to(&mut world, origin);
        for k in 0..40 {
            let y = (half - 0.25) * if k % 2 == 0 { 1.0 } else { -1.0 };
            let position = turn(-2.0 - 0.35 * f64::from(k) + draw.between(-0.1, 0.1), y);
            world.add_agent(Agent { position: position.extend(0.0), journey, ..Agent::default() }).unwrap();
        }
        assert_all_arrive(&mut world, 160.0, &format!("a passage of {width} m"));
    }
}

/// A ring-shaped corridor between walls, one body wide, and agents that go round it in single file: the gap between
/// their centres in diameters, their number and radius, the time step, and the side.
fn roundabout((gap, count, body, step, side): (f64, u32, f64, f64, f64), group: Group) -> World {
    let mut world = world(step, DVec2::new(-800.0, 70.0));
    let group = world.add_group(group).unwrap();
    let origin = world.settings().origin;
    let spoke = |part: f64| DVec2::from_angle(0.3 + side * part * std::f64::consts::TAU);
    let radius = body * gap / (std::f64::consts::PI / f64::from(count)).sin();
    world.add_obstacle(Obstacle::Circle { center: origin, radius: radius - 1.25 * body }).unwrap();
    let points = (0..=64).map(|k| origin + spoke(f64::from(k) / 64.0) * (radius + 1.5 * body)).collect();
    world.add_obstacle(Obstacle::Wall { points }).unwrap();
    let goal = |k: usize| Goal::Point { at: origin + spoke(k as f64 / 8.0) * radius, tolerance: 1.5 * body as f32 };
    let goals = [0, 1, 2, 3, 4, 5, 6, 7].map(|k| world.add_goal(goal(k)).unwrap());
    for k in 0..count {
        let eighth = (8 * k / count) as usize;
        let stops = (1..9).map(|stop| Stop { goal: goals[(eighth + stop) % 8], wait: 0.0 }).collect();
        let journey = world.add_journey(Journey { stops, repeat: true }).unwrap();
        let position = origin + spoke(f64::from(k) / f64::from(count)) * radius;
        world
            .add_agent(Agent {
                position: position.extend(0.0),
                journey,
                group,
                radius: body as f32,
                ..Agent::default()
            })
            .unwrap();
    }
    world
}

/// A full ring, without a first agent, with the local model alone.
#[test]
fn a_full_roundabout_turns() {
    for (gap, count, body, step, side) in [
        (1.032, 40, 0.2, 0.04, 1.0),
        (1.035, 40, 0.2, 0.04, 1.0),
        (1.04, 40, 0.2, 0.04, 1.0),
        (1.045, 40, 0.2, 0.04, 1.0),
        (1.034, 24, 0.3, 0.1, 1.0),
        (1.05, 64, 0.15, 1.0 / 60.0, 1.0),
        (1.038, 33, 0.25, 0.05, -1.0),
        (1.1, 40, 0.2, 0.04, 1.0),
    ] {
        let group = Group { look_ahead: false, keep_right: 0.0, ..Group::default() };
        let mut world = roundabout((gap, count, body, step, side), group);
        run(&mut world, 30.0, assert_free);
        let walked = world.relative_columns().walked.iter().sum::<f64>() / f64::from(count);
        let label = format!("{count} of {body} m, {gap} apart");
        // 26 m and more; 39 m at preferred speed
        assert!(world.summary().stuck == 0 && walked > 20.0, "{label}: {walked} m in 30 s, {:?}", world.summary());
    }
}

/// Seyfried, Steffen, Klingsch, Boltes 2005: in single file each pedestrian needs 0.36 m and 1.06 s of its speed.
#[test]
fn a_roundabout_turns_as_fast_as_people_walk_in_single_file() {
    for (each, side) in [(0.6, 1.0), (0.8, -1.0), (0.8, 1.0), (1.04, 1.0), (1.04, -1.0)] {
        let mut world = roundabout((each / 0.4, 40, 0.2, 0.04, side), Group::default());
        run(&mut world, 20.0, assert_free);
        let before = world.relative_columns().walked.iter().sum::<f64>();
        run(&mut world, 50.0, assert_free);
        let speed = (world.relative_columns().walked.iter().sum::<f64>() - before) / (40.0 * 30.0);
        let people = (each - 0.36) / 1.06;
        assert!((speed - people).abs() < 0.15, "{each} m each: {speed} m/s, people {people}");
    }
}
