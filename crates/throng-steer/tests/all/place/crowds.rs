//! Crowds on a path and at a door.

use super::{Shared, barriers, nearest};
use crate::harness::{Actor, RADIUS, RATES, Stage};
use glam::{Quat, Vec3};
use std::f32::consts::FRAC_PI_6;
use std::sync::Arc;
use throng::motion::{Motion, Vehicle};
use throng::space::Pathway;
use throng::space::surface::{Cuboid, Moved, Pose};
use throng::steer::Target;
use throng_steer::{CrowdPath, QueueAtDoor};

/// The least distance between two agents.
fn least_gap(stage: &Stage) -> f32 {
    let places: Vec<Vec3> = stage.actors.iter().map(|actor| actor.motion.position).collect();
    let pairs = places.iter().enumerate().flat_map(|(k, a)| places[..k].iter().map(|b| a.distance(*b)));
    pairs.fold(f32::INFINITY, f32::min)
}

/// A crowd on a ring stays on it, moves on, and does not overlap much.
#[test]
fn a_crowd_walks_along_a_path() {
    let corners: Vec<Vec3> = (0..12).map(|k| Quat::from_rotation_z(k as f32 * FRAC_PI_6) * Vec3::X * 6.0).collect();
    let path = Pathway::new(&corners, 1.2, true).unwrap();
    let actors = (0..24).map(|k| {
        let place = path.at(k as f32 * 1.4) * (0.9 + 0.1 * (k % 3) as f32);
        let vehicle = Vehicle { max_speed: 1.2 + 0.02 * k as f32, ..Vehicle::default() };
        Actor::new(Motion::at_rest(place, Vec3::Z.cross(place)), vehicle, CrowdPath::new(path.clone()))
    });
    for seconds in RATES {
        let mut stage = Stage::new(seconds, actors.clone().collect());
        let (mut least, mut outside, mut speed, mut steps) = (f32::INFINITY, f32::NEG_INFINITY, 0.0, 0.0);
        stage.run(120.0, |stage| {
            if stage.time() > 5.0 {
                least = least.min(least_gap(stage));
                for Actor { motion, .. } in &stage.actors {
                    outside = outside.max(path.nearest(motion.position).outside);
                    speed += motion.velocity.dot(Vec3::Z.cross(motion.position).normalize()) / 24.0;
                    steps += 1.0 / 24.0;
                }
            }
        });
        assert!(least > 1.6 * RADIUS && outside < 0.3 && speed / steps > 0.8, "{least} {outside} {}", speed / steps);
    }
}

/// All agents get through a door, none through the wall.
#[test]
fn a_crowd_queues_at_a_door() {
    let half = |y: f32| {
        let pose = Pose::at(Vec3::new(5.0, y, 0.0)).unwrap();
        Arc::new(Moved::new(Cuboid::new(Vec3::new(0.4, 10.0, 4.0)).unwrap(), pose)) as Shared
    };
    let walls = [half(5.6), half(-5.6)];
    let actors = (0..20).map(|k| {
        let place = Vec3::new(-(k / 5) as f32 * 0.8, (k % 5) as f32 * 0.9 - 1.8, 0.0);
        let (goal, door) = (Target::Point(Vec3::X * 12.0), Target::Point(Vec3::X * 5.0));
        let queue = QueueAtDoor { goal, door, obstacles: barriers(&walls) };
        Actor::new(Motion::at_rest(place, Vec3::X), Vehicle::default(), queue)
    });
    for seconds in RATES {
        let mut stage = Stage::new(seconds, actors.clone().collect());
        let (mut least, mut off) = (f32::INFINITY, f32::INFINITY);
        stage.run(60.0, |stage| {
            least = least.min(least_gap(stage));
            off = stage.actors.iter().map(|actor| nearest(&walls, actor.motion.position)).fold(off, f32::min);
        });
        let through = stage.actors.iter().filter(|actor| actor.motion.position.x > 5.5).count();
        assert!(through == 20 && off > 0.0 && least > 1.6 * RADIUS, "{through} {off} {least}");
    }
}
