//! Intervening in the running scene, and keeping what was done.

use super::{App, floating_frame};
use crate::panels::{self, KeepAnswer, RestartAnswer};
use crate::play::{Act, Command, RunMoment};
use eframe::egui::{self, Ui};
use throng_scene::Interventions;

impl App {
    /// Lets the user change the running scene in the view of `response`.
    pub(super) fn intervene(&mut self, ui: &Ui, response: &egui::Response, shown: &RunMoment) {
        let size = glam::Vec2::new(response.rect.width(), response.rect.height());
        let (projector, theme) = (self.views[0].eye.projector(size), self.settings.theme());
        let (tool, group) = (self.director.tool, shown.setting.group_name(self.director.group as u32));
        let told = (tool, &*group, self.views[0].hovered());
        let acts = self.intervener.ui(ui, response, told, (&projector, &theme));
        self.do_all(acts);
    }

    /// Ends a gesture in the running scene.
    pub(super) fn let_go(&mut self) {
        let acts = self.intervener.let_go();
        self.do_all(acts);
    }

    fn do_all(&mut self, acts: Vec<Act>) {
        acts.into_iter().for_each(|act| self.player.command(Command::Intervene(act)));
    }

    /// Shows how much the user has done to the run, and asks whether to keep it.
    pub(super) fn ask_to_keep(&mut self, ui: &Ui, rect: egui::Rect, shown: &RunMoment) {
        if shown.interventions.is_empty() {
            return;
        }
        let area = egui::Area::new(egui::Id::unique("interventions"))
            .fixed_pos(rect.left_bottom() + egui::vec2(12.0, -12.0))
            .pivot(egui::Align2::LEFT_BOTTOM);
        let frame = floating_frame(&self.settings, ui);
        let asked =
            area.show(ui.ctx(), |ui| frame.show(ui, |ui| panels::interventions(ui, &shown.interventions)).inner);
        match asked.inner {
            Some(KeepAnswer::Keep) => self.keep_interventions(shown),
            Some(KeepAnswer::Forget) => self.player.command(Command::Restart),
            None => {}
        }
    }

    /// Starts the scene again. Asks first if that would forget interventions.
    pub(super) fn restart(&mut self, shown: Option<&RunMoment>) {
        match shown.is_some_and(|shown| !shown.interventions.is_empty()) {
            true => self.restarting = true,
            false => self.player.command(Command::Restart),
        }
    }

    /// Asks what becomes of the interventions before a restart, if the user wants one.
    pub(super) fn ask_restart(&mut self, ctx: &egui::Context, shown: Option<&RunMoment>) {
        let Some(shown) = shown.filter(|_| self.restarting) else { return };
        let Some(answer) = panels::restarting(ctx) else { return };
        self.restarting = false;
        if answer == RestartAnswer::Keep {
            self.keep_interventions(shown);
        }
        if answer != RestartAnswer::Cancel {
            self.player.command(Command::Restart);
        }
    }

    /// Says that a change of the scene waits for a restart.
    pub(super) fn say_waiting(&mut self, ui: &Ui, rect: egui::Rect, shown: &RunMoment) {
        if !shown.waits {
            return;
        }
        let area = egui::Area::new(egui::Id::unique("waiting")).fixed_pos(rect.left_top() + egui::vec2(12.0, 12.0));
        let frame = floating_frame(&self.settings, ui);
        let asked = area.show(ui.ctx(), |ui| {
            let row = |ui: &mut Ui| {
                ui.label("The scene has changed.");
                ui.button("Restart").on_hover_text("start the changed scene (R)").clicked()
            };
            frame.show(ui, |ui| ui.horizontal(row).inner).inner
        });
        if asked.inner {
            self.restart(Some(shown));
        }
    }

    /// Writes the interventions into the text of the scene. The run goes on.
    fn keep_interventions(&mut self, shown: &RunMoment) {
        match Interventions::text(&shown.interventions) {
            Ok(text) => {
                self.document.edit(format!("{}\n\n{text}", self.document.text().trim_end()));
                self.notice = Some("the interventions are in the text now: each run of the scene repeats them".into());
                self.change();
            }
            Err(error) => self.notice = Some(error.to_string()),
        }
    }
}
