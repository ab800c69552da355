//! Fields through anchors, compared with their definition, with closed forms, and with transformed copies of
//! themselves.

use glam::{DMat2, DVec2, Vec3};
use proptest::prelude::*;
use throng::Error;
use throng::field::Field;
use throng_field::{Anchor, Anchors, Kernel, Note, Sketch};

fn vector(size: f64) -> impl Strategy<Value = DVec2> {
    (-size..size, -size..size).prop_map(DVec2::from)
}

/// Random anchors, anywhere, at any scale.
fn anchors(count: std::ops::Range<usize>) -> impl Strategy<Value = Vec<Anchor>> {
    let all = prop::collection::vec((vector(1.0), vector(2.0), prop_oneof![2 => Just(1.0), 1 => 1.0f64..4.0]), count);
    (all, vector(3000.0), 0.1f64..500.0).prop_map(|(all, middle, extent)| {
        let anchor = |(place, velocity, stretch)| Anchor { place: middle + place * extent, velocity, stretch };
        all.into_iter().map(anchor).collect()
    })
}

fn plain(mut anchors: Vec<Anchor>) -> Vec<Anchor> {
    anchors.iter_mut().for_each(|anchor| anchor.stretch = 1.0);
    anchors
}

fn field(anchors: &[Anchor], sketch: Sketch) -> Anchors {
    Anchors::new(anchors, sketch).unwrap()
}

/// Greatest distance from the first anchor.
fn extent(anchors: &[Anchor]) -> f64 {
    anchors.iter().map(|anchor| anchor.place.distance(anchors[0].place)).fold(0.0, f64::max)
}

/// Greatest distance from the line through the first two anchors.
fn across(anchors: &[Anchor]) -> f64 {
    let along = (anchors[1].place - anchors[0].place).normalize_or_zero();
    anchors.iter().map(|anchor| along.perp_dot(anchor.place - anchors[0].place).abs()).fold(0.0, f64::max)
}

/// Solves a system of equations with two right sides by Gaussian elimination with partial pivoting.
fn solve(mut rows: Vec<Vec<f64>>) -> Vec<DVec2> {
    let size = rows.len();
    for column in 0..size {
        let pivot = (column..size).max_by(|&a, &b| rows[a][column].abs().total_cmp(&rows[b][column].abs())).unwrap();
        rows.swap(column, pivot);
        let top = rows[column].clone();
        for row in &mut rows[column + 1..] {
            let factor = row[column] / top[column];
            row.iter_mut().zip(&top).for_each(|(value, top)| *value -= factor * top);
        }
    }
    let mut solved = vec![DVec2::ZERO; size];
    for row in (0..size).rev() {
        let known: DVec2 = (row + 1..size).map(|column| solved[column] * rows[row][column]).sum();
        solved[row] = (DVec2::new(rows[row][size], rows[row][size + 1]) - known) / rows[row][row];
    }
    solved
}

/// The thin plate of the paper, relative to its first anchor, without scaling or rotated axes.
fn by_definition(anchors: &[Anchor], at: DVec2) -> DVec2 {
    let count = anchors.len();
    let places: Vec<DVec2> = anchors.iter().map(|anchor| anchor.place - anchors[0].place).collect();
    let phi = |r: f64| if r > 0.0 { r * r * r.ln() } else { 0.0 };
    let terms = |place: DVec2| [1.0, place.x, place.y];
    let mut rows = Vec::new();
    for (place, anchor) in places.iter().zip(anchors) {
        let mut row: Vec<f64> = places.iter().map(|other| phi(place.distance(*other))).collect();
        row.extend(terms(*place));
        row.extend([anchor.velocity.x, anchor.velocity.y]);
        rows.push(row);
    }
    for term in 0..3 {
        let mut row: Vec<f64> = places.iter().map(|place| terms(*place)[term]).collect();
        row.extend([0.0; 5]);
        rows.push(row);
    }
    let solved = solve(rows);
    let at = at - anchors[0].place;
    let near: DVec2 = (0..count).map(|k| solved[k] * phi(at.distance(places[k]))).sum();
    near + (0..3).map(|term| solved[count + term] * terms(at)[term]).sum::<DVec2>()
}

proptest! {
    #[test]
    fn a_field_goes_through_its_anchors(all in anchors(1..60), reach in prop_oneof![Just(None), (0.05f64..3.0).prop_map(Some)]) {
        let wide = extent(&all).max(1e-3);
        let kernel = reach.map_or(Kernel::ThinPlate, |reach| Kernel::Wendland { reach: reach * wide });
        // systems of stretched compact kernels need not be solvable
        let all = if reach.is_some() && all.len() % 2 == 0 { all } else { plain(all) };
        let stretched = all.iter().any(|anchor| anchor.stretch != 1.0);
        let field = match Anchors::new(&all, Sketch { kernel, ..Sketch::default() }) {
            Err(Error::Shape { .. }) if stretched => return Ok(()),
            field => field.unwrap(),
        };
        for anchor in &all {
            let off = field.at(anchor.place).distance(anchor.velocity);
            prop_assert!(off <= 1e-5 * anchor.velocity.length().max(0.1), "{off} m/s off at {anchor:?}");
        }
    }

    #[test]
    fn a_thin_plate_is_what_the_paper_says(all in anchors(3..25), at in vector(1.5)) {
        let all = plain(all);
        let wide = extent(&all);
        // on nearly collinear anchors both lose digits
        prop_assume!(across(&all) > 0.05 * wide);
        let at = all[0].place + at * wide;
        let (ours, theirs) = (field(&all, Sketch::default()).at(at), by_definition(&all, at));
        prop_assert!(ours.distance(theirs) <= 1e-6 * theirs.length().max(1.0), "{ours} and {theirs}");
    }

    #[test]
    fn linear_fields_come_out_as_they_are(
        all in anchors(1..40), constant in vector(2.0), x in vector(0.5), y in vector(0.5), at in vector(2.0), smoothing in prop_oneof![Just(0.0), 0.0f64..10.0],
    ) {
        let all = plain(all);
        let wide = extent(&all).max(1.0);
        let middle = all[0].place;
        let linear = |place: DVec2| constant + DMat2::from_cols(x, y) * (place - middle) / wide;
        let all: Vec<Anchor> = all.into_iter().map(|anchor| Anchor { velocity: linear(anchor.place), ..anchor }).collect();
        let field = field(&all, Sketch { smoothing, ..Sketch::default() });
        let at = middle + at * wide;
        match all.len() {
            1 => prop_assert!(field.at(at).distance(constant) < 1e-9),
            // on one line: only along it
            2 => {
                let along = all[1].place - all[0].place;
                let on_line = middle + along * (at - middle).dot(along) / along.length_squared();
                prop_assert!(field.at(at).distance(linear(on_line)) < 1e-6);
            }
            _ => prop_assert!(field.at(at).distance(linear(at)) < 1e-5, "{} and {}", field.at(at), linear(at)),
        }
    }

    /// Rotated, shifted and scaled anchors have the rotated, shifted and scaled field.
    #[test]
    fn a_field_turns_with_its_anchors(all in anchors(1..30), at in vector(1.5), angle in -3.1f64..3.1, shift in vector(500.0), scale in 0.1f64..10.0) {
        let all = plain(all);
        let turn = DVec2::from_angle(angle);
        let move_to = |place: DVec2| (turn.rotate(place - all[0].place)) * scale + shift;
        let moved: Vec<Anchor> = all
            .iter()
            .map(|anchor| Anchor { place: move_to(anchor.place), velocity: turn.rotate(anchor.velocity), ..*anchor })
            .collect();
        let wide = extent(&all).max(1e-3);
        let sketch = |scale: f64| Sketch { fade: Some(0.7 * wide * scale), smoothing: 1e-4, max_speed: 1.5, ..Sketch::default() };
        let at = all[0].place + at * wide;
        let (here, there) = (field(&all, sketch(1.0)).at(at), field(&moved, sketch(scale)).at(move_to(at)));
        prop_assert!(turn.rotate(here).distance(there) < 1e-5, "{here} and {there}");
    }

    #[test]
    fn a_changed_velocity_gives_the_field_that_is_built_with_it(all in anchors(1..40), index: prop::sample::Index, velocity in vector(2.0), at in vector(1.5)) {
        let (mut all, index) = (plain(all), index.index(40));
        let mut dragged = field(&all, Sketch::default());
        if index >= all.len() {
            prop_assert_eq!(dragged.set_velocity(index, velocity), Err(Error::Unknown { what: "anchor", index }));
            return Ok(());
        }
        dragged.set_velocity(index, velocity).unwrap();
        all[index].velocity = velocity;
        let made = field(&all, Sketch::default());
        let at = all[0].place + at * extent(&all);
        prop_assert_eq!(dragged.at(at).to_array().map(f64::to_bits), made.at(at).to_array().map(f64::to_bits));
        prop_assert_eq!(dragged.anchors(), made.anchors());
    }

    /// Outside of the hull the field decreases with the distance from it, which is compared with a search over all
    /// edges.
    #[test]
    fn a_field_fades_outside_of_its_hull(all in anchors(3..30), at in vector(2.0), fade in 0.05f64..2.0) {
        let all = plain(all);
        let wide = extent(&all);
        let at = all[0].place + at * wide;
        let whole = field(&all, Sketch::default()).at(at);
        let faded = field(&all, Sketch { fade: Some(fade * wide), ..Sketch::default() }).at(at);
        // the greatest distance of any half-plane that contains all anchors; candidates have a border along an edge, or
        // through a corner
        let places: Vec<DVec2> = all.iter().map(|anchor| anchor.place).collect();
        let beyond = |normal: DVec2| normal.dot(at) - places.iter().map(|place| normal.dot(*place)).fold(f64::NEG_INFINITY, f64::max);
        let edges = places.iter().flat_map(|a| places.iter().map(move |b| (*b - *a).perp().normalize_or_zero()));
        let corners = places.iter().map(|place| (at - *place).normalize_or_zero());
        let distance = edges.chain(corners).filter(|normal| *normal != DVec2::ZERO).map(beyond).fold(0.0, f64::max);
        let expected = whole * (-(distance / (fade * wide)).powi(2)).exp();
        prop_assert!(faded.distance(expected) <= 1e-6 * whole.length().max(1.0), "{faded} and {expected} at {distance}");
    }

    #[test]
    fn nowhere_is_a_field_faster_than_it_may_be(all in anchors(1..30), at in vector(9.0), most in 0.1f64..2.0) {
        let all = plain(all);
        let field = field(&all, Sketch { max_speed: most, ..Sketch::default() });
        let at = all[0].place + at * extent(&all);
        prop_assert!(field.at(at).length() <= most * (1.0 + 1e-12));
        prop_assert!(field.velocity(at.as_vec2().extend(3.0), 7.0).length() <= most as f32 * 1.001);
    }

    /// The greater the smoothing, the farther the field is from its anchors' velocities, up to the plane of least
    /// squares.
    #[test]
    fn smoothing_leads_to_the_plane_of_least_squares(all in anchors(5..30), at in vector(1.0)) {
        let all = plain(all);
        let wide = extent(&all);
        prop_assume!(across(&all) > 0.1 * wide);
        let off = |smoothing: f64| {
            let field = field(&all, Sketch { smoothing, ..Sketch::default() });
            all.iter().map(|anchor| field.at(anchor.place).distance_squared(anchor.velocity)).sum::<f64>()
        };
        let all_off = [0.0, 1e-6, 1e-3, 1e-1, 10.0].map(off);
        prop_assert!(all_off.is_sorted_by(|a, b| *a <= b + 1e-9), "{all_off:?}");
        let terms = |place: DVec2| [1.0, (place.x - all[0].place.x) / wide, (place.y - all[0].place.y) / wide];
        let mut normal = vec![vec![0.0; 5]; 3];
        for anchor in &all {
            let t = terms(anchor.place);
            for row in 0..3 {
                (0..3).for_each(|column| normal[row][column] += t[row] * t[column]);
                normal[row][3] += t[row] * anchor.velocity.x;
                normal[row][4] += t[row] * anchor.velocity.y;
            }
        }
        let plane = solve(normal);
        let at = all[0].place + at * wide;
        let expected: DVec2 = (0..3).map(|term| plane[term] * terms(at)[term]).sum();
        let smooth = field(&all, Sketch { smoothing: 1e9, ..Sketch::default() }).at(at);
        prop_assert!(smooth.distance(expected) < 1e-5 * expected.length().max(1.0), "{smooth} and {expected}");
    }
}

#[test]
fn sets_that_span_nothing_have_sensible_fields_and_a_note() {
    let empty = field(&[], Sketch { fade: Some(1.0), ..Sketch::default() });
    assert_eq!((empty.at(DVec2::ONE), empty.notes()), (DVec2::ZERO, &[Note::Empty][..]));

    let (here, there) = (DVec2::new(3.0, -4.0), DVec2::new(50.0, 7.0));
    let one = field(&[Anchor::new(here, DVec2::X)], Sketch::default());
    assert_eq!((one.at(there), one.notes()), (DVec2::X, &[Note::OnePlace][..]));

    let shared = [Anchor::new(here, DVec2::X), Anchor::new(here, DVec2::Y), Anchor::new(here, DVec2::ZERO)];
    let shared = field(&shared, Sketch::default());
    assert!(shared.at(there).distance(DVec2::new(1.0, 1.0) / 3.0) < 1e-12);
    assert_eq!(shared.notes(), [Note::OnePlace, Note::Shared(2)]);

    let line = [0.0, 1.0, 4.0].map(|at| Anchor::new(here + DVec2::new(2.0, 1.0) * at, DVec2::X * at));
    let line = field(&line, Sketch::default());
    assert_eq!(line.notes(), [Note::OnLine]);
    assert!(line.at(here + DVec2::new(2.0, 1.0) * 3.0).distance(DVec2::X * 3.0) < 1e-9, "linear along it");
    assert!(line.at(here + DVec2::new(-1.0, 2.0)).length() < 1e-9, "the same on both sides");

    let corner = [(0.0, 0.0), (5.0, 0.0), (5.0, 5.0), (0.0, 0.0)].map(|place| Anchor::new(place.into(), DVec2::X));
    assert_eq!(field(&corner, Sketch::default()).notes(), [Note::Shared(1)]);
}

/// The influence of a single anchor is the kernel; a stretch of 4 doubles the reach along its velocity and halves it
/// across.
#[test]
fn a_stretched_anchor_reaches_farther_along_than_across() {
    let along = DVec2::from_angle(0.6);
    let kernel = Kernel::Wendland { reach: 10.0 };
    let one = Anchor { stretch: 4.0, ..Anchor::new(DVec2::new(7.0, 7.0), along) };
    let field = field(&[one], Sketch { kernel, ..Sketch::default() });
    let left = |r: f64| (1.0 - r).max(0.0).powi(4) * (4.0 * r + 1.0);
    for distance in [0.5, 3.0, 4.9, 8.0, 19.0, 21.0] {
        let speed = |direction: DVec2| field.at(one.place + direction * distance).length();
        assert!((speed(along) - left(distance / 20.0)).abs() < 1e-9, "along");
        assert!((speed(along.perp()) - left(distance / 5.0)).abs() < 1e-9, "across");
    }
}

#[test]
fn what_cannot_be_is_refused() {
    let message = |anchors: &[Anchor], sketch: Sketch| Anchors::new(anchors, sketch).unwrap_err().to_string();
    let (one, plain) = (Anchor::new(DVec2::ZERO, DVec2::X), Sketch::default());
    let lost = Anchor { place: DVec2::new(0.0, f64::NAN), ..one };
    assert_eq!(message(&[one, lost], plain), "place of an anchor is NaN, but must be finite");
    let fast = Anchor { velocity: DVec2::new(f64::INFINITY, 0.0), ..one };
    assert_eq!(message(&[fast], plain), "velocity of an anchor is inf, but must be finite");
    assert!(message(&[Anchor { stretch: 0.5, ..one }], plain).contains("must be 1 to 100"));
    assert!(message(&[Anchor { stretch: 2.0, ..one }], plain).contains("use Wendland's kernel"));
    let many = vec![one; 1_000_000];
    assert_eq!(message(&many, plain), "number of anchors is 1000000, but must be at most 4000: set them farther apart");
    for sketch in [
        Sketch { smoothing: -1.0, ..plain },
        Sketch { smoothing: f64::NAN, ..plain },
        Sketch { fade: Some(0.0), ..plain },
        Sketch { max_speed: 0.0, ..plain },
        Sketch { kernel: Kernel::Wendland { reach: 0.0 }, ..plain },
    ] {
        assert!(message(&[one], sketch).contains("must be"), "{sketch:?}");
    }
    let mut field = field(&[one], plain);
    assert!(field.set_velocity(0, DVec2::NAN).is_err());
    assert_eq!(field.velocity(Vec3::ONE, 0.0), Vec3::X, "as before");
}
