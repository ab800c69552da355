//! Floor plans in SVG: style sheets, lines with a width, nested pictures, as areas of known size.

use std::f64::consts::PI;
use throng_scene::import::plan::{PlanGround, PlanOptions, from_text, ground};
use throng_scene::{ExitGoal, Goal};

/// Returns the ground of a picture of 20 m by 10 m that is walkable except for the shapes.
fn drawn(shapes: &str) -> PlanGround {
    let head = r#"<svg xmlns="http://www.w3.org/2000/svg" width="2000" height="1000" class="picture">"#;
    of(&format!(r#"{head}<rect id="floor" width="2000" height="1000"/>{shapes}</svg>"#))
}

fn of(text: &str) -> PlanGround {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.svg");
    std::fs::write(&path, text).unwrap();
    ground(path, &PlanOptions::default()).unwrap_or_else(|error| panic!("{text}: {error}"))
}

fn size(ground: &PlanGround) -> f64 {
    let ring = |ring: &Vec<glam::DVec2>| {
        let next = ring.iter().cycle().skip(1);
        (ring.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum::<f64>() * 0.5).abs()
    };
    ground.areas.iter().map(|area| ring(&area.outer) - area.holes.iter().map(ring).sum::<f64>()).sum()
}

/// Asserts that the shapes remove an area from the ground, m², within a tolerance.
fn takes(shapes: &str, solid: f64, tolerance: f64) {
    let found = 200.0 - size(&drawn(shapes));
    assert!((found - solid).abs() <= tolerance, "{shapes}: {found}, not {solid}");
}

/// Returns a wall of 1 m² with the given attributes, at a place.
fn wall(says: &str, x: u32) -> String {
    format!(r#"<rect {says} x="{x}" y="200" width="100" height="100"/>"#)
}

#[test]
fn corners_are_rounded() {
    for (radii, off) in [
        (r#"rx="50""#, 0.5 * 0.5),
        (r#"ry="50""#, 0.5 * 0.5),
        (r#"rx="100" ry="50""#, 1.0 * 0.5),
        // at most half of the side
        (r#"rx="900" ry="900""#, 2.0 * 1.0),
        (r#"rx="0" ry="50""#, 0.0),
    ] {
        takes(
            &format!(r#"<rect id="wall" {radii} x="200" y="200" width="400" height="200"/>"#),
            8.0 - (4.0 - PI) * off,
            0.06,
        );
    }
}

#[test]
fn style_sheets_say_what_is_shown() {
    let sheet = |css: &str| format!("<style>{css}</style>");
    let walls = wall(r#"class="wall a""#, 200)
        + r#"<g id="walls2" class="g">"#
        + &wall(r#"id="one""#, 400)
        + &wall("", 600)
        + "</g>";
    let all = walls.clone() + &wall(r#"class="wall" style="display:inline""#, 800);
    takes(&all, 4.0, 1e-6);
    for (css, solid) in [
        (".a { display: none }", 3.0),
        ("#one { display: none }", 3.0),
        (".g rect { display: none }", 2.0),
        ("svg.picture > g { display: none }", 2.0),
        // the style of the element itself has precedence, except over important declarations
        ("rect.wall { display: none }", 3.0),
        ("rect.wall { display: none !important }", 2.0),
        // higher specificity has precedence
        ("#one { visibility: visible } .g rect { visibility: hidden }", 3.0),
        (".g { visibility: hidden } #one { visibility: visible }", 3.0),
        ("/* nothing */ .other, text { display: none } @media print { .a { display: none } }", 4.0),
        ("rubbish { { ; } .a", 4.0),
    ] {
        takes(&(sheet(css) + &all), solid, 1e-6);
    }
    let holed = r#"<path class="wall" d="M200 200H600V600H200Z M300 300H500V500H300Z"/>"#;
    takes(holed, 16.0, 1e-6);
    takes(&(sheet("path { fill-rule: evenodd }") + holed), 12.0, 1e-6);
}

#[test]
fn what_is_not_seen_is_left_out() {
    takes(&wall(r#"class="wall" fill="none" stroke="none""#, 200), 0.0, 1e-6);
    let notes = drawn(&wall(r#"class="wall" style="fill:none;stroke:none""#, 200)).notes.join("\n");
    assert!(notes.contains("layer `wall`: shapes without fill and stroke are invisible: left out"), "{notes}");
    // an element in a group inherits the group's style, unless it has its own
    let group = |says: &str| format!(r#"<g id="walls" fill="none" stroke="none">{}</g>"#, wall(says, 200));
    takes(&group(""), 0.0, 1e-6);
    takes(&group(r#"fill="black""#), 1.0, 1e-6);
    takes(&group(r#"fill="inherit""#), 0.0, 1e-6);
}

#[test]
fn walls_are_as_thick_as_they_are_drawn() {
    let line = |says: &str| format!(r#"<line class="wall" x1="500" y1="500" x2="900" y2="500" {says}/>"#);
    takes(&line(r#"stroke="black" stroke-width="20""#), 4.0 * 0.2, 1e-6);
    takes(&line(r#"style="stroke:#000;stroke-width:20px;stroke-linecap:square""#), 4.2 * 0.2, 1e-6);
    takes(&line(r#"stroke="black" stroke-width="20" stroke-linecap="round""#), 4.0 * 0.2 + 0.01 * PI, 4e-3);
    takes(&line(r#"stroke="black" stroke-width="20" transform="translate(-500 -500) scale(2)""#), 8.0 * 0.4, 1e-6);
    // without a width, or with the width of other walls: 2 cm
    for thin in ["", r#"stroke="black""#, r#"stroke="black" stroke-width="2""#, r#"stroke="none" stroke-width="50""#] {
        takes(&line(thin), 4.02 * 0.02, 1e-6);
    }
    let pen = r#"stroke="black" stroke-width="20""#;
    // a rectangle of 4 m by 2 m: filled, or its outline alone, with agents inside
    let rect = |says: &str| format!(r#"<rect class="wall" x="200" y="200" width="400" height="200" {pen} {says}/>"#);
    takes(&rect(""), 4.2 * 2.2, 1e-6);
    takes(&rect(r#"fill="none""#), 4.2 * 2.2 - 3.8 * 1.8, 1e-6);
    takes(&rect(r#"fill="none" stroke-linejoin="bevel""#), 4.2 * 2.2 - 3.8 * 1.8 - 4.0 * 0.005, 1e-6);
    assert_eq!(drawn(&rect(r#"fill="none""#)).areas.len(), 2);
    // along a bend, and a triangle with tips that the miter limit cuts off
    takes(
        &format!(r#"<polyline class="wall" points="200,200 600,200 600,500" fill="none" {pen}/>"#),
        4.1 * 0.2 + 2.9 * 0.2,
        1e-6,
    );
    // only walls have widths
    let exit = from_text(
        "a.svg",
        r#"<svg xmlns="http://www.w3.org/2000/svg" width="20" height="10"><rect id="floor" width="20" height="10"/>
           <rect id="exit" stroke="red" stroke-width="4" width="2" height="2"/></svg>"#,
        &PlanOptions { unit: Some(1.0), ..PlanOptions::default() },
    );
    let goal: Option<ExitGoal> = exit.unwrap().scene.groups[0].goal.as_ref().and_then(Goal::read);
    let goal = format!("{goal:?}");
    assert!(goal.contains("[2.0, 8.0]") && !goal.contains("4.0"), "{goal}");
}

#[test]
fn pictures_in_pictures_have_their_own_units() {
    let inner = |says: &str, shape: &str| format!(r#"<svg id="wall" {says}>{shape}</svg>"#);
    // 4 by 2 units are 4 m by 2 m: scaled by ten, then centred in a viewport of twice the height, then stretched
    let shape = r#"<rect width="40" height="20"/>"#;
    let room = |h: u32, ratio: &str| format!(r#"x="200" y="100" width="400" height="{h}" viewBox="0 0 40 20" {ratio}"#);
    let corners = |ground: PlanGround| {
        let all = ground.areas[0].holes[0].clone();
        let by = |f: fn(f64, f64) -> f64, of: fn(&glam::DVec2) -> f64| all.iter().map(of).reduce(f).unwrap();
        [by(f64::min, |p| p.x), by(f64::max, |p| p.x), by(f64::min, |p| p.y), by(f64::max, |p| p.y)]
            .map(|x| (x * 1e6).round() / 1e6)
    };
    let lies = |says: &str, shape: &str| corners(drawn(&inner(says, shape)));
    assert_eq!(lies(&room(200, ""), shape), [2.0, 6.0, 7.0, 9.0]);
    assert_eq!(lies(&room(400, ""), shape), [2.0, 6.0, 6.0, 8.0]);
    assert_eq!(lies(&room(400, r#"preserveAspectRatio="xMidYMax""#), shape), [2.0, 6.0, 5.0, 7.0]);
    assert_eq!(lies(&room(400, r#"preserveAspectRatio="none""#), shape), [2.0, 6.0, 5.0, 9.0]);
    assert_eq!(lies(&room(400, r#"preserveAspectRatio="xMinYMin slice""#), shape), [2.0, 10.0, 5.0, 9.0]);
    // percentages of the enclosing picture: 10 % of 20 m, 50 % of the inner 40 units
    assert_eq!(
        lies(r#"x="10%" y="10%" width="20%" height="20%" viewBox="0 0 40 20""#, r#"<rect width="50%" height="50%"/>"#),
        [2.0, 4.0, 8.0, 9.0]
    );
    assert_eq!(corners(drawn(r#"<rect id="wall" x="50%" width="1cm" y="5mm" height="0.5in"/>"#)), {
        let cm = 0.96 / 2.54;
        [10.0, 10.0 + cm, 10.0 - 0.5 * cm - 0.48, 10.0 - 0.5 * cm].map(|x: f64| (x * 1e6).round() / 1e6)
    });
    // a symbol with the size that its copy defines
    let symbol = r##"<symbol id="s" viewBox="0 0 40 20"><rect width="40" height="20"/></symbol><use id="wall" href="#s" x="200" y="100" width="400" height="200"/>"##;
    assert_eq!(corners(drawn(symbol)), [2.0, 6.0, 7.0, 9.0]);
    // the height of the whole picture, in millimetres
    let whole = of(
        r#"<svg xmlns="http://www.w3.org/2000/svg" height="254mm"><rect id="floor" width="100" height="100"/></svg>"#,
    );
    assert!((whole.areas[0].outer.iter().map(|p| p.y).fold(0.0, f64::max) - 9.6).abs() < 1e-9, "{whole:?}");
}

#[test]
fn errors_have_their_position() {
    for (shape, expected) in [
        (r#"<rect id="wall" width="5 furlongs" height="1"/>"#, "<rect>: `width` is `5 furlongs`, which is no length"),
        (r#"<rect id="wall" width="5em" height="1"/>"#, "only lengths in px, %"),
        (r#"<rect id="wall" width="50%" height="1"/>"#, "give the picture a viewBox"),
        (
            r#"<line id="wall" x2="3" stroke="red" stroke-width="1e300"/>"#,
            "<line>: its stroke is more than 1000000000 units",
        ),
        (r#"<svg viewBox="0 0 0 0"/>"#, "<svg>: its viewBox is wrong"),
        (r#"<path id="wall" d="M0 0A5 49e60 0 1 1 9 9"/>"#, "<path>: its path goes farther than 1000000000 units"),
        (r#"<path id="wall" d="M0 0h1e80A5 4 0 1 1 9 9"/>"#, "<path>: its path goes farther than"),
        (r#"<line id="wall" x2="3" stroke="red" style="stroke-width: wide"/>"#, "<line>: `stroke-width` is `wide`"),
    ] {
        let text = format!(r#"<svg xmlns="http://www.w3.org/2000/svg">{shape}</svg>"#);
        let error = from_text("a.svg", &text, &PlanOptions::default()).unwrap_err();
        assert!(error.to_string().contains(expected) && error.at.is_some_and(|at| at.0 == 1), "{error}");
    }
}
