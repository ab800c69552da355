//! Lessons: their scenes, questions and exercises, in the studio.

use crate::layout::{studio, wait};
use egui_kittest::kittest::Queryable;
use std::sync::Arc;
use std::time::Duration;
use throng_scene::lessons;
use throng_studio::document::Document;
use throng_studio::lesson::{self, Check, Teaching};

#[test]
fn a_step_opens_the_scene_that_the_lesson_names() {
    for known in lessons::all() {
        for step in &known.steps {
            let document =
                lesson::document(step, &Arc::default()).unwrap_or_else(|says| panic!("{}: {says}", step.title));
            assert_eq!(**document.scene().unwrap(), step.scene().unwrap(), "{}: {}", known.name, step.title);
            assert!(!document.changed(), "the changes of the lesson count as saved");
        }
    }
}

/// A step with two models leaves no trace in the studio.
#[test]
fn the_model_beside_the_scene_ends_with_the_lesson() {
    let mut harness = studio([1440.0, 900.0], "circle@10&beside=rvo&lesson-avoidance");
    let beside = |harness: &mut egui_kittest::Harness<'_>| {
        harness.get_by_label("All topics").click();
        harness.run_steps(3);
        harness.get_by_label("Open the studio").click();
        harness.run_steps(3);
        harness.get_by_label("beside").value()
    };
    wait(&mut harness, "1 of 6");
    assert_eq!(beside(&mut harness).as_deref(), Some("rvo"));
}

#[test]
fn a_question_pauses_the_scene_once() {
    let at = lessons::all().iter().position(|lesson| lesson.name == "steering").unwrap();
    let mut teaching = Teaching::default();
    assert!(!teaching.asks(1, 100.0), "no step has begun");
    teaching.begin((at, 0), 1);
    assert_eq!((teaching.position(at), teaching.votes.len()), (Some(0), 3));
    assert!(!teaching.asks(1, 100.0), "this is still the run before");
    assert!(!teaching.asks(2, 3.5) && teaching.asks(2, 3.62) && !teaching.asks(2, 3.66));
}

#[test]
fn an_exercise_is_checked() {
    let step = lessons::named("steering").unwrap().steps.last().unwrap();
    let verdict = |scene| {
        let mut check = Check::new(&scene);
        while check.work(Duration::from_millis(5)) {}
        check.passed()
    };
    let document: Document = lesson::document(step, &Arc::default()).unwrap();
    assert!(!verdict(document.scene().unwrap().clone()));
    assert!(verdict(Arc::new(step.solved().unwrap())));
}

#[test]
fn a_class_votes_and_sees_the_answer() {
    let mut harness = studio([1440.0, 900.0], "seek-flee&lesson-steering");
    wait(&mut harness, "Go on and see");
    harness.get_by_label("It stops at the flag").click();
    harness.run_steps(3);
    harness.get_by_label("It stops at the flag   (1)").click();
    harness.run_steps(3);
    assert!(harness.query_by_label("It stops at the flag   (2)").is_some());
    assert!(harness.query_by_label_contains("Seek knows no braking").is_none());
    harness.get_by_label("Go on and see").click();
    harness.run_steps(3);
    assert!(harness.query_by_label_contains("Seek knows no braking").is_some());
    harness.get_by_label("Next").click();
    harness.run_steps(3);
    assert!(harness.query_by_label("2. Arrival").is_some());
}
