//! Hiding: a hidden agent cannot be seen.

use super::{Shared, barriers, field, first, nearest};
use crate::harness::{Actor, RADIUS, RATES, Stage, rate};
use glam::Vec3;
use proptest::prelude::*;
use std::sync::Arc;
use throng::motion::{Motion, Vehicle};
use throng::space::surface::{Cylinder, Surface};
use throng::steer::Target;
use throng_steer::{AvoidObstacles, Hide, TargetSpeed, Wander};

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    /// After the time to get there, a hiding agent cannot be seen from the other agent's place, among any trees.
    #[test]
    fn hidden_agents_are_not_seen_among_any_trees(field in field(), x in 4.0f32..14.0, y in -4.0f32..4.0, seconds in rate()) {
        let all = barriers(&field);
        let at = Vec3::new(x, y, 0.0);
        prop_assume!(nearest(&field, at) > 0.5 && nearest(&field, Vec3::ZERO) > 0.5);
        let hide = Hide { obstacles: all, ..Hide::new(Target::Agent(0)) };
        let actors = vec![
            Actor::new(Motion::at_rest(Vec3::ZERO, Vec3::X), Vehicle::default(), TargetSpeed { speed: 0.0 }),
            Actor::new(Motion::at_rest(at, Vec3::X), Vehicle::default(), hide),
        ];
        let mut stage = Stage::new(seconds, actors);
        let mut least = f32::INFINITY;
        stage.run(40.0, |stage| least = least.min(nearest(&field, stage.actors[1].motion.position)));
        let to = stage.actors[1].motion.position;
        let (way, distance) = to.normalize_and_length();
        prop_assert!(least > RADIUS - 0.01, "{least}");
        prop_assert!(stage.actors[1].motion.speed() < 0.01, "it rests there");
        prop_assert!(field.iter().any(|tree| tree.ray(Vec3::ZERO, way, distance).is_some()), "it is seen at {to}");
    }
}

/// After the time to get there, a hiding agent cannot be seen from the other agent's place.
#[test]
fn hidden_agents_are_not_seen() {
    let trees = [(3.0, 4.0, 1.0), (-5.0, 2.0, 1.5), (0.0, -6.0, 0.8), (6.0, -3.0, 1.2)];
    let trees = trees
        .map(|(x, y, r)| Arc::new(Cylinder::new(Vec3::new(x, y, -1.0), Vec3::new(x, y, 1.0), r).unwrap()) as Shared);
    for seconds in RATES {
        let all = barriers(&trees);
        let hunter = first(vec![AvoidObstacles::from(all.clone()).into(), Wander::default().into()]);
        let slow = Vehicle { max_speed: 0.4, ..Vehicle::default() };
        let hide = Hide { obstacles: all, ..Hide::new(Target::Agent(0)) };
        let actors = vec![
            Actor::new(Motion::at_rest(Vec3::ZERO, Vec3::X), slow, hunter),
            Actor::new(Motion::at_rest(Vec3::new(2.0, -1.0, 0.0), Vec3::X), Vehicle::default(), hide),
        ];
        let mut stage = Stage::new(seconds, actors);
        let (mut seen, mut steps) = (0.0, 0.0);
        stage.run(200.0, |stage| {
            let [from, to] = [0, 1].map(|row| stage.actors[row].motion.position);
            assert!(nearest(&trees, to) > RADIUS - 0.01);
            if stage.time() > 10.0 && from.distance(to) > 2.5 {
                let (way, distance) = (to - from).normalize_and_length();
                steps += 1.0;
                seen += f64::from(u8::from(trees.iter().all(|tree| tree.ray(from, way, distance).is_none())));
            }
        });
        assert!(seen < 0.02 * steps, "{} of {steps}", seen / steps);
    }
}
