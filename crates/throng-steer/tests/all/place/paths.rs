//! Paths: followers stay on them.

use super::first;
use crate::harness::{Actor, RATES, Stage, flier, rate};
use glam::{Quat, Vec3};
use proptest::prelude::*;
use std::f32::consts::TAU;
use std::sync::Arc;
use throng::motion::{Motion, Vehicle};
use throng::space::{PathDirection, Pathway};
use throng::steer::BoxedBehaviour;
use throng_steer::{FollowPath, MoveForward, Priority, StayOnPath, Wander};

/// Corners of a path that bends by less than a right angle at each of them.
fn corners() -> impl Strategy<Value = Vec<Vec3>> {
    let bend = (4.0f32..8.0, -1.2f32..1.2, -0.5f32..0.5);
    (prop::collection::vec(bend, 2..7), any::<bool>()).prop_map(|(bends, space)| {
        let (mut at, mut heading) = (Vec3::ZERO, 0.0f32);
        let mut corners = vec![at];
        for (length, turn, slope) in bends {
            heading += turn;
            at += Vec3::new(heading.cos(), heading.sin(), if space { slope } else { 0.0 }) * length;
            corners.push(at);
        }
        corners
    })
}

/// Moves forward where there is nothing to correct.
fn onward(follow: impl Into<BoxedBehaviour>) -> Priority {
    first(vec![follow.into(), MoveForward { part: 0.5 }.into()])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    /// From the start of a path to its end, in either direction, the agent stays on the path, and stops there.
    #[test]
    fn followers_stay_on_the_path(corners in corners(), radius in 0.6f32..1.5, back in any::<bool>(), rate in 0usize..3) {
        let path = Pathway::new(&corners, radius, false).unwrap();
        let way = if back { PathDirection::Backward } else { PathDirection::Forward };
        let (start, end) = (corners[0], corners[corners.len() - 1]);
        let (start, end) = if back { (end, start) } else { (start, end) };
        let follow = FollowPath { direction: way, ..FollowPath::new(path.clone()) };
        let motion = Motion::at_rest(start, Vec3::Y);
        let mut stage = Stage::new(RATES[rate], vec![Actor::new(motion, flier(), onward(follow))]);
        let mut outside = f32::NEG_INFINITY;
        stage.run(path.length() / 1.5 + 8.0, |stage| {
            outside = outside.max(path.nearest(stage.actors[0].motion.position).outside);
        });
        let motion = stage.actors[0].motion;
        prop_assert!(outside <= 0.0, "it leaves the path by {outside}");
        prop_assert!(motion.position.distance(end) < 0.011, "{motion:?}, not {end}");
    }

    /// A wandering agent stays on the path, except inside of bends: it may cut across them where the way to its
    /// predicted position is outside, as deep as the triangle of that way.
    #[test]
    fn wanderers_stay_on_a_path(corners in corners(), radius in 0.8f32..1.6, seed in 0u64..999, seconds in rate()) {
        let path = Arc::new(Pathway::new(&corners, radius, false).unwrap());
        let stay = StayOnPath { path: path.clone(), horizon: 0.6 };
        let wander = first(vec![stay.into(), Wander::default().into()]);
        let start = Motion::at_rest(corners[0], Vec3::X);
        let mut stage = Stage { seed, ..Stage::new(seconds, vec![Actor::new(start, flier(), wander)]) };
        let mut outside = f32::NEG_INFINITY;
        stage.run(100.0, |stage| outside = outside.max(path.nearest(stage.actors[0].motion.position).outside));
        let bend = corners.windows(3).map(|c| (c[1] - c[0]).angle_between(c[2] - c[1])).fold(0.0, f32::max);
        let across = 0.5 * 0.6 * 1.8 * (0.5 * bend).tan();
        prop_assert!(outside < across + 0.1, "{outside}, not {across}");
    }
}

/// Lap after lap on a ring, in either direction.
#[test]
fn rings_are_followed_all_the_way_round() {
    let corners: Vec<Vec3> = (0..7).map(|k| Quat::from_rotation_z(k as f32 * 0.9) * Vec3::X * 6.0).collect();
    let path = Pathway::new(&corners, 0.8, true).unwrap();
    for (way, sense) in [(PathDirection::Forward, 1.0), (PathDirection::Backward, -1.0)] {
        for seconds in RATES {
            let follow = FollowPath { direction: way, ..FollowPath::new(path.clone()) };
            let start = Motion::at_rest(Vec3::X * 6.0, Vec3::X);
            let mut stage = Stage::new(seconds, vec![Actor::new(start, Vehicle::default(), onward(follow))]);
            let (mut turned, mut before) = (0.0, start.position);
            stage.run(120.0, |stage| {
                let place = stage.actors[0].motion.position;
                turned += before.angle_between(place) * before.cross(place).z.signum();
                before = place;
                let outside = path.nearest(place).outside;
                assert!(outside <= 0.0 || stage.time() < 2.0, "{outside} outside at {}", stage.time());
            });
            assert!(turned * sense > 30.0, "{way:?}: it turns by {turned}");
        }
    }
}

/// On an eight the agent never changes arms at the crossing.
#[test]
fn an_eight_is_walked_as_an_eight() {
    let corners: Vec<Vec3> = (0..24)
        .map(|k| k as f32 / 24.0 * TAU)
        .map(|t| Vec3::new(8.0 * (t + 0.1).sin(), 4.0 * (2.0 * (t + 0.1)).sin(), 0.0))
        .collect();
    let path = Pathway::new(&corners, 0.5, true).unwrap();
    for way in [PathDirection::Forward, PathDirection::Backward] {
        for seconds in RATES {
            let follow = FollowPath { direction: way, ..FollowPath::new(path.clone()) };
            let start = Motion::at_rest(corners[0], Vec3::Y);
            let mut stage = Stage::new(seconds, vec![Actor::new(start, Vehicle::default(), onward(follow))]);
            let mut lobes = vec![];
            stage.run(120.0, |stage| {
                let lobe = stage.actors[0].motion.position.x.signum();
                if lobes.last() != Some(&lobe) {
                    lobes.push(lobe);
                }
                let along = stage.actors[0].memory[1];
                assert!(path.at(along).distance(stage.actors[0].motion.position) < 0.6, "it jumped");
            });
            assert!(lobes.len() >= 6, "{lobes:?}");
        }
    }
}
