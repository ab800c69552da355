//! What is nearest at each pixel is what a ray meets first.

use crate::scene::{Numbers, bodies, cast, cube, ray};
use glam::{DVec3, Mat3, Vec3};
use throng_render::{Body, Light, Line, LineEnd, Material, Mesh, Picture, Scene, View};

const SIZE: [u32; 2] = [96, 72];

fn view() -> View {
    View::look(DVec3::ZERO, DVec3::Y * 10.0, 0.9, SIZE)
}

#[test]
fn the_nearest_surface_is_that_of_a_ray() {
    let (cube, ball) = (cube(), Mesh::capsule(Vec3::ZERO, Vec3::X, [0.5, 0.3], 20));
    let (mut hits, mut misses) = (0, 0);
    for seed in 0..6 {
        let mut numbers = Numbers(seed);
        // every other scene is far from the origin of the world
        let shift = if seed % 2 == 0 { DVec3::ZERO } else { DVec3::new(4e5, -2e5, 30.0) };
        let view = View { eye: shift, ..view() };
        let mut bodies = bodies(&[&cube, &ball], 12, &mut numbers);
        bodies.iter_mut().for_each(|body| body.place += shift);
        let picture = Picture::render(&Scene { bodies: bodies.clone(), ..Scene::default() }, &view, SIZE).unwrap();
        for row in 1..SIZE[1] - 1 {
            for column in 1..SIZE[0] - 1 {
                let found = |column: u32, row: u32| cast(&bodies, view.eye, ray(&view, column, row));
                let about = [(0, 1), (2, 1), (1, 0), (1, 2), (0, 0), (2, 2), (0, 2), (2, 0)];
                let about = about.map(|(x, y)| found(column + x - 1, row + y - 1));
                let here = found(column, row);
                let along = ray(&view, column, row);
                match here {
                    None if about.iter().all(Option::is_none) => {
                        misses += 1;
                        let at = (0..200).find(|&way| picture.hides(view.eye + along * f64::from(way) * 0.5));
                        assert_eq!(at, None, "{seed}: {column}, {row} is empty");
                    }
                    // where neighbours are nearly as near, no edge is between them
                    Some(way)
                        if about.iter().all(|other| other.is_some_and(|other| (other - way).abs() < 0.02 * way)) =>
                    {
                        hits += 1;
                        let hidden = [0.985, 1.015].map(|part| picture.hides(view.eye + along * (way * part)));
                        assert_eq!(hidden, [false, true], "{seed}: {column}, {row} at {way} m");
                    }
                    _ => {}
                }
            }
        }
    }
    assert!(hits > 3000 && misses > 3000, "{hits} and {misses} pixels");
}

#[test]
fn closed_surfaces_have_no_gaps() {
    let ball = Mesh::capsule(Vec3::ZERO, Vec3::ZERO, [1.0; 2], 60);
    let mut numbers = Numbers(5);
    for round in 0..12 {
        let distance = numbers.between(3.0, 60.0);
        let place = DVec3::new(numbers.between(-0.2, 0.2), 1.0, numbers.between(-0.2, 0.2)) * distance;
        let body = Body { mesh: &ball, place, turn: numbers.turn(), material: Material::plain(Vec3::ONE), thin: false };
        let picture = Picture::render(&Scene { bodies: vec![body], ..Scene::default() }, &view(), SIZE).unwrap();
        let mut inside = 0;
        for row in 0..SIZE[1] {
            for column in 0..SIZE[0] {
                let along = ray(&view(), column, row).normalize();
                let pixel = distance / f64::from(view().focal);
                // The chords of a circle of 60 corners are up to 0.2 % within it.
                if (place - along * along.dot(place)).length() < 0.99 - 1.5 * pixel {
                    inside += 1;
                    assert!(picture.hides(along * (place.length() + 2.0)), "{round}: {column}, {row}");
                }
            }
        }
        assert!(inside > 0 || distance > 20.0, "{round}: nothing at {distance} m");
    }
}

#[test]
fn the_ground_ends_at_the_horizon() {
    let eye = DVec3::new(3.0, 1.0, 2.0);
    let view = View::look(eye, eye + DVec3::Y, 0.9, SIZE);
    let scene = Scene { ground: Some(Material::plain(Vec3::splat(0.5))), ..Scene::default() };
    let picture = Picture::render(&scene, &view, SIZE).unwrap();
    for row in 0..SIZE[1] {
        let along = ray(&view, 40, row);
        let below = row > SIZE[1] / 2 + 1;
        assert!(row.abs_diff(SIZE[1] / 2) <= 1 || picture.hides(eye + along * 1e4) == below, "row {row}");
        if below {
            let way = -eye.z / along.z;
            let hidden = [0.99, 1.01].map(|part| picture.hides(eye + along * (way * part)));
            assert_eq!(hidden, [false, true], "row {row}");
        }
    }
}

#[test]
fn what_is_before_the_near_plane_is_cut_off() {
    // a floor from behind the viewpoint to far before it
    let mut floor = Mesh::default();
    floor.face(&[[-50.0, -50.0], [50.0, -50.0], [50.0, 80.0], [-50.0, 80.0]].map(|[x, y]| Vec3::new(x, y, 0.0)));
    let body = Body {
        mesh: &floor,
        place: DVec3::new(0.0, 0.0, -1.5),
        turn: Mat3::IDENTITY,
        material: Material::plain(Vec3::ONE),
        thin: false,
    };
    let picture = Picture::render(&Scene { bodies: vec![body], ..Scene::default() }, &view(), SIZE).unwrap();
    for row in SIZE[1] / 2 + 2..SIZE[1] {
        let along = ray(&view(), 20, row);
        let way = -1.5 / along.z;
        let hidden = [0.99, 1.01].map(|part| picture.hides(along * (way * part)));
        assert!(way > 79.0 || hidden == [false, true], "row {row}, {way} m: {hidden:?}");
    }
}

#[test]
fn bodies_hide_lines_and_lines_have_their_width() {
    let cube = cube();
    let red = Vec3::new(1.0, 0.0, 0.0);
    let line = |height: f64, width: f32| Line {
        ends: [-9.0, 9.0].map(|x| LineEnd { at: DVec3::new(x, 10.0, height), width, opacity: 1.0 }).to_vec(),
        color: red,
        flat: false,
    };
    let scale = f64::from(view().focal) / 10.0;
    let body = Body {
        mesh: &cube,
        place: DVec3::new(0.0, 8.0, 0.0),
        turn: Mat3::from_diagonal(Vec3::new(2.0, 1.0, 9.0)),
        material: Material::plain(Vec3::ONE),
        thin: false,
    };
    let light = Light { haze: throng_render::Haze { distance: f32::INFINITY }, ..Light::default() };
    for (height, width) in [(0.0, 6.0), (1.2, 2.0), (-1.7, 9.0)] {
        let scene = Scene { lines: vec![line(height, width)], bodies: vec![body.clone()], light, ..Scene::default() };
        let picture = Picture::render(&scene, &view(), SIZE).unwrap();
        let is_red = |column: u32, row: u32| {
            let pixel = &picture.bytes()[4 * (row * SIZE[0] + column) as usize..][..3];
            f64::from(pixel[0].saturating_sub(pixel[1])) / 255.0
        };
        let covered = |column: u32| (0..SIZE[1]).map(|row| is_red(column, row)).sum::<f64>();
        let whole = (0..SIZE[1]).map(|row| is_red(12, row)).fold(0.0, f64::max);
        assert!(whole > 0.5, "{whole}");
        assert!((covered(12) / whole - f64::from(width)).abs() < 1.0, "{} of {width} pixels", covered(12) / whole);
        assert_eq!(covered(SIZE[0] / 2), 0.0, "the body hides the line");
        let row = (f64::from(SIZE[1]) / 2.0 - height * scale) as u32;
        let column: Vec<f64> = (0..SIZE[1]).map(|row| is_red(12, row)).collect();
        assert!(is_red(12, row) > 0.5 * whole, "{height} m: row {row} of {column:.2?}");
    }
}
