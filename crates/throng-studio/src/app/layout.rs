//! The bars and the panels around the views.

use super::{App, floating_frame, frame_of};
use crate::face::Face;
use crate::keep::Leaving;
use crate::keys::Action;
use crate::panels::{self, Asked, NARROW, PanelKind, TextRequest, Tuned};
use crate::play::{Command, RunMoment, Trouble};
use eframe::egui::{Align2, Area, Button, Frame, Id, Label, Margin, Panel, RichText, ScrollArea, Ui, vec2};

/// What the button *Open* opens.
const OPEN: &str = "a scene file, a floor plan, another program's scene, or trajectories to replay (Ctrl O)";
/// What the button *Export* writes.
const EXPORT: &str = "a film, characters, a stage or a table of this scene: for Blender, Houdini, engines, notebooks";
/// What the name of the program and the button *Topics* open.
const START: &str = "the start page: topics and lessons";
/// The width that a message needs beside the controls, points. In less, it is over the view, which keeps its place.
const MESSAGE: f32 = 200.0;
/// The distance of messages over the view from the edges of the window, points.
const FROM_EDGE: f32 = 24.0;
/// The width that the title of the scene needs, points.
const TITLE: f32 = 60.0;

/// A control of the top bar.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Control {
    Name,
    Line,
    Panel(PanelKind),
    Why,
    Edit,
    Layers,
    Beside,
    New,
    Open,
    SaveAs,
    Picture,
    Record,
    Share,
    Topics,
    Help,
}

impl Control {
    /// All controls. Those at the end are hidden first in a narrow window.
    const ALL: [Self; 21] = [
        Self::Name,
        Self::Line,
        Self::Panel(PanelKind::Gallery),
        Self::Edit,
        Self::Panel(PanelKind::Tuning),
        Self::Panel(PanelKind::Look),
        Self::Layers,
        Self::Panel(PanelKind::Text),
        Self::Panel(PanelKind::Summary),
        Self::Panel(PanelKind::Plots),
        Self::Why,
        Self::Beside,
        Self::Line,
        Self::New,
        Self::Open,
        Self::SaveAs,
        Self::Picture,
        Self::Record,
        Self::Share,
        Self::Topics,
        Self::Help,
    ];

    /// Whether the control is shown in a narrow window or not, with the tools as a menu or not, with a replay or a scene.
    /// Addresses are for pages.
    pub(super) fn is_shown(self, narrow: bool, menu: bool, film: bool) -> bool {
        match self {
            Self::Name | Self::Line => !narrow,
            Self::Topics => narrow,
            Self::Edit => menu && !film,
            Self::Share => cfg!(target_arch = "wasm32"),
            _ => true,
        }
    }
}

impl App {
    /// Shows the bars, the tools and the panels.
    pub(super) fn panels(&mut self, ui: &mut Ui, shown: Option<&RunMoment>, trouble: Option<&Trouble>) {
        let (frame, screen) = (frame_of(&self.settings), ui.max_rect().size());
        let narrow = screen.x < NARROW;
        let menu = narrow || !panels::tools_fit(ui, screen.y);
        Panel::top("top")
            .frame(frame)
            .show_separator_line(false)
            .show(ui, |ui| self.top(ui, (narrow, menu), shown, trouble));
        if !self.aside.is_empty() {
            Panel::top("aside").frame(frame).show_separator_line(false).show(ui, |ui| self.offer(ui));
        }
        self.playback(ui, shown);
        let film = shown.is_some_and(|shown| shown.reel.is_some());
        self.arrangement.fit(&mut self.settings.panels, screen.x);
        if !film && !menu {
            self.toolbar(ui);
        }
        // the first ones are at the edge
        use PanelKind::{Gallery, Look, Plots, Summary, Text, Tuning};
        let all = [Gallery, Text, Tuning, Look, Summary, Plots];
        for kind in all.into_iter().filter(|kind| ![Tuning, Look].contains(kind) || !film) {
            if !*kind.open(&mut self.settings.panels) {
                continue;
            }
            let panel = if narrow {
                let height = panels::sheet(screen.y, ui.available_height());
                Panel::bottom("sheet").exact_size(height)
            } else {
                let room = panels::room(screen.x).min(ui.available_width() - 0.25 * screen.x);
                let panel = if kind == Gallery { Panel::left(kind.label()) } else { Panel::right(kind.label()) };
                let width = kind.width().min(room);
                panel.default_size(width).size_range(width.min(220.0)..=room.max(width))
            };
            panel.frame(frame).show_separator_line(narrow).show(ui, |ui| self.panel(ui, kind, shown, trouble));
        }
    }

    /// Shows the tools beside the view.
    pub(super) fn toolbar(&mut self, ui: &mut Ui) {
        let plain = Frame::new().fill(frame_of(&self.settings).fill).inner_margin(Margin::symmetric(6, 8));
        let width = panels::tools_width(ui, ui.available_height() - 16.0);
        let panel = Panel::left("tools").frame(plain).show_separator_line(false).resizable(false);
        panel.exact_size(width + 12.0).show(ui, |ui| panels::tools(ui, &mut self.director));
    }

    /// Shows the bar below the view.
    pub(super) fn playback(&mut self, ui: &mut Ui, shown: Option<&RunMoment>) {
        let Some(shown) = shown else { return };
        let keys = self.camera_keys(shown);
        let panel = Panel::bottom("bar").frame(frame_of(&self.settings)).show_separator_line(false);
        let asked = panel.show(ui, |ui| {
            panels::bar(ui, shown, &mut self.settings, &mut self.views[0], &mut self.timeline, keys.as_deref())
        });
        let Asked { commands, camera } = asked.inner;
        for command in commands {
            match command {
                Command::Restart => self.restart(Some(shown)),
                command => self.player.command(command),
            }
        }
        camera.into_iter().for_each(|request| self.film(request, shown));
    }

    /// Shows the content of a panel.
    fn panel(&mut self, ui: &mut Ui, kind: PanelKind, shown: Option<&RunMoment>, trouble: Option<&Trouble>) {
        match kind {
            PanelKind::Gallery => {
                let about = self.document.scene().map(|scene| scene.about.clone()).unwrap_or_default();
                if let Some(name) = self.gallery.ui(ui, self.document.plugins(), &self.document.name, &about) {
                    self.leave(Leaving::Open(name));
                }
            }
            PanelKind::Text => match panels::text(ui, &mut self.document, &mut self.settings.restarts, trouble) {
                Some(TextRequest::Apply) => self.change(),
                Some(TextRequest::Save) => self.save(),
                Some(TextRequest::Restarts) => self.player.command(Command::Restarts(self.settings.restarts)),
                None => {}
            },
            PanelKind::Tuning => {
                let tuned = self.tuning.ui(ui, &mut self.document);
                self.tuned(tuned);
            }
            PanelKind::Look => {
                if self.settings.dark {
                    ui.label(
                        RichText::new("Colours of the ground are for light pictures. The view is dark now (D).").weak(),
                    );
                }
                let scene = self.document.scene().ok().filter(|_| !cfg!(target_arch = "wasm32"));
                let asked = scene.and_then(|scene| panels::stage_set(ui, scene));
                asked.into_iter().for_each(|asked| self.stage(asked));
                let tuned = self.look_panel.ui(ui, &mut self.document);
                self.tuned(tuned);
            }
            PanelKind::Summary => {
                let scroll = ScrollArea::vertical().auto_shrink(false);
                shown.into_iter().for_each(|shown| _ = scroll.clone().show(ui, |ui| panels::summary(ui, shown)));
            }
            PanelKind::Plots => {
                let asked = shown.and_then(|shown| panels::plots(ui, shown, &mut self.meters));
                asked.into_iter().for_each(|command| self.player.command(command));
            }
        }
    }

    /// Lets the run follow the sliders.
    pub(super) fn tuned(&mut self, tuned: Option<Tuned>) {
        match tuned {
            Some(Tuned::Changed) => self.change(),
            Some(Tuned::Dragged(scene)) => {
                self.player.command(Command::Change { name: self.document.name.clone(), scene });
            }
            None => {}
        }
    }

    fn top(&mut self, ui: &mut Ui, (narrow, menu): (bool, bool), shown: Option<&RunMoment>, trouble: Option<&Trouble>) {
        let film = shown.is_some_and(|shown| shown.reel.is_some());
        let all: Vec<Control> =
            Control::ALL.into_iter().filter(|control| control.is_shown(narrow, menu, film)).collect();
        let message = self.saying(trouble).is_some();
        let mut told = false;
        let app = std::cell::RefCell::new(&mut *self);
        let show = |ui: &mut Ui, control| app.borrow_mut().control(ui, control, shown);
        panels::row(ui, "top", &all, show, |ui| {
            if message && ui.available_width() > MESSAGE {
                told = true;
                app.borrow_mut().said(ui, trouble);
            } else if let Some(shown) = shown.filter(|_| !message && ui.available_width() > TITLE) {
                ui.add(Label::new(RichText::new(&shown.setting.title).strong()).truncate());
            }
        });
        if message && !told {
            let at = ui.max_rect().center_bottom() + vec2(0.0, 14.0);
            let frame = floating_frame(&self.settings, ui);
            let area = Area::new(Id::unique("said")).pivot(Align2::CENTER_TOP).fixed_pos(at);
            area.show(ui.ctx(), |ui| {
                ui.set_max_width(ui.ctx().content_rect().width() - 2.0 * FROM_EDGE);
                frame.show(ui, |ui| self.said(ui, trouble))
            });
        }
    }

    /// Shows a control of the top bar.
    pub(super) fn control(&mut self, ui: &mut Ui, control: Control, shown: Option<&RunMoment>) {
        let mut action = |ui: &mut Ui, label: &str, says: &str, action: Action| {
            if ui.button(label).on_hover_text(says).clicked() {
                self.actions.push(action);
            }
        };
        match control {
            Control::Name => {
                let name = Button::new(RichText::new("throng").heading()).frame(false);
                if ui.add(name).on_hover_text(START).clicked() {
                    self.turn_to(Face::Start);
                }
            }
            Control::Line => _ = ui.separator(),
            Control::Panel(kind) => {
                let open = kind.open(&mut self.settings.panels);
                ui.toggle_value(open, kind.label()).on_hover_text(kind.says());
            }
            Control::Why => {
                let open = &mut self.settings.panels.why;
                ui.toggle_value(open, "Why").on_hover_text("why the selected agent moves as it does (W)");
            }
            Control::Edit => panels::tool_menu(ui, &mut self.director),
            Control::Layers => panels::layers(ui, &mut self.settings, shown.map(|shown| &*shown.setting)),
            Control::Beside => {
                if panels::beside_by(ui, &self.document.plugins().models, &mut self.settings.beside) {
                    self.put_beside();
                }
            }
            Control::New => action(ui, "New", "an empty scene (Ctrl N)", Action::New),
            Control::Open => action(ui, "Open…", OPEN, Action::Open),
            Control::SaveAs => {
                action(ui, "Save as…", "the scene as a file with another name (Ctrl Shift S)", Action::SaveAs);
            }
            Control::Picture => {
                if ui.button("Picture").on_hover_text("a picture of the view, as a file").clicked() {
                    self.picture(self.place);
                }
            }
            Control::Record => {
                let record = match &self.recording {
                    Some((recording, _)) => format!("Recording {:.0} %", 100.0 * recording.share()),
                    None => "Export".into(),
                };
                if ui.button(record).on_hover_text(EXPORT).clicked() {
                    self.record.toggle();
                }
            }
            Control::Share => {
                if ui.button("Share").on_hover_text("an address that opens exactly this view").clicked() {
                    self.share(shown);
                }
            }
            Control::Topics => {
                if ui.button("Topics").on_hover_text(START).clicked() {
                    self.turn_to(Face::Start);
                }
            }
            Control::Help => _ = ui.toggle_value(&mut self.help, "?").on_hover_text("keys and mouse (?)"),
        }
    }
}
