//! Declared parameters: defaults, limits, reading, writing, schema; and models of plug-ins, which are equal to those of
//! throng.

use glam::{Vec2, Vec3};
use serde_json::json;
use throng::avoid::{AvoidanceBatch, AvoidanceInput, Hrvo, LocalModel, Orca, Workspace};
use throng::field::Field;
use throng::parameters::{Angle, Parameters, Value, parameters};
use throng_scene::flow::{Eraser, Sketch};
use throng_scene::{Avoid, Flow, Kind, Model, Models, Plugins, Scene, caught, gallery};

/// How an agent looks
/// about.
///
/// More about it.
#[parameters(name = "look")]
#[derive(Clone, Debug, PartialEq)]
struct LooksAround {
    /// Half the angle of view.
    #[parameter(default = Angle::degrees(60.0), unit = "°", least = 0, most = 180)]
    angle: Angle,
    /// The number of looks.
    #[parameter(default = 12_000, least = 1, most = 100_000)]
    looks: u32,
    /// A shift.
    #[parameter(above = -0.5)]
    shift: f32,
    /// A time.
    #[parameter(unit = "s", above = 0, most = 1e6)]
    time: Option<f32>,
    side: Side,
}

/// A side.
#[parameters]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Side {
    /// The left.
    #[default]
    FarLeft,
    /// The right.
    Right,
}

/// Goes somewhere.
#[parameters]
#[derive(Debug, PartialEq)]
struct Going {
    /// Where to.
    #[parameter(required)]
    to: f32,
    /// How fast.
    #[parameter(default = 1.5, above = 0)]
    speed: f64,
}

#[test]
fn a_declaration_gives_defaults_names_and_doc_lines() {
    let usual = LooksAround::default();
    assert_eq!((usual.angle.radians(), usual.looks, usual.shift), (60.0_f64.to_radians() as f32, 12_000, 0.0));
    assert_eq!((usual.time, usual.side), (None, Side::FarLeft));
    assert_eq!((LooksAround::NAME, Going::NAME, Orca::NAME), ("look", "going", "orca"));
    assert_eq!(LooksAround::ABOUT, "How an agent looks about.");
    let lines: Vec<(&str, &str)> = LooksAround::PARAMETERS.iter().map(|said| (said.about, said.unit)).collect();
    assert_eq!(
        lines,
        [
            ("Half the angle of view. Limit: 0 to 180.", "°"),
            ("The number of looks. Limit: 1 to 100,000.", ""),
            ("A shift. Limit: > -0.5.", ""),
            ("A time. Limit: > 0, at most 1,000,000.", "s"),
            ("", ""),
        ]
    );
}

#[test]
fn limits_are_checked_with_the_numbers_of_the_file() {
    let usual = LooksAround::default;
    for (wrong, says) in [
        (LooksAround { angle: Angle::degrees(180.5), ..usual() }, "angle is 180.5, but must be from 0 to 180"),
        (LooksAround { looks: 0, ..usual() }, "looks is 0, but must be from 1 to 100,000"),
        (LooksAround { shift: -0.7, ..usual() }, "shift is -0.7, but must be more than -0.5"),
        (LooksAround { shift: f32::INFINITY, ..usual() }, "shift is inf, but must be more than -0.5"),
        (LooksAround { time: Some(f32::NAN), ..usual() }, "time is NaN, but must be more than 0 and at most 1,000,000"),
    ] {
        assert_eq!(wrong.check_limits().unwrap_err().to_string(), says);
    }
    assert_eq!(usual().check_limits(), Ok(()));
    let error = Going { to: f32::NAN, speed: 1.0 }.check_limits().unwrap_err();
    assert_eq!(error.to_string(), "to is NaN, but must be a finite number");
}

/// Reads the text of a choice.
fn read<P: Parameters>(text: &str) -> Result<P, throng_scene::Error> {
    toml::from_str::<Avoid>(text).unwrap().parameters_as()
}

#[test]
fn files_use_degrees_and_names() {
    let turned =
        LooksAround { angle: Angle::degrees(90.0), side: Side::Right, time: Some(2.0), ..LooksAround::default() };
    assert_eq!(read("look = { angle = 90, side = \"right\", time = 2 }").as_ref(), Ok(&turned));
    let written = Avoid::of(&turned);
    assert_eq!(written, toml::from_str("look = { angle = 90, side = \"right\", time = 2 }").unwrap());
    assert_eq!(written.parameters_as().as_ref(), Ok(&turned));
    assert_eq!(read("going = { to = 3 }"), Ok(Going { to: 3.0, speed: 1.5 }));
    assert_eq!(Going::new(3.0_f32), Going { to: 3.0, speed: 1.5 });
    for (text, says) in [
        ("going = { speed = 3 }", "the key `to` is missing here"),
        ("going = { to = 3, fast = true }", "there is no key `fast` here"),
        ("going = { to = 3, speed = -1 }", "going.speed is -1, but must be more than 0"),
        ("going = 3", "this is the wrong type: the whole number 3, but should be a table such as { key = value }"),
        ("gone = {}", "this is `gone`, not `going`"),
    ] {
        assert_eq!(read::<Going>(text).unwrap_err().message, says, "{text}");
    }
    for (text, says) in [
        ("look = { side = \"left\" }", "`left` is not one of the choices here"),
        ("look = { looks = 5e9 }", "but should be a whole number that is not negative"),
        ("look = { looks = 5_000_000_000 }", "but should be a whole number that is not negative"),
    ] {
        let error = read::<LooksAround>(text).unwrap_err().message;
        assert!(error.contains(says), "{text}: {error}");
    }
}

/// Every angle that a file can state in tenths of a degree is written as it was.
#[test]
fn angles_keep_their_digits() {
    for tenths in -3600..=3600 {
        let degrees = f64::from(tenths) / 10.0;
        assert_eq!(Angle::degrees(degrees).to_degrees(), degrees);
    }
}

impl LocalModel for LooksAround {
    fn velocity(&self, view: &AvoidanceInput<'_>, _: &mut Workspace) -> Vec2 {
        view.preferred
    }

    fn wall_range(&self, radius: f32, _: f32) -> f32 {
        radius
    }
}

impl Field for Going {
    fn velocity(&self, _: Vec3, _: f64) -> Vec3 {
        Vec3::X * self.to
    }
}

#[test]
fn the_schema_has_limits_units_and_defaults() {
    let schema = Plugins::new().model::<LooksAround>().field::<Going>().schema();
    let of = |choice: &str, name: &str| {
        let choices = schema["$defs"][choice]["oneOf"].as_array().unwrap();
        choices.iter().find_map(|choice| choice["properties"].get(name)).unwrap().clone()
    };
    let look = of("Avoid", "look");
    assert_eq!(look["description"], "How an agent looks about.");
    let angle = &look["properties"]["angle"];
    assert_eq!((&angle["minimum"], &angle["maximum"], &angle["unit"]), (&json!(0), &json!(180), &json!("°")));
    assert_eq!((&angle["type"], &angle["default"]), (&json!("number"), &json!(60.0)));
    assert_eq!(look["properties"]["shift"]["exclusiveMinimum"], json!(-0.5));
    assert_eq!(look["properties"]["side"]["oneOf"][0]["const"], "far_left");
    assert_eq!(look["properties"]["side"]["default"], "far_left");
    assert_eq!(of("Flow", "going")["required"], json!(["to"]));
}

/// HRVO as a plug-in would have it.
#[parameters(name = "own_hrvo")]
#[derive(Clone, Copy, Debug, PartialEq)]
struct OwnHrvo {
    /// Seconds ahead for which a velocity must be safe from obstacles.
    #[parameter(default = 0.7, unit = "s", above = 0)]
    time_horizon_obstacles: f32,
    /// The speed at which it panics.
    #[parameter(default = 1e9)]
    fuse: f32,
}

impl OwnHrvo {
    fn inner(&self) -> Hrvo {
        Hrvo { time_horizon_obstacles: self.time_horizon_obstacles }
    }
}

impl LocalModel for OwnHrvo {
    fn velocity(&self, view: &AvoidanceInput<'_>, workspace: &mut Workspace) -> Vec2 {
        assert!(view.velocity.length() < self.fuse, "too fast");
        self.inner().velocity(view, workspace)
    }

    fn velocities(&self, batch: &mut AvoidanceBatch<'_>) {
        self.inner().velocities(batch);
    }

    fn wall_range(&self, radius: f32, max_speed: f32) -> f32 {
        self.inner().wall_range(radius, max_speed)
    }

    fn check(&self) -> Result<(), throng::Error> {
        self.check_limits()
    }
}

fn plugins() -> Plugins {
    Plugins::new().model::<OwnHrvo>()
}

fn with_model(name: &str, model: &str) -> Scene {
    let mut scene = gallery::scene(name).unwrap();
    plugins().equip(&mut scene);
    let model = Model::parse(model, &scene.plugins.models).unwrap();
    scene.with_model(&model).unwrap()
}

fn hash(scene: &Scene) -> u64 {
    let (mut world, _) = scene.build().unwrap();
    (0..200).for_each(|_| world.step());
    world.state_hash()
}

#[test]
fn a_model_of_a_plug_in_moves_agents_as_throngs_own() {
    for name in ["circle", "crossing", "doorway"] {
        let own = with_model(name, "hrvo:time_horizon_obstacles=0.9");
        assert_eq!(hash(&with_model(name, "own-hrvo:time_horizon_obstacles=0.9")), hash(&own), "{name}");
    }
}

#[test]
fn a_model_of_a_plug_in_has_a_name_a_schema_and_errors_with_their_place() {
    assert!(plugins().models.names().any(|name| name == "own_hrvo"));
    let schema = plugins().schema();
    let models = schema["$defs"]["Avoid"]["oneOf"].as_array().unwrap();
    assert_eq!(models.len(), Models::default().names().count() + 1);
    let own = &models.last().unwrap()["properties"]["own_hrvo"]["properties"];
    assert_eq!((&own["time_horizon_obstacles"]["unit"], &own["neighbours"]["default"]), (&json!("s"), &json!(10)));
    for (avoid, kind, says) in [
        ("own_hrvo = { fuse = true }", Kind::WrongType, "but should be a number"),
        ("own_hrvo = { fusee = 1 }", Kind::UnknownKey, "there is no key `fusee` here"),
        ("own_hrvo = { neighbours = 0 }", Kind::OutOfRange, "neighbours is 0, but must be from 1 to 1000"),
        ("own_hrv = {}", Kind::UnknownKey, "`own_hrv` is not one of the choices here"),
    ] {
        let text = format!("[[group]]\nplace.point = [5, 0]\navoid = {{ {avoid} }}");
        let mut scene = Scene::parse("own.toml", text).unwrap();
        plugins().equip(&mut scene);
        let error = scene.plan().unwrap_err();
        assert!(error.message.contains(says), "{avoid}: {error}");
        assert_eq!((error.kind, error.at.map(|at| at.0)), (kind, Some(3)), "{avoid}: {error}");
    }
}

#[test]
fn a_panic_in_a_model_names_it() {
    let (mut world, _) = with_model("circle", "own_hrvo:fuse=0.5").build().unwrap();
    let says = caught(|| (0..200).for_each(|_| world.step())).unwrap_err();
    assert_eq!(says, "model `own_hrvo`: too fast");
}

#[test]
fn a_choice_in_code_is_the_choice_in_a_file() {
    let orca = Avoid::of(&Orca { time_horizon: 0.3, ..Orca::default() }).with("neighbours", 5);
    let read: Avoid = toml::from_str("orca = { neighbours = 5, time_horizon = 0.3 }").unwrap();
    assert_eq!(orca, read);
    let written = toml::to_string(&orca).unwrap();
    assert!(written.contains("time_horizon = 0.3\n"), "{written}");
    let whole: Avoid = toml::from_str("orca = { neighbours = 5, time_horizon = 2 }").unwrap();
    assert_eq!(whole, Avoid::named("orca").with("time_horizon", 2.0).with("neighbours", 5));
    // numbers in double precision stay as they are
    let nearly = f64::from(0.7_f32);
    let cloud = Eraser { at: [0.0, nearly], radius: 1.0 };
    let sketch = Sketch { erase: Some(vec![cloud]), ..toml::from_str("").unwrap() };
    assert_eq!(Flow::from(sketch).read::<Sketch>().unwrap().erase.unwrap()[0].at[1], nearly);
    let several = toml::from_str::<Avoid>("orca = {}\nrvo = {}").unwrap_err().to_string();
    assert!(several.contains("more than 1 element"), "{several}");
}

/// Blows along +x.
#[parameters]
#[derive(Debug)]
struct Wind {
    /// Its speed.
    #[parameter(default = 1.0, unit = "m/s", least = 0, most = 10)]
    speed: f32,
    /// The x beyond which it panics.
    #[parameter(default = 1e9)]
    edge: f32,
}

impl Field for Wind {
    fn velocity(&self, place: Vec3, _: f64) -> Vec3 {
        assert!(place.x < self.edge, "no wind there");
        Vec3::X * self.speed
    }
}

fn windy(flow: &str) -> Scene {
    // far from the origin: the field gets world coordinates
    let text = format!("[[group]]\nplace.point = [1000, 0]\nfield.of = {{ {flow} }}");
    let mut scene = Scene::parse("wind.toml", text).unwrap();
    Plugins::new().field::<Wind>().equip(&mut scene);
    scene
}

#[test]
fn a_field_of_a_plug_in_leads_agents_and_has_errors_with_their_place() {
    let x = |scene: &Scene| {
        let (mut world, _) = scene.build().unwrap();
        (0..100).for_each(|_| world.step());
        world.agents().next().unwrap().position().x
    };
    let uniform = x(&windy("uniform = [1.5, 0]"));
    assert!(uniform > 1003.0, "{uniform}");
    assert_eq!(x(&windy("wind = { speed = 1.5 }")), uniform);
    assert_eq!(x(&windy("sum = [{ of.wind = { speed = 1.5 } }]")), uniform);
    for (flow, kind, says) in [
        ("wind = { speed = 11 }", Kind::OutOfRange, "field.of.wind.speed is 11, but must be from 0 to 10"),
        ("wind = { sped = 1 }", Kind::UnknownKey, "there is no key `sped` here"),
        ("sum = [{ of.wind = { speed = true } }]", Kind::WrongType, "but should be a number"),
        ("wnd = {}", Kind::UnknownKey, "`wnd` is not one of the choices here"),
    ] {
        let error = windy(flow).plan().unwrap_err();
        assert!(error.message.contains(says), "{flow}: {error}");
        assert_eq!((error.kind, error.at.map(|at| at.0)), (kind, Some(3)), "{flow}: {error}");
    }
    let schema = Plugins::new().field::<Wind>().schema();
    let fields = schema["$defs"]["Flow"]["oneOf"].as_array().unwrap();
    assert_eq!(fields.last().unwrap()["properties"]["wind"]["properties"]["speed"]["maximum"], json!(10));
    let (mut world, _) = windy("wind = { edge = 1001 }").build().unwrap();
    let says = caught(|| (0..100).for_each(|_| world.step())).unwrap_err();
    assert_eq!(says, "field `wind`: no wind there");
}
