//! Promises about input: nothing panics, errors name what is wrong, and threads change nothing.

use crate::scene::{Numbers, bodies, cube};
use glam::{DVec2, DVec3, Mat3, Vec2, Vec3};
use proptest::prelude::*;
use throng_render::{Area, Body, Light, Line, LineEnd, Material, Mesh, MeshError, Picture, Scene, SizeError, View};

fn scene<'a>(meshes: &[&'a Mesh<'a>]) -> Scene<'a> {
    let mut numbers = Numbers(3);
    let end = |x: f64| LineEnd { at: DVec3::new(x, 9.0, -3.0), width: 3.0, opacity: 0.7 };
    let corners = [[-3.0, 4.0], [3.0, 4.0], [0.0, 12.0]].map(DVec2::from).to_vec();
    Scene {
        ground: Some(Material::paving()),
        areas: vec![Area::new(&[corners], Material::wood())],
        bodies: bodies(meshes, 40, &mut numbers),
        lines: vec![Line { ends: [-5.0, 0.0, 5.0].map(end).to_vec(), color: Vec3::X, flat: true }],
        light: Light::default(),
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bytes() {
    let (cube, ball) = (cube(), Mesh::capsule(Vec3::ZERO, Vec3::X, [0.5, 0.3], 20));
    let view = View::look(DVec3::new(0.0, -4.0, 5.0), DVec3::new(0.0, 8.0, 0.0), 0.9, [131, 97]);
    let bytes = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| Picture::render(&scene(&[&cube, &ball]), &view, [131, 97]).unwrap().into_bytes())
    };
    let one = bytes(1);
    assert!([2, 3, 7].into_iter().all(|threads| bytes(threads) == one));
}

#[test]
fn sizes_have_limits() {
    let view = View::look(DVec3::ZERO, DVec3::Y, 0.9, [1, 1]);
    let render = |size| Picture::render(&Scene::default(), &view, size).map(|picture| picture.bytes().len());
    assert_eq!(render([1, 1]), Ok(4));
    assert_eq!(render([16_384, 1]), Ok(4 * 16_384));
    for [width, height] in [[0, 5], [5, 0], [16_385, 5], [5, u32::MAX]] {
        assert_eq!(render([width, height]), Err(SizeError { width, height }));
    }
    assert_eq!(SizeError { width: 0, height: 5 }.to_string(), "a picture of 0 by 5 pixels: give 1 to 16384 for both");
}

#[test]
fn meshes_are_checked() {
    let corners = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
    let new = |normals: usize, colors: usize, triangles: Vec<[u32; 3]>| {
        Mesh::new(corners.clone(), vec![Vec3::Z; normals], vec![Vec3::ONE; colors], triangles).map(|_| ())
    };
    assert_eq!(new(3, 0, vec![[0, 1, 2]]), Ok(()));
    assert_eq!(new(3, 3, vec![]), Ok(()));
    let lengths = |other, name| Err(MeshError::Lengths { positions: 3, other, name });
    assert_eq!(new(2, 0, vec![]), lengths(2, "normals"));
    assert_eq!(new(3, 1, vec![]), lengths(1, "colours"));
    assert_eq!(new(3, 0, vec![[0, 1, 2], [0, 3, 1]]), Err(MeshError::Vertex { triangle: 1, vertex: 3, positions: 3 }));
}

#[test]
fn prisms_and_capsules_are_closed() {
    let ring = |radius: f32, turn: f32| -> Vec<Vec2> {
        (0..7).map(|k| Vec2::from_angle(turn * k as f32 * std::f32::consts::TAU / 7.0) * radius).collect()
    };
    let meshes = [
        Mesh::prism(&[ring(2.0, 1.0)], 0.0, 3.0),
        Mesh::prism(&[ring(2.0, -1.0), ring(1.0, -1.0)], 0.0, 3.0),
        Mesh::prism(&[ring(2.0, 1.0), ring(1.0, 1.0)], 0.0, 3.0),
        Mesh::capsule(Vec3::ZERO, Vec3::new(1.0, 2.0, 3.0), [1.0, 0.5], 24),
    ];
    for (k, mesh) in meshes.iter().enumerate() {
        // The sum of the areas of a closed surface is zero, and its volume is positive.
        let corners = mesh.triangles().iter().map(|face| face.map(|corner| mesh.positions()[corner as usize]));
        let areas: Vec3 = corners.clone().map(|[a, b, c]| (b - a).cross(c - a)).sum();
        let volume: f32 = corners.map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum();
        assert!(areas.length() < 1e-3, "{k}: {areas}");
        assert!(volume > 1.0, "{k}: {volume}");
    }
    let area = |rings: &[Vec<Vec2>]| {
        let mesh = Mesh::prism(rings, 0.0, 1.0);
        let corners = mesh.triangles().iter().map(|face| face.map(|corner| mesh.positions()[corner as usize]));
        corners.map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum::<f32>()
    };
    // the area of a regular polygon of 7 corners
    let polygon = |radius: f32| 3.5 * radius * radius * (std::f32::consts::TAU / 7.0).sin();
    assert!((area(&[ring(2.0, 1.0)]) - polygon(2.0)).abs() < 1e-3);
    assert!((area(&[ring(2.0, -1.0), ring(1.0, 1.0)]) - polygon(2.0) + polygon(1.0)).abs() < 1e-3);
}

/// Numbers that are usual, huge, tiny, or none.
fn number() -> impl Strategy<Value = f64> {
    let special = [0.0, -0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e30, 1e-300, 1e9, f64::MAX];
    prop_oneof![4 => -20.0..20.0, 1 => prop::sample::select(special.to_vec())]
}

fn point() -> impl Strategy<Value = DVec3> {
    [number(), number(), number()].prop_map(DVec3::from_array)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 150, ..ProptestConfig::default() })]
    #[test]
    fn nothing_panics(
        eye in point(),
        target in point(),
        angle in number(),
        corners in prop::collection::vec(point(), 3..9),
        place in point(),
        turn in [number(), number(), number()],
        ends in prop::collection::vec((point(), number(), number()), 0..5),
        ground in any::<bool>(),
        thin in any::<bool>(),
        flat in any::<bool>(),
        size in [1u32..40, 1u32..40],
        light in [number(), number(), number(), number()],
    ) {
        let positions: Vec<Vec3> = corners.iter().map(|corner| corner.as_vec3()).collect();
        let triangles = (2..positions.len() as u32).map(|k| [0, k - 1, k]).collect::<Vec<_>>();
        let mesh = Mesh::new(positions.clone(), vec![Vec3::Z; positions.len()], vec![], triangles).unwrap();
        let ring: Vec<DVec2> = corners.iter().map(|corner| corner.truncate()).collect();
        let prism = Mesh::prism(&[ring.iter().map(|corner| corner.as_vec2()).collect()], 0.0, turn[0] as f32);
        let turn = Mat3::from_diagonal(Vec3::from_array(turn.map(|part| part as f32)));
        let body = |mesh, material| Body { mesh, place, turn, material, thin };
        let mut lights = Light::default();
        (lights.sun.azimuth, lights.sun.elevation) = (light[0] as f32, light[1] as f32);
        (lights.sun.size, lights.haze.distance) = (light[2] as f32, light[3] as f32);
        let scene = Scene {
            ground: ground.then(Material::paving),
            areas: vec![Area::new(&[ring], Material::wood())],
            bodies: vec![body(&mesh, Material::concrete()), body(&prism, Material::glass()), body(&prism, Material::wood())],
            lines: vec![Line {
                ends: ends
                    .iter()
                    .map(|&(at, width, opacity)| LineEnd { at, width: width as f32, opacity: opacity as f32 })
                    .collect(),
                color: Vec3::X,
                flat,
            }],
            light: lights,
        };
        let view = View::look(eye, target, angle, size);
        let picture = Picture::render(&scene, &view, size).unwrap();
        prop_assert_eq!(picture.bytes().len(), (size[0] * size[1] * 4) as usize);
        prop_assert!(picture.bytes().as_chunks::<4>().0.iter().all(|pixel| pixel[3] == 255));
        picture.hides(target);
    }
}
