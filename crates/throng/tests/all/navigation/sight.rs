//! Visibility, compared with dense cuts and samples.

use crate::navigation::oracle::{Dice, Scene, inside, leaves_by, to_edges};

#[test]
fn sight_agrees_with_the_outline() {
    let (mut clear, mut blocked) = (0, 0);
    for seed in 0..40 {
        let scene = Scene::random(seed);
        let mesh = scene.mesh(0.2);
        let mut rng = Dice(seed + 4000);
        let count = mesh.vertices().len() as f64;
        for round in 0..200 {
            let mut a = scene.free_point(&mesh, &mut rng);
            let mut b = scene.free_point(&mesh, &mut rng);
            if round % 2 == 1 {
                a = mesh.vertices()[(rng.unit() * count) as usize];
            }
            if round % 4 == 3 {
                b = mesh.vertices()[(rng.unit() * count) as usize];
            }
            let out = leaves_by(mesh.outline(), a, b);
            let visible = mesh.visible(a, b);
            assert_eq!(visible, mesh.visible(b, a), "seed {seed} {a} {b} {out}");
            if out < 1e-7 {
                assert!(visible, "seed {seed}.{round} {a} {b}");
                clear += 1;
            } else if out > 1e-5 {
                assert!(!visible, "seed {seed}.{round} {a} {b} leaves by {out}");
                blocked += 1;
            }
            if visible {
                for k in 0..=200 {
                    let at = a.lerp(b, k as f64 / 200.0);
                    assert!(inside(mesh.outline(), at) || to_edges(mesh.outline(), at) < 2e-6);
                }
            }
        }
        for ring in mesh.outline() {
            for k in 0..ring.len() {
                assert!(mesh.visible(ring[k], ring[(k + 1) % ring.len()]), "seed {seed}: along a wall");
                assert!(mesh.visible(ring[k], ring[k]));
            }
        }
    }
    assert!(clear > 500 && blocked > 500);
}
