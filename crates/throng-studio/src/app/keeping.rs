//! Protection of unsaved work: the user is asked before it would be lost.

use super::App;
use crate::document::Document;
use crate::keep::{Answer, Draft, Leaving, Unfinished, remembered};
use crate::outside::Files;
use crate::panels;
use crate::play::Trouble;
use eframe::Storage;
use eframe::egui::{Context, Ui, ViewportCommand};
use std::sync::Arc;
use std::time::Duration;
use throng_scene::Plugins;

/// The interval at which unsaved text is stored.
pub(super) const AUTOSAVE: Duration = Duration::from_secs(3);

/// The first document, a message for the user, and the unsaved texts of other documents.
pub(super) type Beginning = (Document, Option<String>, Vec<Draft>);

/// Returns the first document: the unsaved text of the previous session, or the scene `wanted`. `named` says whether the
/// scene was given at the start: then it is opened, and the unsaved text of another scene is set aside.
pub(super) fn begin(
    storage: Option<&dyn Storage>,
    (wanted, named): (&str, bool),
    files: &Files,
    plugins: &Arc<Plugins>,
) -> Result<Beginning, String> {
    let mut aside: Vec<Draft> = storage.and_then(|storage| remembered(storage, Draft::ASIDE)).unwrap_or_default();
    let draft: Option<Draft> = storage.and_then(|storage| remembered(storage, Draft::KEY)).flatten();
    match draft {
        Some(draft) if named && draft.origin() != wanted => {
            aside.retain(|other| *other != draft);
            aside.push(draft);
        }
        Some(draft) => {
            let document = draft.restore(|scene| files.open(scene, plugins)).with(plugins);
            let notice = format!("restored: the changes of {} that were not saved", document.name);
            return Ok((document, Some(notice), aside));
        }
        None => {}
    }
    match files.open(wanted, plugins) {
        Ok(document) => Ok((document.with(plugins), None, aside)),
        Err(says) => Ok((Document::named("circle", plugins).ok_or("there is no gallery")?, Some(says), aside)),
    }
}

impl App {
    /// Leaves the text. Asks first if the text has unsaved changes or a recording is under way.
    pub(super) fn leave(&mut self, to: Leaving) {
        if self.document.changed() {
            self.leaving = Some((to, Unfinished::Text));
        } else {
            self.leave_recording(to);
        }
    }

    /// Continues once the unsaved text is handled. Reloading the file does not affect a recording.
    fn leave_recording(&mut self, to: Leaving) {
        if self.recording.is_some() && !matches!(to, Leaving::Reload(_)) {
            self.leaving = Some((to, Unfinished::Recording));
        } else {
            self.go(to);
        }
    }

    pub(super) fn go(&mut self, to: Leaving) {
        match to {
            Leaving::Open(scene) => match self.files.open(&scene, self.document.plugins()) {
                Ok(document) => {
                    self.show(document);
                    self.opened_file(scene);
                    self.begin(true);
                }
                Err(says) => self.notice = Some(says),
            },
            Leaving::Step(lesson, step) => self.teach(lesson, step),
            Leaving::Reload(text) => {
                self.document.edit(text);
                self.document.mark_saved();
                self.change();
            }
            Leaving::Restore(draft) => {
                self.aside.retain(|other| *other != draft);
                let plugins = self.document.plugins().clone();
                self.show(draft.restore(|scene| self.files.open(scene, &plugins)));
                self.opened_file(self.document.origin());
                self.begin(true);
            }
            Leaving::New => {
                self.show(Document::empty());
                self.play(false);
            }
            Leaving::Close => self.ctx.send_viewport_cmd(ViewportCommand::Close),
        }
    }

    pub(super) fn show(&mut self, document: Document) {
        let document = document.with(self.document.plugins());
        self.outside = crate::outside::Outside::new(&document);
        self.document = document;
        self.director.cancel();
        self.notice = None;
        self.player.command(self.meters.clear());
    }

    /// Offers the unsaved texts of other documents that an earlier session left.
    pub(super) fn offer(&mut self, ui: &mut Ui) {
        let Some(draft) = self.aside.last().cloned() else { return };
        ui.horizontal(|ui| {
            ui.label(format!("{} has changes of an earlier session that were not saved.", draft.name()));
            if ui.button("Open them").clicked() {
                self.leave(Leaving::Restore(draft));
            } else if ui.button("Discard them").clicked() {
                self.aside.pop();
            }
        });
    }

    /// Opens the text panel if the first scene of the session has an error.
    pub(super) fn explain_first_error(&mut self, found: bool, trouble: Option<&Trouble>) {
        let wrong = self.document.scene().is_err() || matches!(trouble, Some(Trouble::Scene(_)));
        if !self.begun && (found || wrong) {
            self.begun = true;
            self.settings.panels.text |= wrong;
        }
    }

    /// Shows only the text and the gallery. Used after the scene stopped the studio.
    pub(super) fn rest(&mut self) {
        (self.settings.panels.text, self.settings.panels.gallery) = (true, true);
        let name = &self.document.name;
        self.notice = Some(format!(
            "the studio stopped while {name} played: change its text, choose another scene, or press R to play it again"
        ));
    }

    /// Opens dropped and picked files.
    pub(super) fn receive(&mut self, ctx: &Context) {
        let dropped = ctx.input(|input| input.raw.dropped_files.clone());
        if !dropped.is_empty() {
            self.files.folder.take(&dropped, ctx);
        }
        match self.files.folder.came() {
            Some(Ok(name)) => self.leave(Leaving::Open(name)),
            Some(Err(says)) => self.notice = Some(says),
            None => {}
        }
    }

    /// Handles changes of the file and requests to close the window, and shows the question to the user.
    pub(super) fn keep(&mut self, ctx: &Context) {
        if let Some(text) = self.outside.changed(ctx) {
            if text == self.document.text() {
                self.document.mark_saved();
            } else {
                self.leave(Leaving::Reload(text));
            }
        }
        if self.document.changed() {
            // stores the draft even without input events
            ctx.request_repaint_after(AUTOSAVE);
        }
        let unfinished = self.document.changed() || self.recording.is_some();
        if unfinished && ctx.input(|input| input.viewport().close_requested()) {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            self.leave(Leaving::Close);
        }
        if self.recording.is_none() {
            // the recording may be complete meanwhile
            if let Some((to, _)) = self.leaving.take_if(|(_, of)| *of == Unfinished::Recording) {
                self.go(to);
            }
        }
        let answer = self.asks().and_then(|(to, of, name)| panels::leaving(ctx, &name, to, of));
        let Some(((to, of), answer)) = answer.and_then(|answer| Some((self.leaving.take()?, answer))) else { return };
        match of {
            Unfinished::Text => self.left_text(to, answer),
            Unfinished::Recording => self.left_recording(to, answer),
        }
    }

    /// Returns the open question: the action, what is unfinished, and its name.
    pub(super) fn asks(&self) -> Option<(&Leaving, Unfinished, String)> {
        let (to, of) = self.leaving.as_ref()?;
        let recorded = self.recording.as_ref().filter(|_| *of == Unfinished::Recording);
        let name = recorded.map_or_else(|| self.document.name.to_string(), |(_, path)| path.display().to_string());
        Some((to, *of, name))
    }

    fn left_text(&mut self, to: Leaving, answer: Answer) {
        match answer {
            Answer::Keep => return,
            Answer::Save => {
                self.save();
                if self.document.changed() || matches!(to, Leaving::Reload(_)) {
                    return;
                }
            }
            Answer::Discard if to == Leaving::Close => self.document.revert(),
            Answer::Discard | Answer::Beside => {}
        }
        self.leave_recording(to);
    }

    fn left_recording(&mut self, to: Leaving, answer: Answer) {
        match answer {
            Answer::Keep => return,
            Answer::Save => {
                self.finish_recording();
                if to == Leaving::Close {
                    // the studio closes when the file is complete
                    self.after_recording = Some(to);
                    return;
                }
            }
            Answer::Discard => self.recording = None,
            Answer::Beside => {}
        }
        self.go(to);
    }

    /// Remembers what was opened or saved last.
    pub(super) fn opened_file(&mut self, scene: String) {
        if let Some(path) = self.files.folder.path(&scene) {
            self.settings.used(path);
        }
        self.settings.scene = scene;
    }

    /// Writes the text to its file.
    pub(super) fn save(&mut self) {
        match self.outside.save(&mut self.document) {
            Ok(says) => {
                self.opened_file(self.document.origin());
                self.notice = None;
                self.pass(says);
                self.change();
            }
            Err(says) => self.notice = Some(says),
        }
    }
}
