//! Interventions in a running scene: what the user does is recorded, and the record gives the same bits.

use eframe::egui;
use egui_kittest::kittest::Queryable;
use std::sync::Arc;
use std::time::Duration;
use throng_scene::{AddAgents, Change, Interventions, Obstacle, Scene, Shape, gallery};
use throng_studio::document::Document;
use throng_studio::play::{Act, Command, Engine, Held, Trouble};

fn load(name: &str) -> Engine {
    let mut engine = Engine::default();
    let scene = Arc::new(gallery::scene(name).unwrap());
    engine.command(Command::Load { name: name.into(), scene, run: false });
    engine
}

fn seek(engine: &mut Engine, step: u64) -> u64 {
    engine.command(Command::Seek(step));
    while engine.idle().is_some() {
        engine.work(Duration::from_millis(20));
    }
    let shown = engine.shown().unwrap();
    assert_eq!(shown.step, step);
    shown.hash
}

fn act(engine: &mut Engine, act: Act) {
    engine.command(Command::Intervene(act));
}

/// Does something of everything, running and paused. Returns the step and the hash at the end.
fn play_about(engine: &mut Engine, group: &str) -> (u64, u64) {
    seek(engine, 20);
    act(engine, Act::Make(Change::Obstacle(Obstacle::from(Shape::Wall(vec![[-9.0, 6.3], [-5.0, 6.9]])))));
    act(engine, Act::Make(Change::Add(AddAgents { group: group.into(), count: 7, at: [9.0, 8.0], radius: None })));
    // a hold that is moved before the first step, then with the steps, then at rest
    act(engine, Act::Hold(Held::Grab(3), [1.0, 1.0]));
    act(engine, Act::Hold(Held::Grab(3), [1.5, 1.25]));
    seek(engine, 21);
    for k in 0..8u32 {
        act(engine, Act::Hold(Held::Grab(3), [1.5 + 0.1 * f64::from(k), 1.25]));
        seek(engine, 22 + u64::from(k));
    }
    act(engine, Act::LetGo);
    seek(engine, 40);
    act(engine, Act::Hold(Held::Push(3.0), [0.0, 0.0]));
    seek(engine, 60);
    act(engine, Act::LetGo);
    act(engine, Act::Door([-7.0, 6.6], 0.5));
    act(engine, Act::Hold(Held::Lead(5), [0.5, -4.0]));
    seek(engine, 80);
    act(engine, Act::LetGo);
    (110, seek(engine, 110))
}

#[test]
fn what_was_done_is_repeated_by_the_scene_with_the_same_bits() {
    for (name, group) in [("circle", "ring"), ("boids", "boids")] {
        let mut engine = load(name);
        let group = engine.shown().unwrap().setting.groups.first().cloned().unwrap_or(group.into());
        let (step, hash) = play_about(&mut engine, &group);
        assert_eq!(engine.trouble(), None, "{name}");
        let made = engine.shown().unwrap().interventions.clone();
        assert_eq!(made.len(), 6, "{name}: {made:?}");

        // going back and forth repeats it
        seek(&mut engine, 33);
        assert_eq!(seek(&mut engine, step), hash, "{name}");

        // the program runs the text of the scene
        let mut document = Document::gallery(name).unwrap();
        document.edit(format!("{}\n{}", document.text(), Interventions::text(&made).unwrap()));
        let kept = document.scene().unwrap_or_else(|error| panic!("{error}")).clone();
        let (mut world, _) = kept.build().unwrap();
        (0..step).for_each(|_| world.step());
        assert_eq!(world.state_hash(), hash, "{name}");

        // the run goes on with the text that holds it
        engine.command(Command::Change { name: name.into(), scene: kept.clone() });
        let shown = engine.shown().unwrap();
        assert_eq!((shown.step, shown.hash, shown.interventions.len()), (step, hash, 0), "{name}");
        (0..30).for_each(|_| world.step());
        assert_eq!(seek(&mut engine, step + 30), world.state_hash(), "{name}");
        seek(&mut engine, 25);
        assert_eq!(seek(&mut engine, step), hash, "{name}");
    }
}

#[test]
fn an_intervention_in_the_past_begins_another_future() {
    let mut engine = load("circle");
    play_about(&mut engine, "agents");
    seek(&mut engine, 30);
    act(&mut engine, Act::Make(Change::Remove(0)));
    let made = engine.shown().unwrap().interventions.clone();
    assert!(made.iter().all(|made| made.time <= 30.0 * engine.shown().unwrap().scene.time.step + 1e-9), "{made:?}");
    let hash = seek(&mut engine, 70);
    let scene = Scene { interventions: made.to_vec(), ..gallery::scene("circle").unwrap() };
    let (mut world, _) = scene.build().unwrap();
    (0..70).for_each(|_| world.step());
    assert_eq!(world.state_hash(), hash);
}

#[test]
fn what_is_refused_is_said_and_not_recorded() {
    let mut engine = load("circle");
    let hash = seek(&mut engine, 5);
    let at = engine.shown().unwrap().frame.bodies[0].position;
    let pillar = throng_scene::Circle { center: at.to_array(), radius: 1.0 };
    act(&mut engine, Act::Make(Change::Obstacle(Shape::Circle(pillar).into())));
    assert!(matches!(engine.trouble(), Some(Trouble::Refused(_))), "{:?}", engine.trouble());
    act(&mut engine, Act::Door([100.0, 100.0], 1.0));
    assert!(engine.trouble().unwrap().to_string().contains("no obstacle"));
    let shown = engine.shown().unwrap();
    assert_eq!((shown.hash, shown.interventions.len()), (hash, 0));
    act(&mut engine, Act::Make(Change::Remove(0)));
    assert_eq!(engine.trouble(), None);
}

#[test]
fn the_view_has_the_walls_of_now() {
    let mut engine = load("circle");
    let walls = |engine: &mut Engine| engine.shown().unwrap().setting.obstacles.len();
    seek(&mut engine, 10);
    assert_eq!(walls(&mut engine), 0);
    act(&mut engine, Act::Make(Change::Obstacle(Shape::Wall(vec![[-20.0, -20.0], [-20.0, 20.0]]).into())));
    assert_eq!(walls(&mut engine), 1);
    seek(&mut engine, 30);
    assert_eq!(walls(&mut engine), 1);
    seek(&mut engine, 4);
    assert_eq!(walls(&mut engine), 0);
    seek(&mut engine, 12);
    assert_eq!(walls(&mut engine), 1);
}

/// Draws a wall into the running scene.
fn drawn() -> egui_kittest::Harness<'static> {
    let mut harness = crate::layout::studio([1440.0, 900.0], "circle@60&panels.text=true");
    let view = harness.get_by_label("view of the scene").rect();
    let at = |x: f32, y: f32| view.lerp_inside([x, y]);
    harness.get_by_label("barrier: drag a wall into the running scene").click();
    harness.run_steps(2);
    for (event, pos) in [(true, at(0.45, 0.45)), (false, at(0.55, 0.5))] {
        harness.event(egui::Event::PointerMoved(pos));
        harness.run_steps(2);
        let button = egui::PointerButton::Primary;
        harness.event(egui::Event::PointerButton { pos, button, pressed: event, modifiers: egui::Modifiers::NONE });
        harness.run_steps(2);
    }
    crate::layout::wait(&mut harness, "1 intervention");
    harness
}

/// A restart would forget what was done, so it is a question.
#[test]
fn a_restart_asks_before_it_forgets() {
    let mut harness = drawn();
    harness.get_by_label("restart (R)").click();
    harness.run_steps(3);
    harness.get_by_label("Cancel").click();
    harness.run_steps(3);
    assert!(harness.query_by_label("Cancel").is_none());
    harness.get_by_label("1 intervention");
    harness.get_by_label("restart (R)").click();
    harness.run_steps(3);
    harness.get_by_label("Restart without it").click();
    settled(&mut harness);
}

/// The whole way: a tool, a drag in the view, and the answer that keeps it.
#[test]
fn a_wall_is_drawn_before_walking_people_and_kept() {
    let mut harness = drawn();
    harness.get_by_label("Keep in the scene").click();
    settled(&mut harness);
}

/// Waits until the run has no interventions that are not in the text.
fn settled(harness: &mut egui_kittest::Harness<'_>) {
    harness.run_steps(3);
    let gone = |harness: &mut egui_kittest::Harness<'_>| harness.query_by_label("1 intervention").is_none();
    for _ in 0..400 {
        if gone(harness) {
            break;
        }
        std::thread::sleep(Duration::from_millis(5));
        harness.step();
    }
    assert!(gone(harness), "the interventions are still there");
}
