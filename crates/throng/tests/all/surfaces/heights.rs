//! Height fields, compared with their own mesh and with samples of their heights.

use crate::surfaces::oracle::{Known, direction, point};
use glam::{Vec2, Vec3, Vec3Swizzles};
use proptest::prelude::*;
use throng::space::surface::{HeightField, Mesh, Surface, Sweep};

const CELL: f32 = 1.5;

fn field() -> impl Strategy<Value = (HeightField, Vec2, usize, Vec<f32>)> {
    let grid = (2usize..6, 2usize..6)
        .prop_flat_map(|(columns, rows)| (Just(columns), prop::collection::vec(-1.5f32..1.5, columns * rows)));
    (grid, point(2.0)).prop_map(|((columns, heights), low)| {
        let field = HeightField::new(low.xy(), CELL, columns, heights.clone()).unwrap();
        (field, low.xy(), columns, heights)
    })
}

/// The triangles of the grid, without the ground beyond it.
fn mesh(low: Vec2, columns: usize, heights: &[f32]) -> Mesh {
    let at = |i: usize| (low + Vec2::new((i % columns) as f32, (i / columns) as f32) * CELL).extend(heights[i]);
    let points: Vec<Vec3> = (0..heights.len()).map(at).collect();
    let cells = (0..heights.len() - columns).filter(|i| i % columns + 1 < columns);
    let triangles: Vec<_> = cells
        .flat_map(|i| {
            let (a, b, c, d) = (i, i + 1, i + 1 + columns, i + columns);
            [[a, b, c], [a, c, d]].map(|triangle| triangle.map(|k| k as u32))
        })
        .collect();
    Mesh::new(&points, &triangles).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn the_ground_is_its_mesh_and_goes_on_level(
        (field, low, columns, heights) in field(), points in prop::collection::vec(point(8.0), 6),
    ) {
        let mesh = mesh(low, columns, &heights);
        prop_assert!(!mesh.is_closed());
        let samples: Vec<Vec3> = (0..=480)
            .flat_map(|i| (0..=480).map(move |j| Vec2::new(i as f32, j as f32) * 0.1 - 24.0))
            .map(|p| p.extend(field.height(p)))
            .collect();
        let ground = field.clone();
        let known = Known::solid(field, samples, 0.3, move |p| p.z < ground.height(p.xy()));
        for p in points {
            known.check_query(p)?;
            let (near, of_mesh) = (known.surface.query(p), mesh.query(p));
            prop_assert!(near.distance.abs() <= of_mesh.distance + 1e-4);
            if mesh.query(near.point).distance < 1e-4 {
                prop_assert!((near.distance.abs() - of_mesh.distance).abs() < 1e-4);
            }
            // straight up and down the ray meets the height of the field
            let hit = known.surface.ray(p, if near.is_inside() { Vec3::Z } else { -Vec3::Z }, 100.0).unwrap();
            let above = known.surface.bounds().high.z;
            prop_assert!((hit.point.z - p.z).abs() - hit.distance < 1e-4 && hit.point.z <= above + 1e-4);
        }
    }

    #[test]
    fn balls_touch_the_ground((field, ..) in field(), from in point(6.0), ahead in direction(), radius in 0.0f32..1.0) {
        let known = Known::solid(field, vec![], 0.0, |_| true);
        known.check_sweep(&Sweep { origin: from, direction: ahead, radius, reach: 12.0 })?;
        known.check_slope(from, from + ahead * radius)?;
    }
}
