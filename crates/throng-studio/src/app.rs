//! The application: the panels, the views and the state of the studio.

mod beside;
mod directing;
mod keeping;
mod recording;
mod sharing;
mod telling;

use crate::Options;
use crate::direct::{Director, Tool};
use crate::document::Document;
use crate::keep::{Draft, Leaving, Unfinished, remember, remembered};
use crate::keys::{self, Action};
use crate::opened::Opened;
use crate::outside::Files;
use crate::panels::{self, ExplanationWindow, Gallery, Meters, TextRequest, Tuned, Tuning};
use crate::play::{Command, Player, RunMoment, Speed, Trouble};
use crate::record::Recording;
use crate::settings::Settings;
use crate::style;
use crate::view::ViewOptions;
use eframe::egui::{self, CentralPanel, Context, Frame, Margin, Panel, Rect, Ui};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};

/// The studio application.
pub struct App {
    settings: Settings,
    /// The settings that the scene has given.
    opened: Opened,
    options: Options,
    document: Document,
    player: Player,
    /// The main view, and the view of the same scene with another model.
    views: [ViewOptions; 2],
    gallery: Gallery,
    why: ExplanationWindow,
    tuning: Tuning,
    director: Director,
    save_as: panels::Naming,
    open: panels::Naming,
    meters: Meters,
    record: panels::Record,
    /// The current recording and its file.
    recording: Option<(Recording, PathBuf)>,
    /// The run that stays visible while a trajectory file is read.
    reading: Option<u64>,
    /// The agent with the requested decision trace.
    explained: Option<u32>,
    /// Whether people are requested.
    people: bool,
    help: bool,
    /// Actions requested by keys since the last frame.
    actions: Vec<Action>,
    /// What the style of the panels was built for: dark theme, touch screen.
    look: Option<(bool, bool)>,
    /// A message for the user, shown until it is dismissed.
    notice: Option<String>,
    /// An action that would lose unsaved text or a recording, and waits for the user's answer.
    leaving: Option<(Leaving, Unfinished)>,
    /// An action that waits until the recording is complete.
    after_recording: Option<Leaving>,
    /// Messages from background work.
    news: (Sender<String>, Receiver<String>),
    /// The rectangle of the main view.
    place: Rect,
    ctx: Context,
    /// The last published state, as JSON.
    told: String,
    files: Files,
    outside: crate::outside::Outside,
}

impl App {
    /// Creates the studio with its remembered settings and starts the first scene.
    pub fn new(ctx: &Context, storage: Option<&dyn eframe::Storage>, options: Options) -> Result<Self, String> {
        let mut settings: Settings =
            storage.and_then(|storage| remembered(storage, eframe::APP_KEY)).unwrap_or_default();
        options.adjust(&mut settings)?;
        let wanted = options.scene.clone().unwrap_or_else(|| settings.scene.clone());
        let (files, plugins) = (Files::default(), Arc::new(options.plugins.clone()));
        let (document, notice, leaving) =
            keeping::begin(storage, (&wanted, options.scene.is_some()), &files, &plugins)?;
        // a restored draft takes precedence over a trajectory file
        if notice.is_some() || leaving.is_some() || !files.is_film(&wanted) {
            settings.scene = document.origin();
        } else {
            settings.scene = wanted;
        }
        let mut app = Self {
            player: crate::outside::player(ctx)?,
            outside: crate::outside::Outside::new(&document),
            files,
            settings,
            opened: Opened::new(&options.with),
            document,
            views: Default::default(),
            gallery: Gallery::default(),
            why: ExplanationWindow::default(),
            tuning: Tuning::default(),
            director: Director::default(),
            save_as: panels::Naming::new("Save as", "Save", "name.toml"),
            open: panels::Naming::new("Open", "Open", "a scene (.toml) or trajectories (.rec, .csv, ..)"),
            meters: Meters::default(),
            record: panels::Record::default(),
            recording: None,
            reading: None,
            explained: None,
            people: false,
            help: false,
            actions: Vec::new(),
            look: None,
            notice,
            leaving: leaving.map(|to| (to, Unfinished::Text)),
            after_recording: None,
            news: channel(),
            place: Rect::NOTHING,
            ctx: ctx.clone(),
            told: String::new(),
            options,
        };
        app.views[0].at_first = (app.options.select, app.options.camera);
        let still = app.options.at_step;
        app.player.command(Command::Speed(app.settings.speed));
        app.put_beside();
        if app.options.rest {
            app.rest();
            return Ok(app);
        }
        app.begin(still.is_none());
        if let Some(step) = still {
            app.player.command(Command::Seek(step));
        }
        Ok(app)
    }

    /// Plays the opened item: a trajectory file, or the scene of the text.
    fn begin(&mut self, run: bool) {
        if let Some(film) = self.files.film(&self.settings.scene, &self.document) {
            self.director.take(Tool::Hand);
            self.reading = Some(self.player.shown().map_or(0, |shown| shown.run));
            self.player.command(Command::Replay { film, run });
        } else {
            self.play(run);
        }
    }

    /// Plays the scene of the text. If the text is invalid, plays the saved scene.
    fn play(&mut self, run: bool) {
        let said = self.document.scene().ok().cloned();
        if let Some(scene) = said.or_else(|| self.document.saved_scene()) {
            let name = self.document.name.clone();
            self.player.command(Command::Load { name, scene, run });
        }
    }

    /// Applies the text to the running scene. If only groups changed, the run continues from the current state.
    fn change(&mut self) {
        if let Ok(scene) = self.document.scene() {
            let (name, scene) = (self.document.name.clone(), scene.clone());
            self.player.command(Command::Change { name, scene });
        }
    }

    fn act(&mut self, action: Action, shown: Option<&RunMoment>) {
        let panels = &mut self.settings.panels;
        match action {
            // after a failure, nothing plays until the user starts it
            Action::Play | Action::Restart if shown.is_none() => self.begin(true),
            Action::Play if shown.is_some_and(|shown| shown.playing) => self.player.command(Command::Pause),
            Action::Play => self.player.command(Command::Run),
            Action::Step => self.player.command(Command::Step),
            Action::Back => self.player.command(Command::Back),
            Action::Restart => self.player.command(Command::Restart),
            Action::NextScene | Action::PreviousScene => {
                let by = if action == Action::NextScene { 1 } else { -1 };
                if let Some(name) = panels::beside(self.document.plugins(), &self.document.name, by) {
                    self.leave(Leaving::Open(name));
                }
            }
            Action::NextAgent => shown.into_iter().for_each(|shown| self.views[0].select_next(shown)),
            Action::NextCamera => self.views[0].eye.set_mode(self.views[0].eye.mode().next()),
            Action::NextSpeed => self.set_speed(self.settings.speed.next()),
            Action::Annotations => self.settings.annotations = !self.settings.annotations,
            Action::Trails => self.settings.trails = if self.settings.trails > 0.0 { 0.0 } else { 1.5 },
            Action::Fit => self.views[0].refit(),
            Action::Dark => self.settings.dark = !self.settings.dark,
            Action::Gallery => panels.gallery = !panels.gallery,
            Action::Text => panels.text = !panels.text,
            Action::Tuning => panels.tuning = !panels.tuning,
            Action::Summary => panels.summary = !panels.summary,
            Action::Plots => panels.plots = !panels.plots,
            Action::Why => panels.why = !panels.why,
            Action::Help => self.help = !self.help,
            Action::Leave if self.director.cancel() => {}
            Action::Leave => {
                (self.help, self.views[0].selected) = (false, None);
                self.director.take(Tool::Hand);
                self.meters.take_up(None);
            }
            // a replay cannot be edited
            Action::Take(_) | Action::Remove if shown.is_some_and(|shown| shown.reel.is_some()) => {}
            Action::Take(tool) => self.director.take(tool),
            Action::Remove => self.remove(shown),
            Action::More => self.more(1, shown),
            Action::Fewer => self.more(-1, shown),
            Action::New => self.leave(Leaving::New),
            Action::Open if self.files.folder.pick(&self.ctx) => {}
            Action::Open => self.open.open(""),
            Action::SaveAs => self.save_as.open(&format!("{}.toml", self.document.name)),
            Action::Save => self.save(),
            Action::Undo | Action::Redo => {
                let changed = if action == Action::Undo { self.document.undo() } else { self.document.redo() };
                self.director.cancel();
                if changed {
                    self.change();
                }
            }
        }
    }

    fn set_speed(&mut self, speed: Speed) {
        self.settings.speed = speed;
        self.player.command(Command::Speed(speed));
    }

    fn panels(&mut self, ui: &mut Ui, shown: Option<&RunMoment>, trouble: Option<&Trouble>) {
        let frame = frame_of(&self.settings);
        Panel::top("top").frame(frame).show_separator_line(false).show(ui, |ui| self.top(ui, shown, trouble));
        if let Some(shown) = shown {
            Panel::bottom("bar").frame(frame).show_separator_line(false).show(ui, |ui| {
                let asked = panels::bar(ui, shown, &mut self.settings, &mut self.views[0]);
                asked.into_iter().for_each(|command| self.player.command(command));
            });
        }
        let plain = Frame::new().fill(frame.fill).inner_margin(Margin::symmetric(6, 8));
        let film = shown.is_some_and(|shown| shown.reel.is_some());
        if !film {
            let panel = Panel::left("tools").frame(plain).show_separator_line(false).resizable(false);
            panel.exact_size(40.0).show(ui, |ui| panels::tools(ui, &mut self.director));
        }
        if self.settings.panels.gallery {
            Panel::left("gallery").frame(frame).show_separator_line(false).min_size(234.0).default_size(242.0).show(
                ui,
                |ui| {
                    let about = self
                        .document
                        .scene()
                        .map_or_else(|_| throng_scene::About::default(), |scene| scene.about.clone());
                    if let Some(name) = self.gallery.ui(ui, self.document.plugins(), &self.document.name, &about) {
                        self.leave(Leaving::Open(name));
                    }
                },
            );
        }
        if self.settings.panels.text {
            Panel::right("text").frame(frame).show_separator_line(false).default_size(440.0).show(ui, |ui| {
                match panels::text(ui, &mut self.document, trouble) {
                    Some(TextRequest::Apply) => self.change(),
                    Some(TextRequest::Save) => self.save(),
                    None => {}
                }
            });
        }
        if self.settings.panels.tuning && !film {
            Panel::right("tuning").frame(frame).show_separator_line(false).default_size(330.0).show(
                ui,
                |ui| match self.tuning.ui(ui, &mut self.document) {
                    Some(Tuned::Changed) => self.change(),
                    Some(Tuned::Dragged(scene)) => {
                        self.player.command(Command::Change { name: self.document.name.clone(), scene });
                    }
                    None => {}
                },
            );
        }
        if let Some(shown) = shown.filter(|_| self.settings.panels.summary) {
            Panel::right("summary")
                .frame(frame)
                .show_separator_line(false)
                .default_size(230.0)
                .show(ui, |ui| panels::summary(ui, shown));
        }
        if let Some(shown) = shown.filter(|_| self.settings.panels.plots) {
            let panel = Panel::right("plots").frame(frame).show_separator_line(false).default_size(320.0);
            let asked = panel.show(ui, |ui| panels::plots(ui, shown, &mut self.meters)).inner;
            asked.into_iter().for_each(|command| self.player.command(command));
        }
    }

    fn top(&mut self, ui: &mut Ui, shown: Option<&RunMoment>, trouble: Option<&Trouble>) {
        ui.horizontal(|ui| {
            ui.label(egui::RichText::new("throng").heading());
            ui.separator();
            let panels = &mut self.settings.panels;
            ui.toggle_value(&mut panels.gallery, "Gallery");
            ui.toggle_value(&mut panels.text, "Text");
            ui.toggle_value(&mut panels.tuning, "Tune").on_hover_text("sliders for the parameters of the groups (U)");
            ui.toggle_value(&mut panels.summary, "Summary");
            ui.toggle_value(&mut panels.plots, "Plots").on_hover_text("figures against time; meters (H)");
            ui.toggle_value(&mut panels.why, "Why").on_hover_text("why the selected agent moves as it does (W)");
            ui.separator();
            if ui.button("New").on_hover_text("an empty scene (Ctrl N)").clicked() {
                self.actions.push(Action::New);
            }
            if ui
                .button("Open…")
                .on_hover_text(
                    "a scene file, a floor plan, another program's scene, or trajectories to replay (Ctrl O)",
                )
                .clicked()
            {
                self.actions.push(Action::Open);
            }
            if ui.button("Save as…").clicked() {
                self.actions.push(Action::SaveAs);
            }
            ui.separator();
            panels::layers(ui, &mut self.settings, shown.map(|shown| &*shown.setting));
            if panels::beside_by(ui, &self.document.plugins().models, &mut self.settings.beside) {
                self.put_beside();
            }
            ui.toggle_value(&mut self.help, "?");
            if ui.button("Picture").on_hover_text("a picture of the view, as a file").clicked() {
                self.picture(self.place);
            }
            let record = match &self.recording {
                Some((recording, _)) => format!("Recording {:.0} %", 100.0 * recording.share()),
                None => "Record".into(),
            };
            if ui.button(record).on_hover_text("a film or a table of this scene, as a file").clicked() {
                self.record.toggle();
            }
            if cfg!(target_arch = "wasm32")
                && ui.button("Share").on_hover_text("an address that opens this scene as it is now").clicked()
            {
                self.share();
            }
            ui.separator();
            if let Some(shown) = shown {
                ui.label(egui::RichText::new(&shown.setting.title).strong());
            }
            self.said(ui, trouble);
        });
    }
}

/// Returns the frame of the panels.
fn frame_of(settings: &Settings) -> Frame {
    Frame::new().fill(style::color(style::panel(&settings.theme()))).inner_margin(Margin::symmetric(12, 8))
}

impl eframe::App for App {
    fn raw_input_hook(&mut self, ctx: &Context, raw: &mut egui::RawInput) {
        if self.leaving.is_some() {
            return;
        }
        let actions = keys::take(&mut raw.events, ctx.egui_wants_keyboard_input());
        self.actions.extend(actions);
    }

    fn ui(&mut self, ui: &mut Ui, _: &mut eframe::Frame) {
        let ctx = ui.ctx().clone();
        let (dark, touch) = (self.settings.dark, ctx.input(egui::InputState::has_touch_screen));
        if self.look != Some((dark, touch)) {
            style::apply(&ctx, &self.settings.theme(), dark, touch);
            self.look = Some((dark, touch));
        }
        crate::outside::work(&mut self.player, &ctx);
        self.keep(&ctx);
        let (shown, trouble): (Option<Arc<RunMoment>>, _) = (self.player.shown(), self.player.trouble());
        let run = shown.as_ref().map_or(0, |shown| shown.run);
        self.reading = self.reading.filter(|before| *before == run && trouble.is_none());
        self.notice = self.news.1.try_iter().last().or(self.notice.take());
        self.receive(&ctx);
        if !self.actions.is_empty() {
            // a web page has no thread that wakes it, so request the frame that shows the result
            ctx.request_repaint();
        }
        if let Some(shown) = &shown {
            self.opened.open(&shown.name, &shown.scene, &mut self.settings);
        }
        for action in std::mem::take(&mut self.actions) {
            self.act(action, shown.as_deref());
        }
        self.panels(ui, shown.as_deref(), trouble.as_ref());
        CentralPanel::default().frame(Frame::NONE).show(ui, |ui| {
            if let Some(shown) = &shown {
                self.views(ui, shown);
            } else {
                ui.painter().rect_filled(ui.max_rect(), 0.0, ui.visuals().panel_fill);
            }
        });
        panels::help(&ctx, &mut self.help);
        self.ask_name(&ctx);
        self.explain();
        self.ask_people();
        if let Some(shown) = &shown {
            let mut open = self.settings.panels.why;
            self.why.ui(&ctx, &mut open, shown, &self.settings, &self.options.typeface);
            self.settings.panels.why = open;
            self.record(&ctx, shown);
            self.tell(shown, trouble.as_ref());
            self.outside.screenshot(&ctx, &self.options, shown);
        }
    }

    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        remember(storage, eframe::APP_KEY, &self.opened.own(&self.settings));
        remember(storage, Draft::KEY, &Draft::of(&self.document));
    }

    fn auto_save_interval(&self) -> std::time::Duration {
        keeping::AUTOSAVE
    }

    fn on_exit(&mut self, gl: Option<&eframe::glow::Context>) {
        gl.into_iter().for_each(|gl| self.views.iter_mut().for_each(|view| view.destroy(gl)));
    }
}
