//! Fields through anchors in space.

use glam::{DMat3, DVec3};
use proptest::prelude::*;
use throng::Error;
use throng_field::{AnchorsInSpace, Kernel, Note, Sketch};

fn vector(size: f64) -> impl Strategy<Value = DVec3> {
    (-size..size, -size..size, -size..size).prop_map(DVec3::from)
}

/// Anchors at different places.
fn anchors() -> impl Strategy<Value = Vec<(DVec3, DVec3)>> {
    prop::collection::vec((vector(20.0), vector(3.0)), 4..40)
        .prop_filter("apart", |all| (0..all.len()).all(|i| (0..i).all(|j| all[i].0.distance(all[j].0) > 0.2)))
}

/// The system of Jin et al., IEEE CG&A 28(6), 2008 for the kernel r, by Gaussian elimination, relative to the origin
/// and in metres.
fn by_elimination(anchors: &[(DVec3, DVec3)], at: DVec3) -> DVec3 {
    let (count, size) = (anchors.len(), anchors.len() + 4);
    let term = |index: usize, place: DVec3| if index == 0 { 1.0 } else { place[index - 1] };
    let mut rows: Vec<Vec<f64>> = (0..size)
        .map(|row| {
            let entry = |column: usize| match (row < count, column < count) {
                (true, true) => anchors[row].0.distance(anchors[column].0),
                (true, false) => term(column - count, anchors[row].0),
                (false, true) => term(row - count, anchors[column].0),
                (false, false) => 0.0,
            };
            let right = if row < count { anchors[row].1 } else { DVec3::ZERO };
            (0..size).map(entry).chain(right.to_array()).collect()
        })
        .collect();
    for column in 0..size {
        let pivot = (column..size).max_by(|&a, &b| rows[a][column].abs().total_cmp(&rows[b][column].abs())).unwrap();
        rows.swap(column, pivot);
        let head = rows[column].clone();
        for (row, values) in rows.iter_mut().enumerate().filter(|(row, _)| *row != column) {
            let part = values[column] / head[column];
            assert!(row < size);
            values.iter_mut().zip(&head).for_each(|(value, head)| *value -= part * head);
        }
    }
    let weight = |row: usize| DVec3::from_slice(&rows[row][size..]) / rows[row][row];
    let influence = |row: usize| if row < count { anchors[row].0.distance(at) } else { term(row - count, at) };
    (0..size).map(|row| weight(row) * influence(row)).sum()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn it_is_the_solution_of_the_system(anchors in anchors(), at in vector(25.0), shift in vector(500.0)) {
        let moved: Vec<_> = anchors.iter().map(|&(place, velocity)| (place + shift, velocity)).collect();
        let field = AnchorsInSpace::new(&moved, Sketch::default()).unwrap();
        let expected = by_elimination(&anchors, at);
        prop_assert!(field.at(at + shift).distance(expected) < 1e-5 * (1.0 + expected.length()), "{} {expected}", field.at(at + shift));
        for (place, velocity) in moved {
            prop_assert!(field.at(place).distance(velocity) < 1e-6 * (1.0 + velocity.length()));
        }
    }

    /// Linear fields, rotations included, are reproduced; for anchors that do not span space, within the subspace that
    /// they span.
    #[test]
    fn linear_fields_are_reproduced(places in prop::collection::vec(vector(10.0), 5..20), m in prop::array::uniform9(-1.0f64..1.0), c in vector(2.0), flat in any::<bool>(), at in vector(10.0)) {
        let flatten = |place: DVec3| if flat { place.with_z(0.5 * place.x) } else { place };
        let linear = |place: DVec3| DMat3::from_cols_array(&m) * place + c;
        let anchors: Vec<_> = places.iter().map(|&place| (flatten(place), linear(flatten(place)))).collect();
        let field = AnchorsInSpace::new(&anchors, Sketch::default()).unwrap();
        let at = flatten(at);
        prop_assert!(field.at(at).distance(linear(at)) < 1e-6, "{} {}", field.at(at), linear(at));
        prop_assert_eq!(field.notes().contains(&Note::OnPlane), flat);
    }
}

#[test]
fn few_anchors_and_those_in_one_place_make_sense() {
    let through = |all: &[(DVec3, DVec3)], sketch: Sketch| AnchorsInSpace::new(all, sketch).unwrap();
    let plain = Sketch::default();
    assert_eq!(through(&[], plain).at(DVec3::ONE), DVec3::ZERO);
    assert_eq!(through(&[], plain).notes(), [Note::Empty]);
    let one = through(&[(DVec3::ONE, DVec3::X)], plain);
    assert!(one.at(DVec3::splat(9.0)).distance(DVec3::X) < 1e-12 && one.notes() == [Note::OnePlace]);
    let two = through(&[(DVec3::ZERO, DVec3::X), (DVec3::Z * 2.0, DVec3::Y), (DVec3::Z * 2.0, -DVec3::Y)], plain);
    assert!(two.at(DVec3::new(7.0, 7.0, 1.0)).distance(DVec3::X * 0.5) < 1e-9);
    assert_eq!(two.notes(), [Note::OnLine, Note::Shared(1)]);
    // a kernel with a reach ends there; fading ends a plate
    let near = through(&[(DVec3::ZERO, DVec3::X)], Sketch { kernel: Kernel::Wendland { reach: 3.0 }, ..plain });
    assert!(near.at(DVec3::X * 1.5).x > 0.1 && near.at(DVec3::Y * 3.1) == DVec3::ZERO);
    let faded = through(&[(DVec3::ZERO, DVec3::X)], Sketch { fade: Some(2.0), ..plain });
    assert!((faded.at(DVec3::Y * 2.0).x - (-1.0f64).exp()).abs() < 1e-12);
    let slow = through(&[(DVec3::ZERO, DVec3::X * 5.0)], Sketch { max_speed: 2.0, ..plain });
    assert!(slow.at(DVec3::ZERO).distance(DVec3::X * 2.0) < 1e-12);
}

#[test]
fn mistakes_in_space_are_told() {
    let limit = |all: &[(DVec3, DVec3)], sketch: Sketch| match AnchorsInSpace::new(all, sketch) {
        Err(Error::Limit { what, .. }) => what,
        other => panic!("{other:?}"),
    };
    assert_eq!(limit(&[(DVec3::NAN, DVec3::X)], Sketch::default()), "place of an anchor");
    assert_eq!(limit(&[(DVec3::X, DVec3::splat(f64::INFINITY))], Sketch::default()), "velocity of an anchor");
    assert_eq!(limit(&vec![(DVec3::X, DVec3::X); 1_000_000], Sketch::default()), "number of anchors");
    assert_eq!(limit(&[], Sketch { smoothing: -1.0, ..Sketch::default() }), "smoothing of a field");
}
