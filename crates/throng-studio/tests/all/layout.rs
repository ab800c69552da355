//! The whole studio in windows of many sizes.

use eframe::egui::{Event, Key, Modifiers, Rect, Role, TouchDeviceId, TouchId, TouchPhase, pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{By, NodeT, Queryable};
use std::time::{Duration, Instant};
use throng_studio::{App, Options};

/// A phone, a small and a usual window, and a large one.
const SIZES: [[f32; 2]; 4] = [[390.0, 844.0], [800.0, 600.0], [1440.0, 900.0], [2560.0, 1440.0]];

/// The margin of the test window around the studio, points.
const MARGIN: f32 = 8.0;

/// Starts the studio in a window of this size, with a paused scene.
pub fn studio(size: [f32; 2], address: &str) -> Harness<'static> {
    let (mut app, mut frame) = (None::<App>, eframe::Frame::_new_kittest());
    let options = Options::of_address(address).unwrap();
    let window = vec2(size[0], size[1]) + 2.0 * vec2(MARGIN, MARGIN);
    let mut harness = Harness::builder().with_size(window).build_ui(move |ui| {
        let app = app.get_or_insert_with(|| App::new(ui.ctx(), None, options.clone()).unwrap());
        eframe::App::ui(app, ui, &mut frame);
    });
    wait(&mut harness, VIEW);
    harness.run_steps(4);
    harness
}

const VIEW: &str = "view of the scene";

/// Returns the controls: role, name and place.
fn controls(harness: &Harness<'_>) -> Vec<(String, Rect)> {
    let is_control = |role| matches!(role, Role::Button | Role::ComboBox | Role::Slider | Role::SpinButton);
    let nodes = harness.query_all(By::new().predicate(move |node| is_control(node.role())));
    let name = |node: &egui_kittest::Node<'_>| {
        let node = node.accesskit_node();
        format!("{:?} {:?}", node.role(), node.label())
    };
    nodes.map(|node| (name(&node), node.rect())).collect()
}

/// Checks that all controls are inside of the window and that no two overlap.
fn check(harness: &Harness<'_>, size: [f32; 2]) {
    let window = Rect::from_min_size(pos2(MARGIN, MARGIN), size.into()).expand(0.5);
    let all = controls(harness);
    assert!(all.len() > 8, "{all:?}");
    for (k, (name, rect)) in all.iter().enumerate() {
        assert!(window.contains_rect(*rect), "{size:?}: {name} at {rect:?}");
        for (other, place) in &all[..k] {
            assert!(!rect.shrink(0.5).intersects(place.shrink(0.5)), "{size:?}: {name} {rect:?} and {other} {place:?}");
        }
    }
}

fn touch(harness: &mut Harness<'_>) {
    for phase in [TouchPhase::Start, TouchPhase::End] {
        let (device_id, id, pos) = (TouchDeviceId(0), TouchId(1), pos2(200.0, 300.0));
        harness.event_modifiers(Event::Touch { device_id, id, phase, pos, force: None }, Modifiers::NONE);
    }
    harness.run_steps(4);
}

#[test]
fn controls_are_inside_of_every_window() {
    for size in SIZES {
        let mut harness = studio(size, "circle@0&panels.gallery=false&panels.summary=false");
        for finger in [false, true] {
            if finger {
                touch(&mut harness);
                let small =
                    controls(&harness).into_iter().find(|(_, rect)| rect.height() < 39.0 && rect.width() < 100.0);
                assert!(small.is_none(), "{size:?}: {small:?} is too small for a finger");
            }
            check(&harness, size);
            let mores = harness.query_all_by_label("More").count();
            assert_eq!(mores > 0, size[0] < 1400.0, "{size:?}");
            for more in [0, 1] {
                if let Some(more) = harness.query_all_by_label("More").nth(more) {
                    more.click();
                }
                harness.run_steps(3);
            }
            check(&harness, size);
            for name in ["Gallery", "Why", "Export", "one step back (Left)", "camera", "shape", "seed"] {
                assert!(harness.query_all_by_label(name).count() > 0, "{size:?}: {name} is missing");
            }
            let mores: Vec<_> = harness.query_all_by_label("More").map(|node| node.click()).collect();
            drop(mores);
            harness.run_steps(3);
        }
    }
}

#[test]
fn the_view_keeps_its_place() {
    for size in SIZES {
        let mut harness = studio(size, "circle@0");
        for panel in ["Text", "Tune", "Plots", "Gallery"] {
            if harness.query_by_label(panel).is_none() {
                harness.query_all_by_label("More").next().unwrap().click();
                harness.run_steps(3);
            }
            harness.get_all_by_label(panel).next().unwrap().click();
            harness.run_steps(4);
            if harness.query_all_by_label("More").next().is_some() && size[0] < 700.0 && panel == "Text" {
                harness.query_all_by_label("More").next().unwrap().click();
                harness.run_steps(3);
            }
        }
        let view = harness.get_by_label(VIEW).rect();
        let share = if size[0] < 700.0 { view.height() / size[1] } else { view.width() / size[0] };
        let least = if size[0] < 700.0 { 0.42 } else { 0.35 };
        assert!(share >= least, "{size:?}: the view is {view:?}");
    }
}

#[test]
fn the_start_page_leads_to_a_topic_and_to_the_studio() {
    for size in SIZES {
        let mut harness = studio(size, "circle@0&start");
        assert!(harness.query_by_label("Gallery").is_none(), "no panels");
        let view = harness.get_by_label(VIEW).rect();
        assert!(view.height() >= 0.5 * size[1], "{size:?}: {view:?}");
        for topic in ["Steering", "Avoidance", "Crowds", "Flocks", "Fields", "Swarms"] {
            harness.get_by_label(topic);
        }
        // the keyboard is enough
        harness.get_by_label("Swarms").focus();
        harness.run_steps(2);
        harness.key_press(Key::Enter);
        harness.run_steps(2);
        wait(&mut harness, "Locusts migrate between houses");
        for name in ["in the running scene", "All topics", "try"] {
            assert!(harness.query_all_by_label(name).next().is_some(), "{size:?}: {name}");
        }
        harness.get_by_label("Open the studio").click();
        harness.run_steps(3);
        harness.get_by_label("Gallery");
        // hints come once
        harness.get_by_label("1 of 5");
        harness.get_by_label("Next hint").click();
        harness.run_steps(3);
        harness.get_by_label("2 of 5");
        harness.get_by_label("No hints").click();
        harness.run_steps(3);
        assert!(harness.query_by_label("No hints").is_none());
    }
}

#[test]
fn an_embedded_scene_has_no_controls_and_plays_after_a_click() {
    let mut harness = studio([390.0, 300.0], "circle@0&embed");
    assert_eq!(harness.get_by_label(VIEW).rect().size(), vec2(390.0, 300.0));
    assert_eq!(controls(&harness).len(), 1);
    harness.get_by_label("play").click();
    harness.run_steps(2);
    wait(&mut harness, "pause");
}

/// The window *Why* fits a phone and is closed there.
#[test]
fn why_fits_a_phone() {
    for size in [[390.0, 844.0], [360.0, 640.0]] {
        let mut harness = studio(size, "circle@20&panels.gallery=false&panels.summary=false&panels.why=true");
        harness.get_by_label("Explain an agent").click();
        for _ in 0..60 {
            std::thread::sleep(Duration::from_millis(5));
            harness.step();
        }
        assert!(harness.query_by_label("Explain an agent").is_none(), "an agent is explained");
        let close = harness.get_by_label("Close window");
        let window = Rect::from_min_size(pos2(MARGIN, MARGIN), size.into()).expand(0.5);
        let figure = harness.get_by_role(Role::Image);
        let frame = harness.get_by_label("Why agent 0 moves as it does");
        for part in [figure.rect(), close.rect()] {
            assert!(window.contains_rect(part) && frame.rect().contains_rect(part), "{size:?}: {part:?}");
        }
        close.click();
        harness.run_steps(6);
        assert!(harness.query_by_label("Close window").is_none());
    }
}

#[test]
fn a_presentation_has_no_panels() {
    let harness = studio([800.0, 600.0], "circle@0&present");
    assert!(controls(&harness).is_empty());
}

#[test]
fn a_try_of_a_topic_is_left_without_a_question() {
    let mut harness = studio([800.0, 1200.0], "&flocks");
    assert!(harness.query_all_by_label("Boids in a box").next().is_some());
    harness.get_by_label("without cohesion").click();
    harness.run_steps(3);
    harness.get_by_label("Boids in open space").click();
    harness.run_steps(3);
    assert!(harness.query_by_label("Discard").is_none());
    wait(&mut harness, "without alignment");
    // in the studio, the same change is work
    harness.get_by_label("without alignment").click();
    harness.get_by_label("Open the studio").click();
    harness.run_steps(3);
    let other = harness.get_all_by_label("Seek and flee").next().unwrap();
    other.click();
    harness.run_steps(3);
    harness.get_by_label("Discard");
}

/// Waits for a label.
pub fn wait(harness: &mut Harness<'_>, label: &str) {
    let begin = Instant::now();
    while harness.query_all_by_label(label).next().is_none() {
        assert!(begin.elapsed() < Duration::from_secs(20), "there is no {label}");
        std::thread::sleep(Duration::from_millis(5));
        harness.step();
    }
}
