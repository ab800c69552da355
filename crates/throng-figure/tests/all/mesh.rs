//! The body fits its skeleton.

use glam::Vec3;
use std::collections::BTreeMap;
use throng_figure::{Build, JOINTS, Joint, LOOKS, Level, Look, Mesh, Person, Region, Skeleton, Walk};

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

/// Returns the volume of a closed surface, and whether each of its edges has a triangle on both sides.
fn solid(mesh: &Mesh, triangles: &[[u32; 3]]) -> (f32, bool) {
    let mut edges: BTreeMap<(u32, u32), i32> = BTreeMap::new();
    let mut volume = 0.0;
    for &[a, b, c] in triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            *edges.entry((from.min(to), from.max(to))).or_default() += if from < to { 1 } else { -1 };
        }
        let [a, b, c] = [a, b, c].map(|vertex| mesh.positions[vertex as usize]);
        volume += a.dot(b.cross(c)) / 6.0;
    }
    (volume, edges.values().all(|&sum| sum == 0))
}

/// Returns the triangles of a region that only some looks wear.
fn triangles_in(mesh: &Mesh, region: Region) -> Vec<[u32; 3]> {
    let inside = |triangle: &&[u32; 3]| triangle.iter().all(|&vertex| mesh.regions[vertex as usize] == region);
    mesh.triangles.iter().filter(inside).copied().collect()
}

#[test]
fn surfaces_are_closed_and_face_outward() {
    for (build, level, mesh) in meshes() {
        for number in 0..LOOKS {
            let look = Look::new(number);
            let (volume, closed) = solid(&mesh, &mesh.triangles_of(&look));
            assert!(closed, "{build:?} {level:?} {number}: an edge is open");
            // 70 l at a height of 1.75 m is 0.013 of the cube of the height; skirt and rucksack add 0.01
            assert!((0.008..0.030).contains(&volume), "{build:?} {level:?} {number}: volume {volume}");
        }
        let low = mesh.positions.iter().fold(Vec3::MAX, |low, &point| low.min(point));
        let high = mesh.positions.iter().fold(Vec3::MIN, |high, &point| high.max(point));
        assert!(low.z > -0.002 && low.z < 0.005 && high.z > 0.97 && high.z < 1.02, "{build:?} {level:?}");
    }
}

#[test]
fn clothes_are_solids_of_the_right_size_in_the_right_place() {
    let (mut bags, mut skirts) = (0, 0);
    for (build, level, mesh) in meshes() {
        for region in [Region::Bag, Region::Skirt, Region::Coat, Region::LongHair, Region::Umbrella] {
            let triangles = triangles_in(&mesh, region);
            let has = if build == Build::Man { region != Region::Skirt } else { region != Region::Coat };
            let has = has && (region != Region::LongHair || build != Build::Man);
            let has = has && (region != Region::Umbrella || level != Level::Blocks);
            assert_eq!(!triangles.is_empty(), has, "{build:?} {level:?} {region:?}");
            if !has {
                continue;
            }
            let (volume, closed) = solid(&mesh, &triangles);
            assert!(closed && volume > 0.0, "{build:?} {level:?} {region:?}: {volume}");
            let places: Vec<Vec3> = triangles.iter().flatten().map(|&vertex| mesh.positions[vertex as usize]).collect();
            let reach = |axis: fn(Vec3) -> f32| {
                let low = places.iter().map(|&point| axis(point)).fold(f32::INFINITY, f32::min);
                [low, places.iter().map(|&point| axis(point)).fold(f32::NEG_INFINITY, f32::max)]
            };
            let ([back, _], [low, high]) = (reach(|point| point.x), reach(|point| point.z));
            match region {
                // of a height of 1.75 m: 8 to 21 l
                Region::Bag => {
                    assert!((0.0015..0.0040).contains(&volume), "{build:?} {level:?}: volume {volume}");
                    assert!(back > -0.22 && low > 0.5 && high < 0.86, "{build:?} {level:?}: {back}, {low} to {high}");
                    bags += 1;
                }
                // the hem is above the knee, the waist above the hips
                Region::Skirt | Region::Coat => {
                    assert!((0.27..0.40).contains(&low) && (0.5..0.66).contains(&high), "{build:?}: {low} to {high}");
                    skirts += 1;
                }
                // below the hand, which is aslant at rest
                Region::Umbrella => {
                    assert!((1e-4..6e-4).contains(&volume), "{build:?} {level:?}: volume {volume}");
                    assert!(low > 0.2 && high < 0.62, "{build:?} {level:?}: {low} to {high}");
                }
                _ => assert!(low > 0.72 && high < 1.0, "{build:?}: {low} to {high}"),
            }
        }
    }
    assert_eq!((bags, skirts), (12, 12));
}

/// A place is inside of a closed surface if a ray from it crosses the surface an odd number of times.
fn is_inside(place: glam::DVec3, surface: &[[glam::DVec3; 3]]) -> bool {
    let ray = glam::DVec3::new(0.013, 1.0, 0.007);
    let crosses = |[a, b, c]: &[glam::DVec3; 3]| {
        let (ab, ac, from) = (*b - *a, *c - *a, place - *a);
        let across = ray.cross(ac);
        let scale = ab.dot(across);
        let u = from.dot(across) / scale;
        let around = from.cross(ab);
        let v = ray.dot(around) / scale;
        u >= 0.0 && v >= 0.0 && u + v <= 1.0 && ac.dot(around) / scale > 0.0
    };
    surface.iter().filter(|triangle| crosses(triangle)).count() % 2 == 1
}

#[test]
fn skirts_and_coats_cover_the_thighs_of_people_that_walk() {
    for build in BUILDS {
        let region = if build == Build::Man { Region::Coat } else { Region::Skirt };
        let person = Person::new(4, 4).with_build(build);
        let samples = crate::paths::driven(25.0, 5.0, |_| (1.3, 0.0, 0.0));
        let (skeleton, walk) = (Skeleton::new(&person), Walk::recorded(&person, &samples).unwrap());
        let mesh = Mesh::new(build, Level::Fine);
        let (mut thighs, mut covered) = (0, 0);
        for moment in 0..25 {
            let pose = walk.pose(1.0 + f64::from(moment) * 0.05);
            let posed = mesh.posed(&skeleton, person.height, &skeleton.world(&pose));
            let surface: Vec<_> = triangles_in(&mesh, region)
                .iter()
                .map(|corners| corners.map(|corner| posed[corner as usize]))
                .collect();
            let hips = skeleton.offset(Joint::Hips).z / person.height;
            for ((position, place), region) in mesh.positions.iter().zip(&posed).zip(&mesh.regions) {
                if *region == Region::Trousers && (0.0..0.13).contains(&(hips - f64::from(position.z))) {
                    thighs += 1;
                    covered += u32::from(is_inside(*place, &surface));
                }
            }
        }
        let share = f64::from(covered) / f64::from(thighs);
        assert!(thighs > 500 && share > 0.95, "{build:?}: {share} of {thighs}");
    }
}

#[test]
fn coarser_levels_have_fewer_vertices() {
    for build in BUILDS {
        let meshes = Level::ALL.map(|level| Mesh::new(build, level));
        let body = |region: &&Region| **region < Region::Skirt;
        let counts = meshes.each_ref().map(|mesh| mesh.regions.iter().filter(body).count());
        assert_eq!(counts, [1104, 704, 352, 128], "the numbers of the documentation");
        let clothes: Vec<usize> = meshes.iter().zip(counts).map(|(mesh, body)| mesh.regions.len() - body).collect();
        assert!(clothes.iter().zip([346, 262, 116, 34]).all(|(&count, most)| count <= most), "{clothes:?}");
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
    let share = |region: Region| looks.iter().filter(|look| look[region as usize].is_some()).count();
    let worn = [Region::Top, Region::Skirt, Region::Coat, Region::Bag, Region::LongHair, Region::Umbrella].map(share);
    assert_eq!(worn, [16, 8, 2, 4, 8, 2], "the numbers of the documentation");
    looks.sort_unstable();
    looks.dedup();
    assert_eq!(looks.len(), usize::from(LOOKS));
    assert_eq!(Look::new(3), Look::new(3 + LOOKS));
}
