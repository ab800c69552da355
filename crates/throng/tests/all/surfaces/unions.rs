//! Unions, compared with their members.

use crate::surfaces::oracle::{Known, point, rotation, sweep};
use glam::{Quat, Vec3};
use proptest::prelude::*;
use std::sync::Arc;
use throng::space::surface::{Cuboid, Moved, Plane, Pose, Sphere, Surface, Sweep, Union};

fn member() -> impl Strategy<Value = Arc<dyn Surface>> {
    let ball = (point(4.0), 0.3f32..2.0)
        .prop_map(|(center, radius)| Arc::new(Sphere::new(center, radius).unwrap()) as Arc<dyn Surface>);
    let cuboid = (point(4.0), rotation(), 0.3f32..3.0, 0.3f32..3.0).prop_map(|(at, turn, x, y)| {
        let pose = Pose::new(at, turn).unwrap();
        Arc::new(Moved::new(Cuboid::new(Vec3::new(x, y, 1.0)).unwrap(), pose)) as Arc<dyn Surface>
    });
    let plane = (point(1.0), -7.0f32..-4.0).prop_map(|(normal, away)| {
        let normal = normal.normalize_or(Vec3::X);
        Arc::new(Plane::new(normal * away, normal).unwrap()) as Arc<dyn Surface>
    });
    prop_oneof![5 => ball, 5 => cuboid, 1 => plane]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn a_union_is_the_least_of_its_members(
        members in prop::collection::vec(member(), 1..14), points in prop::collection::vec(point(7.0), 6),
        balls in prop::collection::vec(sweep(), 3),
    ) {
        let union = Union::new(members.clone()).unwrap();
        for p in points {
            let least = members.iter().map(|member| member.query(p).distance).fold(f32::INFINITY, f32::min);
            prop_assert!((union.query(p).distance - least).abs() < 1e-5);
        }
        for ball in balls {
            if !union.query(ball.origin).is_inside() {
                let first = members.iter().filter_map(|member| member.sweep(&ball)).map(|hit| hit.distance);
                let first = first.fold(f32::INFINITY, f32::min);
                prop_assert_eq!(union.sweep(&ball).map_or(f32::INFINITY, |hit| hit.distance), first);
            }
        }
    }

    #[test]
    fn a_union_is_left_where_no_member_is_left(
        members in prop::collection::vec(member(), 1..8), ball in sweep(),
    ) {
        let union = Union::new(members).unwrap();
        if union.query(ball.origin).distance < -ball.radius {
            let known = Known::solid(union, vec![], 0.0, |_| true);
            known.check_way(&ball)?;
            known.check_sweep(&Sweep { radius: 0.0, ..ball })?;
        }
    }
}

#[test]
fn a_chain_of_overlapping_balls_is_left_at_its_end() {
    let ball = |x: f32| Arc::new(Sphere::new(Vec3::X * x, 1.0).unwrap()) as Arc<dyn Surface>;
    let chain = Union::new((0..10).map(|k| ball(1.5 * k as f32)).collect()).unwrap();
    let turned = Moved::new(chain, Pose::new(Vec3::ONE, Quat::from_rotation_z(1.0)).unwrap());
    let ahead = Quat::from_rotation_z(1.0) * Vec3::X;
    let hit = turned.ray(Vec3::ONE, ahead, 100.0).unwrap();
    assert!((hit.distance - 14.5).abs() < 1e-4 && !hit.from_outside, "{hit:?}");
}
