//! The look-ahead of agents.

use crate::world::common::{journey_into, run_for, walker, with_settings};
use crate::world::oracle::Snapshot;
use glam::DVec2;
use throng::{Agent, Goal, Group, Obstacle, SubSteps, Walkable, World};

/// The sideways deviation of two agents that pass each other on lines 1 m apart; `between` builds walls along the line
/// between them, given its ends.
fn strayed(between: impl Fn(&mut World, DVec2, DVec2)) -> f64 {
    let origin = DVec2::new(830.0, -4100.0);
    let (along, off) = (DVec2::from_angle(0.7), 0.5);
    let mut world = with_settings(0.04, SubSteps::Auto, origin);
    let group = world.add_group(Group::default()).unwrap();
    between(&mut world, origin - along * 12.0, origin + along * 12.0);
    for side in [1.0, -1.0] {
        let way = |part: f64| origin + (along * part + along.perp() * off) * side;
        let agent = walker(&mut world, way(-8.0), way(8.0));
        world.add_agent(Agent { group, ..agent }).unwrap();
    }
    let mut most = 0.0f64;
    run_for(&mut world, 15.0, |world| {
        let places = Snapshot::of(world).positions;
        for (place, side) in places.into_iter().zip([1.0, -1.0]) {
            most = most.max(((place - origin).dot(along.perp()) * side - off).abs());
        }
    });
    assert!(world.finished(), "both arrive");
    most
}

#[test]
fn agents_that_a_wall_hides_are_not_avoided() {
    let seen = strayed(|_, _, _| {});
    assert!(seen > 0.02, "they make room for each other: {seen}");
    let hidden = strayed(|world, start, end| {
        world.add_obstacle(Obstacle::Wall { points: vec![start, end] }).unwrap();
    });
    assert!(hidden < 1e-3, "{hidden}");
}

/// The least distance from the inner corner of a bend, for a single agent that starts `off` from the wall on that side.
fn nearest_to_the_corner(look_ahead: bool, off: f64) -> f64 {
    let corner = DVec2::new(-512.0, 77.0);
    let mut world = with_settings(0.04, SubSteps::Auto, corner);
    let at = |x: f64, y: f64| corner + DVec2::new(x, y);
    let outer = vec![at(-12.0, -3.0), at(3.0, -3.0), at(3.0, 12.0), at(0.0, 12.0), at(0.0, 0.0), at(-12.0, 0.0)];
    world.set_walkable(vec![Walkable { outer, holes: vec![] }]).unwrap();
    let group = world.add_group(Group { look_ahead, keep_right: 0.0, ..Group::default() }).unwrap();
    let agent = walker(&mut world, at(-10.0, -off), at(off, 10.0));
    world.add_agent(Agent { group, ..agent }).unwrap();
    let mut least = f64::INFINITY;
    run_for(&mut world, 25.0, |world| least = least.min(Snapshot::of(world).positions[0].distance(corner)));
    assert!(world.finished(), "it arrives");
    least
}

#[test]
fn agents_keep_their_places_in_a_bend() {
    let taut = nearest_to_the_corner(false, 1.0);
    assert!(taut < 0.2, "without looking ahead they touch the corner: {taut}");
    let places = [0.3, 0.6, 1.0].map(|off| nearest_to_the_corner(true, off));
    let kept = places.iter().zip([0.3, 0.6, 1.0]).all(|(place, off)| (0.6 * off..1.2 * off).contains(place));
    assert!(kept && places.is_sorted(), "{places:?}");
}

/// The distance from the inner wall at which an agent leaves a corridor, if it starts `off` from that wall, before a
/// bend. The exit is as wide as the corridor.
fn leave_at(off: f64, turned: f64) -> f64 {
    let corner = DVec2::new(90.0, -640.0);
    let mut world = with_settings(0.04, SubSteps::Auto, corner);
    let at = |x: f64, y: f64| corner + DVec2::from_angle(turned).rotate(DVec2::new(x, y));
    let outer = vec![at(-12.0, -3.0), at(3.0, -3.0), at(3.0, 12.0), at(0.0, 12.0), at(0.0, 0.0), at(-12.0, 0.0)];
    world.set_walkable(vec![Walkable { outer, holes: vec![] }]).unwrap();
    let corners = vec![at(0.0, 10.0), at(3.0, 10.0), at(3.0, 12.0), at(0.0, 12.0)];
    let journey = journey_into(&mut world, Goal::Exit { corners });
    world.add_agent(Agent { position: at(-8.0, -off).extend(0.0), journey, ..Agent::default() }).unwrap();
    let mut last = corner;
    run_for(&mut world, 25.0, |world| last = Snapshot::of(world).positions.first().copied().unwrap_or(last));
    assert!(world.finished(), "it leaves");
    (last - corner).dot(DVec2::from_angle(turned))
}

#[test]
fn agents_leave_where_they_come_to_the_exit() {
    for turned in [0.0, 0.9, 4.0] {
        let places = [0.4, 0.7, 1.0].map(|off| leave_at(off, turned));
        // the agent swings out of the bend by its speed times its relaxation time, 0.6 m
        let kept = places.iter().zip([0.4, 0.7, 1.0]).all(|(place, off)| (0.6 * off..off + 0.6).contains(place));
        assert!(kept && places.is_sorted(), "turned by {turned}: {places:?}");
    }
}
