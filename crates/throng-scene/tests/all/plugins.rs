//! Behaviours, rules and scenes of plug-ins.

use glam::Vec3;
use throng::motion::Steering;
use throng::parameters::parameters;
use throng::steer::{Behaviour, SteeringInput, TraceRecorder};
use throng::{Rules, World};
use throng_scene::{Kind, Plugins, Scene, Steer, caught, gallery};

/// Rises to a height.
#[parameters]
#[derive(Debug)]
struct Climb {
    /// The height, metres.
    #[parameter(default = 3.0, unit = "m", least = 0, most = 100)]
    height: f32,
    /// The height at which it panics, metres.
    #[parameter(unit = "m", least = 0)]
    end: Option<f32>,
}

impl Behaviour for Climb {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], _: &mut TraceRecorder<'_>) -> Option<Steering> {
        assert!(self.end.is_none_or(|end| view.position().z < end), "out of breath");
        Some(view.reach(Vec3::Z * (self.height - view.position().z).clamp(-1.0, 1.0) * view.vehicle.max_speed))
    }

    fn check(&self) -> Result<(), throng::Error> {
        assert!(self.height != 13.0, "not thirteen");
        Ok(())
    }
}

/// Panics at its end.
#[derive(Debug)]
struct Fuse(f64);

impl Rules for Fuse {
    fn figures(&self) -> Vec<String> {
        vec![]
    }
    fn act(&self, world: &mut World, _: &mut [f64]) -> Result<(), throng::Error> {
        assert!(world.time() < self.0, "bang");
        Ok(())
    }
}

fn plugins() -> Plugins {
    let rules = |_: &throng_scene::SceneNames<'_>| Ok(Fuse(0.5));
    Plugins::new()
        .behaviour::<Climb>()
        .rules("fuse", rules)
        .scene("lift", lift("{ climb = {} }"))
        .scene("box", "# mine\n")
}

fn lift(steer: &str) -> String {
    format!(
        "title = \"A lift\"\n[[group]]\nplace.point = [5, 0]\nvehicle = {{ kind = \"level\", max_speed = 2.0 }}\nsteer = {steer}\n"
    )
}

fn scene(steer: &str) -> Scene {
    let mut scene = Scene::parse("lift.toml", lift(steer)).unwrap();
    plugins().equip(&mut scene);
    scene
}

fn height(scene: &Scene) -> f32 {
    let (mut world, _) = scene.build().unwrap();
    (0..500).for_each(|_| world.step());
    world.relative_columns().altitude[0]
}

#[test]
fn parameters_are_said_or_the_behaviours_own() {
    assert!((height(&scene("{ climb = {} }")) - 3.0).abs() < 0.1);
    assert!((height(&scene("{ climb = { height = 5 } }")) - 5.0).abs() < 0.1);
    assert!((height(&plugins().open("lift").unwrap()) - 3.0).abs() < 0.1);
}

#[test]
fn what_is_said_is_written_as_it_was() {
    for said in ["{ climb = {} }", "{ climb = { height = 5 } }"] {
        let scene = scene(said);
        let again: Scene = scene.to_toml().unwrap().parse().unwrap();
        assert_eq!(scene, again);
    }
    assert_eq!(scene("{ climb = {} }").groups[0].steer, Some(Steer::named("climb")));
}

#[test]
fn what_does_not_fit_is_said_with_its_place() {
    for (said, kind, column, says) in [
        ("{ clim = {} }", Kind::UnknownKey, 11, "`clim` is not one of the choices here"),
        ("{ climb = { heigth = 5 } }", Kind::UnknownKey, 21, "there is no key `heigth` here"),
        ("{ climb = { height = 500 } }", Kind::OutOfRange, 30, "must be from 0 to 100"),
        ("{ climb = { end = -1 } }", Kind::OutOfRange, 27, "must be 0 or more"),
        ("{ climb = { height = \"high\" } }", Kind::WrongType, 30, "but should be a number"),
        ("{ climb = { height = 13 } }", Kind::Panic, 19, "a plug-in panicked: behaviour `climb`: not thirteen"),
    ] {
        let error = scene(said).build().unwrap_err();
        assert!(error.message.contains(says) && error.message.contains("`group-1`"), "{said}: {error}");
        assert_eq!((error.kind, error.at), (kind, Some((5, column))), "{said}: {error}");
    }
    let error = Scene::parse("lift.toml", lift("{ climb = {}, swim = {} }")).unwrap_err();
    assert!(error.to_string().contains("several choices are given"), "{error}");
}

#[test]
fn a_panic_says_whose_it_is() {
    let (mut world, _) = scene("{ climb = { end = 1 } }").build().unwrap();
    let says = caught(|| (0..500).for_each(|_| world.step())).unwrap_err();
    assert_eq!(says, "behaviour `climb`: out of breath");
    let mut scene = scene("{ climb = {} }");
    scene.rules = Some("fuse".into());
    let (mut world, _) = scene.build().unwrap();
    let says = caught(|| (0..500).for_each(|_| world.step())).unwrap_err();
    assert_eq!(says, "rules `fuse`: bang");
}

#[test]
fn own_scenes_come_first_and_in_the_place_of_others() {
    let plugins = plugins();
    let groups = plugins.groups();
    assert_eq!(groups[0], ("plug-ins", vec!["lift", "box"]));
    assert_eq!(plugins.names().len(), gallery::names().count() + 1);
    assert_eq!((plugins.title("lift"), plugins.text("box")), (Some("A lift"), Some("# mine\n")));
    assert_eq!((plugins.title("circle"), plugins.text("nothing")), (gallery::title("circle"), None));
    assert_eq!(Plugins::new().names(), gallery::names().collect::<Vec<_>>());
    let made = Scene { title: "In code".into(), ..scene("{ climb = {} }") };
    let plugins = plugins.scene_in_code("code", &made);
    assert_eq!((plugins.title("code"), plugins.open("code")), (Some("In code"), Ok(made)));
}

#[test]
fn the_schema_knows_behaviours_and_their_parameters() {
    assert_eq!(Plugins::new().schema(), throng_scene::schema());
    let schema = plugins().schema();
    let tables = schema["$defs"]["Steer"]["oneOf"].as_array().unwrap();
    let vertical_velocity = tables
        .iter()
        .map(|table| &table["properties"]["climb"])
        .find(|vertical_velocity| !vertical_velocity.is_null())
        .unwrap();
    assert_eq!(vertical_velocity["properties"]["height"]["maximum"], 100);
    assert_eq!(vertical_velocity["properties"]["height"]["default"], 3.0);
    let sound = jsonschema::validator_for(&schema).unwrap();
    for (said, good) in [
        ("{ climb = {} }", true),
        ("{ climb = { height = 5 } }", true),
        ("\"climb\"", false),
        ("{ climb = { height = 500 } }", false),
    ] {
        let text: toml::Value = toml::from_str(&lift(said)).unwrap();
        assert_eq!(sound.is_valid(&serde_json::to_value(text).unwrap()), good, "{said}");
    }
}
