//! Strokes and stamps, compared with their definitions and by the fields that they produce.

use glam::DVec2;
use proptest::prelude::*;
use throng_field::{Anchor, Anchors, Critical, Sampled, Sketch, Stamp, Stroke, erase};

fn vector(size: f64) -> impl Strategy<Value = DVec2> {
    (-size..size, -size..size).prop_map(DVec2::from)
}

/// Returns the distance along a line of its nearest point to a place, and the distance of the place: by a walk in small
/// steps.
fn along(points: &[DVec2], place: DVec2) -> (f64, f64) {
    let (mut walked, mut best) = (0.0, (0.0, f64::INFINITY));
    for pair in points.windows(2) {
        let length = pair[0].distance(pair[1]);
        let steps = (length / 1e-3).ceil().max(1.0) as usize;
        for step in 0..=steps {
            let part = step as f64 / steps as f64;
            let off = pair[0].lerp(pair[1], part).distance(place);
            if off < best.1 {
                best = (walked + part * length, off);
            }
        }
        walked += length;
    }
    best
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn anchors_lie_along_their_stroke(points in prop::collection::vec(vector(8.0), 2..6), spacing in 0.2f64..5.0, speed in -2.0f64..2.0) {
        let length: f64 = points.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
        let stroke = Stroke { points: points.clone(), spacing, speed, stretch: 2.0 };
        let anchors = stroke.anchors().unwrap();
        let parts = (length / spacing).round().max(1.0);
        prop_assert_eq!(anchors.len(), parts as usize + 1);
        prop_assert!(anchors[0].place.distance(points[0]) < 1e-9);
        prop_assert!(anchors[anchors.len() - 1].place.distance(points[points.len() - 1]) < 1e-9);
        for (k, anchor) in anchors.iter().enumerate() {
            let expected = length * k as f64 / parts;
            let (_, off) = along(&points, anchor.place);
            prop_assert!(off < 1e-3, "{off} m beside the line");
            // a line that crosses itself may have several nearest points: the lengths before and after decide
            prop_assert!(anchor.place.distance(points[0]) <= expected + 1e-9);
            prop_assert!(anchor.place.distance(points[points.len() - 1]) <= length - expected + 1e-9);
            prop_assert_eq!(anchor.stretch, 2.0);
            let chord = anchors[(k + 1).min(anchors.len() - 1)].place - anchors[k.saturating_sub(1)].place;
            prop_assert!(anchor.velocity.distance(chord.normalize_or_zero() * speed) < 1e-9);
        }
    }

    /// A stamp on a field makes its critical point at its place, and no other near it.
    #[test]
    fn a_stamp_makes_its_critical_point(
        place in vector(300.0), radius in 0.5f64..20.0, speed in 0.2f64..3.0, backwards: bool, flow in vector(0.0001),
        kind in prop_oneof![Just(Critical::Center), Just(Critical::Sink), Just(Critical::Source), Just(Critical::Saddle)],
    ) {
        let speed = if backwards { -speed } else { speed };
        let mut anchors = Stamp { place, kind, radius, speed }.anchors().unwrap().to_vec();
        // another flow far away
        anchors.extend([(30.0, 0.0), (0.0, 30.0)].map(|(x, y)| Anchor::new(place + DVec2::new(x, y) * radius, flow)));
        let field = Anchors::new(&anchors, Sketch::default()).unwrap();
        let reach = 1.2 * radius;
        let sampled = Sampled::of(&field, place - reach, place + reach * 1.03, 0.09 * radius, 0.0).unwrap();
        let points = sampled.critical_points();
        prop_assert_eq!(points.len(), 1, "{:?}", points);
        prop_assert!(points[0].place.distance(place) < 0.1 * radius);
        let expected = match (kind, backwards) {
            (Critical::Sink, true) => Critical::Source,
            (Critical::Source, true) => Critical::Sink,
            _ => kind,
        };
        if kind == Critical::Center {
            // in single precision a centre may be a spiral with a small sink or source
            prop_assert_eq!(points[0].turn > 0.0, !backwards);
        } else {
            prop_assert_eq!(points[0].kind, expected);
        }
    }
}

#[test]
fn erasing_removes_what_is_within_the_radius() {
    let stroke = Stroke { points: vec![DVec2::ZERO, DVec2::X * 10.0], spacing: 1.0, ..Stroke::default() };
    let mut anchors = stroke.anchors().unwrap();
    assert_eq!(erase(&mut anchors, DVec2::new(4.0, 0.0), 1.5), 3);
    assert_eq!(
        anchors.iter().map(|anchor| anchor.place.x).collect::<Vec<_>>(),
        [0.0, 1.0, 2.0, 6.0, 7.0, 8.0, 9.0, 10.0]
    );
}

#[test]
fn what_cannot_be_drawn_is_refused() {
    let points = vec![DVec2::ZERO, DVec2::X * 10.0];
    let message = |stroke: Stroke| stroke.anchors().unwrap_err().to_string();
    assert!(message(Stroke::default()).contains("it has no length"));
    assert!(message(Stroke { points: vec![DVec2::ONE; 3], ..Stroke::default() }).contains("it has no length"));
    assert!(message(Stroke { points: vec![DVec2::ZERO, DVec2::NAN], ..Stroke::default() }).contains("finite"));
    assert!(message(Stroke { points: points.clone(), spacing: 0.0, ..Stroke::default() }).contains("greater than 0"));
    assert!(message(Stroke { points, spacing: 1e-6, ..Stroke::default() }).contains("space them wider"));
    let stamp = Stamp { place: DVec2::ZERO, kind: Critical::Sink, radius: 0.0, speed: 1.0 };
    assert!(stamp.anchors().is_err() && Stamp { radius: 1.0, speed: f64::NAN, ..stamp }.anchors().is_err());
}
