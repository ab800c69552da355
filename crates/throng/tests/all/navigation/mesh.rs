//! The triangles of a mesh: area, neighbours, location, nearest point.

use crate::navigation::oracle::{Dice, Scene, inside, shoelace, to_edges};
use glam::DVec2;

#[test]
fn triangles_fill_the_outline_exactly() {
    for seed in 0..40 {
        let mesh = Scene::random(seed).mesh(0.2);
        let (triangles, outline) = (mesh.area_size(), shoelace(mesh.outline()));
        assert!((triangles - outline).abs() < 1e-9 * outline, "seed {seed}: {triangles} {outline}");
        for (index, corners) in mesh.triangles().iter().enumerate() {
            let [a, b, c] = corners.map(|vertex| mesh.vertices()[vertex as usize]);
            assert!((b - a).perp_dot(c - a) > 0.0);
            for edge in 0..3 {
                let Some(next) = mesh.neighbour(index as u32, edge) else { continue };
                let back = (0..3).find(|&back| mesh.neighbour(next, back) == Some(index as u32)).unwrap();
                let other = mesh.triangles()[next as usize];
                assert_eq!((corners[edge], corners[(edge + 1) % 3]), (other[(back + 1) % 3], other[back]));
            }
        }
    }
}

#[test]
fn location_agrees_with_the_outline_and_the_nearest_point_with_its_edges() {
    for seed in 0..20 {
        let scene = Scene::random(seed);
        let mesh = scene.mesh(0.25);
        let mut rng = Dice(seed + 100);
        for _ in 0..300 {
            let at = scene.point(&mut rng) + DVec2::splat(rng.between(-1.0, 1.0));
            let away = to_edges(mesh.outline(), at);
            let within = inside(mesh.outline(), at);
            if away > 1e-6 {
                assert_eq!(mesh.locate(at).is_some(), within, "seed {seed} {at}");
            }
            let nearest = mesh.nearest(at);
            let expected = if within { 0.0 } else { away };
            assert!((nearest.distance(at) - expected).abs() < 1e-9, "seed {seed} {at} {nearest}");
            assert!(mesh.locate(nearest).is_some());
        }
        let far = scene.place(DVec2::new(500.0, -300.0));
        assert!((mesh.nearest(far).distance(far) - to_edges(mesh.outline(), far)).abs() < 1e-9);
    }
}
