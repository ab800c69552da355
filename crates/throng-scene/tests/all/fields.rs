//! Vector fields of scenes match their files, pictures and keys.

use glam::{DVec2, Vec2, Vec3};
use std::fs;
use std::path::Path;
use tempfile::TempDir;
use throng_scene::{Built, Error, Kind, Scene};

const CROWD: &str = "\n[[group]]\nname = \"crowd\"\nplace.point = [0, 0]\ngoal.point = [5, 0]\n";

/// A scene with one field, read from a folder.
fn scene(folder: &Path, field: &str) -> Scene {
    let file = folder.join("scene.toml");
    fs::write(&file, format!("[[field]]\nname = \"f\"\n{field}\n{CROWD}")).unwrap();
    Scene::load(&file).unwrap_or_else(|error| panic!("{error}"))
}

/// The built scene of a field, which evaluates the field at places of the scene.
struct Says {
    built: Built,
    origin: DVec2,
}

impl Says {
    fn of(folder: &Path, field: &str) -> Result<Self, Error> {
        let (world, built) = scene(folder, field).build()?;
        Ok(Self { built, origin: world.settings().origin })
    }

    fn at(&self, x: f64, y: f64) -> Vec2 {
        let place = (DVec2::new(x, y) - self.origin).as_vec2().extend(0.0);
        self.built.fields[0].field.velocity(place, 0.0).truncate()
    }
}

fn says(field: &str) -> Says {
    let folder = TempDir::new().unwrap();
    Says::of(folder.path(), field).unwrap_or_else(|error| panic!("{error}"))
}

/// Returns the error of a field that is refused.
fn refused(field: &str) -> Error {
    let folder = TempDir::new().unwrap();
    match Says::of(folder.path(), field) {
        Err(error) => error,
        Ok(_) => panic!("not refused: {field}"),
    }
}

fn picture(file: &Path, kind: png::ColorType, depth: png::BitDepth, width: u32, bytes: &[u8]) {
    let rows = bytes.len() / (kind.samples() * width as usize * if depth == png::BitDepth::Sixteen { 2 } else { 1 });
    let mut encoder = png::Encoder::new(fs::File::create(file).unwrap(), width, rows as u32);
    encoder.set_color(kind);
    encoder.set_depth(depth);
    encoder.write_header().unwrap().write_image_data(bytes).unwrap();
}

#[test]
fn what_is_said_in_a_file_is_what_the_library_does() {
    let says = says(
        "flow.sketch = { anchors = [{ at = [0, 0], velocity = [1, 0] }, { at = [9, 1], velocity = [0, 1] }, { at = [3, 8], velocity = [-1, 0.5] }] }",
    );
    for (x, y, vx, vy) in [(0.0, 0.0, 1.0, 0.0), (9.0, 1.0, 0.0, 1.0), (3.0, 8.0, -1.0, 0.5)] {
        // sampled on a grid of half a metre
        assert!(says.at(x, y).distance(Vec2::new(vx, vy)) < 0.03, "{} at {x} {y}", says.at(x, y));
    }
    assert_eq!(says.built.fields[0].anchors.len(), 3);
    assert!(says.at(200.0, 0.0) == Vec2::ZERO);
}

#[test]
fn strokes_stamps_and_erasers_make_anchors() {
    let says = says(
        "flow.sketch = { strokes = [{ points = [[0, 0], [20, 0]], spacing = 2 }], stamps = [{ at = [10, 12], kind = \"vortex\", radius = 3 }], erase = [{ at = [20, 0], radius = 3.5 }] }",
    );
    assert_eq!(says.built.fields[0].anchors.len(), 11 + 9 - 2);
    assert!(says.at(8.0, 0.0).distance(Vec2::X * 1.3) < 0.05);
    assert!(says.at(13.0, 12.0).distance(Vec2::Y * 1.3) < 0.05);
}

#[test]
fn fields_combine_as_they_say() {
    let says = says(
        "flow.sum = [{ of.uniform = [1, 0] }, { of.whirl = { center = [10, 0], speed = 1 }, weight = 0.5 }, { of.towards = { at = [10, 5], speed = 2, within = 6 }, map = { min = [0, 0], max = [40, 40], strokes = [{ points = [[10, 10]], radius = 1, hardness = 1 }] } }]",
    );
    assert!(says.at(20.0, 0.0).distance(Vec2::new(1.0, 0.5)) < 1e-6);
    assert!(says.at(10.0, 10.0).distance(Vec2::new(0.5, -2.0)) < 1e-6, "{}", says.at(10.0, 10.0));
    let painted = says_painted();
    assert!(painted.at(5.0, 0.0).distance(Vec2::X * 2.0) < 1e-6 && painted.at(5.0, 3.0).distance(Vec2::Y) < 1e-6);
    assert_eq!(painted.at(8.0, 0.0), Vec2::ZERO, "erased");
}

fn says_painted() -> Says {
    says(
        "flow.paint = { min = [-10, -10], max = [10, 10], on.uniform = [0, 1], strokes = [{ points = [[-9, 0], [9, 0]], speed = 2, radius = 2 }, { points = [[8, 0]], radius = 1, hardness = 1, erase = true }] }",
    )
}

#[test]
fn pixels_say_velocities() {
    let folder = TempDir::new().unwrap();
    // two rows of three pixels: the upper row first
    let pixels = [
        [255, 128, 0, 255],
        [128, 255, 0, 255],
        [0, 0, 9, 255],
        [255, 255, 7, 0],
        [128, 127, 0, 255],
        [0, 128, 0, 128],
    ];
    picture(&folder.path().join("map.png"), png::ColorType::Rgba, png::BitDepth::Eight, 3, &pixels.concat());
    let says =
        Says::of(folder.path(), "flow.picture = { file = \"map.png\", min = [10, 20], max = [16, 24], speed = 2 }")
            .unwrap();
    let expected = [
        (11.0, 23.0, 2.0, 0.0),
        (13.0, 23.0, 0.0, 2.0),
        (15.0, 23.0, -2.0, -2.0),
        (11.0, 21.0, 0.0, 0.0),
        (13.0, 21.0, 0.0, 0.0),
        (15.0, 21.0, -1.0, 0.0),
    ];
    for (x, y, vx, vy) in expected {
        assert!(says.at(x, y).distance(Vec2::new(vx, vy)) < 0.01, "{} at {x} {y}", says.at(x, y));
    }
    assert_eq!(says.at(10.0, 24.0), says.at(11.0, 23.0), "the value at the pixel's centre extends to the edge");
    assert_eq!(says.at(8.0, 23.0), Vec2::ZERO);
    // hues: red, yellow-green (90 degrees is halfway from yellow to green), cyan, and a pale red
    let hues: Vec<u8> = [[255, 0, 0], [128, 255, 0], [0, 255, 255], [255, 128, 128]].concat();
    let sixteen: Vec<u8> = hues.iter().flat_map(|&byte| [byte, byte]).collect();
    picture(&folder.path().join("hue.png"), png::ColorType::Rgb, png::BitDepth::Sixteen, 2, &sixteen);
    let says = Says::of(
        folder.path(),
        "flow.picture = { file = \"hue.png\", min = [0, 0], max = [2, 2], encoding = \"direction\", speed = 1 }",
    )
    .unwrap();
    let at = [says.at(0.5, 1.5), says.at(1.5, 1.5), says.at(0.5, 0.5), says.at(1.5, 0.5)];
    let expected = [Vec2::X, Vec2::Y, Vec2::NEG_X, Vec2::X * 0.5];
    assert!(at.iter().zip(expected).all(|(at, expected)| at.distance(expected) < 0.01), "{at:?}");
}

#[test]
fn files_of_other_programs_are_read() {
    let folder = TempDir::new().unwrap();
    // two rows of three cells, 2 m wide, from (-1, 5) on
    fs::write(folder.path().join("field.txt"), "2 3\n2.0\n-1 5\n1 0  0 1  -1 0\n0 -1  0.5 0.5  0 0\n").unwrap();
    let says = Says::of(folder.path(), "flow.table = { file = \"field.txt\" }").unwrap();
    let cells = [
        (0.0, 6.0, 1.0, 0.0),
        (2.0, 6.0, 0.0, 1.0),
        (4.0, 6.0, -1.0, 0.0),
        (0.0, 8.0, 0.0, -1.0),
        (2.0, 8.0, 0.5, 0.5),
        (-0.9, 5.2, 1.0, 0.0),
    ];
    for (x, y, vx, vy) in cells {
        assert!(says.at(x, y).distance(Vec2::new(vx, vy)) < 1e-6, "{} at {x} {y}", says.at(x, y));
    }
    assert!(says.at(1.0, 6.0).distance(Vec2::new(0.5, 0.5)) < 1e-6);
    fs::write(folder.path().join("field.csv"), "vy,x,y,vx\n4,1,1,3\n# a remark\n2,0,0,1\n0, 1, 0, 0\n8,0,1,7\n")
        .unwrap();
    let says = Says::of(folder.path(), "flow.table = { file = \"field.csv\" }").unwrap();
    assert_eq!(
        [says.at(0.0, 0.0), says.at(1.0, 1.0), says.at(0.0, 1.0)],
        [Vec2::new(1.0, 2.0), Vec2::new(3.0, 4.0), Vec2::new(7.0, 8.0)]
    );
}

#[test]
fn files_that_are_wrong_are_told() {
    let folder = TempDir::new().unwrap();
    let error_of = |field: &str| match Says::of(folder.path(), field) {
        Err(error) => error.to_string(),
        Ok(_) => panic!("taken: {field}"),
    };
    for (name, text, expected) in [
        ("a.txt", "2 3\n2.0\n-1 5\n1 0 0", "it ends after 8 numbers, before a velocity along y"),
        ("b.txt", "2 x\n", "number 2, the number of columns, is `x`"),
        ("c.txt", "1e9 1e9 1 0 0", "the number of rows is 1000000000"),
        ("d.txt", "1 1 1 0 0 1 nan", "number 7, a velocity along y, is `nan`"),
        ("e.txt", "1 1 1 0 0 1 1 1", "comes `1`"),
        ("a.csv", "x,y,vx\n1,2,3\n", "there is no column `vy`"),
        ("b.csv", "x,y,vx,vy\n0,0,1,1\n1,0,1,no\n", "b.csv:3: `no` is no number"),
        ("c.csv", "x,y,vx,vy\n0,0,1,1\n1,0,1,1\n0,1,1,1\n", "no grid of two or more rows of 2"),
        ("d.csv", "x,y,vx,vy\n0,0,1,1\n1,0,1,1\n0,2,1,1\n1,2,1,1\n", "1 m wide and 2 m high"),
        (
            "e.csv",
            "x,y,vx,vy\n0,0,1,1\n1,0,1,1\n2,0,1,1\n0,1,1,1\n1.4,1,1,1\n2,1,1,1\n",
            "(1.4, 1) is no corner of the grid; (1, 1) would be",
        ),
    ] {
        fs::write(folder.path().join(name), text).unwrap();
        let message = error_of(&format!("flow.table = {{ file = \"{name}\" }}"));
        assert!(message.contains(expected) && message.contains("scene.toml:3:"), "{message}");
    }
    let over = "min = [0, 0], max = [2, 1]";
    let message = error_of(&format!("flow.picture = {{ file = \"none.png\", {over} }}"));
    assert!(message.contains("there is no file"), "{message}");
    fs::write(folder.path().join("text.png"), "no picture").unwrap();
    let message = error_of(&format!("flow.picture = {{ file = \"text.png\", {over} }}"));
    assert!(message.contains("cannot be read as PNG"), "{message}");
    picture(&folder.path().join("grey.png"), png::ColorType::Grayscale, png::BitDepth::Eight, 2, &[0, 255]);
    let message = error_of(&format!("flow.picture = {{ file = \"grey.png\", {over} }}"));
    assert!(
        message.contains("its pixels give a speed, but no direction") && message.contains("a flow map has red for x"),
        "{message}"
    );
    picture(&folder.path().join("wide.png"), png::ColorType::Rgb, png::BitDepth::Eight, 4, &[9; 12]);
    let message = error_of(&format!("flow.picture = {{ file = \"wide.png\", {over} }}"));
    assert!(message.contains("its pixels are not square") && message.contains("max is 0.500 m above min"), "{message}");
    let map = format!("map = {{ file = \"wide.png\", {over} }}");
    let message = error_of(&format!("flow.sum = [{{ of.uniform = [1, 0], {map} }}]"));
    assert!(message.contains("its pixels are not square"), "{message}");
}

#[test]
fn a_sketch_has_no_heights() {
    for flow in [
        "sketch.anchors = [{ at = [0, 0, 1], velocity = [1, 0] }]",
        "paint = { min = [0, 0, 0], max = [9, 9], strokes = [] }",
    ] {
        let scene: Scene = format!("[[field]]\nname = \"f\"\nflow.{flow}\n{CROWD}").parse().unwrap();
        let message = scene.plan().unwrap_err().to_string();
        assert!(message.contains("3, but should be two numbers"), "{message}");
    }
}

#[test]
fn mistakes_are_told_where_they_are() {
    let many =
        "flow.sketch.strokes = [{{ points = [[0, 0], [9e6, 0]], spacing = 9 }}]".replace("{{", "{").replace("}}", "}");
    for (field, kind, expected) in [
        ("flow.sketch.anchors = [{ at = [nan, 0], velocity = [1, 0] }]", Kind::OutOfRange, "anchors[0].at[0]"),
        ("flow.sketch.anchors = [{ at = [0, 0], velocity = [1, inf] }]", Kind::OutOfRange, "velocity[1]"),
        (
            "flow.sketch = { anchors = [{ at = [0, 0], velocity = [1, 0], stretch = 3 }] }",
            Kind::OutOfRange,
            "1 where the kernel is a thin plate",
        ),
        ("flow.sketch = { smoothing = -1 }", Kind::OutOfRange, "smoothing"),
        ("flow.sketch.strokes = [{ points = [[1, 1], [1, 1]] }]", Kind::Geometry, "it has no length"),
        ("flow.sketch.stamps = [{ at = [0, 0], kind = \"sink\", radius = 0 }]", Kind::OutOfRange, "radius of a stamp"),
        (&many, Kind::Geometry, "anchors"),
        (
            "flow.paint = { min = [0, 0], max = [-1, 5], strokes = [] }",
            Kind::OutOfRange,
            "max is right of min and above it",
        ),
        (
            "flow.paint = { min = [0, 0], max = [1e6, 1e6], cell = 0.1, strokes = [] }",
            Kind::Geometry,
            "make its cells wider",
        ),
        (
            "flow.paint = { min = [0, 0], max = [1, 1], strokes = [{ points = [[0, 0]], strength = 2 }] }",
            Kind::OutOfRange,
            "strength of a brush",
        ),
        ("flow.named = \"f\"", Kind::UnknownKey, "it is below"),
        ("flow.named = \"g\"", Kind::UnknownKey, "there is no field `g` above"),
        ("flow.keyframes.frames = []", Kind::Geometry, "there are none"),
        (
            "flow.keyframes = { frames = [{ at = 0, of.uniform = [1, 0] }, { at = 9, of.uniform = [1, 0] }], period = 5 }",
            Kind::OutOfRange,
            "period",
        ),
        ("flow.blend = [{ of.uniform = [1, 0], weight = -1 }]", Kind::OutOfRange, "weight"),
        ("flow.around_walls = { of.uniform = [1, 0], width = 0 }", Kind::OutOfRange, "width"),
    ] {
        let error = refused(field);
        let text = error.to_string();
        assert!(text.contains(expected), "{field}\n{text}");
        if !field.contains("strokes = [{ points = [[0, 0], [9e6") {
            assert_eq!(error.kind, kind, "{text}");
        }
        assert!(error.at.is_some() && error.message.contains("field `f`"), "{text}");
    }
}

#[test]
fn groups_are_governed_as_they_say() {
    let text = "[[field]]\nname = \"east\"\nflow.uniform = [1, 0]\n[[group]]\ncount = 50\nplace.disc = { center = [-1800, 900], radius = 9 }\n\
                field = { of.named = \"east\", ratio = { uniform = [0.2, 0.4] } }\n";
    let (world, _) = text.parse::<Scene>().unwrap().build().unwrap();
    let ratios: Vec<f32> = (0..50).map(|row| world.relative_columns().governed[row]).collect();
    assert!(ratios.iter().all(|ratio| (0.2..=0.4).contains(ratio)));
    assert!(ratios.iter().any(|ratio| *ratio > 0.35) && ratios.iter().any(|ratio| *ratio < 0.25));
    for (field, expected) in [
        ("field.of.named = \"west\"", "there is no field `west` above"),
        ("field = {}", "it has neither `of` nor `around`"),
        ("field = { of.uniform = [1, 0], ratio = 1.5 }", "field.ratio is 1.5, but must be from 0 to 1"),
        ("field.around = [{ source = \"lost\", of.uniform = [1, 0] }]", "there is no group or mover `lost`"),
        ("field.around = [{ source = \"a\", of.uniform = [1, 0], reach = 0 }]", "reach is 0"),
    ] {
        let text = format!("[[group]]\nname = \"a\"\nplace.point = [0, 0]\n{field}\n");
        let error = text.parse::<Scene>().unwrap().build().map(drop).unwrap_err();
        assert!(error.to_string().contains(expected), "{error}");
    }
}

/// An interaction field is in the frame of the agent that carries it, wherever the scene is.
#[test]
fn fields_about_others_are_in_their_frame() {
    let text = "[time]\nstep = 0.05\n[[field]]\nname = \"beside\"\nflow.towards = { at = [0, 2], speed = 1.5, slow = 1 }\n\
                [[group]]\nname = \"fan\"\nplace.point = [905, 400]\nfield.around = [{ source = \"star\", of.named = \"beside\" }]\n\
                [[group]]\nname = \"star\"\nplace.point = [900, 400]\nheading = 90\n";
    let (mut world, _) = text.parse::<Scene>().unwrap().build().unwrap();
    while world.time() < 12.0 {
        world.step();
    }
    let fan = world.relative_columns().number.iter().position(|&number| number == 0).unwrap();
    let place = world.relative_columns().position[fan].as_dvec2() + world.settings().origin;
    assert!(place.distance(DVec2::new(898.0, 400.0)) < 0.2, "{place}: to the left of an agent that faces north");
}

#[test]
fn what_is_worth_knowing_is_noted() {
    let notes = |field: &str| says(field).built.notes.join("\n");
    assert!(notes("flow.sketch = {}").contains("it has no anchors"));
    assert!(notes("flow.sketch.anchors = [{ at = [0, 0], velocity = [1, 0] }]").contains("in one place"));
    let line = "flow.sketch.anchors = [{ at = [0, 0], velocity = [1, 0] }, { at = [4, 4], velocity = [1, 0] }]";
    assert!(notes(line).contains("on one line"));
    let sink = "flow.sketch.stamps = [{ at = [3, 4], kind = \"sink\", radius = 2 }]";
    assert!(notes(sink).contains("it leads to (3.0, 4.0): agents that follow it do not get out"), "{}", notes(sink));
    let scene: Scene =
        "[[group]]\nplace.points = [[0, 0], [50, 0]]\nfield.of.towards = { at = [0, 5], speed = 1, within = 20 }\n"
            .parse()
            .unwrap();
    let (_, built) = scene.build().unwrap();
    assert!(built.notes[0].contains("its field is zero where 1 of its 2 agents start"), "{:?}", built.notes);
    // also in space
    let up = says("flow.uniform = [0, 0, 1]");
    assert_eq!(up.built.fields[0].field.velocity(Vec3::ONE, 0.0), Vec3::Z);
}

impl Says {
    /// Returns the velocity in space at a time.
    fn in_space(&self, place: Vec3, time: f64) -> Vec3 {
        let place = place - self.origin.as_vec2().extend(0.0);
        self.built.fields[0].field.velocity(place, time)
    }

    /// Returns how much the field counts at a place; `None` if it counts everywhere.
    fn cover(&self, x: f64, y: f64) -> Option<f32> {
        self.built.fields[0].field.cover().map(|cover| cover.at(DVec2::new(x, y) - self.origin))
    }
}

#[test]
fn directions_and_speeds_are_blended_separately() {
    let says = says("flow.blend = [{ of.uniform = [2, 0], weight = 3 }, { of.uniform = [0, 1] }]");
    // three quarters of the first: a quarter of a right angle from it
    let angle = std::f32::consts::FRAC_PI_2 / 4.0;
    assert!(says.at(7.0, -3.0).distance(Vec2::from_angle(angle) * 1.75) < 1e-5, "{}", says.at(7.0, -3.0));
}

#[test]
fn keyframes_are_interpolated_and_come_again() {
    let frames = "frames = [{ at = 2, of.uniform = [1, 0] }, { at = 6, of.uniform = [0, 3, 1] }]";
    let at = |field: &str, time: f64| says(field).in_space(Vec3::new(4.0, 5.0, 6.0), time);
    let (first, last) = (Vec3::X, Vec3::new(0.0, 3.0, 1.0));
    for (time, expected) in [(0.0, first), (3.0, 0.75 * first + 0.25 * last), (6.0, last), (90.0, last)] {
        assert!(at(&format!("flow.keyframes.{frames}"), time).distance(expected) < 1e-6, "at {time} s");
    }
    // with a period of 10 s, 9 s are half of the way from 6 s to the first field at 12 s
    for (time, expected) in [(9.0, 0.5 * (first + last)), (13.0, 0.75 * first + 0.25 * last)] {
        let field = format!("flow.keyframes = {{ period = 10, {frames} }}");
        assert!(at(&field, time).distance(expected) < 1e-6, "at {time} s");
    }
}

#[test]
fn a_field_flows_around_the_walls_of_the_scene() {
    let walls = |ground: &str| says(&format!("flow.around_walls = {{ of.uniform = [1.5, 0], width = 2 }}\n{ground}"));
    let says = walls("[[obstacle]]\nshape.circle = { center = [30, 10], radius = 3 }");
    // at the wall the field has no component into it, and its speed is that of the field
    for angle in [2.0f64, 2.6, 3.5, 4.2] {
        let (place, out) = (DVec2::new(30.0, 10.0) + 3.0 * DVec2::from_angle(angle), DVec2::from_angle(angle));
        let velocity = says.at(place.x, place.y);
        assert!(velocity.dot(out.as_vec2()) > -1e-3, "{velocity} at {angle}");
        assert!((velocity.length() - 1.5).abs() < 1e-4, "{velocity} at {angle}");
    }
    assert_eq!(says.at(24.9, 10.5), Vec2::X * 1.5, "2 m from the wall it is as it was");
    let says = walls("[walkable.rectangle]\ncenter = [0, 0]\nsize = [40, 20]");
    assert!(says.at(19.999, 1.0).x < 1e-2, "the edge of the ground is a wall: {}", says.at(19.999, 1.0));
}

#[test]
fn a_field_has_the_anchors_of_the_sketches_in_it() {
    let sketch = |x: i32| format!("sketch.anchors = [{{ at = [{x}, 0], velocity = [1, 0] }}]");
    let places = |flow: &str| -> Vec<f64> {
        let says = says(flow);
        says.built.fields[0].anchors.iter().map(|anchor| anchor.place.x + says.origin.x).collect()
    };
    let (a, b, c) = (sketch(3), sketch(8), sketch(5));
    let sum =
        format!("flow.sum = [{{ of.{a} }}, {{ of.around_walls = {{ of.{b} }} }}, {{ of.sampled = {{ of.{c} }} }}]");
    assert_eq!(places(&sum), [3.0, 8.0, 5.0]);
    assert_eq!(places(&format!("flow.keyframes.frames = [{{ at = 0, of.{b} }}, {{ at = 1, of.{a} }}]")), [8.0, 3.0]);
    let named = format!("flow.{a}\n[[field]]\nname = \"g\"\nflow.blend = [{{ of.named = \"f\" }}, {{ of.{b} }}]");
    let scene = says(&named);
    assert_eq!(scene.built.fields[1].anchors.len(), 2, "those of a field that it names too");
}

#[test]
fn paint_covers_what_is_made_of_it() {
    let paint = "paint = { min = [-9, -9], max = [9, 9], strokes = [{ points = [[-5, 0], [5, 0]], radius = 2, strength = 0.5, hardness = 1 }] }";
    for flow in [
        format!("flow.{paint}"),
        format!("flow.around_walls = {{ of.{paint} }}"),
        format!("flow.sampled = {{ min = [-9, -9], max = [9, 9], of.{paint} }}"),
        format!("flow.paint = {{ min = [-9, -9], max = [9, 9], strokes = [], on.{paint} }}"),
    ] {
        let says = says(&flow);
        assert_eq!((says.cover(1.0, 0.0), says.cover(1.0, 7.0)), (Some(0.5), Some(0.0)), "{flow}");
        assert!(says.at(1.0, 0.0).distance(Vec2::X * 1.3) < 1e-5, "{flow}");
    }
    assert_eq!(says(&format!("flow.sum = [{{ of.{paint} }}]")).cover(1.0, 0.0), None);
}

#[test]
fn a_path_through_space_leads_to_its_target() {
    let box_of_space = "min = [0, 0, 0], max = [12, 8, 6], cell = 0.5";
    let target = Vec3::new(10.0, 4.0, 3.0);
    let free = says(&format!("flow.through_space = {{ to = [10, 4, 3], speed = 2, tolerance = 0.5, {box_of_space} }}"));
    for place in [Vec3::new(1.3, 1.7, 0.9), Vec3::new(6.2, 7.1, 5.1), Vec3::new(11.2, 2.0, 4.0)] {
        let (velocity, direct) = (free.in_space(place, 0.0), (target - place).normalize());
        assert!(
            (velocity.length() - 2.0).abs() < 1e-4 && velocity.normalize().dot(direct) > 0.97,
            "{velocity} at {place}"
        );
    }
    assert_eq!(free.in_space(target + Vec3::X * 0.4, 0.0), Vec3::ZERO, "within the tolerance it has arrived");
    // a pillar stands in the way: an agent that follows the field goes round it, and not along the straight line
    let pillar = "\n[[obstacle]]\nname = \"pillar\"\nshape.circle = { center = [6, 4], radius = 1.5 }";
    for from in ["", "from = [2, 4.3, 3],"] {
        let field = format!(
            "flow.through_space = {{ to = [10, 4, 3], {from} walls = [\"pillar\"], radius = 0.2, {box_of_space} }}"
        );
        let around = says(&(field + pillar));
        let (mut place, mut steps) = (Vec3::new(2.0, 4.3, 3.0), 0);
        while place.distance(target) > 0.2 && steps < 4000 {
            place += around.in_space(place, 0.0) * 0.01;
            steps += 1;
            let off = place.truncate().distance(Vec2::new(6.0, 4.0)) - 1.5;
            assert!(off > 0.2, "{off} from the pillar at {place}");
        }
        assert!((800..1200).contains(&steps), "{steps} steps of 1 cm for 8 m");
    }
}

#[test]
fn fields_that_move_have_no_walls() {
    // wherever the origin of the world is
    for (flow, place) in
        [("around_walls.of.uniform = [1, 0]", "[9, 4]"), ("to_goal.to = [{ point.at = [1, 0] }]", "[-3, 0]")]
    {
        let text = format!(
            "[[field]]\nname = \"f\"\nflow.{flow}\n\
             [[group]]\nplace.point = [3, 0]\nfield.around = [{{ source = \"star\", of.named = \"f\" }}]\n\
             [[group]]\nname = \"star\"\nplace.point = {place}\n"
        );
        let error = text.parse::<Scene>().unwrap().build().map(drop).unwrap_err();
        assert!(error.to_string().contains("a field that moves with agents has no walls"), "{error}");
        assert_eq!((error.kind, error.at.map(|(line, _)| line)), (Kind::Conflict, Some(3)));
    }
}

#[test]
fn parameters_of_combinations_are_refused_at_their_keys() {
    for (field, expected) in [
        (
            "flow.blend = [{ of.uniform = [1, 0] }, { of.uniform = [1, 0], weight = -1 }]",
            "flow.blend[1].weight is -1, but must be 0 or more",
        ),
        (
            "flow.sum = [{ of.uniform = [1, 0], weight = inf }]",
            "flow.sum[0].weight is inf, but must be a finite number",
        ),
        ("flow.sum = [{ weight = 2 }]", "the key `of` is missing here"),
        ("flow.sum = [{ of.uniform = [1, 0], wieght = 2 }]", "did you mean `weight`?"),
        (
            "flow.around_walls = { of.uniform = [1, 0], width = 0 }",
            "flow.around_walls.width is 0, but must be more than 0",
        ),
        (
            "flow.keyframes.frames = [{ at = nan, of.uniform = [1, 0] }]",
            "frames[0].at is NaN, but must be a finite number",
        ),
        (
            "flow.through_space = { to = [1, 1, 1], min = [0, 0], max = [2, 2, 2], speed = 1e4 }",
            "flow.through_space.speed is 10000, but must be more than 0 and at most 1000",
        ),
    ] {
        let text = refused(field).to_string();
        assert!(text.contains(expected) && text.contains("scene.toml:3"), "{field}\n{text}");
    }
}
