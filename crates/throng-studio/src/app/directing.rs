//! Editing the scene in the view.

use super::{App, frame_of};
use crate::direct::{DirectedWorld, Sight};
use crate::keep::Leaving;
use crate::panels;
use crate::play::RunMoment;
use eframe::egui::{self, Context, Ui};

impl App {
    /// Handles the result of a gesture. After an edit, the scene restarts, running or paused as before.
    fn directed(&mut self, edited: Result<bool, String>, shown: &RunMoment) {
        match edited {
            Ok(true) => {
                self.notice = None;
                self.play(shown.playing);
            }
            Ok(false) => {}
            Err(says) => self.notice = Some(says),
        }
    }

    /// Lets the user edit the scene in the view of `response`.
    pub(super) fn direct(&mut self, ui: &Ui, response: &egui::Response, shown: &RunMoment) {
        let size = glam::Vec2::new(response.rect.width(), response.rect.height());
        let (projector, theme) = (self.views[0].eye.projector(size), self.settings.theme());
        let stage = DirectedWorld { first: &shown.first, bounds: shown.bounds, scale: 1.0 };
        let sight = Sight { projector: &projector, theme: &theme };
        if self.views[0].lent {
            let area = egui::Area::new(egui::Id::unique("tool")).fixed_pos(response.rect.min + egui::vec2(12.0, 12.0));
            let frame = frame_of(&self.settings).corner_radius(6).stroke(ui.visuals().window_stroke);
            area.show(ui.ctx(), |ui| frame.show(ui, |ui| panels::tool_options(ui, &mut self.director, &shown.scene)));
        }
        let edited = self.director.ui(ui, response, &mut self.document, stage, sight);
        self.directed(edited, shown);
    }

    /// Removes the selected item.
    pub(super) fn remove(&mut self, shown: Option<&RunMoment>) {
        let edited = self.director.remove(&mut self.document);
        if let Some(shown) = shown {
            self.directed(edited, shown);
        }
    }

    /// Adds an agent to the group of the selected agent, or to the edited group if none is selected. Removes an agent
    /// if `by` is negative.
    pub(super) fn more(&mut self, by: i64, shown: Option<&RunMoment>) {
        let Some(shown) = shown else { return };
        let of = |number| shown.first.bodies.iter().find(|body| body.number == number);
        let selected = self.views[0].selected.and_then(of).map(|body| body.group as usize);
        let group = selected.unwrap_or(self.director.group);
        let edited = self.director.more(&mut self.document, group, by);
        self.directed(edited, shown);
    }

    /// Shows the windows "Save as" and "Open" and handles their answers.
    pub(super) fn ask_name(&mut self, ctx: &Context) {
        if let Some(name) = self.open.ui(ctx) {
            let opened = self.files.open(&name, self.document.plugins()).map(|_| ());
            let good = opened.is_ok();
            self.open.answer(opened);
            if good {
                self.leave(Leaving::Open(name));
            }
        }
        if let Some(name) = self.save_as.ui(ctx) {
            let saved = self.outside.save_as(&mut self.document, &name);
            if saved.is_ok() {
                self.settings.scene.clone_from(&name);
            }
            self.save_as.answer(saved);
        }
    }
}
