//! Meshes, compared with the solids that they represent.

use crate::surfaces::oracle::{Known, ball, point, sweep};
use crate::surfaces::shapes::star;
use glam::{Vec2, Vec3};
use proptest::prelude::*;
use throng::space::surface::{Mesh, Prism, Sphere, Surface, SurfaceHit, Sweep};

/// Triangles of a prism over a star, as three corners each.
fn prism(corners: &[Vec2], bottom: f32, top: f32) -> Vec<[Vec3; 3]> {
    let sides = (0..corners.len()).map(|i| (corners[i], corners[(i + 1) % corners.len()]));
    let triangles = |(a, b): (Vec2, Vec2)| {
        let [low_a, low_b, high_a, high_b] = [a.extend(bottom), b.extend(bottom), a.extend(top), b.extend(top)];
        let (floor, ceiling) = (Vec3::Z * bottom, Vec3::Z * top);
        [[low_a, low_b, high_b], [low_a, high_b, high_a], [ceiling, high_a, high_b], [floor, low_b, low_a]]
    };
    sides.flat_map(triangles).collect()
}

/// A mesh of triangles that share no points and have random orientations.
fn soup(triangles: &[[Vec3; 3]], turned: &[bool]) -> Mesh {
    let turn = |(i, &[a, b, c]): (usize, &[Vec3; 3])| if turned[i % turned.len()] { [a, c, b] } else { [a, b, c] };
    let points: Vec<Vec3> = triangles.iter().enumerate().flat_map(turn).collect();
    let indices: Vec<[u32; 3]> = (0..triangles.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    Mesh::new(&points, &indices).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn the_mesh_of_a_prism_is_the_prism(
        corners in star(), points in prop::collection::vec(point(5.0), 8), ball in sweep(),
        turned in prop::collection::vec(any::<bool>(), 1..20),
    ) {
        let (bottom, top) = (-1.0, 0.7);
        let solid = Prism::new(&corners, bottom, top).unwrap();
        let mesh = soup(&prism(&corners, bottom, top), &turned);
        prop_assert!(mesh.is_closed());
        for p in points {
            let (near, expected) = (mesh.query(p), solid.query(p));
            prop_assert!((near.distance - expected.distance).abs() < 1e-4, "{near:?} {expected:?}");
        }
        // a ball that touches at the start gets the hits of single parts: walls or triangles
        if solid.query(ball.origin).distance.abs() > ball.radius + 1e-3 {
            let reached = |hit: Option<SurfaceHit>| hit.map(|hit| (hit.distance, hit.from_outside));
            match (reached(mesh.sweep(&ball)), reached(solid.sweep(&ball))) {
                (Some(hit), Some(expected)) => {
                    prop_assert!((hit.0 - expected.0).abs() < 2e-3 && hit.1 == expected.1, "{hit:?} {expected:?}");
                }
                (hit, expected) => prop_assert_eq!(hit, expected),
            }
        }
        Known::solid(mesh, vec![], 0.0, |_| true).check_sweep(&ball)?;
    }

    #[test]
    fn what_is_within_a_solid_is_a_hollow_and_solid_again_within_that(
        corners in star(), p in point(4.0), turned in prop::collection::vec(any::<bool>(), 1..20),
    ) {
        let shells: Vec<f32> = vec![1.0, 0.5, 0.25];
        let scaled = |scale: f32| corners.iter().map(|c| *c * scale).collect::<Vec<_>>();
        let triangles: Vec<_> = shells.iter().flat_map(|&s| prism(&scaled(s), -s, s)).collect();
        let mesh = soup(&triangles, &turned);
        prop_assert!(mesh.is_closed());
        let depths: Vec<f32> =
            shells.iter().map(|&s| Prism::new(&scaled(s), -s, s).unwrap().query(p).distance).collect();
        let nearest = depths.iter().map(|d| d.abs()).fold(f32::INFINITY, f32::min);
        let near = mesh.query(p);
        prop_assert!((near.distance.abs() - nearest).abs() < 1e-4);
        let inside = depths.iter().filter(|d| **d < 0.0).count() % 2 == 1;
        prop_assert!(nearest < 1e-4 || near.is_inside() == inside);
    }
}

/// An octahedron with each triangle cut into four, `cuts` times, with all corners on the unit sphere.
fn round(cuts: u32) -> Vec<[Vec3; 3]> {
    let mut triangles = vec![];
    for z in [Vec3::Z, -Vec3::Z] {
        let around = [Vec3::X, Vec3::Y, -Vec3::X, -Vec3::Y];
        triangles.extend((0..4).map(|i| [around[i], around[(i + 1) % 4], z]));
    }
    for _ in 0..cuts {
        let cut = |[a, b, c]: [Vec3; 3]| {
            let middle = |a: Vec3, b: Vec3| (a + b).normalize();
            let (x, y, z) = (middle(a, b), middle(b, c), middle(c, a));
            [[a, x, z], [x, b, y], [z, y, c], [x, y, z]]
        };
        triangles = triangles.into_iter().flat_map(cut).collect();
    }
    triangles
}

#[test]
fn a_finely_cut_sphere_is_nearly_a_sphere() {
    let mesh = soup(&round(5), &[false, true, true]);
    let sphere = Sphere::new(Vec3::ZERO, 1.0).unwrap();
    assert_eq!(mesh.len(), 8192);
    for (i, p) in ball(500).enumerate() {
        let p = p * (0.05 + i as f32 * 0.006);
        let (near, expected) = (mesh.query(p), sphere.query(p));
        assert!((near.distance - expected.distance).abs() < 2e-3, "{near:?} {expected:?}");
        let (from, ahead) = (p, (Vec3::new(0.3, -0.2, 0.1) - p).normalize());
        let (hit, expected) = (mesh.ray(from, ahead, 9.0).unwrap(), sphere.ray(from, ahead, 9.0).unwrap());
        assert!((hit.distance - expected.distance).abs() < 5e-3, "{hit:?} {expected:?}");
        assert_eq!(hit.from_outside, expected.from_outside);
    }
}

#[test]
fn open_meshes_and_those_without_volume_are_sheets() {
    let box_ = prism(&[Vec2::new(1.0, 0.0), Vec2::new(0.0, 1.0), Vec2::new(-1.0, 0.0), Vec2::new(0.0, -1.0)], 0.0, 1.0);
    let open = soup(&box_[1..], &[false]);
    assert!(!open.is_closed());
    assert!(open.query(Vec3::new(0.0, 0.0, 0.5)).distance > 0.0);
    let (a, b, c) = (Vec3::ZERO, Vec3::X, Vec3::Y);
    let plate = soup(&[[a, b, c], [a, c, b]], &[false]);
    assert!(!plate.is_closed());
    for z in [-0.5, 0.5] {
        let from = Vec3::new(0.2, 0.2, z);
        assert_eq!(plate.query(from).distance, 0.5);
        let hit = plate.ray(from, Vec3::Z * -z.signum(), 2.0).unwrap();
        assert!(hit.from_outside && hit.normal == Vec3::Z * z.signum());
    }
}

#[test]
fn a_ball_that_leaves_one_wall_of_a_corner_meets_the_other_from_within() {
    let wedge = [Vec2::NEG_Y * 2.0, Vec2::new(4.0, 2.0), Vec2::new(-4.0, 2.0)];
    let mesh = soup(&prism(&wedge, -4.0, 4.0), &[false]);
    // the ball touches the right wall and goes to the left wall
    let sweep = Sweep { origin: Vec3::new(0.1, -1.5, 0.0), direction: -Vec3::X, radius: 0.3, reach: 2.0 };
    let hit = mesh.sweep(&sweep).expect("the left wall is in the way");
    assert!(!hit.from_outside && hit.normal.x < -0.7 && hit.normal.y < -0.7, "{hit:?}");
    assert!(hit.distance > 0.0 && (hit.distance - (0.6 - 0.3 * 2.0f32.sqrt())).abs() < 1e-4, "{hit:?}");
}
