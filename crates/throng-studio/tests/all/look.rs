//! The look of pictures and films: the panel, the text, and the pictures of the program.

use crate::layout::{studio, wait};
use eframe::egui::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use throng_draw::{Painter, Style};
use throng_record::{Frame, moment};
use throng_scene::Scene;
use throng_studio::document::Document;
use throng_studio::panels::{Tuned, Tuning};
use throng_studio::settings::Settings;

const WALL: &str = "[[obstacle]]\nshape.wall = [[2, -3], [2, 3]]\n[[group]]\ncount = 1\nplace.point = [0, 0]\n\
                    goal.point = [1, 0]\n[view]\ncamera = { eye = [-4, -5, 3], target = [1, 0, 0.5] }\n";

/// Returns the picture of the start of a scene.
fn picture(scene: &Scene) -> Vec<u8> {
    let (world, built) = scene.build().unwrap();
    let (setting, mut frame) = (moment::setting(&world, &built, ""), Frame::default());
    moment::capture(&world, &mut frame);
    let style = Style { width: 96, height: 72, legend: false, ..Style::said(scene) };
    Painter::new(&setting, &style, &frame).unwrap().paint(&frame).data().to_vec()
}

/// Operates the panel of a document. Returns whether the text has changed.
fn operate(document: &mut Document, act: impl FnOnce(&mut Harness<'_>)) -> bool {
    let (mut panel, mut last) = (Tuning::look(), None);
    let mut harness = Harness::builder().with_size([500.0, 900.0]).build_ui(|ui| {
        last = panel.ui(ui, document).or(last.take());
    });
    act(&mut harness);
    harness.run();
    drop(harness);
    last == Some(Tuned::Changed)
}

#[test]
fn every_control_changes_the_text_and_the_picture() {
    let mut document = Document::new("wall", WALL);
    let before = picture(document.scene().unwrap());
    // the sun begins where it is in the afternoon, and is then lower
    assert!(operate(&mut document, |harness| harness.get_by_label("as in the afternoon").click()));
    assert_eq!(document.scene().unwrap().view.sun.height, Some(41.0), "{}", document.text());
    document.set("view.sun.height", 12.0).unwrap();
    assert!(picture(document.scene().unwrap()) != before, "another light");
    assert!(operate(&mut document, |harness| harness.get_by_label("default").click()));
    assert_eq!(document.text(), WALL, "the key is removed");

    // people are balls
    let switch = |harness: &mut Harness<'_>| {
        let row = harness.get_by_label("people").rect().center().y;
        let boxes = harness.get_all_by_role(Role::CheckBox);
        boxes.filter(|node| (node.rect().center().y - row).abs() < 4.0).for_each(|node| node.click());
    };
    assert!(operate(&mut document, switch));
    assert_eq!(document.scene().unwrap().view.people, Some(false), "{}", document.text());
    assert!(picture(document.scene().unwrap()) != before);
    assert!(!Settings::default().draws_people(document.scene().unwrap(), false), "in the view too");
    assert!(document.undo() && document.text() == WALL);

    // a colour
    let choose = |harness: &mut Harness<'_>| {
        harness.get_by_role_and_label(Role::SpinButton, "ground: red").decrement_accesskit();
    };
    assert!(operate(&mut document, choose));
    let ground = document.scene().unwrap().view.ground.unwrap();
    assert!(document.text().contains("ground = \"#") && picture(document.scene().unwrap()) != before, "{ground:?}");
}

#[test]
fn the_run_goes_on_with_another_look() {
    let mut harness = studio([1440.0, 900.0], "circle@60&camera=orbit&panels.look=true&panels.gallery=false");
    harness.get_by_label("as in the afternoon").click();
    harness.run_steps(3);
    wait(&mut harness, "default");
    harness.run_steps(5);
    assert!(harness.query_by_label("  2.40 s").is_some());
}
