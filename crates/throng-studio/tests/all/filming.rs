//! Keys of the camera, made on the timeline.

use crate::layout::{studio, wait};
use eframe::egui::{Event, Modifiers, PointerButton, Pos2, Role, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{By, NodeT, Queryable};
use glam::DVec3;
use throng_draw::{FilmCamera, Style};
use throng_record::{Frame, moment};
use throng_scene::{CameraKey, Scene};

const KEY: &str = "key the camera: films of the scene look from here at this time (Insert)";

/// Returns the text of the scene, from the panel *Text*.
fn text(harness: &Harness<'_>) -> String {
    let field = harness.get(By::new().predicate(|node| node.role() == Role::MultilineTextInput));
    field.accesskit_node().value().unwrap_or_default()
}

fn keys(harness: &Harness<'_>) -> Vec<CameraKey> {
    Scene::parse("scene.toml", text(harness)).unwrap().view.camera.map(|camera| camera.keys).unwrap_or_default()
}

/// Drags from a place to another.
fn drag(harness: &mut Harness<'_>, from: Pos2, to: Pos2) {
    for (pos, pressed) in [(from, true), (to, false)] {
        harness.event(Event::PointerMoved(pos));
        harness.run_steps(2);
        let button = PointerButton::Primary;
        harness.event(Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE });
        harness.run_steps(2);
    }
}

fn click(harness: &mut Harness<'_>, label: &str) {
    harness.get_by_label(label).click();
    harness.run_steps(3);
}

/// Opens the menu of a key and clicks an item.
fn choose(harness: &mut Harness<'_>, key: &str, item: &str) {
    harness.get_by_label(key).click_secondary();
    harness.run_steps(3);
    click(harness, item);
}

#[test]
fn a_shot_is_made_on_the_timeline() {
    let mut harness = studio([1440.0, 900.0], "circle@60&camera=orbit&panels.text=true&panels.gallery=false");
    let before = text(&harness);
    click(&mut harness, KEY);
    wait(&mut harness, "camera key at 2.40 s");
    // another camera at another time
    click(&mut harness, "one step forward (Right)");
    wait(&mut harness, "  2.44 s");
    let view = harness.get_by_label("view of the scene").rect().center();
    drag(&mut harness, view, view + vec2(160.0, 30.0));
    click(&mut harness, KEY);
    wait(&mut harness, "camera key at 2.44 s");
    assert!(harness.query_by_label("  2.44 s").is_some(), "the run goes on");
    let [first, second] = keys(&harness)[..] else { panic!("{}", text(&harness)) };
    assert!(DVec3::from(first.eye).distance(second.eye.into()) > 3.0, "{first:?} {second:?}");

    // a drag along the timeline is another time
    let line = harness.get_by_label("step").rect();
    let at = harness.get_by_label("camera key at 2.44 s").rect().center();
    drag(&mut harness, at, Pos2::new(line.center().x, at.y));
    let moved = keys(&harness)[1].time;
    assert!((moved - 5.0).abs() < 0.3, "the timeline has 10 s: {moved}");
    choose(&mut harness, &format!("camera key at {moved:.2} s"), "Cut before it");
    assert_eq!(keys(&harness).iter().map(|key| key.cut).collect::<Vec<_>>(), [false, true]);

    // the film of the text has these cameras at these times
    let scene = Scene::parse("scene.toml", text(&harness)).unwrap();
    let (world, built) = scene.build().unwrap();
    let (setting, mut frame) = (moment::setting(&world, &built, ""), Frame::default());
    moment::capture(&world, &mut frame);
    let mut camera = FilmCamera::new(&setting, &Style::said(&scene), &frame).unwrap();
    for key in keys(&harness) {
        let (sight, angle) = camera.turn(&Frame { time: key.time, ..frame.clone() });
        assert_eq!(
            (sight.eye.to_array(), sight.target.to_array(), Some(angle)),
            (key.eye, key.target, key.field_of_view)
        );
    }

    // the present camera, at the time of another key
    choose(&mut harness, "camera key at 2.40 s", "Replace by the present camera");
    let [first, second] = keys(&harness)[..] else { panic!("{}", text(&harness)) };
    assert!((first.time, first.eye) == (2.4, second.eye), "{first:?} {second:?}");
    choose(&mut harness, "camera key at 2.40 s", "Remove");
    assert_eq!(keys(&harness).len(), 1);
    click(&mut harness, &format!("camera key at {moved:.2} s"));
    wait(&mut harness, &format!("{moved:6.2} s"));
    for _ in 0..6 {
        click(&mut harness, "Undo");
    }
    assert_eq!(text(&harness), before, "each was one edit");
}

#[test]
fn keys_are_made_in_space_and_replace_an_orbit() {
    let mut harness = studio([1440.0, 900.0], "circle@10&panels.text=true");
    assert!(harness.query_by_label(KEY).is_none(), "a plan cannot be a key");
    drop(harness);
    harness = studio([1440.0, 900.0], "boids-pillars@4&panels.text=true&panels.gallery=false");
    assert!(text(&harness).contains("crowd = true"));
    click(&mut harness, KEY);
    assert!(!text(&harness).contains("crowd = true") && keys(&harness).len() == 1, "{}", text(&harness));
    assert!(harness.query_by_label_contains("keys replace the camera that follows the crowd").is_some());
}
