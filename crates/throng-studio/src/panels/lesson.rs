//! The panel of a lesson: text, question, exercise.

use crate::lesson::{Check, Teaching};
use eframe::egui::{Button, Color32, ProgressBar, RichText, Ui};
use throng_scene::lessons::{Lesson, Question};

/// What the user wants of a lesson.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LessonRequest {
    /// To go to another step.
    Go(usize),
    /// To see the answer: the scene goes on.
    Answer,
    /// To check the exercise.
    Check,
}

/// Shows the text of a step, its question, and the buttons to other steps.
pub fn lesson(ui: &mut Ui, lesson: &Lesson, at: usize, teaching: &mut Teaching) -> Option<LessonRequest> {
    let mut wanted = None;
    let step = lesson.steps.get(at)?;
    ui.label(RichText::new(&lesson.title).weak());
    ui.label(RichText::new(format!("{}. {}", at + 1, step.title)).heading());
    ui.label(&step.text);
    ui.add_space(8.0);
    if let Some(question) = &step.question {
        wanted = ask(ui, question, teaching).or(wanted);
    }
    if let Some(exercise) = &step.exercise {
        ui.label(RichText::new(&exercise.task).strong());
        ui.add_space(4.0);
        wanted = check(ui, teaching).or(wanted);
    }
    if let Some(note) = &step.note {
        ui.add_space(8.0);
        ui.collapsing("for the lecturer", |ui| ui.label(note));
    }
    ui.add_space(8.0);
    ui.horizontal(|ui| {
        if ui.add_enabled(at > 0, Button::new("Back")).clicked() {
            wanted = Some(LessonRequest::Go(at - 1));
        }
        ui.label(format!("{} of {}", at + 1, lesson.steps.len()));
        let next = at + 1 < lesson.steps.len();
        if ui.add_enabled(next, Button::new("Next")).clicked() {
            wanted = Some(LessonRequest::Go(at + 1));
        }
    });
    wanted
}

/// Shows a question with the votes for its answers. Before the scene has paused, it only says that a question follows.
fn ask(ui: &mut Ui, question: &Question, teaching: &mut Teaching) -> Option<LessonRequest> {
    if !teaching.asked {
        ui.label(RichText::new(format!("The scene pauses at {} s for a question.", question.pause)).weak());
        return None;
    }
    ui.label(RichText::new(&question.ask).strong());
    ui.add_space(4.0);
    for (k, (answer, votes)) in question.answers.iter().zip(&mut teaching.votes).enumerate() {
        let right = teaching.told && k == question.right;
        let mut text = RichText::new(if *votes > 0 { format!("{answer}   ({votes})") } else { answer.clone() });
        if right {
            text = text.strong().color(good(ui));
        }
        let button = Button::new(text).wrap();
        let width = ui.available_width();
        if ui.add_enabled(!teaching.told, button.min_size([width, 0.0].into())).clicked() {
            *votes += 1;
        }
    }
    ui.add_space(4.0);
    if teaching.told {
        ui.label(&question.because);
        return None;
    }
    let shown = ui.button("Go on and see").on_hover_text("each click on an answer is a vote; then let the scene go on");
    shown.clicked().then_some(LessonRequest::Answer)
}

/// Shows the button that checks an exercise, and the result.
fn check(ui: &mut Ui, teaching: &Teaching) -> Option<LessonRequest> {
    match &teaching.check {
        Some(Check::Running(run)) => {
            ui.add(ProgressBar::new(run.share()).text("checking"));
            return None;
        }
        Some(Check::Wrong(says)) => _ = ui.colored_label(ui.visuals().error_fg_color, says),
        Some(done @ Check::Done(checks)) => {
            if done.passed() {
                ui.label(RichText::new("Solved: the scene shows all that it expects.").strong().color(good(ui)));
            }
            for (says, _) in checks.iter().filter(|(_, passed)| !passed) {
                ui.colored_label(ui.visuals().error_fg_color, says);
            }
        }
        None => {}
    }
    let button = ui.button("Check").on_hover_text("runs the scene as it is now, and checks what it expects");
    button.clicked().then_some(LessonRequest::Check)
}

/// Returns the colour of what is right.
fn good(ui: &Ui) -> Color32 {
    if ui.visuals().dark_mode { Color32::from_rgb(120, 210, 130) } else { Color32::from_rgb(20, 115, 45) }
}
