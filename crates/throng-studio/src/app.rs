//! The application: the panels, the views and the state of the studio.

mod beside;
mod directing;
mod faces;
mod filming;
mod intervening;
mod keeping;
mod layout;
mod naming;
mod pen;
mod recording;
mod sharing;
mod teaching;
mod telling;

use crate::Options;
use crate::direct::{Director, Tool};
use crate::document::Document;
use crate::face::Face;
use crate::intervene::Intervener;
use crate::keep::{Draft, Leaving, Unfinished, remember, remembered};
use crate::keys::{self, Action};
use crate::lesson::Teaching;
use crate::opened::Opened;
use crate::outside::{Asks, Files};
use crate::panels::{self, Arrangement, CameraRequest, ExplanationWindow, Gallery, Meters, Timeline, Tuning};
use crate::play::{Command, Player, RunMoment, Speed};
use crate::record::Recording;
use crate::settings::Settings;
use crate::style;
use crate::view::ViewOptions;
use eframe::egui::{self, CentralPanel, Context, Frame, Margin, Rect, Ui};
use pen::Pen;
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
    /// What is around the views.
    face: Face,
    gallery: Gallery,
    why: ExplanationWindow,
    tuning: Tuning,
    /// The sliders that the scene names.
    trying: Tuning,
    /// The pointer of the keyboard.
    pen: Pen,
    /// The look of pictures and films.
    look_panel: Tuning,
    /// Whether all changes of the text are tries on the page of a topic.
    tried: bool,
    director: Director,
    intervener: Intervener,
    /// The lesson under way.
    teaching: Teaching,
    save_as: panels::Naming,
    open: panels::Naming,
    set: panels::Naming,
    meters: Meters,
    timeline: Timeline,
    arrangement: Arrangement,
    record: panels::Record,
    /// The current recording and its file.
    recording: Option<(Recording, PathBuf)>,
    /// The run that stays visible while a trajectory file is read.
    reading: Option<u64>,
    /// The step at which the next run is shown, paused.
    still: Option<u64>,
    /// What the last address asked for, and all new addresses.
    visit: Option<sharing::Visit>,
    addresses: Receiver<String>,
    /// The agent with the requested decision trace.
    explained: Option<u32>,
    /// Whether people are requested.
    people: bool,
    help: bool,
    hints: panels::Hints,
    /// Whether the user is asked about interventions that a restart would forget.
    restarting: bool,
    /// Whether the user is asked to reset the settings.
    resetting: bool,
    /// Actions requested by keys since the last frame.
    actions: Vec<Action>,
    /// What the style of the panels was built for: dark theme, touch screen.
    look: Option<(bool, bool)>,
    /// A message for the user, shown until it is dismissed.
    notice: Option<String>,
    /// A message that is shown up to a time, seconds.
    passing: Option<(String, f64)>,
    /// The unsaved texts of other documents that an earlier session left.
    aside: Vec<Draft>,
    /// Whether the first scene of the session plays, or has an error.
    begun: bool,
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
        // a visitor without a link, or the first start of the window
        let first = options.scene.is_none() && storage.is_some_and(|kept| kept.get_string(eframe::APP_KEY).is_none());
        let usual = if first { Face::Start } else { Face::Studio };
        // after a failure, the text and the gallery are needed
        let mut face = if options.rest { Face::Studio } else { options.face.unwrap_or(usual) };
        let usual = face.scene().unwrap_or(&settings.scene);
        let wanted = options.scene.clone().unwrap_or_else(|| usual.to_owned());
        let (files, plugins) = (Files::default(), Arc::new(options.plugins.clone()));
        let (document, notice, aside) = keeping::begin(storage, (&wanted, options.scene.is_some()), &files, &plugins)?;
        if face.scene().is_some() && notice.is_some() {
            face = Face::Studio;
        }
        // a restored draft takes precedence over a trajectory file
        if notice.is_some() || !files.is_film(&wanted) {
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
            face: Face::default(),
            gallery: Gallery::default(),
            why: ExplanationWindow::default(),
            tuning: Tuning::default(),
            trying: Tuning::brief(),
            pen: Pen::default(),
            look_panel: Tuning::look(),
            tried: false,
            director: Director::default(),
            intervener: Intervener::default(),
            teaching: Teaching::default(),
            save_as: panels::Naming::new("Save as", "Save", "name.toml", Asks::Save),
            open: panels::Naming::new("Open", "Open", "a scene (.toml) or trajectories (.rec, .csv, ..)", Asks::Open),
            set: panels::Naming::new(
                "A set to look at",
                "Take",
                "a .glb file, or a .gltf file with everything in it",
                Asks::Set,
            ),
            meters: Meters::default(),
            timeline: Timeline::default(),
            arrangement: Arrangement::default(),
            record: panels::Record::default(),
            recording: None,
            reading: None,
            still: options.at_step,
            visit: None,
            addresses: crate::outside::addresses(ctx),
            explained: None,
            people: false,
            hints: panels::Hints::default(),
            help: false,
            restarting: false,
            resetting: false,
            actions: Vec::new(),
            look: None,
            notice,
            passing: None,
            leaving: None,
            aside,
            begun: false,
            after_recording: None,
            news: channel(),
            place: Rect::NOTHING,
            ctx: ctx.clone(),
            told: String::new(),
            options,
        };
        app.turn_to(face);
        let first = app.options.first_view();
        app.views.iter_mut().for_each(|view| view.at_first = first.clone());
        app.player.command(Command::Speed(app.settings.speed));
        app.player.command(Command::Restarts(app.settings.restarts));
        app.put_beside();
        if app.options.rest {
            app.rest();
            return Ok(app);
        }
        app.begin(!app.options.paused);
        Ok(app)
    }

    /// Plays the opened item: a trajectory file, or the scene of the text.
    fn begin(&mut self, run: bool) {
        let still = self.still.take();
        let run = run && still.is_none();
        if let Some(film) = self.files.film(&self.settings.scene, &self.document) {
            self.director.take(Tool::Hand);
            self.reading = Some(self.player.shown().map_or(0, |shown| shown.run));
            self.player.command(Command::Replay { film, run });
        } else {
            self.play(run);
        }
        still.into_iter().for_each(|step| self.player.command(Command::Seek(step)));
    }

    /// Plays the scene of the text. Where it cannot be played, the previous scene stays; without one, or if the text is
    /// invalid, the saved scene plays.
    fn play(&mut self, run: bool) {
        let said = self.document.scene().ok().cloned();
        let none = self.player.shown().is_none() && self.document.changed();
        let saved = if none || said.is_none() { self.document.saved_scene() } else { None };
        for scene in saved.into_iter().chain(said) {
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
            Action::Restart => self.restart(shown),
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
            Action::KeyCamera => shown.into_iter().for_each(|shown| self.film(CameraRequest::Key, shown)),
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

    /// Resets the settings, except for what was opened.
    fn reset(&mut self) {
        let (scene, recent) = (self.settings.scene.clone(), self.settings.recent.clone());
        self.settings = Settings { scene, recent, ..Settings::default() };
        self.opened = Opened::new(&[]);
        self.set_speed(self.settings.speed);
        self.put_beside();
    }
}

/// Returns the frame of the panels.
fn frame_of(settings: &Settings) -> Frame {
    Frame::new().fill(style::color(style::panel(&settings.theme()))).inner_margin(Margin::symmetric(12, 8))
}

/// Returns the frame of what stands over the view.
fn floating_frame(settings: &Settings, ui: &Ui) -> Frame {
    frame_of(settings).corner_radius(6).stroke(ui.visuals().window_stroke)
}

impl eframe::App for App {
    fn raw_input_hook(&mut self, ctx: &Context, raw: &mut egui::RawInput) {
        if self.leaving.is_some() {
            return;
        }
        if self.pen.take(&mut raw.events, self.director.tool, self.place, ctx) && !self.face.has_keys() {
            self.actions.push(Action::Leave);
        }
        if !self.face.has_keys() {
            return;
        }
        // a gesture takes digits as its size
        let writing = ctx.egui_wants_keyboard_input() || self.director.takes_numbers();
        let actions = keys::take(&mut raw.events, writing);
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
        self.explain_first_error(shown.is_some(), trouble.as_ref());
        if let Some(says) = self.news.1.try_iter().last() {
            self.pass(says);
        }
        self.receive(&ctx);
        if let Some(address) = self.addresses.try_iter().last() {
            self.visit(&address, run);
        }
        self.arrive(run);
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
        self.around(ui, shown.as_deref(), trouble.as_ref());
        CentralPanel::default().frame(Frame::NONE).show(ui, |ui| {
            if let Some(shown) = &shown {
                self.views(ui, shown);
            } else {
                self.nothing(ui, trouble.as_ref());
            }
            self.over(ui, shown.as_deref());
        });
        self.pen.draw(&ctx, style::color(self.settings.theme().goal));
        self.resetting |= panels::help(&ctx, &mut self.help);
        if panels::resetting(&ctx, &mut self.resetting) {
            self.reset();
        }
        self.ask_name(&ctx);
        self.ask_restart(&ctx, shown.as_deref());
        self.explain();
        self.ask_people(shown.as_deref());
        if let Some(shown) = &shown {
            self.show_why(&ctx, shown);
            self.record(&ctx, shown);
            self.tell(shown, trouble.as_ref());
            self.outside.screenshot(&ctx, &self.options, shown);
        }
    }

    fn save(&mut self, storage: &mut dyn eframe::Storage) {
        remember(storage, eframe::APP_KEY, &self.opened.own(&self.settings));
        remember(storage, Draft::KEY, &Draft::of(&self.document));
        remember(storage, Draft::ASIDE, &self.aside);
    }

    fn auto_save_interval(&self) -> std::time::Duration {
        keeping::AUTOSAVE
    }

    fn on_exit(&mut self, gl: Option<&eframe::glow::Context>) {
        gl.into_iter().for_each(|gl| self.views.iter_mut().for_each(|view| view.destroy(gl)));
    }
}
