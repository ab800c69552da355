//! The file dialogs of the system.

use super::Asks;
use eframe::egui::Context;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::time::{Duration, Instant};
use throng_record::formats::FORMATS;
use throng_scene::import::plan;

/// A dialog that ends sooner without a file has probably never appeared.
const SOON: Duration = Duration::from_millis(500);

/// An open dialog.
#[derive(Debug)]
pub struct Dialog {
    answer: Receiver<PathBuf>,
    begun: Instant,
}

/// Returns the name and the endings of the files that are asked for.
fn kinds(asks: Asks) -> (&'static str, Vec<&'static str>) {
    if asks == Asks::Set {
        return ("sets", vec!["glb", "gltf"]);
    }
    let films = FORMATS.iter().filter(|format| format.is_read()).map(|format| format.ending);
    ("scenes, trajectories and floor plans", ["toml"].into_iter().chain(films).chain(plan::ENDINGS).collect())
}

impl Dialog {
    /// Whether there are dialogs.
    pub const EXISTS: bool = true;

    /// Opens a dialog in the folder of a typed name; `None` if the system starts no thread.
    pub fn open(title: &str, asks: Asks, typed: &str, ctx: &Context) -> Option<Self> {
        let path = std::path::absolute(if typed.is_empty() { "." } else { typed }).unwrap_or_default();
        let folder = if path.is_dir() { Some(&*path) } else { path.parent().filter(|folder| folder.is_dir()) };
        let mut dialog = rfd::AsyncFileDialog::new().set_title(title);
        if let Some(folder) = folder {
            dialog = dialog.set_directory(folder);
        }
        if let Some(name) = Path::new(typed).file_name() {
            dialog = dialog.set_file_name(name.to_string_lossy());
        }
        let (sender, answer) = channel();
        let ctx = ctx.clone();
        let wait = move |file: Option<rfd::FileHandle>| {
            // sending fails only after the studio has closed its own dialog
            let _ = file.map(|file| sender.send(file.path().to_owned()));
            ctx.request_repaint();
        };
        // some systems open dialogs only in the thread of the window, so only the wait is in another one
        let thread = std::thread::Builder::new().name("throng-dialog".into());
        let begun = match asks {
            Asks::Open | Asks::Set => {
                let (name, endings) = kinds(asks);
                let file = dialog.add_filter(name, &endings).add_filter("all files", &["*"]).pick_file();
                thread.spawn(move || wait(pollster::block_on(file)))
            }
            Asks::Save => {
                let file = dialog.save_file();
                thread.spawn(move || wait(pollster::block_on(file)))
            }
        };
        begun.is_ok().then(|| Self { answer, begun: Instant::now() })
    }

    /// Returns the chosen file, or that the dialog has ended without one. `None` while it is open.
    pub fn answer(&self) -> Option<Result<PathBuf, Option<&'static str>>> {
        match self.answer.try_recv() {
            Ok(path) => Some(Ok(path)),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => {
                let says = "no file was chosen. If no dialog appeared, the system has none (xdg-desktop-portal, zenity): type the name";
                Some(Err((self.begun.elapsed() < SOON).then_some(says)))
            }
        }
    }
}
