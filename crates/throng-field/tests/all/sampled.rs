//! Fields on grids, compared with the fields that they sample.

use glam::{DVec2, Vec2, Vec3};
use proptest::prelude::*;
use std::sync::Arc;
use throng::field::Field;
use throng_field::{Anchor, Anchors, Kernel, Sampled, Sketch};

fn vector(size: f64) -> impl Strategy<Value = DVec2> {
    (-size..size, -size..size).prop_map(DVec2::from)
}

fn with_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(work)
}

fn bits(field: &Sampled) -> Vec<[u32; 2]> {
    field.velocities().iter().map(|v| v.to_array().map(f32::to_bits)).collect()
}

/// The rim belongs to the field.
#[test]
fn at_the_rim_it_says_what_its_corners_say() {
    let linear = |place: Vec3, _: f64| Vec3::new(1.0 + place.x, place.y - 2.0 * place.x, 0.0);
    let field = Sampled::of(&linear, DVec2::ZERO, DVec2::new(3.0, 2.0), 0.5, 0.0).unwrap();
    for (x, y) in [(3.0, 2.0), (3.0, 1.2), (1.3, 2.0), (3.0, 0.0), (0.0, 2.0), (0.0, 0.0)] {
        let place = Vec3::new(x, y, 0.0);
        assert!(field.velocity(place, 0.0).distance(linear(place, 0.0)) < 1e-5, "{place}");
    }
    assert_eq!(field.velocity(Vec3::new(3.001, 1.0, 0.0), 0.0), Vec3::ZERO);
}

proptest! {
    /// A bilinear field is its own interpolation.
    #[test]
    fn what_is_bilinear_comes_out_as_it_is(low in vector(100.0), size in (0.1f64..50.0, 0.1f64..50.0), cell in 0.05f64..5.0, at in (0.0f64..1.0, 0.0f64..1.0)) {
        let size = DVec2::from(size);
        let bilinear = move |place: Vec3, _: f64| {
            let p = place - low.as_vec2().extend(0.0);
            Vec3::new(1.0 + 0.02 * p.x - 0.03 * p.y, 0.001 * p.x * p.y, 0.0)
        };
        let field = Sampled::of(&bilinear, low, low + size, cell, 0.0).unwrap();
        let place = (low + size * DVec2::from(at)).as_vec2().extend(5.0);
        let inside = place.x >= low.x as f32 && place.y >= low.y as f32;
        prop_assume!(inside);
        prop_assert!(field.velocity(place, 1.0).distance(bilinear(place, 0.0)) < 1e-3);
        for beyond in [-DVec2::X, -DVec2::Y, size.with_y(0.0) + 2.1 * cell, size.with_x(0.0) + 2.1 * cell] {
            prop_assert_eq!(field.velocity((low + beyond).as_vec2().extend(0.0), 0.0), Vec3::ZERO);
        }
    }

    /// A batch is the field at single places, except for single precision; it has the same bits for any number of
    /// threads and any division into parts.
    #[test]
    fn a_grid_of_anchors_is_their_field(
        all in prop::collection::vec((vector(20.0), vector(2.0), prop_oneof![2 => Just(1.0), 1 => 1.0f64..3.0]), 1..30),
        middle in vector(2000.0), reach in prop_oneof![Just(None), (2.0f64..30.0).prop_map(Some)],
        fade in prop_oneof![Just(None), (1.0f64..20.0).prop_map(Some)], part in (vector(25.0), vector(25.0)),
    ) {
        // thin plates are not stretched
        let stretch = |stretch: f64| if reach.is_some() { stretch } else { 1.0 };
        let anchor = |&(place, velocity, s)| Anchor { place: middle + place, velocity, stretch: stretch(s) };
        let anchors: Vec<Anchor> = all.iter().map(anchor).collect();
        let kernel = reach.map_or(Kernel::ThinPlate, |reach| Kernel::Wendland { reach });
        let sketch = Sketch { kernel, fade, max_speed: 5.0, ..Sketch::default() };
        // systems of stretched compact kernels need not be solvable; anchors at nearly one place are inaccurate in
        // single precision
        let Ok(field) = Anchors::new(&anchors, sketch) else { return Ok(()) };
        let apart = |k: usize| all[..k].iter().map(|other| other.0.distance(all[k].0)).fold(f64::INFINITY, f64::min);
        prop_assume!((1..all.len()).all(|k| apart(k) > 0.5));
        let (low, high) = (middle - 25.0, middle + 25.0);
        let sampled = with_threads(1, || Sampled::of(&field, low, high, 0.8, 0.0).unwrap());
        // adjacent anchors with opposite velocities have large weights that nearly cancel
        let fastest = sampled.velocities().iter().map(|v| v.length()).fold(2.0, f32::max);
        let mut off = 0.0;
        for (k, found) in sampled.velocities().iter().enumerate() {
            let place = low + DVec2::new((k % sampled.columns()) as f64, (k / sampled.columns()) as f64) * 0.8;
            let exact = field.at(place).as_vec2();
            off += f64::from(found.distance(exact));
            prop_assert!(found.distance(exact) < 4e-3 * fastest, "{found} and {exact} at {place}");
        }
        let mean = off / sampled.velocities().len() as f64;
        prop_assert!(mean < 1e-3 * f64::from(fastest), "{mean} m/s off");
        let shared: Arc<dyn Field> = Arc::new(field);
        let again = with_threads(3, || Sampled::of(&shared, low, high, 0.8, 0.0).unwrap());
        prop_assert_eq!(bits(&sampled), bits(&again));
        let mut parts = sampled.clone();
        parts.sample(&shared, middle + part.0.min(part.1), middle + part.0.max(part.1), 0.0);
        prop_assert_eq!(bits(&sampled), bits(&parts));
    }

    /// Sampling a box changes all values in the box and no others.
    #[test]
    fn sampling_a_box_changes_that_box(a in vector(12.0), b in vector(12.0)) {
        let (low, high) = (a.min(b), a.max(b));
        let one = |_: Vec3, _: f64| Vec3::X;
        let mut field = Sampled::over(DVec2::splat(-10.0), DVec2::splat(10.0), 0.5).unwrap();
        field.sample(&one, low, high, 0.0);
        for (k, found) in field.velocities().iter().enumerate() {
            let place = field.low() + DVec2::new((k % field.columns()) as f64, (k / field.columns()) as f64) * field.cell();
            let inside = place.cmpge(low).all() && place.cmple(high).all();
            prop_assert_eq!(*found, if inside { Vec2::X } else { Vec2::ZERO }, "{}", place);
        }
    }
}

#[test]
fn what_cannot_be_is_refused() {
    let message = |found: Result<Sampled, throng::Error>| found.unwrap_err().to_string();
    let (low, high) = (DVec2::ZERO, DVec2::splat(100.0));
    assert!(message(Sampled::over(low, high, 0.0)).contains("greater than 0"));
    assert!(message(Sampled::over(low, high, 1e-6)).contains("make its cells wider"));
    assert!(message(Sampled::over(low, DVec2::NAN, 1.0)).contains("finite"));
    assert!(message(Sampled::new(low, 1.0, 3, vec![Vec2::ZERO; 7])).contains("7 corners are not"));
    let mut holed = vec![Vec2::ZERO; 6];
    holed[4].y = f32::NAN;
    assert!(message(Sampled::new(low, 1.0, 3, holed)).contains("row 1, column 1 is not finite"));
    let wild = |_: Vec3, _: f64| Vec3::NAN;
    let field = Sampled::of(&wild, low, high, 10.0, 0.0).unwrap();
    assert!(field.velocities().iter().all(|v| *v == Vec2::ZERO));
}
