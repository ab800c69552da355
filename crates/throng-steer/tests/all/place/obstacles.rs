//! Obstacle avoidance, by the way ahead and by whiskers: no contact, and all agents arrive.

use super::{Shared, barriers, field, first, nearest};
use crate::harness::{Actor, RADIUS, RATES, Stage, flier, told, vector};
use glam::{Quat, Vec3};
use proptest::prelude::*;
use std::slice;
use std::sync::Arc;
use throng::motion::{Motion, Vehicle};
use throng::parameters::Angle;
use throng::space::surface::{Cuboid, Cylinder, Moved, Pose, Sphere, Surface};
use throng::steer::{SteeringInput, SteeringReason, Target};
use throng_steer::{Arrive, AvoidObstacles, Hold, Seek, Whisker, Whiskers};

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    /// Through any field of obstacles an agent gets to the other side without contact.
    #[test]
    fn agents_get_through_without_touching(
        field in field(), y in -4.0f32..4.0, to in -4.0f32..4.0, rate in 0usize..3, flies in any::<bool>(),
    ) {
        let vehicle = if flies { flier() } else { Vehicle::default() };
        let goal = Vec3::new(19.0, to, 0.0);
        let avoid = AvoidObstacles { towards: Target::Point(goal), ..AvoidObstacles::from(barriers(&field)) };
        let walk = first(vec![avoid.into(), Arrive::new(Target::Point(goal)).into()]);
        let start = Motion::moving(Vec3::new(-1.0, y, 0.0), Vec3::X * 1.5);
        let mut stage = Stage::new(RATES[rate], vec![Actor::new(start, vehicle, walk)]);
        let (mut least, mut arrived) = (f32::INFINITY, f32::INFINITY);
        stage.run(40.0, |stage| {
            let place = stage.actors[0].motion.position;
            least = least.min(nearest(&field, place));
            if place.distance(goal) < 0.1 {
                arrived = arrived.min(stage.time() as f32);
            }
        });
        prop_assert!(least > RADIUS, "{least}");
        prop_assert!(arrived < 22.0, "it takes {arrived} s, and ends at {:?}", stage.actors[0].motion);
    }
}

/// An agent that goes to a goal round obstacles.
fn walker(start: Motion, goal: Vec3, all: &[Shared]) -> Actor {
    let goal = Target::Point(goal);
    let avoid = AvoidObstacles { towards: goal, ..AvoidObstacles::from(barriers(all)) };
    Actor::new(start, Vehicle::default(), first(vec![avoid.into(), Arrive::new(goal).into()]))
}

/// Straight at the middle of a wall or a ball: the agent goes round it without a stop and without circling it.
#[test]
fn agents_neither_hesitate_before_a_wall_nor_orbit() {
    let wall: Shared =
        Arc::new(Moved::new(Cuboid::new(Vec3::new(0.5, 8.0, 4.0)).unwrap(), Pose::at(Vec3::X * 8.0).unwrap()));
    let ball: Shared = Arc::new(Sphere::new(Vec3::X * 8.0, 3.0).unwrap());
    for (surface, detour) in [(wall, 20.0), (ball, 18.5)] {
        for seconds in RATES {
            let start = Motion::moving(Vec3::ZERO, Vec3::X * 1.5);
            let mut stage = Stage::new(seconds, vec![walker(start, Vec3::X * 16.0, slice::from_ref(&surface))]);
            let (mut slowest, mut arrived, mut turned, mut before) = (f32::INFINITY, 0.0, 0.0, Vec3::X);
            let mut sides = vec![];
            stage.run(30.0, |stage| {
                let Actor { motion, .. } = &stage.actors[0];
                if motion.position.distance(Vec3::X * 16.0) > 2.0 {
                    slowest = slowest.min(motion.speed());
                    arrived = stage.time() as f32;
                    turned += before.angle_between(motion.basis.forward);
                    before = motion.basis.forward;
                }
                if motion.position.y.abs() > 0.3 && sides.last() != Some(&motion.position.y.signum()) {
                    sides.push(motion.position.y.signum());
                }
            });
            let what = format!("{surface:?} at {seconds}");
            assert!(slowest > 0.4, "{what}: it stops, at {slowest} m/s");
            assert!(arrived < 1.25 * detour / 1.8, "{what}: it takes {arrived} s");
            assert!(turned < 13.0 && sides.len() == 1, "{what}: it turns by {turned}, {sides:?}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    /// Of all rays, sampled in small steps, the first touch of the surface counts.
    #[test]
    fn the_nearest_touch_of_a_whisker_counts(place in vector(4.0), velocity in vector(1.0)) {
        prop_assume!(velocity.length() > 0.1 && place.length() > 1.6);
        let ball = Sphere::new(Vec3::ZERO, 1.5).unwrap();
        let rays = [(0.0, 0.0, 3.0), (0.2, 0.5, 2.0), (-0.2, -0.5, 2.0)];
        let view = SteeringInput { motion: Motion::moving(place, velocity), vehicle: flier(), ..SteeringInput::default() };
        let basis = view.motion.basis;
        let touches = rays.iter().filter_map(|&(beside, angle, length)| {
            let direction = Quat::from_axis_angle(basis.up, angle) * basis.forward;
            let start = place + basis.side * beside;
            (0..=3000).map(|k| k as f32 * length / 3000.0).find(|&s| (start + direction * s).length() < 1.5).map(|s| (s, start + direction * s))
        });
        let expected = touches.min_by(|a, b| a.0.total_cmp(&b.0));
        let whiskers = rays.map(|(beside, angle, length)| Whisker { beside, angle: Angle::from_radians(angle), length });
        let feel = Whiskers { rays: whiskers.into(), ..Whiskers::single(barriers(&[Arc::new(ball.clone())]), 1.0) };
        let (said, reasons) = told(&feel, &view);
        prop_assert_eq!(said.is_some(), expected.is_some());
        if let Some((_, point)) = expected {
            let touch = |told: &throng::steer::TraceEntry| if let SteeringReason::Hits { point: touched, .. } = told.reason { Some(touched) } else { None };
            let touched = reasons.iter().find_map(touch).expect("it says where it touches");
            prop_assert!(touched.distance(point) < 0.1, "{touched} {point}");
        }
    }
}

/// Round obstacles by whiskers alone.
#[test]
fn whiskers_lead_round() {
    let pillar: Shared = Arc::new(Cylinder::new(Vec3::new(6.0, 0.1, -1.0), Vec3::new(6.0, 0.1, 1.0), 1.5).unwrap());
    let goal = Target::Point(Vec3::X * 12.0);
    for seconds in RATES {
        for whiskers in [
            Whiskers::single(barriers(slice::from_ref(&pillar)), 2.5),
            Whiskers::parallel(barriers(slice::from_ref(&pillar)), 2.5, 0.8),
            Whiskers::fan(barriers(slice::from_ref(&pillar)), 2.5, 1.0, Angle::from_radians(0.6)),
        ] {
            let what = format!("{:?}", whiskers.rays);
            let steady = Hold { seconds: 0.5, of: whiskers.into() };
            let walk = first(vec![steady.into(), Seek { target: goal }.into()]);
            let mut stage = Stage::new(seconds, vec![Actor::new(Motion::default(), Vehicle::default(), walk)]);
            let (mut least, mut arrived) = (f32::INFINITY, false);
            stage.run(15.0, |stage| {
                let place = stage.actors[0].motion.position;
                least = least.min(pillar.query(place).distance);
                arrived |= place.distance(Vec3::X * 12.0) < 0.3;
            });
            assert!(least > 0.0 && arrived, "{what} at {seconds}: {least}, {arrived}");
        }
    }
}
