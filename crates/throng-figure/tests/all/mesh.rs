//! The body fits its skeleton.

use glam::Vec3;
use std::collections::BTreeMap;
use throng_figure::{Build, JOINTS, LOOKS, Level, Look, Mesh, Person, Region, Skeleton, Walk};

const BUILDS: [Build; 3] = [Build::Woman, Build::Man, Build::Child];

fn meshes() -> impl Iterator<Item = (Build, Level, Mesh)> {
    BUILDS.into_iter().flat_map(|build| Level::ALL.map(|level| (build, level, Mesh::new(build, level))))
}

#[test]
fn weights_are_shares_of_joints() {
    for (build, level, mesh) in meshes() {
        let count = mesh.positions.len();
        assert!([mesh.normals.len(), mesh.joints.len(), mesh.weights.len(), mesh.regions.len()] == [count; 4]);
        for (joints, weights) in mesh.joints.iter().zip(&mesh.weights) {
            assert!((weights.iter().sum::<f32>() - 1.0).abs() < 1e-6, "{build:?} {level:?}");
            assert!(weights.iter().all(|&weight| (0.0..=1.0).contains(&weight)));
            assert!(joints.iter().all(|&joint| usize::from(joint) < JOINTS));
        }
    }
}

#[test]
fn surfaces_are_closed_and_face_outward() {
    for (build, level, mesh) in meshes() {
        let mut edges: BTreeMap<(u32, u32), i32> = BTreeMap::new();
        let mut volume = 0.0;
        for &[a, b, c] in &mesh.triangles {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                *edges.entry((from.min(to), from.max(to))).or_default() += if from < to { 1 } else { -1 };
            }
            let [a, b, c] = [a, b, c].map(|vertex| mesh.positions[vertex as usize]);
            volume += a.dot(b.cross(c)) / 6.0;
        }
        assert!(edges.values().all(|&sum| sum == 0), "{build:?} {level:?}: an edge is open");
        // 70 l at a height of 1.75 m is 0.013 of the cube of the height
        assert!((0.008..0.022).contains(&volume), "{build:?} {level:?}: volume {volume}");
        let low = mesh.positions.iter().fold(Vec3::MAX, |low, &point| low.min(point));
        let high = mesh.positions.iter().fold(Vec3::MIN, |high, &point| high.max(point));
        assert!(low.z > -0.002 && low.z < 0.005 && high.z > 0.97 && high.z < 1.02, "{build:?} {level:?}");
    }
}

#[test]
fn coarser_levels_have_fewer_vertices() {
    for build in BUILDS {
        let counts = Level::ALL.map(|level| Mesh::new(build, level).positions.len());
        assert!(counts.is_sorted_by(|a, b| a > b), "{counts:?}");
        assert_eq!(counts, [1104, 704, 352, 128], "the numbers of the documentation");
    }
}

#[test]
fn at_rest_the_body_is_the_mesh() {
    for (build, level, mesh) in meshes() {
        let skeleton = Skeleton::scaled(build, 1.7);
        let posed = mesh.posed(&skeleton, 1.7, &skeleton.world(&skeleton.rest()));
        for (posed, position) in posed.iter().zip(&mesh.positions) {
            assert!(posed.distance(position.as_dvec3() * 1.7) < 1e-6, "{build:?} {level:?}");
        }
    }
}

#[test]
fn walking_bodies_stay_in_shape_and_above_the_ground() {
    let samples = crate::paths::driven(25.0, 5.0, |_| (1.3, 0.0, 0.0));
    for build in BUILDS {
        let person = Person::new(4, 4).with_build(build);
        let (skeleton, walk) = (Skeleton::new(&person), Walk::recorded(&person, &samples).unwrap());
        let mesh = Mesh::new(build, Level::Fine);
        for moment in 0..50 {
            let pose = walk.pose(f64::from(moment) / 10.0);
            let posed = mesh.posed(&skeleton, person.height, &skeleton.world(&pose));
            for point in &posed {
                assert!(point.z > -0.03 && point.z < 1.03 * person.height, "{build:?}: {point}");
                assert!(point.truncate().distance(pose.hips.truncate()) < 0.62 * person.height, "{build:?}: {point}");
            }
        }
    }
}

#[test]
fn looks_differ() {
    let mut looks: Vec<_> =
        (0..LOOKS).map(|number| Region::ALL.map(|region| Look::new(number).colour(region))).collect();
    looks.sort_unstable();
    looks.dedup();
    assert_eq!(looks.len(), usize::from(LOOKS));
    assert_eq!(Look::new(3), Look::new(3 + LOOKS));
}
