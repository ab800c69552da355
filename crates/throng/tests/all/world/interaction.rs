//! Which agents avoid each other: layers, one-sided and mutual avoidance, and right of way.

use crate::world::common::{run_for, with_settings};
use crate::world::oracle::Snapshot;
use glam::DVec2;
use throng::{Agent, Goal, Group, Journey, Stop, SubSteps, World};

/// The sideways deviation of each of two agents that meet head-on, slightly off the middle, and the least distance of
/// their centres. There is no keep-right: the deviation is avoidance.
fn meeting(change: impl Fn(usize, Agent) -> Agent) -> ([f64; 2], f64) {
    let angle = 0.9;
    let origin = DVec2::new(-5200.0, 310.0);
    let mut world = with_settings(0.04, SubSteps::Fixed(2), origin);
    let group = world.add_group(Group { look_ahead: false, keep_right: 0.0, ..Group::default() }).unwrap();
    let along = DVec2::from_angle(angle);
    for (index, side) in [1.0, -1.0].into_iter().enumerate() {
        let off = along.perp() * (0.03 * side);
        let goal = Goal::Point { at: origin + along * (7.0 * side) + off, tolerance: 0.1 };
        let goal = world.add_goal(goal).unwrap();
        let journey = world.add_journey(Journey { stops: vec![Stop { goal, wait: 0.0 }], repeat: false }).unwrap();
        let position = origin - along * (7.0 * side) + off;
        world
            .add_agent(change(
                index,
                Agent { position: position.extend(0.0), journey, group, radius: 0.2, ..Agent::default() },
            ))
            .unwrap();
    }
    let (mut strayed, mut least) = ([0.0f64; 2], f64::INFINITY);
    run_for(&mut world, 20.0, |world| {
        let positions = Snapshot::of(world).positions;
        for (index, side) in [1.0, -1.0].into_iter().enumerate() {
            let off = (positions[index] - origin).dot(along.perp()) - 0.03 * side;
            strayed[index] = strayed[index].max(off.abs());
        }
        least = least.min(positions[0].distance(positions[1]));
    });
    assert!(world.finished(), "both arrive");
    (strayed, least)
}

#[test]
fn equals_share_the_avoiding() {
    let ([a, b], least) = meeting(|_, agent| agent);
    assert!((a - b).abs() < 0.02 && a > 0.12 && a < 0.3, "{a} {b}");
    assert!(least >= 0.4 * (1.0 - 1e-4), "{least}");
}

#[test]
fn unseen_agents_are_not_avoided_and_the_seeing_agent_does_all_of_it() {
    let ([blind, seeing], least) = meeting(|index, agent| match index {
        0 => Agent { layers: 0b10, avoids: 0b10, ..agent },
        _ => Agent { layers: 0b01, avoids: 0b10, ..agent },
    });
    assert!(blind < 1e-3, "an agent without avoidance walks straight: {blind}");
    assert!(seeing > 0.3 && seeing < 0.5, "{seeing}");
    assert!(least >= 0.4 * (1.0 - 1e-4), "one avoiding agent is enough to be solid: {least}");
}

#[test]
fn two_worlds_in_one_place_do_not_touch() {
    let (strayed, least) = meeting(|index, agent| Agent { layers: 1 << index, avoids: 1 << index, ..agent });
    assert!(strayed[0] < 1e-3 && strayed[1] < 1e-3, "{strayed:?}");
    assert!(least < 0.1, "they walk through each other: {least}");
}

#[test]
fn bodies_of_other_layers_are_no_overlap() {
    let mut world = with_settings(0.05, SubSteps::Auto, DVec2::ZERO);
    for layer in [0b01, 0b10] {
        world.add_agent(Agent { layers: layer, avoids: layer, ..Agent::default() }).unwrap();
    }
    assert_eq!(world.overlapping(), []);
    world.step();
    assert_eq!(world.summary().overlaps, 0);
    assert_eq!(world.relative_columns().position[0], world.relative_columns().position[1]);
}

/// Of three agents at one place: 0 and 1 are solid to each other because 1 avoids 0; 2 is solid to neither.
#[test]
fn one_sided_overlaps_are_reported() {
    let mut world = with_settings(0.05, SubSteps::Auto, DVec2::ZERO);
    for (layers, avoids) in [(0b001, 0b000), (0b010, 0b001), (0b100, 0b100)] {
        world.add_agent(Agent { layers, avoids, ..Agent::default() }).unwrap();
    }
    assert_eq!(world.overlapping(), [(0, 1, 0.0)]);
}

#[test]
fn the_higher_priority_strays_less_and_a_whole_one_not_at_all() {
    let with =
        |priority: f32| meeting(move |index, agent| Agent { priority: priority * (index == 0) as u8 as f32, ..agent });
    let ([equal, _], _) = with(0.0);
    let ([half, yields], _) = with(0.5);
    let ([whole, does_all], least) = with(1.0);
    assert!(half < 0.75 * equal && yields > 1.25 * equal, "{equal}: {half} {yields}");
    assert!(whole < 0.01, "{whole}");
    assert!(does_all > 0.3, "{does_all}");
    assert!(least >= 0.4 * (1.0 - 1e-4));
}

/// A column walks straight through a standing crowd that gives way to it, with little delay.
#[test]
fn resting_agents_make_way_for_walking_agents() {
    let mut world: World = with_settings(0.04, SubSteps::Auto, DVec2::new(0.0, 9000.0));
    let origin = world.settings().origin;
    for k in 0..45 {
        let at = DVec2::new(f64::from(k % 9) - 4.0, 0.6 * f64::from(k / 9) - 1.2);
        world.add_agent(Agent::at(origin + at)).unwrap();
    }
    let walker =
        crate::world::common::walker(&mut world, origin + DVec2::new(-9.0, 0.1), origin + DVec2::new(9.0, -0.2));
    let id = world.add_agent(walker).unwrap();
    run_for(&mut world, 30.0, crate::world::oracle::assert_free);
    let left = world.position(id).unwrap().distance((origin + DVec2::new(9.0, -0.2)).extend(0.0));
    assert!(left < 0.11, "{left} m from its goal");
}
