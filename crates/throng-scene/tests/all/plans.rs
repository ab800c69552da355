//! Floor plans of every kind become scenes in which agents leave.

use super::data::data;
use throng_scene::import::plan::{PlanOptions, from_text, load};
use throng_scene::{ExitGoal, Goal, Kind, PointsPlace, PolygonPlace, Region, Scene, Shape, Walkable};

const ROOM: &str = r#"{ "type": "FeatureCollection", "features": [
    { "type": "Feature", "properties": { "layer": "floor" }, "geometry": { "type": "Polygon", "coordinates":
        [[[0, 0], [20, 0], [20, 10], [0, 10], [0, 0]]] } },
    { "type": "Feature", "properties": { "layer": "walls" }, "geometry": { "type": "LineString", "coordinates":
        [[10, 0], [10, 4]] } },
    { "type": "Feature", "properties": { "type": "column" }, "geometry": { "type": "Polygon", "coordinates":
        [[[14, 4], [15, 4], [15, 5], [14, 5], [14, 4]]] } },
    { "type": "Feature", "properties": { "name": "Exit east" }, "geometry": { "type": "Polygon", "coordinates":
        [[[19, 4], [20, 4], [20, 6], [19, 6], [19, 4]]] } },
    { "type": "Feature", "properties": { "layer": "spawn", "people": 12 }, "geometry": { "type": "Polygon", "coordinates":
        [[[1, 1], [6, 1], [6, 9], [1, 9], [1, 1]]] } },
    { "type": "Feature", "properties": { "layer": "axis" }, "geometry": { "type": "LineString", "coordinates":
        [[0, 5], [20, 5]] } }
] }"#;

/// The same room in the other formats: 20 m by 10 m, a wall, a column, an exit, a start place.
const DRAWN: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
        width="2000" height="1000">
    <g inkscape:label="Walkable"><rect width="2000" height="1000"/></g>
    <g id="walls" stroke="black"><line x1="1000" y1="1000" x2="1000" y2="600"/></g>
    <g id="layer4" inkscape:label="columns" transform="translate(1400 500)"><path d="M0 0h100v100h-100z"/></g>
    <g id="exit"><path d="M1900,400 L2000,400 2000,600 1900,600 Z"/></g>
    <polygon class="start" points="100,100 600,100 600,900 100,900"/>
    <g id="axis"><path d="M0 500 H2000"/></g>
    <g id="wall_hidden" style="display:none"><rect width="500" height="500"/></g>
</svg>"#;

fn scene(name: &str, text: &str) -> (Scene, String) {
    let imported = from_text(name, text, &PlanOptions::default()).unwrap_or_else(|error| panic!("{name}: {error}"));
    imported.scene.build().unwrap_or_else(|error| panic!("{name}: {error}"));
    (imported.scene, imported.notes.join("\n"))
}

/// Returns a DXF drawing in metres or another unit. Each entity is a line of pairs.
fn dxf(unit: u32, entities: &[&str]) -> String {
    let head = format!("0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n{unit}\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n");
    let pairs: String = entities.iter().flat_map(|entity| entity.split(' ')).map(|word| format!("{word}\n")).collect();
    head + &pairs + "0\nENDSEC\n0\nEOF\n"
}

/// Returns the exit to which the agents of the first group go.
fn exit(scene: &Scene) -> Option<Region> {
    scene.groups[0].goal.as_ref().and_then(Goal::read).map(|ExitGoal(region)| region)
}

#[test]
fn a_plan_of_a_few_centimetres_names_its_likely_unit() {
    let room = |unit: u32, wide: u32, ask: &PlanOptions| {
        let high = wide / 2;
        let floor = format!("0 LWPOLYLINE 8 floor 70 1 10 0 20 0 10 {wide} 20 0 10 {wide} 20 {high} 10 0 20 {high}");
        let (from, to) = (wide - wide / 10, wide - 1);
        let exit =
            format!("0 LWPOLYLINE 8 exit 70 1 10 {from} 20 1 10 {to} 20 1 10 {to} 20 {high} 10 {from} 20 {high}");
        match from_text("room.dxf", &dxf(unit, &[&floor, &exit]), ask) {
            Ok(imported) => imported.notes.join("\n"),
            Err(error) => error.to_string(),
        }
    };
    // 20 m, drawn in metres, centimetres and millimetres, and tagged as millimetres, micrometres and micrometres
    for (code, wide, size, unit) in [(4, 20, "0.02", "1"), (13, 2000, "0.002", "0.01"), (13, 20_000, "0.02", "0.001")] {
        let message = room(code, wide, &PlanOptions::default());
        let wanted = format!("the whole plan is only {size} m wide");
        assert!(message.contains(&wanted) && message.contains(&format!("--plan-unit {unit},")), "{message}");
        let fixed = room(code, wide, &PlanOptions { unit: Some(unit.parse().unwrap()), ..PlanOptions::default() });
        assert!(!fixed.contains("plan-unit"), "{fixed}");
    }
    // a telephone box is small, but its unit is right
    assert!(!room(5, 110, &PlanOptions::default()).contains("plan-unit"));
}

#[test]
fn the_layers_of_a_room_say_what_is_what() {
    let (geojson, notes) = scene("room.geojson", ROOM);
    assert!(notes.contains("layer `axis`: a shape without a known role: left out"), "{notes}");
    let (drawn, notes) = scene("room.svg", DRAWN);
    assert!(notes.contains("a pixel, or unit of the view box, is taken to be 0.01 m"), "{notes}");
    let corner = |layer: &str, x: u32, y: u32| format!("0 LWPOLYLINE 8 {layer} 70 1 10 {x} 20 {y}");
    let box_ = |layer: &str, x: u32, y: u32, w: u32, h: u32| {
        format!("{} 10 {} 20 {y} 10 {} 20 {} 10 {x} 20 {}", corner(layer, x, y), x + w, x + w, y + h, y + h)
    };
    let cad = dxf(
        5,
        &[
            &box_("Floor", 0, 0, 2000, 1000),
            "0 LINE 8 A-WALL 10 1000 20 0 11 1000 21 400",
            &box_("Columns", 1400, 400, 100, 100),
            &box_("EXIT", 1900, 400, 100, 200),
            &box_("Start", 100, 100, 500, 800),
            "0 TEXT 8 0 10 300 20 500 1 people=12",
            "0 LINE 8 axis 10 0 20 500 11 2000 21 500",
        ],
    );
    let (cad, _) = scene("room.dxf", &cad);
    for (what, scene) in [("geojson", &geojson), ("svg", &drawn), ("dxf", &cad)] {
        let Some(Walkable::Polygon(area)) = &scene.walkable else { panic!("{what}: {:?}", scene.walkable) };
        assert!(area.outer.contains(&[20.0, 10.0]) && area.holes.is_empty(), "{what}: {area:?}");
        let shapes: Vec<&Shape> = scene.obstacles.iter().map(|obstacle| &obstacle.shape).collect();
        let wall = |shape: &&Shape| matches!(shape, Shape::Wall(points) if points.contains(&[10.0, 0.0]) && points.contains(&[10.0, 4.0]));
        let column = |shape: &&Shape| matches!(shape, Shape::Polygon(corners) if corners.contains(&[15.0, 5.0]) && corners.len() == 4);
        assert!(shapes.len() == 2 && shapes.iter().any(wall) && shapes.iter().any(column), "{what}: {shapes:?}");
        assert!(exit(scene).is_some(), "{what}");
        let place: PolygonPlace = scene.groups[0].place.read().unwrap();
        assert!(place.corners.contains(&[6.0, 9.0]), "{what}");
        // 40 m² without a number: an agent on every 4 m²
        assert_eq!(scene.groups[0].count, Some(if what == "svg" { 10 } else { 12 }), "{what}");
    }
}

#[test]
fn what_is_asked_for_comes_before_what_the_plan_says() {
    let ask = PlanOptions { exit: Some([18.0, 1.0, 1.0, 2.0]), people: Some(30), ..PlanOptions::default() };
    let scene = from_text("room.geojson", ROOM, &ask).unwrap().scene;
    assert_eq!(scene.groups[0].count, Some(30));
    assert!(matches!(exit(&scene), Some(Region::Rectangle(r)) if r.center == [18.5, 2.0]));
    let halved =
        from_text("room.geojson", ROOM, &PlanOptions { unit: Some(0.5), ..PlanOptions::default() }).unwrap().scene;
    let Some(Walkable::Polygon(area)) = halved.walkable else { panic!() };
    assert!(area.outer.contains(&[10.0, 5.0]));
}

#[test]
fn degrees_become_metres() {
    // a square of 0.001 degrees at 50 degrees north: 71.70 m by 111.23 m (WGS 84)
    let text = r#"{ "type": "FeatureCollection", "features": [
        { "type": "Feature", "properties": {}, "geometry": { "type": "Polygon", "coordinates":
            [[[8.0, 50.0], [8.001, 50.0], [8.001, 50.001], [8.0, 50.001], [8.0, 50.0]]] } } ] }"#;
    let ask = PlanOptions { exit: Some([30.0, 50.0, 4.0, 4.0]), people: Some(5), ..PlanOptions::default() };
    let imported = from_text("square.geojson", text, &ask).unwrap();
    let Some(Walkable::Polygon(area)) = &imported.scene.walkable else { panic!() };
    let [low, high] = [area.outer[0], area.outer[2]];
    assert!((high[0] - low[0] - 71.70).abs() < 0.01 && (high[1] - low[1] - 111.23).abs() < 0.01, "{low:?} {high:?}");
    assert!((high[0] + low[0]).abs() < 1e-9);
    assert!(imported.notes[0].starts_with("degrees (WGS 84)"), "{:?}", imported.notes);
}

#[test]
fn curves_of_a_drawing_are_followed() {
    let area = |entity: &str| {
        let text = dxf(6, &[entity, "0 POINT 8 exit 10 0 20 0"]);
        let scene = from_text("a.dxf", &text, &PlanOptions { people: Some(1), ..PlanOptions::default() })
            .unwrap_or_else(|error| panic!("{error}"))
            .scene;
        let Some(Walkable::Polygon(area)) = scene.walkable else { panic!() };
        let next = area.outer.iter().cycle().skip(1);
        (area.outer.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>() * 0.5).abs()
    };
    let pi = std::f64::consts::PI;
    // a lens of two half circles, a circle, an ellipse: each smaller by less than its circumference times 1 cm
    for (entity, size) in [
        ("0 LWPOLYLINE 8 room 70 1 10 -5 20 0 42 1 10 5 20 0 42 1", 25.0 * pi),
        ("0 CIRCLE 8 room 10 0 20 0 40 5", 25.0 * pi),
        ("0 ELLIPSE 8 room 10 0 20 0 11 8 21 0 40 0.5 41 0 42 6.283185307179586", 32.0 * pi),
        ("0 ARC 8 room 10 0 20 0 40 5 50 0 51 180 0 LINE 8 room 10 -5 20 0 11 5 21 0", 12.5 * pi),
        ("0 POLYLINE 8 room 70 1 0 VERTEX 10 -5 20 0 42 1 0 VERTEX 10 5 20 0 42 1 0 SEQEND", 25.0 * pi),
        ("0 SOLID 8 room 10 -1 20 -1 11 1 21 -1 12 -1 22 1 13 1 23 1", 4.0),
    ] {
        let is = area(entity);
        assert!(is <= size + 1e-6 && is > size - 0.01 * 60.0, "{entity}: {is}, not {size}");
    }
}

#[test]
fn blocks_are_inserted_turned_and_scaled() {
    let text = "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nCOL\n10\n1\n20\n1\n0\nCIRCLE\n8\n0\n10\n1\n20\n1\n40\n0.5\n0\nLINE\n8\nexit\n10\n1\n20\n1\n11\n3\n21\n1\n\
        0\nENDBLK\n0\nENDSEC\n"
        .to_owned()
        + &dxf(6, &["0 LWPOLYLINE 8 floor 70 1 10 -9 20 -9 10 9 20 -9 10 9 20 9 10 -9 20 9", "0 INSERT 8 COLUMNS 2 COL 10 4 20 5 41 2 42 2 50 90"]);
    let scene = from_text("a.dxf", &text, &PlanOptions { people: Some(3), ..PlanOptions::default() }).unwrap().scene;
    // layer 0 of a block becomes the layer where it is inserted
    let [obstacle] = scene.obstacles.as_slice() else { panic!("{:?}", scene.obstacles) };
    assert!(matches!(&obstacle.shape, Shape::Circle(c) if c.radius == 1.0 && c.center == [4.0, 5.0]), "{obstacle:?}");
    // 2 m along x become 4 m along y
    let Some(Region::Polygon(exit)) = exit(&scene) else { panic!("{:?}", scene.groups[0].goal) };
    assert!(
        exit.iter().any(|p| (p[1] - 9.0).abs() < 1e-9) && exit.iter().all(|p| (p[0] - 4.0).abs() < 0.51),
        "{exit:?}"
    );
}

#[test]
fn transforms_and_copies_of_a_picture_are_followed() {
    let text = r##"<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="0 0 10 10">
        <defs><g id="part"><circle id="pillar" r="0.5"/></g></defs>
        <rect class="floor" width="10" height="10"/>
        <g id="columns" transform="translate(2,2) rotate(90) scale(2)"><use xlink:href="#part" x="1" y="0"/></g>
        <rect class="exit" x="4" y="8" width="2" height="2"/>
    </svg>"##;
    let scene = from_text("a.svg", text, &PlanOptions { unit: Some(1.0), people: Some(3), ..PlanOptions::default() })
        .unwrap()
        .scene;
    let [obstacle] = scene.obstacles.as_slice() else { panic!("{:?}", scene.obstacles) };
    let Shape::Polygon(corners) = &obstacle.shape else { panic!("{obstacle:?}") };
    // (1, 0) becomes (2, 4), which is at y = 6 from the bottom
    assert!(corners.iter().all(|p| ((p[0] - 2.0).hypot(p[1] - 6.0) - 1.0).abs() < 1e-9), "{corners:?}");
}

#[test]
fn the_hole_of_a_path_is_a_hole() {
    let text = |rule: &str| {
        format!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" width="10" height="10">
            <path class="floor" fill-rule="{rule}" d="M0 0H10V10H0Z M4 4V6H6V4Z"/><rect class="exit" width="2" height="2"/></svg>"#
        )
    };
    let holes = |rule: &str| {
        let ask = PlanOptions { unit: Some(1.0), people: Some(3), ..PlanOptions::default() };
        let Some(Walkable::Polygon(area)) = from_text("a.svg", &text(rule), &ask).unwrap().scene.walkable else {
            panic!()
        };
        area.holes.len()
    };
    // the rings have opposite orientations
    assert_eq!((holes("evenodd"), holes("nonzero")), (1, 1));
}

#[test]
fn walls_round_a_room_are_lines_and_a_wall_with_rooms_in_it_is_solid() {
    let text = |coordinates: &str| {
        format!(
            r#"{{ "type": "FeatureCollection", "features": [
        {{ "type": "Feature", "properties": {{ "layer": "wall" }}, "geometry": {{ "type": "Polygon", "coordinates": {coordinates} }} }},
        {{ "type": "Feature", "properties": {{ "layer": "exit" }}, "geometry": {{ "type": "Point", "coordinates": [8, 5] }} }},
        {{ "type": "Feature", "properties": {{ "layer": "start" }}, "geometry": {{ "type": "Polygon", "coordinates":
            [[[1, 1], [4, 1], [4, 9], [1, 9], [1, 1]]] }} }} ] }}"#
        )
    };
    let (outline, _) = scene("a.geojson", &text("[[[0, 0], [10, 0], [10, 10], [0, 10], [0, 0]]]"));
    assert!(matches!(&outline.obstacles[0].shape, Shape::Wall(points) if points.len() == 5));
    let (solid, _) = scene(
        "a.geojson",
        &text("[[[-1, -1], [11, -1], [11, 11], [-1, 11], [-1, -1]], [[0, 0], [10, 0], [10, 10], [0, 10], [0, 0]]]"),
    );
    assert!(solid.obstacles.iter().all(|o| matches!(o.shape, Shape::Polygon(_))) && solid.obstacles.len() >= 2);
}

#[test]
fn a_plan_without_an_exit_is_no_scene() {
    let text = ROOM.replace("Exit east", "east");
    let error = from_text("room.geojson", &text, &PlanOptions::default()).unwrap_err();
    assert_eq!(error.kind, Kind::NotAScene);
    assert!(error.to_string().contains("room.geojson is a floor plan, not a scene: it has no exit"), "{error}");
}

#[test]
fn errors_in_a_plan_have_their_position() {
    let says = |name: &str, text: &str, place: Option<(usize, usize)>, expected: &str| {
        let error = from_text(name, text, &PlanOptions::default()).unwrap_err();
        assert!(error.to_string().contains(expected), "{error}");
        assert_eq!(error.at, place, "{error}");
    };
    says("a.geojson", "{", Some((1, 1)), "this is not JSON");
    says("a.geojson", "{}", None, "features[0]: it has no geometry with a `type`");
    says("a.geojson", &ROOM.replace("[10, 4]]", "[10]]"), None, "features[1]: [10] is no point [x, y]");
    says(
        "a.geojson",
        &ROOM.replace("[20, 10], [0, 10]", "[0, 10], [20, 10]"),
        None,
        "features[0]: this outline crosses itself at (10.000, 5.000)",
    );
    says("a.svg", "<svg", Some((1, 1)), "this is not XML");
    says("a.svg", "<html/>", None, "the root <html>, not <svg>");
    says("a.svg", &DRAWN.replace("h100v", "h100w"), Some((5, 77)), "its path is wrong");
    says("a.svg", &DRAWN.replace("x1=\"1000\"", "x1=\"5em\""), Some((4, 34)), "`x1` is `5em`: only lengths in px");
    let unnamed = DRAWN
        .replace("Walkable", "a")
        .replace("walls", "b")
        .replace("columns", "c")
        .replace("\"exit\"", "\"d\"")
        .replace("start", "e");
    says("a.svg", &unnamed, None, "no layer of this plan says what is on it: it has `a`, `axis`, `b`, `c`, `d`, `e`");
    says("a.dxf", "hello\nthere\n", Some((1, 1)), "a group code should be here, not `hello`");
    says("a.dxf", "0\nSECTION\n", None, "this is not a whole DXF drawing");
    says("a.dxf", &dxf(6, &["0 LINE 8 wall 10 x"]), Some((20, 1)), "`x` is no number (group code 10)");
    says("a.dxf", &dxf(99, &[]), None, "its unit has the code 99");
    says("a.obj", "v 0 0 0\n", None, "this file has no faces");
    says("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 3 2\n", None, "nothing of this mesh can be walked on");
}

#[test]
fn many_people_in_a_small_place_stand_in_rows() {
    let text = dxf(
        6,
        &[
            "0 LWPOLYLINE 8 floor 70 1 10 0 20 0 10 12 20 0 10 12 20 2 10 0 20 2",
            "0 LWPOLYLINE 8 start 70 1 10 0 20 0 10 2 20 0 10 2 20 2 10 0 20 2",
            "0 TEXT 8 0 10 1 20 1 1 number=20;radius=0.2",
            "0 LWPOLYLINE 8 exit 70 1 10 11 20 0 10 12 20 0 10 12 20 2 10 11 20 2",
        ],
    );
    let (scene, _) = scene("a.dxf", &text);
    let PointsPlace(points) = scene.groups[0].place.read().unwrap();
    assert_eq!(points.len(), 20);
    for (i, a) in points.iter().enumerate() {
        assert!(a.iter().all(|x| (0.2..=2.0).contains(x)), "{a:?}");
        assert!(points[..i].iter().all(|b| (a[0] - b[0]).hypot(a[1] - b[1]) >= 0.4), "{a:?}");
    }
}

#[test]
fn blocks_that_insert_themselves_are_an_error() {
    let block =
        |name: &str, of: &str| format!("0\nBLOCK\n2\n{name}\n0\nINSERT\n2\n{of}\n70\n1000\n71\n1000\n0\nENDBLK\n");
    for of in ["A", "B"] {
        let text = format!(
            "0\nSECTION\n2\nBLOCKS\n{}{}0\nENDSEC\n{}",
            block("A", of),
            block("B", "A"),
            dxf(6, &["0 INSERT 8 wall 2 A"])
        );
        let error = from_text("a.dxf", &text, &PlanOptions::default()).unwrap_err();
        assert!(
            error.message.contains("blocks insert each other") || error.message.contains("more than 500000"),
            "{error}"
        );
    }
}

#[test]
fn people_walk_on_the_meshes_of_recast() {
    let folder = data("recast");
    for (name, exit, least) in
        [("nav_test.obj", [-18.0, -20.0, 3.0, 3.0], 1500.0), ("undulating.obj", [5040.0, -5060.0, 6.0, 6.0], 9000.0)]
    {
        let path = folder.join(name);
        let ask = PlanOptions { exit: Some(exit), people: Some(20), ..PlanOptions::default() };
        let imported = load(&path, &ask).unwrap_or_else(|error| panic!("{error}"));
        let Some(Walkable::Polygon(area)) = &imported.scene.walkable else { panic!("{name}") };
        let size = |ring: &Vec<[f64; 2]>| {
            let next = ring.iter().cycle().skip(1);
            (ring.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>() * 0.5).abs()
        };
        let ground = size(&area.outer) - area.holes.iter().map(size).sum::<f64>();
        assert!(ground > least, "{name}: {ground} m²; {:?}", imported.notes);
        imported.scene.build().unwrap_or_else(|error| panic!("{name}: {error}"));
    }
}
