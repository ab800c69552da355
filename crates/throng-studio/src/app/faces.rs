//! What is around the views: the panels, the start page, a topic of the gallery, or nothing.

use super::layout::Control;
use super::{App, floating_frame, frame_of};
use crate::direct::Tool;
use crate::face::Face;
use crate::keep::Leaving;
use crate::panels::{self, NARROW, TOPICS};
use crate::play::{Command, RunMoment, Trouble};
use crate::view::ViewOptions;
use eframe::egui::{
    Align, Align2, Area, Button, Color32, FontId, Id, Label, LayerId, Layout, Order, Panel, Rect, RichText, Role,
    ScrollArea, Sense, Shape, Stroke, Ui, Vec2, WidgetInfo, vec2,
};
use throng_scene::Scene;

/// The width of the panel of a topic beside the view, points.
const WIDTH: f32 = 360.0;
/// The height of the start page above its cards, points.
const HEAD: f32 = 140.0;
/// The models to compare with: each paper's beside the next one's.
const COMPARED: [&str; 4] = ["vo", "rvo", "hrvo", "orca"];
/// The enlargement of a presentation.
const LARGE: f32 = 1.5;

impl App {
    /// Changes what is around the views. A presentation is larger.
    pub(super) fn turn_to(&mut self, face: Face) {
        if self.face != face && [self.face, face].contains(&Face::Present) {
            self.ctx.set_zoom_factor(if face == Face::Present { LARGE } else { 1.0 });
            self.views.iter_mut().for_each(ViewOptions::refit);
        }
        if !face.has_tools() {
            self.director.take(Tool::Hand);
        }
        // in the studio, they are work
        self.tried &= face != Face::Studio;
        if matches!(self.face, Face::Lesson(_)) && !matches!(face, Face::Lesson(_)) {
            self.end_lesson();
        }
        self.face = face;
    }

    /// Opens a scene from the start page or from a topic. Tries are not worth a question.
    fn open_to_try(&mut self, scene: String) {
        if std::mem::take(&mut self.tried) {
            self.document.revert();
        }
        self.leave(Leaving::Open(scene));
    }

    /// Shows what is around the views.
    pub(super) fn around(&mut self, ui: &mut Ui, shown: Option<&RunMoment>, trouble: Option<&Trouble>) {
        match self.face {
            Face::Studio => self.panels(ui, shown, trouble),
            Face::Start => self.start(ui, shown),
            Face::Topic(topic) => self.topic(ui, topic, shown, trouble),
            Face::Lesson(lesson) => self.lesson(ui, lesson, shown, trouble),
            Face::Present | Face::Embed => {}
        }
    }

    /// Shows what is over the views.
    pub(super) fn over(&mut self, ui: &Ui, shown: Option<&RunMoment>) {
        let Some(shown) = shown else { return };
        match self.face {
            Face::Embed => {
                if click_to_play(ui, shown.playing) {
                    self.player.command(if shown.playing { Command::Pause } else { Command::Run });
                }
            }
            Face::Present => {
                let at = ui.max_rect().left_top() + vec2(16.0, 12.0);
                let (font, color) = (FontId::proportional(22.0), ui.visuals().text_color());
                ui.painter().text(at, Align2::LEFT_TOP, &shown.setting.title, font, color);
                if let Some(at) = ui.input(|input| input.pointer.hover_pos()) {
                    let painter = ui.ctx().layer_painter(LayerId::new(Order::Tooltip, Id::unique("pointer")));
                    painter.circle_stroke(at, 20.0, Stroke::new(4.0, ui.visuals().hyperlink_color));
                }
            }
            Face::Studio if self.hints.open() => self.hint(ui),
            Face::Studio | Face::Start | Face::Topic(_) | Face::Lesson(_) => {}
        }
    }

    /// Shows the cards of the topics below the view. The scene plays again and again.
    fn start(&mut self, ui: &mut Ui, shown: Option<&RunMoment>) {
        if shown.is_some_and(|shown| shown.over) {
            [Command::Restart, Command::Run].into_iter().for_each(|command| self.player.command(command));
        }
        let frame = frame_of(&self.settings);
        let cards = panels::cards_height(ui, ui.available_width() - frame.inner_margin.sum().x);
        let height = (cards + HEAD).min(0.5 * ui.available_height());
        let panel = Panel::bottom("start").frame(frame).show_separator_line(false);
        panel.resizable(false).exact_size(height).show(ui, |ui| {
            ui.horizontal(|ui| {
                ui.label(RichText::new("throng").heading());
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    self.open_studio(ui);
                    self.offers(ui, shown);
                    let says = RichText::new("crowds, flocks and swarms, to try and to take apart").weak();
                    ui.with_layout(Layout::left_to_right(Align::Center), |ui| ui.add(Label::new(says).truncate()));
                });
            });
            ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                panels::live_tools(ui, &mut self.director);
                self.lessons(ui);
                ui.add_space(6.0);
                if let Some(topic) = self.gallery.topics(ui, self.document.plugins()) {
                    self.turn_to(Face::Topic(topic));
                    self.open_to_try(TOPICS[topic].first.to_owned());
                }
            });
        });
    }

    /// Shows the controls of the studio that every face with panels has.
    fn offers(&mut self, ui: &mut Ui, shown: Option<&RunMoment>) {
        let controls = [Control::Share, Control::Why];
        let offered = controls.into_iter().filter(|control| control.is_shown(false, false, false));
        offered.for_each(|control| self.control(ui, control, shown));
    }

    pub(super) fn open_studio(&mut self, ui: &mut Ui) {
        let button = Button::new("Open the studio").fill(ui.visuals().selection.bg_fill);
        if ui.add(button).on_hover_text("all panels, and tools to edit the scene").clicked() {
            self.turn_to(Face::Studio);
            if !self.settings.hinted {
                self.hints.begin();
            }
        }
    }

    /// Shows a hint over the view.
    fn hint(&mut self, ui: &Ui) {
        let view = ui.max_rect();
        let area =
            Area::new(Id::unique("hints")).pivot(Align2::CENTER_TOP).fixed_pos(view.center_top() + vec2(0.0, 12.0));
        let frame = floating_frame(&self.settings, ui);
        let done = [self.views[0].selected.is_some(), self.settings.panels.why, self.settings.panels.tuning];
        let shown = area.show(ui.ctx(), |ui| frame.show(ui, |ui| self.hints.ui(ui, done)).inner);
        self.settings.hinted |= shown.inner;
    }

    /// Shows a panel beside the view, or below it in a narrow window, with the ways to other faces and this content.
    pub(super) fn beside_view(
        &mut self,
        ui: &mut Ui,
        (shown, trouble): (Option<&RunMoment>, Option<&Trouble>),
        content: impl FnOnce(&mut Self, &mut Ui),
    ) {
        let panel = match ui.ctx().content_rect().width() < NARROW {
            true => Panel::bottom("topic")
                .exact_size(panels::sheet(ui.ctx().content_rect().height(), ui.available_height())),
            false => {
                let most = 0.5 * ui.ctx().content_rect().width();
                Panel::right("topic").default_size(WIDTH.min(most)).max_size(most)
            }
        };
        panel.frame(frame_of(&self.settings)).show_separator_line(false).show(ui, |ui| {
            ui.horizontal_wrapped(|ui| {
                if ui.button("All topics").clicked() {
                    self.turn_to(Face::Start);
                }
                self.offers(ui, shown);
                self.open_studio(ui);
            });
            self.said(ui, trouble);
            // buttons of presets and answers are to be seen as buttons
            ui.visuals_mut().widgets.inactive.weak_bg_fill = ui.visuals().faint_bg_color;
            ScrollArea::vertical().auto_shrink(false).show(ui, |ui| content(self, ui));
        });
    }

    /// Shows a topic beside the view.
    fn topic(&mut self, ui: &mut Ui, topic: usize, shown: Option<&RunMoment>, trouble: Option<&Trouble>) {
        self.playback(ui, shown);
        self.beside_view(ui, (shown, trouble), |app, ui| {
            app.scene_to_try(ui, shown);
            ui.separator();
            ui.label(RichText::new(TOPICS[topic].title).heading());
            let plugins = app.document.plugins().clone();
            let (names, open) = (TOPICS[topic].scenes(&plugins), app.document.name.clone());
            if let Some(name) = app.gallery.scenes(ui, &plugins, &names, &open) {
                app.open_to_try(name);
            }
        });
    }

    /// Shows what the open scene shows, what can be tried, and the models to compare with.
    fn scene_to_try(&mut self, ui: &mut Ui, shown: Option<&RunMoment>) {
        let Some(shown) = shown else { return };
        ui.label(RichText::new(&shown.setting.title).heading());
        shown.scene.about.see.iter().for_each(|see| _ = ui.label(see));
        ui.add_space(6.0);
        let begins = !self.document.changed();
        let tuned = self.trying.ui(ui, &mut self.document);
        self.tried |= begins && self.document.changed();
        self.tuned(tuned);
        ui.add_space(6.0);
        panels::live_tools(ui, &mut self.director);
        self.compare(ui, &shown.scene);
        panels::words(ui, &shown.scene.about, &["look_for", "try", "why", "source"]);
    }

    /// Shows the models to compare the model of the scene with. A scene without avoidance has none.
    fn compare(&mut self, ui: &mut Ui, scene: &Scene) {
        let own = crate::play::models_of(scene);
        if own == "none" {
            return;
        }
        ui.horizontal_wrapped(|ui| {
            ui.label(RichText::new("compare with").strong());
            for name in COMPARED.into_iter().filter(|name| *name != own) {
                let chosen = self.settings.beside == name;
                let label = ui.selectable_label(chosen, name.to_uppercase());
                if label.on_hover_text("the same scene with this model, side by side").clicked() {
                    self.settings.beside = if chosen { String::new() } else { name.to_owned() };
                    self.put_beside();
                }
            }
        });
        ui.add_space(6.0);
    }
}

/// Shows a symbol over a paused view. Returns whether the user clicked the view.
fn click_to_play(ui: &Ui, playing: bool) -> bool {
    let view: Rect = ui.max_rect();
    let response = ui.interact(view, Id::unique("play"), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, if playing { "pause" } else { "play" }));
    if !playing {
        let (center, side) = (view.center(), 0.12 * view.size().min_elem());
        ui.painter().circle_filled(center, 1.6 * side, Color32::from_black_alpha(110));
        let corner = |x: f32, y: f32| center + Vec2::new(x, y) * side;
        let triangle = vec![corner(-0.5, -0.8), corner(0.9, 0.0), corner(-0.5, 0.8)];
        ui.painter().add(Shape::convex_polygon(triangle, Color32::WHITE, Stroke::NONE));
    }
    response.clicked()
}
