//! Splines and hatches of drawings, as areas of known size.

use std::f64::consts::PI;
use throng_scene::import::plan::{PlanOptions, ground};

/// Returns the ground of the entities of a drawing, pairs with spaces between the values, in metres: its areas, and
/// their size, m².
fn ground_of(entities: &str) -> Result<(throng_scene::import::plan::PlanGround, f64), throng_scene::Error> {
    let pairs = entities.split_whitespace().collect::<Vec<_>>().join("\n");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.dxf");
    let head = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n6\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n";
    std::fs::write(&path, format!("{head}{pairs}\n0\nENDSEC\n0\nEOF\n")).unwrap();
    let ground = ground(path, &PlanOptions::default())?;
    let ring = |ring: &Vec<glam::DVec2>| {
        let next = ring.iter().cycle().skip(1);
        (ring.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum::<f64>() * 0.5).abs()
    };
    let size = ground.areas.iter().map(|area| ring(&area.outer) - area.holes.iter().map(ring).sum::<f64>()).sum();
    Ok((ground, size))
}

/// Asserts that entities are ground of a size, within a centimetre along a boundary of length `rim`.
fn is(entities: &str, size: f64, rim: f64) {
    let (_, found) = ground_of(entities).unwrap_or_else(|error| panic!("{entities}: {error}"));
    assert!((found - size).abs() <= 0.01 * rim, "{entities}: {found}, not {size}");
}

/// Returns a circle of radius 5 about the origin as a rational spline: codes of degree, knots, points, weights.
fn circle(degree: u32, weights: u32) -> String {
    let root = std::f64::consts::FRAC_1_SQRT_2;
    let rim = [(5, 0), (5, 5), (0, 5), (-5, 5), (-5, 0), (-5, -5), (0, -5), (5, -5), (5, 0)];
    let points: String = rim.iter().map(|(x, y)| format!(" 10 {x} 20 {y} 30 0")).collect();
    let each = |code: u32, values: &[f64]| values.iter().map(|x| format!(" {code} {x}")).collect::<String>();
    let weights = each(weights, &[1.0, root, 1.0, root, 1.0, root, 1.0, root, 1.0]);
    format!("{degree} 2{}{points}{weights}", each(40, &[0., 0., 0., 1., 1., 2., 2., 3., 3., 4., 4., 4.]))
}

#[test]
fn splines_are_followed() {
    is(&format!("0 SPLINE 8 room 70 12 {}", circle(71, 41)), 25.0 * PI, 10.0 * PI);
    // a parabola y = x² from -2 to 2, closed at the top: a square of 4 by 4 minus the area below the parabola
    let bezier = "71 2 40 0 40 0 40 0 40 1 40 1 40 1 10 -2 20 4 10 0 20 -4 10 2 20 4";
    is(&format!("0 SPLINE 8 room 70 1 {bezier}"), 32.0 / 3.0, 10.0);
    // open, with a line that closes it
    is(&format!("0 SPLINE 8 room 70 0 {bezier} 0 LINE 8 room 10 2 20 4 11 -2 21 4"), 32.0 / 3.0, 10.0);
    // an extrusion direction downwards does not change its coordinates
    is(&format!("0 SPLINE 8 room 230 -1 70 1 {bezier}"), 32.0 / 3.0, 10.0);
    // fit points on a circle only
    let fit: String = (0..=24)
        .map(|k| f64::from(k % 24) * PI / 12.0)
        .map(|a| format!(" 11 {} 21 {} 31 0", 5.0 * a.cos(), 5.0 * a.sin()))
        .collect();
    is(&format!("0 SPLINE 8 room 70 9 71 3{fit}"), 25.0 * PI, 10.0 * PI);
}

#[test]
fn errors_of_splines_have_their_line() {
    for (spline, expected) in [
        (
            "70 1 71 2 40 0 40 1 10 0 20 0 10 1 20 0 10 1 20 1",
            "3 control points and 2 knots: it needs 3 points or more, and 6 knots",
        ),
        ("70 1 71 0 40 0 10 0 20 0", "has the degree 0"),
        ("70 1 71 1 40 0 40 2 40 1 40 3 10 0 20 0 10 1 20 0", "the knots of this spline go back"),
        ("70 1 71 1 40 0 40 0 40 1 40 1 41 1 41 0 10 0 20 0 10 1 20 0", "needs a weight of more than 0"),
    ] {
        let error = ground_of(&format!("0 SPLINE 8 room {spline}")).unwrap_err();
        assert!(error.message.contains(expected) && error.at == Some((16, 1)), "{error}");
    }
}

/// Returns a path of a hatch with these corners.
fn path(corners: &[(i32, i32)]) -> String {
    let corners: String = corners.iter().map(|(x, y)| format!(" 10 {x} 20 {y}")).collect();
    format!("92 2 72 0 73 1 93 4{corners} 97 0 ")
}

fn square(low: i32, high: i32) -> String {
    path(&[(low, low), (high, low), (high, high), (low, high)])
}

fn hatch(style: u32, paths: &str) -> String {
    let count = paths.matches("92 ").count();
    // the elevation before and the seeds of the pattern after the paths are not corners
    format!("0 HATCH 8 room 10 0 20 0 30 0 2 SOLID 70 1 71 0 91 {count} {paths}75 {style} 76 1 98 1 10 99 20 99")
}

#[test]
fn a_hatch_fills_by_its_style() {
    let nested = square(0, 10) + &square(1, 9) + &square(4, 6);
    is(&hatch(0, &nested), 100.0 - 64.0 + 4.0, 1e-4);
    is(&hatch(1, &nested), 100.0 - 64.0, 1e-4);
    is(&hatch(2, &nested), 100.0, 1e-4);
    let (two, _) = ground_of(&hatch(0, &(square(0, 4) + &square(6, 9)))).unwrap();
    assert_eq!(two.areas.len(), 2);
}

#[test]
fn the_edges_of_hatches_are_followed() {
    // a polyline with bulges: a disc
    is(&hatch(0, "92 2 72 1 73 1 93 2 10 -5 20 0 42 1 10 5 20 0 42 1 97 0 "), 25.0 * PI, 10.0 * PI);
    // a half disc: a line and an arc, counter-clockwise or clockwise
    let line = "72 1 10 -5 20 0 11 5 21 0";
    for arc in ["72 2 10 0 20 0 40 5 50 0 51 180 73 1", "72 2 10 0 20 0 40 5 50 180 51 360 73 0"] {
        for path in [format!("92 1 93 2 {line} {arc} 97 0 "), format!("92 1 93 2 {arc} {line} 97 0 ")] {
            is(&hatch(0, &path), 12.5 * PI, 20.0);
        }
    }
    // the lower half, with a line in the opposite direction
    is(&hatch(0, "92 1 93 2 72 1 10 5 20 0 11 -5 21 0 72 2 10 0 20 0 40 5 50 180 51 360 73 1 97 0 "), 12.5 * PI, 20.0);
    // an ellipse of 8 by 4, and a quarter of it with the two half axes
    is(&hatch(0, "92 1 93 1 72 3 10 0 20 0 11 8 21 0 40 0.5 50 0 51 360 73 1 97 0 "), 32.0 * PI, 40.0);
    let axes = "72 1 10 0 20 4 11 0 21 0 72 1 10 0 20 0 11 8 21 0";
    is(&hatch(0, &format!("92 1 93 3 72 3 10 0 20 0 11 8 21 0 40 0.5 50 0 51 90 73 1 {axes} 97 0 ")), 8.0 * PI, 20.0);
    // up to 45°: a sector of an ellipse is that of the circle it is stretched from
    let corner = 8.0 / 5.0f64.sqrt();
    let rays = format!("72 1 10 {corner} 20 {corner} 11 0 21 0 72 1 10 0 20 0 11 8 21 0");
    let sector = format!("92 1 93 3 72 3 10 0 20 0 11 8 21 0 40 0.5 50 0 51 45 73 1 {rays} 97 0 ");
    is(&hatch(0, &sector), 16.0 * 2.0f64.atan(), 20.0);
    is(&hatch(0, &format!("92 1 93 1 72 4 {} 97 0 ", circle(94, 42))), 25.0 * PI, 10.0 * PI);
    // an island: a disc in a square
    let island = format!("{}92 16 93 1 72 2 10 5 20 5 40 2 50 0 51 360 73 1 97 0 ", square(0, 10));
    is(&hatch(0, &island), 100.0 - 4.0 * PI, 4.0 * PI);
    // an extrusion direction downwards mirrors it
    let (below, _) = ground_of(&hatch(0, &square(2, 4)).replace("8 room", "8 room 230 -1")).unwrap();
    assert!(below.areas[0].outer.iter().all(|p| p.x <= -2.0 && p.y >= 2.0), "{below:?}");
}

#[test]
fn arcs_of_ellipses_seen_from_below_go_the_other_way_round() {
    // a quarter about (10, 0), with an extrusion direction downwards clockwise: below the axis
    let quarter = |below: &str| {
        let lines = |y: i32| format!("0 LINE 8 room 10 18 20 0 11 10 21 0 0 LINE 8 room 10 10 20 0 11 10 21 {y}");
        let y = if below.is_empty() { 4 } else { -4 };
        let ellipse = format!("0 ELLIPSE 8 room {below} 10 10 20 0 11 8 21 0 40 0.5 41 0 42 {}", PI * 0.5);
        format!("{ellipse} {}", lines(y))
    };
    is(&quarter(""), 8.0 * PI, 20.0);
    is(&quarter("230 -1"), 8.0 * PI, 20.0);
}

/// The areas of the drawing of `tests/plans/ezdxf.py`, as ezdxf finds them with lines 1 µm off its curves, m².
const EZDXF: [f64; 8] = [31.689235, 35.399997, 46.625445, 89.853478, 20.719100, 49.000001, 11.885655, 12.524181];

#[test]
fn drawings_of_another_program_are_read_as_it_reads_them() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/plans/ezdxf.dxf");
    let mut areas = ground(path, &PlanOptions::default()).unwrap_or_else(|error| panic!("{error}")).areas;
    areas.sort_by(|a, b| a.outer[0].x.total_cmp(&b.outer[0].x));
    let ring = |ring: &Vec<glam::DVec2>| {
        let next = ring.iter().cycle().skip(1);
        let (size, rim) =
            ring.iter().zip(next).fold((0.0, 0.0), |(s, r), (a, b)| (s + a.perp_dot(*b), r + a.distance(*b)));
        (f64::abs(size * 0.5), rim)
    };
    assert_eq!(areas.len(), EZDXF.len());
    for (area, expected) in areas.iter().zip(EZDXF) {
        let (size, rim) = ring(&area.outer);
        let size = size - area.holes.iter().map(|hole| ring(hole).0).sum::<f64>();
        assert!((size - expected).abs() < 0.01 * rim, "{size}, not {expected}: {area:?}");
    }
}
