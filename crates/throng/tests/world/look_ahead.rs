//! What agents see when they look ahead.

use crate::common::{run_for, walker, with_settings};
use crate::oracle::Snapshot;
use glam::DVec2;
use throng::{Group, Obstacle, SubSteps, World};

/// How far two agents that walk past each other, their ways 1.24 m apart, stray to the side; `between` builds walls along
/// the line between them, given its ends.
fn strayed(between: impl Fn(&mut World, DVec2, DVec2)) -> f64 {
    let origin = DVec2::new(830.0, -4100.0);
    let (along, off) = (DVec2::from_angle(0.7), 0.62);
    let mut world = with_settings(0.04, SubSteps::Auto, origin);
    let group = world.add_group(Group::default()).unwrap();
    between(&mut world, origin - along * 12.0, origin + along * 12.0);
    for side in [1.0, -1.0] {
        let way = |part: f64| origin + (along * part + along.perp() * off) * side;
        let agent = walker(&mut world, way(-8.0), way(8.0));
        world.add_agent(throng::Agent { group, ..agent }).unwrap();
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
