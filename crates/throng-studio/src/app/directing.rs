//! Editing the scene in the view.

use super::{App, floating_frame};
use crate::direct::{DirectedWorld, Sight};
use crate::panels;
use crate::play::RunMoment;
use eframe::egui::{self, Ui};

impl App {
    /// Handles the result of a gesture. After an edit, the scene restarts, running or paused as before, or goes on where the
    /// user wants no restarts.
    fn directed(&mut self, edited: Result<bool, String>, shown: &RunMoment) {
        match edited {
            Ok(true) => {
                self.notice = None;
                if self.settings.restarts {
                    self.play(shown.playing);
                } else {
                    self.change();
                }
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
        self.director.snapping = self.settings.snapping;
        if self.views[0].lent {
            let area = egui::Area::new(egui::Id::unique("tool")).fixed_pos(response.rect.min + egui::vec2(12.0, 12.0));
            let frame = floating_frame(&self.settings, ui);
            area.show(ui.ctx(), |ui| {
                frame.show(ui, |ui| panels::tool_options(ui, &mut self.director, &mut self.intervener, &shown.scene))
            });
            self.settings.snapping = self.director.snapping;
        }
        if self.director.tool.intervenes() {
            self.intervene(ui, response, shown);
            return;
        }
        self.let_go();
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
}
