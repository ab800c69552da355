//! Walls, followed at a distance.

use super::{Shared, barriers};
use crate::harness::{Actor, RATES, Stage, rate};
use glam::{Quat, Vec3};
use proptest::prelude::*;
use std::slice;
use std::sync::Arc;
use throng::motion::{Motion, Vehicle};
use throng::space::surface::{Cuboid, Sphere, Surface};
use throng_steer::FollowWall;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    /// Along the outside of balls and the inside of rooms, in any direction: after it reaches the wall the agent keeps
    /// the offset.
    #[test]
    fn walls_are_followed_at_any_offset(
        radius in 2.0f32..6.0, offset in 0.4f32..1.5, from in 0.5f32..1.8, heading in 0.0f32..6.3, inside: bool, seconds in rate(),
    ) {
        let ball: Shared = Arc::new(Sphere::new(Vec3::ZERO, if inside { radius + 3.0 } else { radius }).unwrap());
        let follow = FollowWall { offset, ..FollowWall::from(barriers(slice::from_ref(&ball))) };
        let x = if inside { radius + 3.0 - offset * from } else { radius + offset * from };
        let start = Motion::moving(Vec3::X * x, Quat::from_rotation_z(heading) * Vec3::X);
        let mut stage = Stage::new(seconds, vec![Actor::new(start, Vehicle::default(), follow)]);
        let (mut least, mut most) = (f32::INFINITY, 0.0f32);
        stage.run(40.0, |stage| {
            if stage.time() > 10.0 {
                let distance = ball.query(stage.actors[0].motion.position).distance.abs();
                (least, most) = (least.min(distance), most.max(distance));
            }
        });
        prop_assert!(least > 0.9 * offset && most < 1.1 * offset, "from {least} to {most}, not {offset}");
        prop_assert!(stage.actors[0].motion.speed() > 1.5);
    }
}

/// Round obstacles with all kinds of corners, and along the inside of rooms, on either hand, at the offset.
#[test]
fn walls_are_followed_at_a_distance() {
    let rooms: [(Shared, f32); 2] = [
        (Arc::new(Cuboid::new(Vec3::new(12.0, 9.0, 4.0)).unwrap()), 7.0),
        (Arc::new(Sphere::new(Vec3::ZERO, 5.0).unwrap()), 7.0),
    ];
    for (surface, outside) in rooms {
        for (x, inside) in [(2.0, true), (outside, false)] {
            for hand in [1.0, -1.0] {
                for seconds in RATES {
                    let follow = FollowWall::from(barriers(slice::from_ref(&surface)));
                    let start = Motion::moving(Vec3::X * x, Vec3::Y * hand);
                    let mut stage = Stage::new(seconds, vec![Actor::new(start, Vehicle::default(), follow)]);
                    let (mut off, mut steps, mut least, mut most, mut turned) = (0.0, 0.0, f32::INFINITY, 0.0f32, 0.0);
                    let mut before = start.position;
                    stage.run(80.0, |stage| {
                        let place = stage.actors[0].motion.position;
                        turned += before.angle_between(place) * before.cross(place).z.signum();
                        before = place;
                        if stage.time() > 5.0 {
                            let distance = surface.query(place).distance.abs();
                            off += f64::from((distance - 1.0).abs());
                            steps += 1.0;
                            least = least.min(distance);
                            most = most.max(distance);
                        }
                    });
                    let what = format!("{surface:?}, inside: {inside}, {hand}, {seconds} s");
                    assert!(off < 0.07 * steps, "{what}: {} off on average", off / steps);
                    assert!(least > 0.55 && most < 1.1, "{what}: from {least} to {most}");
                    assert!(turned.abs() > 15.0, "{what}: it goes round by {turned}");
                }
            }
        }
    }
}
