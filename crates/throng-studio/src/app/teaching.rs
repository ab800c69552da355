//! Lessons beside the view.

use super::App;
use crate::face::Face;
use crate::keep::Leaving;
use crate::lesson::{self, Check};
use crate::panels::{self, LessonRequest, NARROW};
use crate::play::{Command, RunMoment, Trouble};
use crate::view::ViewOptions;
use eframe::egui::{RichText, Ui};
use std::time::Duration;
use throng_scene::lessons;

/// The time for a check in each frame.
const SLICE: Duration = Duration::from_millis(8);

impl App {
    /// Opens the scene of a step, and plays it.
    pub(super) fn teach(&mut self, lesson: usize, at: usize) {
        let Some(step) = lesson::lesson(lesson).and_then(|lesson| lesson.steps.get(at)) else { return };
        match lesson::document(step, self.document.plugins()) {
            Ok(document) => {
                self.teaching.begin((lesson, at), self.player.shown().map_or(0, |shown| shown.run));
                self.show(document);
                self.settings.scene.clone_from(&step.scene);
                let own = self.settings.beside.clone();
                self.teaching.own_beside.get_or_insert(own);
                self.settings.beside = step.beside.clone().unwrap_or_default();
                self.put_beside();
                self.play(true);
                // the panel of the lesson takes a part of the view
                self.views.iter_mut().for_each(ViewOptions::refit);
            }
            Err(says) => self.notice = Some(says),
        }
    }

    /// Gives the user's own model beside the scene back, when a lesson is left.
    pub(super) fn end_lesson(&mut self) {
        if let Some(own) = self.teaching.own_beside.take() {
            self.settings.beside = own;
            self.put_beside();
        }
    }

    /// Shows a lesson beside the view. Its scene pauses for questions.
    pub(super) fn lesson(&mut self, ui: &mut Ui, at: usize, shown: Option<&RunMoment>, trouble: Option<&Trouble>) {
        let Some(lesson) = lesson::lesson(at) else { return };
        let Some(step) = self.teaching.position(at) else {
            // a scene plays before the lesson begins, so that only the run of the step counts
            if shown.is_some() {
                self.leave(Leaving::Step(at, 0));
            }
            return;
        };
        if shown.is_some_and(|shown| self.teaching.asks(shown.run, shown.time())) {
            self.player.command(Command::Pause);
        }
        if self.teaching.check.as_mut().is_some_and(|check| check.work(SLICE)) {
            ui.ctx().request_repaint();
        }
        self.playback(ui, shown);
        let (task, screen) = (lesson.steps[step].exercise.is_some(), ui.ctx().content_rect().size());
        if task && screen.x >= NARROW && panels::tools_fit(ui, screen.y) {
            self.toolbar(ui);
        }
        self.beside_view(ui, (shown, trouble), |app, ui| {
            match panels::lesson(ui, lesson, step, &mut app.teaching) {
                Some(LessonRequest::Go(to)) => app.leave(Leaving::Step(at, to)),
                Some(LessonRequest::Answer) => {
                    app.teaching.told = true;
                    app.player.command(Command::Run);
                }
                Some(LessonRequest::Check) => {
                    app.teaching.check = app.document.scene().ok().map(Check::new);
                }
                None => {}
            }
            if task {
                ui.separator();
                let tuned = app.tuning.ui(ui, &mut app.document);
                app.tuned(tuned);
            }
        });
    }

    /// Shows a button for each lesson.
    pub(super) fn lessons(&mut self, ui: &mut Ui) {
        ui.horizontal_wrapped(|ui| {
            ui.visuals_mut().widgets.inactive.weak_bg_fill = ui.visuals().faint_bg_color;
            ui.label(RichText::new("Lessons").strong());
            for (at, lesson) in lessons::all().iter().enumerate() {
                if ui.button(&lesson.title).on_hover_text(&lesson.summary).clicked() {
                    self.turn_to(Face::Lesson(at));
                    self.leave(Leaving::Step(at, 0));
                }
            }
        });
    }
}
