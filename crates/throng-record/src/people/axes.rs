//! Converts between the axes of the scene (z up, x ahead) and those of glTF and BVH (y up, z ahead in a body's own space).
//!
//! "glTF" stands for both formats below.

#[cfg(feature = "glb")]
use glam::{DMat4, DVec4, Mat4};
use glam::{DQuat, DVec3, Quat, Vec3};
use std::f32::consts::FRAC_1_SQRT_2;

/// Rotates the scene's axes to those of glTF.
const UP: Quat = Quat::from_xyzw(-FRAC_1_SQRT_2, 0.0, 0.0, FRAC_1_SQRT_2);
/// The same in double precision.
const EXACT_UP: DQuat = DQuat::from_xyzw(-std::f64::consts::FRAC_1_SQRT_2, 0.0, 0.0, std::f64::consts::FRAC_1_SQRT_2);
/// Rotates a body's own axes in glTF (left, up, ahead) to those in the scene (ahead, left, up).
const AHEAD: Quat = Quat::from_xyzw(0.5, 0.5, 0.5, 0.5);

/// Converts a point of the scene to glTF.
pub(crate) fn point(place: Vec3) -> Vec3 {
    Vec3::new(place.x, place.z, -place.y)
}

/// Returns a rotation within a body in glTF: its axes are left, up and ahead.
pub(crate) fn own_turn(rotation: DQuat) -> DQuat {
    let DQuat { x, y, z, w } = rotation;
    DQuat::from_xyzw(y, z, x, w)
}

/// Converts a point of glTF to the scene.
pub(crate) fn place(point: DVec3) -> DVec3 {
    DVec3::new(point.x, -point.z, point.y)
}

/// Converts a point or a size in a body's own space to glTF.
pub(crate) fn own(place: Vec3) -> Vec3 {
    Vec3::new(place.y, place.z, place.x)
}

/// Converts a transform within a body to glTF.
#[cfg(feature = "glb")]
pub(crate) fn own_matrix(matrix: DMat4) -> Mat4 {
    let column = |column: DVec4| own(column.truncate().as_vec3()).extend(column.w as f32);
    // the axes are left, up and ahead
    Mat4::from_cols(column(matrix.y_axis), column(matrix.z_axis), column(matrix.x_axis), column(matrix.w_axis))
}

/// Converts a rotation of the scene (a body faces +x) to glTF (a body faces +z).
pub(crate) fn turn(rotation: Quat) -> Quat {
    UP * rotation * AHEAD
}

/// Converts a point of the scene to glTF, in double precision.
#[cfg(feature = "bvh")]
pub(crate) fn exact_point(place: DVec3) -> DVec3 {
    DVec3::new(place.x, place.z, -place.y)
}

/// Converts a point or a size in a body's own space to glTF, in double precision.
#[cfg(feature = "bvh")]
pub(crate) fn exact_own(place: DVec3) -> DVec3 {
    DVec3::new(place.y, place.z, place.x)
}

/// Converts a point in a body's own space in glTF to the body's axes in the scene, in double precision.
#[cfg(any(feature = "bvh", feature = "glb"))]
pub(crate) fn own_place(point: DVec3) -> DVec3 {
    DVec3::new(point.z, point.x, point.y)
}

/// Converts a rotation of the scene (a body faces +x) to glTF (a body faces +z), in double precision.
#[cfg(feature = "bvh")]
pub(crate) fn exact_turn(rotation: DQuat) -> DQuat {
    EXACT_UP * rotation * AHEAD.as_dquat()
}

/// Converts a rotation of glTF (a body faces +z) to the scene (a body faces +x).
pub(crate) fn body(turn: DQuat) -> DQuat {
    EXACT_UP.conjugate() * turn * AHEAD.as_dquat().conjugate()
}

/// Returns the direction, in the scene, that an agent with a glTF rotation faces.
pub(crate) fn ahead(turn: Quat) -> Vec3 {
    let ahead = turn * Vec3::Z;
    Vec3::new(ahead.x, -ahead.z, ahead.y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn bodies_stand_in_gltf_as_in_the_scene(
            axis in (-1.0..1.0f32, -1.0..1.0f32, 0.1..1.0f32), angle in -3.0..3.0f32,
            corner in (-1.0..1.0f32, -1.0..1.0f32, -1.0..1.0f32), at in (-9.0..9.0f32, -9.0..9.0f32, -9.0..9.0f32),
        ) {
            let rotation = Quat::from_axis_angle(Vec3::from(axis).normalize(), angle);
            let (corner, at) = (Vec3::from(corner), Vec3::from(at));
            let there = point(at) + turn(rotation) * own(corner);
            prop_assert!(there.distance(point(at + rotation * corner)) < 1e-5);
            prop_assert!(ahead(turn(rotation)).distance(rotation * Vec3::X) < 1e-6);
            prop_assert_eq!(place(point(at).as_dvec3()), at.as_dvec3());
            let back = body(turn(rotation).as_dquat()).as_quat();
            prop_assert!((back * corner).distance(rotation * corner) < 1e-5);
        }
    }

    #[test]
    fn up_is_y_and_ahead_is_z() {
        assert_eq!((point(Vec3::Z), point(Vec3::Y), own(Vec3::X)), (Vec3::Y, -Vec3::Z, Vec3::Z));
    }
}
