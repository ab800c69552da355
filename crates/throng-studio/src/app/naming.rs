//! Names of files that the user gives: to open, to save, and of the set.

use super::App;
use crate::keep::Leaving;
use crate::panels::{Named, Offered, SetRequest};
use eframe::egui::Context;
use std::path::{Path, PathBuf};
use throng_record::moment;

/// The key of the file of the set.
const SET: &str = "view.set.file";

impl App {
    /// Shows the windows that ask for a name, and handles their answers.
    pub(super) fn ask_name(&mut self, ctx: &Context) {
        let asking = [&self.open, &self.save_as, &self.set].into_iter().find_map(|naming| naming.name.as_ref());
        let Some(typed) = asking else { return };
        let (folder, names) = self.files.folder.list(typed);
        let offered = Offered { folder, names, recent: self.settings.recent.clone() };
        if let Some(Named { name, .. }) = self.open.ui(ctx, &offered) {
            let opened = self.files.open(&name, self.document.plugins()).map(|_| ());
            let good = opened.is_ok();
            self.open.answer(opened);
            if good {
                self.leave(Leaving::Open(name));
            }
        }
        if let Some(Named { name, replaces }) = self.save_as.ui(ctx, &offered) {
            let saved = self.outside.save_as(&mut self.document, &name, replaces);
            let saved = saved.map(|says| {
                self.opened_file(self.document.origin());
                self.pass(says);
            });
            self.save_as.answer(saved);
        }
        if let Some(Named { name, .. }) = self.set.ui(ctx, &offered) {
            let taken = self.take_set(Path::new(&name));
            self.set.answer(taken);
        }
    }

    /// Returns the title of the window that asks for a name, if one is open.
    pub(super) fn naming(&self) -> Option<String> {
        let open = [&self.open, &self.save_as, &self.set].into_iter().find(|naming| naming.name.is_some());
        open.map(|naming| naming.title().to_owned())
    }

    /// Asks for a set, or leaves it out.
    pub(super) fn stage(&mut self, asked: SetRequest) {
        match asked {
            SetRequest::Choose => {
                let known = self.document.scene().ok().and_then(|scene| scene.view.set.as_ref());
                let folder = self.document.path.as_deref().and_then(Path::parent).unwrap_or(Path::new(""));
                let file = known.map_or_else(String::new, |set| folder.join(&set.file).display().to_string());
                self.set.open(&file);
            }
            SetRequest::Remove => match self.document.change(|edit| edit.remove("view.set").map(drop)) {
                Ok(()) => self.change(),
                Err(says) => self.notice = Some(says),
            },
        }
    }

    /// Writes the name of a set into the text, relative to the folder of the scene where that is possible.
    ///
    /// # Errors
    /// The file is no set.
    fn take_set(&mut self, file: &Path) -> Result<(), String> {
        let folder = self.document.path.as_deref().and_then(Path::parent).map(std::path::absolute);
        let path = std::path::absolute(file).map_err(|error| error.to_string())?;
        let within = folder.and_then(Result::ok).and_then(|folder| path.strip_prefix(folder).ok().map(PathBuf::from));
        let name = within.unwrap_or(path).display().to_string();
        let scene = self.document.tried(|edit| edit.set(SET, name.clone()))?;
        moment::set(&scene, glam::DVec2::ZERO).map_err(|error| error.to_string())?;
        self.document.change(|edit| edit.set(SET, name))?;
        self.change();
        Ok(())
    }
}
