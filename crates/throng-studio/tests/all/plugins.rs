//! Plug-ins in the studio: gallery, sliders, and panics.

use eframe::egui::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use glam::{DVec3, Vec3};
use std::sync::Arc;
use std::time::Duration;
use throng::motion::Steering;
use throng::parameters::parameters;
use throng::steer::{Behaviour, SteeringInput, TraceRecorder};
use throng_scene::{About, AgentJourney, AgentStart, GoalRule, Placement, Random};
use throng_studio::Plugins;
use throng_studio::document::Document;
use throng_studio::panels::{self, Gallery, Tuned, Tuning};
use throng_studio::play::{Command, Engine, RunMoment, Trouble};
use throng_studio::tune::{ParameterKind, Section, Tunable};

/// Rises to a height.
#[parameters]
#[derive(Debug)]
struct Climb {
    /// Target height, metres.
    #[parameter(default = 3.3, unit = "m", least = 0, most = 100)]
    height: f32,
    /// Height at which it panics, metres.
    #[parameter(default = 1e6, unit = "m")]
    end: f32,
}

impl Behaviour for Climb {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], _: &mut TraceRecorder<'_>) -> Option<Steering> {
        assert!(view.position().z < self.end, "out of breath");
        Some(view.reach(Vec3::Z * (self.height - view.position().z).clamp(-1.0, 1.0) * view.vehicle.max_speed))
    }
}

/// In a row along x.
#[parameters]
#[derive(Debug)]
struct Row {
    /// Distance between agents, metres.
    #[parameter(default = 1.5, unit = "m", above = 0, most = 50)]
    step: f64,
}

impl Placement for Row {
    fn position(&self, k: usize, _: usize, _: &mut Random) -> Option<DVec3> {
        Some(DVec3::X * self.step * k as f64)
    }
}

/// Northwards.
#[parameters]
#[derive(Debug)]
struct North {
    /// How far, metres.
    #[parameter(default = 7.5, unit = "m", above = 0, most = 60)]
    far: f64,
}

impl GoalRule for North {
    fn goal(&self, agent: &AgentStart, _: &mut Random) -> AgentJourney {
        agent.point(agent.at + DVec3::Y * self.far, 0.2).into()
    }
}

const LIFT: &str = "title = \"A lift\"\ntime = { until = \"limit\" }\n[[group]]\nname = \"goers\"\nplace.point = [0, 0]\n\
                    vehicle = { kind = \"level\", max_speed = 2.0 }\nsteer.climb = {}  # up\n";

fn plugins() -> Arc<Plugins> {
    Arc::new(Plugins::new().behaviour::<Climb>().scene("lift", LIFT))
}

fn settle(engine: &mut Engine) -> Arc<RunMoment> {
    while engine.idle().is_some() {
        engine.work(Duration::from_millis(50));
    }
    engine.shown().unwrap()
}

fn altitude(shown: &RunMoment) -> f32 {
    shown.frame.bodies[0].altitude
}

#[test]
fn its_scenes_are_in_the_gallery() {
    let (mut gallery, plugins) = (Gallery::default(), plugins());
    let mut asked = None;
    let mut harness = Harness::new_ui(|ui| asked = asked.take().or(gallery.ui(ui, &plugins, "box", &About::default())));
    assert!(harness.query_by_label("plug-ins").is_some());
    harness.get_by_label("A lift").click();
    harness.run();
    drop(harness);
    assert_eq!(asked.as_deref(), Some("lift"));
    assert_eq!(panels::beside(&plugins, "lift", 1).as_deref(), Some("columns"));
}

fn find<'a>(section: &'a Section, path: &str) -> Option<&'a throng_studio::tune::Parameter> {
    let own = section.parameters.iter().find(|parameter| parameter.path == path);
    own.or_else(|| section.sections.iter().find_map(|section| find(section, path)))
}

#[test]
fn its_places_and_goals_are_those_of_agents() {
    let text = "title = \"A walk\"\n[[group]]\ncount = 3\nplace.row = {}\ngoal.north = { far = 9 }\n";
    let plugins = Arc::new(Plugins::new().placement::<Row>().goal::<North>().scene("walk", text));
    let document = Document::named("walk", &plugins).unwrap();
    let mut engine = Engine::default();
    engine.command(Command::Load { name: "walk".into(), scene: document.scene().unwrap().clone(), run: false });
    engine.command(Command::Seek(1000));
    let bodies = &settle(&mut engine).frame.bodies;
    assert_eq!(bodies.len(), 3);
    for (k, body) in bodies.iter().enumerate() {
        assert!(body.position.distance(glam::DVec2::new(1.5 * k as f64, 9.0)) < 0.3, "{}", body.position);
    }
}

#[test]
fn its_parameters_are_there_before_they_are_said() {
    let plugins = plugins();
    let document = Document::named("lift", &plugins).unwrap();
    let sections = Tunable::new(&plugins).groups(&document);
    let height = find(&sections[0], "group.0.steer.climb.height").unwrap();
    assert_eq!(height.kind, ParameterKind::Number { value: 3.3, low: 0.0, high: 100.0, whole: false });
    assert_eq!((height.about.unit.as_deref(), height.given), (Some("m"), false));
    assert_eq!(height.about.text, "Target height, metres. Limit: 0 to 100.");
}

#[test]
fn its_slider_changes_what_runs() {
    let mut document = Document::named("lift", &plugins()).unwrap();
    let mut engine = Engine::default();
    let scene = |document: &Document| document.scene().unwrap().clone();
    engine.command(Command::Load { name: "lift".into(), scene: scene(&document), run: false });
    engine.command(Command::Seek(200));
    let before = settle(&mut engine);
    assert!((altitude(&before) - 3.3).abs() < 0.1, "{}", altitude(&before));
    let (mut tuning, mut last) = (Tuning::default(), None);
    {
        let mut harness = Harness::builder().with_size([500.0, 1400.0]).build_ui(|ui| {
            last = tuning.ui(ui, &mut document).or(last.take());
        });
        harness.run();
        let height = |node: &egui_kittest::Node<'_>| {
            node.accesskit_node().numeric_value().is_some_and(|x| (x - 3.3).abs() < 1e-6)
        };
        let slider = harness.get_all_by_role(Role::Slider).find(height).unwrap();
        slider.focus();
        harness.run();
        harness.key_press(eframe::egui::Key::ArrowRight);
        harness.run();
    }
    assert_eq!(last, Some(Tuned::Changed));
    assert!(
        document.text().contains("steer.climb = { height = ") && document.text().contains("# up"),
        "{}",
        document.text()
    );
    document.set("group.0.steer.climb.height", 5.0).unwrap();
    engine.command(Command::Change { name: "lift".into(), scene: scene(&document) });
    engine.command(Command::Seek(400));
    let after = settle(&mut engine);
    assert_eq!((after.run, engine.trouble()), (before.run, None), "the run continues");
    assert!((altitude(&after) - 5.0).abs() < 0.1, "{}", altitude(&after));
}

#[test]
fn a_panic_is_told_with_its_name_and_the_studio_goes_on() {
    let mut document = Document::named("lift", &plugins()).unwrap();
    document.set("group.0.steer.climb.end", 1.5).unwrap();
    let mut engine = Engine::default();
    let scene = |document: &Document| document.scene().unwrap().clone();
    engine.command(Command::Load { name: "lift".into(), scene: scene(&document), run: false });
    engine.command(Command::Seek(300));
    let shown = settle(&mut engine);
    let trouble = engine.trouble().unwrap();
    assert_eq!(trouble.to_string(), "a plug-in panicked: behaviour `climb`: out of breath");
    let harness = Harness::new_ui(|ui| _ = panels::text(ui, &mut document, &mut true, Some(&trouble)));
    assert!(harness.query_by_label_contains("behaviour `climb`: out of breath").is_some());
    drop(harness);
    assert!(document.text().contains("end = 1.5"), "the text is unchanged");

    // the world is as before the step: stepping again panics there again, and stepping back works
    assert!(shown.step > 5 && shown.frame.time == shown.step as f64 * shown.scene.time.step);
    let (mut world, _) = scene(&document).build().unwrap();
    (0..shown.step).for_each(|_| world.step());
    assert_eq!(world.state_hash(), shown.hash);
    let (step, hash) = (shown.step, shown.hash);
    engine.command(Command::Step);
    let again = settle(&mut engine);
    assert_eq!((again.step, again.hash), (step, hash));
    engine.command(Command::Back);
    assert_eq!((settle(&mut engine).step, engine.trouble()), (step - 1, None));

    // after the fix, the run continues from there
    document.set("group.0.steer.climb.end", 9.0).unwrap();
    engine.command(Command::Change { name: "lift".into(), scene: scene(&document) });
    engine.command(Command::Seek(300));
    let after = settle(&mut engine);
    assert_eq!((after.step, after.run, engine.trouble()), (300, shown.run, None));
}

/// A behaviour that panics when it is created.
#[parameters]
#[derive(Debug)]
struct Still;

impl Behaviour for Still {
    fn memory(&self) -> usize {
        panic!("not this one")
    }
    fn steer(&self, _: &SteeringInput<'_>, _: &mut [f32], _: &mut TraceRecorder<'_>) -> Option<Steering> {
        None
    }
}

#[test]
fn a_panic_while_it_is_made_leaves_the_scene_before() {
    let plugins = Arc::new(Plugins::new().behaviour::<Still>().scene("still", LIFT.replace("climb", "still")));
    let mut engine = Engine::default();
    let circle = Document::gallery("circle").unwrap();
    engine.command(Command::Load { name: "circle".into(), scene: circle.scene().unwrap().clone(), run: false });
    let still = Document::named("still", &plugins).unwrap();
    engine.command(Command::Load { name: "still".into(), scene: still.scene().unwrap().clone(), run: true });
    assert_eq!(&*settle(&mut engine).name, "circle");
    let Some(Trouble::Scene(error)) = engine.trouble() else { panic!("{:?}", engine.trouble()) };
    assert_eq!((error.kind, error.at), (throng_scene::Kind::Panic, Some((7, 15))), "{error}");
    assert!(error.message.contains("behaviour `still`: not this one"), "{error}");
    // the window's own thread renders the thumbnail
    let mut gallery = Gallery::default();
    let harness = Harness::new_ui(|ui| _ = gallery.ui(ui, &plugins, "circle", &About::default()));
    assert!(harness.query_by_label("A lift").is_some());
}
