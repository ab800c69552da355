//! Comparison of two models side by side.

use super::App;
use crate::direct::Tool;
use crate::face::Face;
use crate::panels;
use crate::play::{Command, RunMoment};
use eframe::egui::{self, Ui};
use throng_scene::Model;

/// The height of the figures under each of two views, points of the screen.
const FIGURES: f32 = 28.0;

impl App {
    /// Runs the scene with a second model beside its own, as the settings select.
    pub(super) fn put_beside(&mut self) {
        let model = Model::parse(&self.settings.beside, &self.document.plugins().models).ok();
        self.player.command(Command::Beside(model));
    }

    /// Draws the main view, or two views of the scene with two models and one camera.
    pub(super) fn views(&mut self, ui: &mut Ui, shown: &RunMoment) {
        let scrolls = self.face == Face::Embed;
        self.views.iter_mut().for_each(|view| view.scrolls = scrolls);
        self.views[0].lent = self.director.tool != Tool::Hand || self.meters.tool().is_some();
        let Some(beside) = shown.beside.as_deref() else {
            let response = self.views[0].ui(ui, shown, &self.settings);
            self.key(ui, response.rect, shown, 0);
            self.lend(ui, &response, shown);
            return;
        };
        ui.painter().rect_filled(ui.max_rect(), 0.0, ui.visuals().panel_fill);
        let size = egui::vec2((ui.available_width() - ui.spacing().item_spacing.x) * 0.5, ui.available_height());
        ui.horizontal(|ui| {
            for (at, (shown, other)) in [(shown, beside), (beside, shown)].into_iter().enumerate() {
                let view = &mut self.views[at];
                let (eye, selected) = (view.eye, view.selected);
                let layout = egui::Layout::top_down(egui::Align::Min);
                let allocated = ui.allocate_ui_with_layout(size, layout, |ui| {
                    let picture = egui::vec2(size.x, size.y - FIGURES);
                    let response = ui.allocate_ui(picture, |ui| view.ui(ui, shown, &self.settings)).inner;
                    ui.horizontal(|ui| {
                        ui.add_space(12.0);
                        panels::figures_of_models(ui, shown, other);
                    });
                    panels::name_of_models(ui, response.rect, &shown.scene);
                    response
                });
                if at == 0 {
                    self.key(ui, allocated.inner.rect, shown, at);
                    self.lend(ui, &allocated.inner, shown);
                }
                let view = &self.views[at];
                let (before, now) = ((eye, selected), (view.eye, view.selected));
                self.views[1 - at].goes_with(before, now);
            }
        });
    }

    /// Draws the legend of colours and lines over a view.
    fn key(&self, ui: &Ui, rect: egui::Rect, shown: &RunMoment, at: usize) {
        if self.settings.layers.key {
            panels::key(ui, rect, &self.views[at].key(shown, &self.settings), &shown.name);
        }
    }

    /// Lets the tools work in the view of `response`.
    fn lend(&mut self, ui: &Ui, response: &egui::Response, shown: &RunMoment) {
        self.place = response.rect;
        if ui.input(|input| input.multi_touch().is_some()) {
            // the second finger starts a camera gesture, so drop what the first finger began
            self.director.cancel();
            self.let_go();
        } else if self.meters.tool().is_none() && shown.reel.is_none() {
            self.direct(ui, response, shown);
        }
        self.ask_to_keep(ui, response.rect, shown);
        self.say_waiting(ui, response.rect, shown);
        let asked = self.meters.ui(ui, response, &self.views[0].eye);
        asked.into_iter().for_each(|command| self.player.command(command));
    }
}
