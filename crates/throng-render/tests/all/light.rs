//! Sun, shadows, sky light, glass and haze.

use crate::scene::{Numbers, cast, cube, ray};
use glam::{DVec2, DVec3, Mat3, Vec3};
use throng_render::{Area, Body, Haze, Light, Material, Mesh, Picture, Scene, Sun, View, linear};

const SIZE: [u32; 2] = [160, 120];

fn clear() -> Light {
    Light { haze: Haze { distance: f32::INFINITY }, ..Light::default() }
}

fn placed<'a>(mesh: &'a Mesh<'a>, place: DVec3, size: Vec3) -> Body<'a> {
    Body { mesh, place, turn: Mat3::from_diagonal(size), material: Material::plain(Vec3::splat(0.6)), thin: false }
}

fn brightness(picture: &Picture, column: u32, row: u32) -> i32 {
    let pixel = &picture.bytes()[4 * (row * picture.size()[0] + column) as usize..][..3];
    pixel.iter().map(|&part| i32::from(part)).sum()
}

/// Shadows are where a ray to the sun meets something.
#[test]
fn shadows_are_where_something_hides_the_sun() {
    let cube = cube();
    let mut numbers = Numbers(11);
    let (mut lit, mut dark) = (0, 0);
    for round in 0..6 {
        let sun = Sun {
            azimuth: numbers.between(0.0, std::f64::consts::TAU) as f32,
            elevation: numbers.between(0.4, 1.2) as f32,
            size: 0.005,
            ..Light::default().sun
        };
        let place = |numbers: &mut Numbers| numbers.point(DVec3::new(-4.0, -4.0, 1.7), DVec3::new(4.0, 4.0, 3.0));
        let bodies: Vec<Body<'_>> =
            (0..6).map(|_| placed(&cube, place(&mut numbers), Vec3::new(0.8, 0.6, 1.2))).collect();
        let view = View::look(DVec3::new(0.0, -1.0, 16.0), DVec3::ZERO, 0.7, SIZE);
        let ground = Some(Material::plain(Vec3::splat(0.6)));
        let scene = Scene { ground, bodies: bodies.clone(), light: Light { sun, ..clear() }, ..Scene::default() };
        let picture = Picture::render(&scene, &view, SIZE).unwrap();
        let open = brightness(&picture, 2, 2);
        let towards = sun.direction().as_dvec3();
        for row in (4..SIZE[1] - 4).step_by(2) {
            for column in (4..SIZE[0] - 4).step_by(2) {
                let along = ray(&view, column, row);
                let at = view.eye + along * (-view.eye.z / along.z);
                // near edges of bodies and of shadows, light is mixed
                let about = [[0.0, 0.0], [1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]];
                let about = about.map(|[x, y]| at + DVec3::new(x, y, 0.0) * 0.3);
                if about.iter().any(|at| cast(&bodies, view.eye, *at - view.eye).is_some_and(|way| way < 0.999)) {
                    continue;
                }
                let shaded = about.map(|at| cast(&bodies, at + DVec3::Z * 1e-3, towards).is_some());
                let found = brightness(&picture, column, row);
                if shaded == [true; 5] {
                    dark += 1;
                    assert!(found < open - 80, "{round}: {column}, {row} is in the shadow: {found} of {open}");
                } else if shaded == [false; 5] {
                    lit += 1;
                    // near bodies hide a part of the sky
                    assert!(found > open - 70, "{round}: {column}, {row}, at {at}, is in the sun: {found} of {open}");
                }
            }
        }
    }
    assert!(lit > 2000 && dark > 60, "{lit} places in the sun and {dark} in shadows");
}

#[test]
fn wider_suns_have_softer_shadows() {
    let cube = cube();
    let wall = placed(&cube, DVec3::new(-4.0, 0.0, 2.0), Vec3::new(0.2, 20.0, 4.0));
    let view = View::look(DVec3::new(0.0, 0.0, 20.0), DVec3::ZERO, 0.25, SIZE);
    let width = |size: f32| {
        let sun = Sun { azimuth: std::f32::consts::PI, elevation: 0.8, size, ..Light::default().sun };
        let ground = Some(Material::plain(Vec3::splat(0.6)));
        let scene = Scene { ground, bodies: vec![wall.clone()], light: Light { sun, ..clear() }, ..Scene::default() };
        let picture = Picture::render(&scene, &view, SIZE).unwrap();
        let row: Vec<i32> = (0..SIZE[0]).map(|column| brightness(&picture, column, 60)).collect();
        let (low, high) = (row[0], row[SIZE[0] as usize - 1]);
        assert!(high - low > 80, "{low} to {high}");
        row.iter().filter(|&&value| value > low + (high - low) / 8 && value < high - (high - low) / 8).count()
    };
    let widths = [0.001, 0.04, 0.1].map(width);
    assert!(widths[0] <= 4 && widths[1] > widths[0] + 2 && widths[2] > widths[1] + 2, "{widths:?}");
}

#[test]
fn corners_are_darker_than_open_ground() {
    let cube = cube();
    let wall = placed(&cube, DVec3::new(0.0, 2.0, 1.0), Vec3::new(12.0, 0.2, 2.0));
    let view = View::look(DVec3::new(0.0, -4.0, 6.0), DVec3::new(0.0, 1.0, 0.0), 0.6, SIZE);
    // The sun is before the wall: no shadow is on the ground before it.
    let sun = Sun { azimuth: -1.57, elevation: 0.7, ..Light::default().sun };
    let ground = Some(Material::plain(Vec3::splat(0.6)));
    let scene = Scene { ground, bodies: vec![wall], light: Light { sun, ..clear() }, ..Scene::default() };
    let picture = Picture::render(&scene, &view, SIZE).unwrap();
    let at = |y: f64| {
        let turned = DVec3::new(0.0, y, 0.0) - view.eye;
        let depth = turned.dot(view.forward.as_dvec3());
        let row = f64::from(view.centre.y) - f64::from(view.focal) * turned.dot(view.up.as_dvec3()) / depth;
        brightness(&picture, SIZE[0] / 2, row as u32)
    };
    assert!(at(1.8) < at(0.6) - 12, "{} by the wall, {} in the open", at(1.8), at(0.6));
}

#[test]
fn glass_lets_see_what_is_behind_and_casts_no_shadow() {
    let cube = cube();
    let behind =
        Body { material: Material::plain(Vec3::X), ..placed(&cube, DVec3::new(0.0, 10.0, 1.0), Vec3::splat(2.0)) };
    let view = View::look(DVec3::new(0.0, 0.0, 1.0), DVec3::new(0.0, 10.0, 1.0), 0.5, SIZE);
    let middle = |pane: Option<Material>| {
        let pane = pane
            .map(|material| Body { material, ..placed(&cube, DVec3::new(0.0, 6.0, 1.0), Vec3::new(8.0, 0.1, 3.0)) });
        let bodies = std::iter::once(behind.clone()).chain(pane).collect();
        let picture = Picture::render(&Scene { bodies, light: clear(), ..Scene::default() }, &view, SIZE).unwrap();
        let pixel = &picture.bytes()[4 * (60 * SIZE[0] + 80) as usize..][..3];
        i32::from(pixel[0]) - i32::from(pixel[1])
    };
    let open = middle(None);
    let glass = middle(Some(Material::glass()));
    let wall = middle(Some(Material::concrete()));
    assert!(open > 100 && glass > open / 2 && glass < open && wall < 20, "{open}, {glass}, {wall}");
}

#[test]
fn haze_takes_colours_to_that_of_the_horizon() {
    let cube = cube();
    let light = Light { haze: Haze { distance: 40.0 }, ..Light::default() };
    let color = |distance: f64| {
        let body = Body {
            material: Material::plain(Vec3::new(0.05, 0.0, 0.0)),
            ..placed(&cube, DVec3::new(0.0, distance, 0.0), Vec3::splat(distance as f32))
        };
        let view = View::look(DVec3::ZERO, DVec3::Y, 0.5, SIZE);
        let picture = Picture::render(&Scene { bodies: vec![body], light, ..Scene::default() }, &view, SIZE).unwrap();
        brightness(&picture, 80, 60)
    };
    let colors = [2.0, 40.0, 400.0].map(color);
    assert!(colors[0] + 60 < colors[1] && colors[1] + 60 < colors[2], "{colors:?}");
}

#[test]
fn areas_lie_on_the_ground_in_order() {
    let square = |half: f64| {
        let corners = [[-half, -half], [half, -half], [half, half], [-half, half]];
        vec![corners.map(DVec2::from).to_vec()]
    };
    let colors = [linear(0xff0000), linear(0x00ff00), linear(0x0000ff)];
    let areas =
        [3.0, 2.0, 1.0].iter().zip(colors).map(|(half, color)| Area::new(&square(*half), Material::plain(color)));
    let ground = Some(Material::plain(Vec3::splat(0.5)));
    let scene = Scene { ground, areas: areas.collect(), light: clear(), ..Scene::default() };
    let view = View::look(DVec3::new(0.0, 0.0, 10.0), DVec3::ZERO, 0.9, SIZE);
    let picture = Picture::render(&scene, &view, SIZE).unwrap();
    for (at, most) in [(2.5, 0), (1.5, 1), (0.5, 2)] {
        let column = f64::from(view.centre.x) + f64::from(view.focal) * at / 10.0;
        let pixel = &picture.bytes()[4 * (60 * SIZE[0] + column as u32) as usize..][..3];
        let found = (0..3).max_by_key(|&k| pixel[k]);
        assert_eq!(found, Some(most), "{pixel:?} at {at} m");
    }
}

/// Where a wall that faces away from the sun meets the ground, both are in its shadow, for walls at any angle.
#[test]
fn no_light_shines_under_a_wall() {
    let cube = cube();
    let mut numbers = Numbers(23);
    for round in 0..8 {
        let turn = numbers.between(-0.4, 0.4);
        let mut wall = placed(&cube, DVec3::new(0.0, 0.0, 1.5), Vec3::ONE);
        wall.turn = Mat3::from_rotation_z(turn as f32) * Mat3::from_diagonal(Vec3::new(40.0, 0.3, 3.0));
        let sun = Sun { azimuth: 1.6, elevation: 0.6, ..Light::default().sun };
        let scene = Scene {
            ground: Some(Material::plain(Vec3::splat(0.6))),
            bodies: vec![wall],
            light: Light { sun, ..clear() },
            ..Scene::default()
        };
        let view = View::look(DVec3::new(0.0, -14.0, 5.0), DVec3::new(0.0, 0.0, 0.5), 0.4, SIZE);
        let picture = Picture::render(&scene, &view, SIZE).unwrap();
        let mut found = 0;
        for column in 20..SIZE[0] - 20 {
            // the row of the foot of the wall, from the view's own directions
            let [a, b] = [0, SIZE[1] - 1].map(|row| ray(&view, column, row));
            let side = DVec3::new(-turn.sin(), turn.cos(), 0.0);
            let before = |way: DVec3| side.dot(view.eye + way * (-view.eye.z / way.z)) < -0.15 && way.z < 0.0;
            assert!(!before(a) && before(b), "{round}: the foot of the wall is in the picture");
            let foot = (0..SIZE[1]).find(|&row| before(ray(&view, column, row))).unwrap();
            let shade = brightness(&picture, column, foot + 4).max(brightness(&picture, column, foot - 5));
            for row in foot - 4..foot + 4 {
                found += 1;
                let here = brightness(&picture, column, row);
                assert!(here < shade + 30, "{round}: {column}, {row} is lit: {here}, and {shade} about it");
            }
        }
        assert!(found > 800);
    }
}
