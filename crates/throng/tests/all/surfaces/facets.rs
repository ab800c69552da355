//! Facets represent the surface: their corners lie on it, they face outwards, and they enclose the solid's volume.

use glam::{Quat, Vec2, Vec3};
use std::f32::consts::PI;
use throng::space::surface::{
    Bounds, Capsule, Cuboid, Cylinder, HeightField, Mesh, Moved, Plane, Pose, Prism, Sphere, Surface,
};

const WITHIN: Bounds = Bounds { low: Vec3::splat(-20.0), high: Vec3::splat(20.0) };

/// The normal of a flat polygon, of twice its area as length (Newell).
fn normal(facet: &[Vec3]) -> Vec3 {
    facet.iter().zip(facet.iter().cycle().skip(1)).map(|(a, b)| a.cross(*b)).sum()
}

fn check(what: &str, surface: &dyn Surface) -> f32 {
    let facets = surface.facets(&WITHIN);
    assert!(!facets.is_empty(), "{what}");
    let mut volume = 0.0;
    for facet in &facets {
        for corner in facet {
            let off = surface.query(*corner).distance;
            assert!(off.abs() < 1e-3 || !WITHIN.grown(-1e-3).contains(*corner), "{what}: {corner} is {off} m off");
        }
        let out = normal(facet);
        assert!(out.length() > 1e-5, "{what}: {facet:?} has no area");
        let middle = facet.iter().sum::<Vec3>() / facet.len() as f32;
        volume += middle.dot(out) / 6.0;
        let step = out.normalize() * 0.05;
        let [beyond, before] = [middle + step, middle - step].map(|p| surface.query(p).distance);
        assert!(beyond > before || !WITHIN.grown(-0.1).contains(middle), "{what}: {facet:?} faces inwards");
    }
    volume
}

fn near(what: &str, is: f32, expected: f32, part: f32) {
    assert!((is / expected - 1.0).abs() < part, "{what}: {is} and not {expected}");
}

#[test]
fn facets_enclose_the_solid() {
    near("sphere", check("sphere", &Sphere::new(Vec3::ONE, 2.0).unwrap()), 32.0 * PI / 3.0, 0.05);
    near("box", check("box", &Cuboid::new(Vec3::new(1.0, 2.0, 3.0)).unwrap()), 6.0, 1e-4);
    let rod = (Vec3::new(1.0, -2.0, 0.5), Vec3::new(2.0, 0.0, 2.5));
    near("cylinder", check("cylinder", &Cylinder::new(rod.0, rod.1, 1.5).unwrap()), 2.25 * PI * 3.0, 0.05);
    let volume = 2.25 * PI * 3.0 + 1.125 * 4.0 * PI;
    near("capsule", check("capsule", &Capsule::new(rod.0, rod.1, 1.5).unwrap()), volume, 0.05);
    near("ball", check("ball", &Capsule::new(rod.0, rod.0, 1.5).unwrap()), 1.125 * 4.0 * PI, 0.05);
    let angle = [
        Vec2::ZERO,
        Vec2::new(4.0, 0.0),
        Vec2::new(4.0, 1.0),
        Vec2::new(1.0, 1.0),
        Vec2::new(1.0, 3.0),
        Vec2::new(0.0, 3.0),
    ];
    let prism = Prism::new(&angle, -1.0, 2.0).unwrap();
    let turned = Pose::new(Vec3::new(3.0, 1.0, 0.0), Quat::from_rotation_x(0.7)).unwrap();
    let sum = |surface: &dyn Surface| surface.facets(&WITHIN).iter().map(|f| f[0].dot(normal(f)) / 6.0).sum::<f32>();
    near("prism", sum(&prism), 18.0, 1e-4);
    near("moved prism", sum(&Moved::new(prism, turned)), 18.0, 1e-4);
    let corners = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
    let mesh = Mesh::new(&corners, &[[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]]).unwrap();
    near("mesh", check("mesh", &mesh), 1.0 / 6.0, 1e-4);
}

#[test]
fn what_has_no_end_is_shown_within_the_box() {
    let area = |surface: &dyn Surface| surface.facets(&WITHIN).iter().map(|f| normal(f).length() / 2.0).sum::<f32>();
    let plane = Plane::new(Vec3::new(0.0, 0.0, 3.0), Vec3::Z).unwrap();
    check("plane", &plane);
    near("plane", area(&plane), 1600.0, 1e-3);
    let slanted = Plane::new(Vec3::ZERO, Vec3::new(1.0, 0.0, 1.0)).unwrap();
    near("slanted plane", area(&slanted), 1600.0 * 2.0f32.sqrt(), 1e-3);
    assert!(Plane::new(Vec3::Z * 90.0, Vec3::Z).unwrap().facets(&WITHIN).is_empty(), "it is not in the box");
    let square = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
    near("pillar", area(&Prism::ground(&square).unwrap()), 4.0 * 40.0 + 2.0, 1e-3);
    let ground = HeightField::new(Vec2::ZERO, 2.0, 3, vec![0.0; 9]).unwrap();
    check("ground", &ground);
    near("ground", area(&ground), 16.0, 1e-4);
    assert_eq!(Cuboid::rectangle(Vec2::new(2.0, 3.0)).unwrap().facets(&WITHIN).len(), 1, "a sheet");
}
