//! Invalid shapes are refused, with the reason.

use glam::{Quat, Vec2, Vec3};
use throng::Error;
use throng::space::surface::{
    Capsule, Cuboid, Cylinder, HeightField, Mesh, Plane, Pose, Prism, Sphere, Surface, Sweep, Union,
};

fn says<T: std::fmt::Debug>(made: Result<T, Error>, words: &str) {
    let message = made.expect_err("this should be refused").to_string();
    assert!(message.contains(words), "{message}");
}

#[test]
fn bad_shapes_are_refused() {
    let nan = Vec3::splat(f32::NAN);
    says(Sphere::new(nan, 1.0), "the centre of a sphere");
    says(Sphere::new(Vec3::ZERO, -1.0), "the radius of a sphere is -1, but must be greater than 0");
    says(Sphere::new(Vec3::ZERO, f32::INFINITY), "finite");
    says(Plane::new(Vec3::ZERO, Vec3::ZERO), "the length of the normal of a plane");
    says(Plane::new(Vec3::ZERO, nan), "the length of the normal of a plane");
    says(Cuboid::new(Vec3::new(1.0, 0.0, 1.0)), "an extent of a box");
    says(Cuboid::rectangle(Vec2::new(1.0, f32::NAN)), "an extent of a rectangle");
    says(Cylinder::new(Vec3::ONE, Vec3::ONE, 1.0), "the length of a cylinder");
    says(Cylinder::new(Vec3::ONE, Vec3::ZERO, 0.0), "the radius of a cylinder");
    says(Capsule::new(nan, Vec3::ZERO, 1.0), "an end of a capsule");
    says(Pose::new(Vec3::ZERO, Quat::from_xyzw(0.0, 0.0, 0.0, 0.0)), "the length of a rotation");
    says(Pose::on_ground(Vec3::ZERO, f32::NAN), "a heading");
    says(Union::new(vec![]), "no surfaces");
    let square = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
    says(Prism::new(&square, 1.0, 1.0), "the top of a prism is 1, but must be greater than its bottom");
    says(Prism::new(&square, 0.0, f32::NAN), "the top of a prism");
    says(Prism::new(&square[..2], 0.0, 1.0), "at least 3 different corners");
    says(Prism::ground(&[Vec2::ZERO, Vec2::ONE, Vec2::X, Vec2::Y]), "crosses itself");
    says(Prism::ground(&[Vec2::ZERO, Vec2::ONE, Vec2::splat(f32::NAN)]), "not a finite number");
    says(HeightField::new(Vec2::ZERO, 1.0, 0, vec![]), "two full rows");
    says(HeightField::new(Vec2::ZERO, 1.0, 3, vec![0.0; 7]), "7 heights in rows of 3");
    says(HeightField::new(Vec2::ZERO, 0.0, 2, vec![0.0; 4]), "the width of the cells");
    says(HeightField::new(Vec2::ZERO, 1.0, 2, vec![f32::NAN; 4]), "a height is NaN");
    says(Mesh::new(&[Vec3::ZERO; 3], &[]), "no triangle");
    says(Mesh::new(&[Vec3::ZERO; 3], &[[0, 1, 2]]), "no triangle");
    says(Mesh::new(&[Vec3::ZERO, Vec3::X, Vec3::Y], &[[0, 1, 3]]), "triangle 0 names point 3, but there are 3");
    says(Mesh::new(&[Vec3::ZERO, Vec3::X, nan], &[[0, 1, 2]]), "a point of a mesh");
}

#[test]
fn points_that_are_not_numbers_do_no_harm() {
    let square = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
    let corners = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
    let shapes: Vec<Box<dyn Surface>> = vec![
        Box::new(Sphere::new(Vec3::ZERO, 1.0).unwrap()),
        Box::new(Plane::new(Vec3::ZERO, Vec3::Z).unwrap()),
        Box::new(Cuboid::new(Vec3::ONE).unwrap()),
        Box::new(Cylinder::new(Vec3::ZERO, Vec3::Z, 1.0).unwrap()),
        Box::new(Capsule::new(Vec3::ZERO, Vec3::Z, 1.0).unwrap()),
        Box::new(Prism::ground(&square).unwrap()),
        Box::new(HeightField::new(Vec2::ZERO, 1.0, 2, vec![0.0; 4]).unwrap()),
        Box::new(Mesh::new(&corners, &[[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]]).unwrap()),
    ];
    for bad in [f32::NAN, f32::INFINITY] {
        for shape in &shapes {
            let origin = Vec3::splat(bad);
            shape.query(origin);
            shape.sweep(&Sweep { origin, direction: Vec3::X, radius: 1.0, reach: f32::INFINITY });
            shape.sweep(&Sweep { origin: Vec3::Z * 3.0, direction: origin, radius: bad, reach: bad });
        }
    }
}
