//! Critical points, compared with the winding number of the field along the rim, and with fields with known critical
//! points.

use glam::{DMat2, DVec2, Vec2, Vec3};
use proptest::prelude::*;
use throng::field::Field;
use throng_field::{Critical, Sampled};

/// Winding number of a field along the rim of its grid, counter-clockwise: the sum of the angles between the corners'
/// vectors, with interpolation along edges.
fn winding(field: &Sampled) -> i32 {
    let (columns, rows) = (field.columns(), field.velocities().len() / field.columns());
    let at = |column: usize, row: usize| field.velocities()[row * columns + column].as_dvec2();
    let mut rim: Vec<DVec2> = (0..columns).map(|column| at(column, 0)).collect();
    rim.extend((1..rows).map(|row| at(columns - 1, row)));
    rim.extend((0..columns - 1).rev().map(|column| at(column, rows - 1)));
    rim.extend((0..rows - 1).rev().map(|row| at(0, row)));
    let turned: f64 = rim.windows(2).map(|pair| pair[0].angle_to(pair[1])).sum();
    (turned / std::f64::consts::TAU).round() as i32
}

fn index(kind: Critical) -> i32 {
    if kind == Critical::Saddle { -1 } else { 1 }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// The Poincaré-Hopf theorem on random fields.
    #[test]
    fn the_indices_add_up_to_the_winding_of_the_rim(
        columns in 2usize..12,
        all in prop::collection::vec((-1.0f32..1.0, -1.0f32..1.0), 4..140),
        low in (-500.0f64..500.0, -500.0f64..500.0), cell in 0.1f64..10.0,
    ) {
        let rows = all.len() / columns;
        prop_assume!(rows > 1);
        let velocities = all[..rows * columns].iter().map(|&v| Vec2::from(v)).collect();
        let field = Sampled::new(low.into(), cell, columns, velocities).unwrap();
        let points = field.critical_points();
        prop_assert_eq!(points.iter().map(|point| index(point.kind)).sum::<i32>(), winding(&field), "{:?}", points);
        for point in &points {
            let there = field.velocity(point.place.as_vec2().extend(0.0), 0.0);
            // places are queried in single precision
            prop_assert!(there.length() < 2e-3, "{there} at {point:?}");
        }
    }

    /// A linear field has one critical point, at the place given by its matrix, of the kind given by its eigenvalues.
    #[test]
    fn linear_fields_have_the_one_that_they_should(
        matrix in [-1.0f64..1.0, -1.0f64..1.0, -1.0f64..1.0, -1.0f64..1.0], middle in (-3.0f64..3.0, -3.0f64..3.0),
    ) {
        let matrix = DMat2::from_cols_array(&matrix);
        let (trace, determinant) = (matrix.x_axis.x + matrix.y_axis.y, matrix.determinant());
        prop_assume!(determinant.abs() > 0.05 && trace.abs() > 0.01);
        let middle = DVec2::from(middle);
        let linear = |place: Vec3, _: f64| (matrix * (place.truncate().as_dvec2() - middle)).as_vec2().extend(0.0);
        let field = Sampled::of(&linear, DVec2::splat(-4.03), DVec2::splat(4.0), 0.31, 0.0).unwrap();
        let points = field.critical_points();
        prop_assert_eq!(points.len(), 1);
        prop_assert!(points[0].place.distance(middle) < 1e-3);
        // the real parts of the eigenvalues
        let root = (0.25 * trace * trace - determinant).max(0.0).sqrt();
        let [low, high] = [0.5 * trace - root, 0.5 * trace + root];
        let expected = if high < 0.0 { Critical::Sink } else if low > 0.0 { Critical::Source } else { Critical::Saddle };
        prop_assert_eq!(points[0].kind, expected);
        prop_assert_eq!(points[0].kind.traps(), high < 0.0);
        prop_assert!((points[0].turn - 0.5 * (matrix.x_axis.y - matrix.y_axis.x)).abs() < 1e-3);
    }
}

#[test]
fn a_rotation_has_a_centre_and_a_field_of_zero_has_no_critical_points() {
    let whirl = |place: Vec3, _: f64| if place.x < 5.0 { -2.0 * Vec3::Z.cross(place) } else { Vec3::ZERO };
    let field = Sampled::of(&whirl, DVec2::splat(-6.1), DVec2::splat(14.0), 0.4, 0.0).unwrap();
    let points = field.critical_points();
    assert_eq!(points.len(), 1, "{points:?}");
    assert!(points[0].kind == Critical::Center && points[0].kind.traps() && (points[0].turn + 2.0).abs() < 1e-4);
    let calm = Sampled::over(DVec2::ZERO, DVec2::splat(3.0), 0.5).unwrap();
    assert!(calm.critical_points().is_empty());
}
