//! Containment: no agent leaves.

use super::{Shared, barriers, first};
use crate::harness::{Actor, RADIUS, RATES, Stage, flier};
use glam::Vec3;
use std::sync::Arc;
use throng::motion::{Motion, Vehicle};
use throng::parameters::Angle;
use throng::space::surface::{Cuboid, Cylinder, Mesh, SeenFrom, Sphere, Surface};
use throng::steer::{Barriers, BoxedBehaviour};
use throng_steer::{AvoidObstacles, Contain, Wander};

/// A box of triangles with a pyramid on each end, along x: it has corners of all kinds.
fn crystal() -> Mesh {
    let square = |x: f32| [(-2.0, -2.0), (2.0, -2.0), (2.0, 2.0), (-2.0, 2.0)].map(|(y, z)| Vec3::new(x, y, z));
    let points = [&square(-2.0)[..], &square(2.0), &[Vec3::X * -4.0, Vec3::X * 4.0]].concat();
    let sides = (0..4u32).flat_map(|i| {
        let j = (i + 1) % 4;
        [[i, j, j + 4], [i, j + 4, i + 4], [j, i, 8], [i + 4, j + 4, 9]]
    });
    Mesh::new(&points, &sides.collect::<Vec<_>>()).unwrap()
}

/// Returns a lower bound of the distance from a point to the outside of a container.
type Inside = fn(Vec3) -> f32;

/// Containers round the origin, with an independent formula of the distance.
fn containers() -> Vec<(Shared, Inside)> {
    vec![
        (Arc::new(Sphere::new(Vec3::ZERO, 3.0).unwrap()), |p| 3.0 - p.length()),
        (Arc::new(Cuboid::new(Vec3::new(4.0, 5.0, 6.0)).unwrap()), |p| {
            (Vec3::new(2.0, 2.5, 3.0) - p.abs()).min_element()
        }),
        (Arc::new(Cylinder::new(Vec3::Z * -3.0, Vec3::Z * 3.0, 2.5).unwrap()), |p| {
            (2.5 - p.truncate().length()).min(3.0 - p.z.abs())
        }),
        (Arc::new(crystal()), |p| {
            let a = p.abs();
            (2.0 - a.y).min(2.0 - a.z).min((4.0 - a.x - a.y.max(a.z)) / 2.0f32.sqrt())
        }),
    ]
}

/// Agents that wander in a container for ten minutes stay inside, at any rate, on the ground and in the air.
#[test]
fn no_agent_leaves_a_container() {
    for (index, (surface, inside)) in containers().into_iter().enumerate() {
        for (rate, seconds) in RATES.into_iter().enumerate() {
            for vehicle in [Vehicle::default(), flier()] {
                let contain = Contain::inside(surface.clone());
                let wander = Wander { rate: Angle::from_radians(2.0), ..Wander::default() };
                let wanderer = first(vec![contain.into(), wander.into()]);
                let mut stage = Stage::new(seconds, vec![Actor::new(Motion::default(), vehicle, wanderer)]);
                stage.seed = (index * 3 + rate) as u64;
                let (mut least, mut way, mut steps) = (f32::INFINITY, 0.0, 0.0f64);
                stage.run(600.0, |stage| {
                    let motion = &stage.actors[0].motion;
                    least = least.min(inside(motion.position));
                    way += f64::from(motion.speed());
                    steps += 1.0;
                });
                let what = format!("container {index} at {seconds} s, {:?}", vehicle.locomotion);
                let speed = way / steps;
                assert!(least >= RADIUS, "{what}: it came as near as {least} to the surface");
                assert!(speed > 1.0, "{what}: it hardly moves, at {speed} m/s");
            }
        }
    }
}

/// An agent inside an obstacle gets out, an agent outside a container gets in.
#[test]
fn agents_on_the_wrong_side_come_back() {
    let ball: Shared = Arc::new(Sphere::new(Vec3::ZERO, 2.0).unwrap());
    for seconds in RATES {
        for (start, side) in [(0.5, SeenFrom::Outside), (4.0, SeenFrom::Inside)] {
            let all = Barriers::default().with(ball.clone(), side);
            let avoid: BoxedBehaviour = AvoidObstacles::from(all).into();
            for behaviour in [avoid, Contain::on_side(ball.clone(), side).into()] {
                let start = Motion::moving(Vec3::X * start, Vec3::Y);
                let mut stage = Stage::new(seconds, vec![Actor::new(start, flier(), behaviour)]);
                stage.run(6.0, |_| {});
                let distance = ball.query(stage.actors[0].motion.position).distance;
                assert!(if side == SeenFrom::Outside { distance > 0.0 } else { distance < 0.0 }, "{side:?} {distance}");
            }
        }
    }
}

/// Statistics of wandering in a bowl do not depend on the time step: mean speed, mean distance from the centre.
#[test]
fn the_step_does_not_show() {
    let means = RATES.map(|seconds| {
        let contain = Contain::inside(Sphere::new(Vec3::ZERO, 5.0).unwrap());
        let pillar: Shared = Arc::new(Sphere::new(Vec3::ZERO, 1.0).unwrap());
        let avoid = AvoidObstacles::from(barriers(&[pillar]));
        let wanderer = first(vec![contain.into(), avoid.into(), Wander::default().into()]);
        let actors = (0..8).map(|k| {
            Actor::new(
                Motion::at_rest(Vec3::new(-3.0, k as f32 * 0.2, 0.0), Vec3::X),
                Vehicle::default(),
                wanderer.clone(),
            )
        });
        let mut stage = Stage::new(seconds, actors.collect());
        let (mut speed, mut distance, mut count) = (0.0, 0.0, 0.0);
        stage.run(300.0, |stage| {
            for Actor { motion, .. } in &stage.actors {
                speed += f64::from(motion.speed());
                distance += f64::from(motion.position.length());
                count += 1.0;
            }
        });
        (speed / count, distance / count)
    });
    for (speed, distance) in means {
        assert!((speed - means[0].0).abs() < 0.05 && (distance - means[0].1).abs() < 0.15, "{means:?}");
    }
}
