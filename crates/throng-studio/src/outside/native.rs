//! The platform of the window.

use super::files::chosen;
use crate::Options;
use crate::document::{Document, Watched};
use crate::play::{Player, RunMoment, ThreadedEngine};
use crate::record::{Recording, Subject, Take};
use eframe::egui::{Context, DroppedFileHandle, ViewportCommand};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};
use throng_draw::record::{Plan, Recorder};
use throng_record::{Output, Trajectories};
use throng_scene::Imported;

/// The file system.
#[derive(Default)]
pub struct Folder {
    /// The file dropped on the window.
    dropped: Option<String>,
    /// The folder that was listed last, its names, and when.
    listed: Option<(PathBuf, Vec<String>, Instant)>,
}

/// The time after which a folder is listed again.
const LISTED: Duration = Duration::from_secs(2);
/// The most names of a list.
const NAMES: usize = 500;

impl Folder {
    /// Whether the file exists.
    pub fn holds(&self, file: &Path) -> bool {
        file.is_file()
    }

    /// Returns the text of a file, `None` if the file does not exist.
    pub fn text(&self, file: &Path) -> Option<Result<String, String>> {
        let text =
            || std::fs::read_to_string(file).map_err(|error| format!("{} cannot be read: {error}", file.display()));
        file.exists().then(text)
    }

    /// Returns the document of a file with this text.
    pub fn document(&self, file: &str, text: String) -> Document {
        Document::of_file(Path::new(file), text)
    }

    /// Imports a file of another program as a document without a file. Comments at the top list what was left out.
    /// Returns `None` for a scene file or a missing file.
    pub fn import(&self, file: &Path) -> Option<Result<Document, String>> {
        if !file.exists() || file.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml")) {
            return None;
        }
        let name = file.file_stem().map_or_else(|| "scene".into(), |stem| stem.to_string_lossy().into_owned());
        let text = |imported: Imported| {
            let notes: String = imported.notes.iter().map(|note| format!("# {note}\n")).collect();
            imported.scene.to_toml().map(|text| notes + &text)
        };
        let document = throng_scene::open(file).and_then(text).map(|text| Document::new(&name, text));
        Some(document.map_err(|error| error.to_string()))
    }

    /// Returns the absolute path of a file, `None` if there is no such file.
    pub fn path(&self, file: &str) -> Option<String> {
        let path = Path::new(file).is_file().then(|| std::path::absolute(file).ok()).flatten()?;
        Some(path.display().to_string())
    }

    /// Returns the folder of a typed name, and its scenes, trajectories and folders.
    pub fn list(&mut self, typed: &str) -> (String, Vec<String>) {
        let parent = typed.rfind(['/', std::path::MAIN_SEPARATOR]).map_or(".", |end| &typed[..=end]);
        let folder = std::path::absolute(parent).unwrap_or_else(|_| parent.into());
        let fresh = |(of, _, at): &(PathBuf, Vec<String>, Instant)| *of == folder && at.elapsed() < LISTED;
        let known = self.listed.take().filter(fresh);
        let (of, names, at) = known.unwrap_or_else(|| (folder.clone(), names(&folder), Instant::now()));
        self.listed = Some((of, names.clone(), at));
        (folder.display().to_string(), names)
    }

    /// Returns `None`: the player reads trajectory files.
    pub fn bytes(&self, _: &str) -> Option<Arc<[u8]>> {
        None
    }

    /// Takes the files dropped on the window.
    pub fn take(&mut self, dropped: &[DroppedFileHandle], _: &Context) {
        let names: Vec<_> = dropped.iter().map(|file| file.path().display().to_string()).collect();
        self.dropped = chosen(&names);
    }

    /// Returns the file to open.
    pub fn came(&mut self) -> Option<Result<String, String>> {
        self.dropped.take().map(Ok)
    }

    /// Returns `false`: the studio asks for a name instead.
    pub fn pick(&self, _: &Context) -> bool {
        false
    }
}

/// The thumbnails of the gallery: the name of the scene, and the PNG file.
const THUMBNAILS: &[(&str, &[u8])] = include!(concat!(env!("OUT_DIR"), "/thumbnails.rs"));

/// Sends the thumbnail of a scene. Sends nothing if there is none.
pub fn thumbnail(name: &str, _: &Context) -> Receiver<Vec<u8>> {
    let (sender, receiver) = channel();
    if let Ok(at) = THUMBNAILS.binary_search_by_key(&name, |(known, _)| known) {
        // the receiver exists in this function
        let _ = sender.send(THUMBNAILS[at].1.to_vec());
    }
    receiver
}

/// Starts a player that wakes the window.
///
/// # Errors
/// The system starts no thread.
pub fn player(ctx: &Context) -> Result<Player, String> {
    let ctx = ctx.clone();
    ThreadedEngine::start(move || ctx.request_repaint())
        .map_err(|error| format!("the player's thread does not start: {error}"))
}

/// Does nothing: the player has its own thread.
pub fn work(_: &mut Player, _: &Context) {}

/// Computes a value in a new thread, and wakes the window when it is available.
pub fn beside<T: Send + 'static>(ctx: &Context, make: impl FnOnce() -> T + Send + 'static) -> Receiver<T> {
    let (sender, receiver) = channel();
    let ctx = ctx.clone();
    let work = move || {
        // sending fails only if the receiver was dropped
        let _ = sender.send(make());
        ctx.request_repaint();
    };
    // if no thread starts, the previous value stays
    let _ = std::thread::Builder::new().name("throng-view".into()).spawn(work);
    receiver
}

/// The watched file of the document.
pub struct Outside {
    watched: Option<Watched>,
    /// Whether the screenshot has been requested.
    pictured: bool,
}

impl Outside {
    /// Watches the file of a document, if it has one.
    pub fn new(document: &Document) -> Self {
        Self { watched: document.path.as_deref().map(Watched::new), pictured: false }
    }

    /// Returns the text of the file if another program has changed it.
    pub fn changed(&mut self, ctx: &Context) -> Option<String> {
        let watched = self.watched.as_mut()?;
        // checks the file even without input events
        ctx.request_repaint_after(Duration::from_millis(300));
        watched.changed()
    }

    /// Writes a document to its file. A document without a file gets a new file of its name in the current folder.
    ///
    /// Returns the message for the user.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn save(&mut self, document: &mut Document) -> Result<String, String> {
        let path = document.path.clone().unwrap_or_else(|| unused(&document.name, ".toml"));
        write(&path, document.text().as_bytes())?;
        document.path = Some(path.clone());
        document.mark_saved();
        let watched = self.watched.get_or_insert_with(|| Watched::new(&path));
        watched.know();
        Ok(saved(&path))
    }

    /// Writes a document to another file, which becomes its file. It `replaces` a file that exists only if the user has
    /// agreed to that. Returns the message for the user.
    ///
    /// # Errors
    /// The file exists already, or it cannot be written.
    pub fn save_as(&mut self, document: &mut Document, name: &str, replaces: bool) -> Result<String, String> {
        let path = Path::new(name);
        let path = if path.extension().is_some() { path.to_owned() } else { path.with_extension("toml") };
        if path.exists() && !replaces {
            return Err(format!("there is a file {} already", path.display()));
        }
        write(&path, document.text().as_bytes())?;
        document.saved_in(&path);
        *self = Self::new(document);
        Ok(saved(&path))
    }

    /// Takes the screenshot of the options when its step is reached, and closes the studio.
    pub fn screenshot(&mut self, ctx: &Context, options: &Options, shown: &RunMoment) {
        let Some(path) = options.screenshot.clone().filter(|_| !self.pictured) else { return };
        ctx.request_repaint();
        // panels need some frames to settle their sizes
        if Some(shown.step) == options.at_step && !shown.playing && ctx.cumulative_frame_nr() > 20 {
            self.pictured = true;
            let window = ctx.clone();
            ctx.request_screenshot(move |image| {
                let file = crate::picture::png(&image).map_err(|error| error.to_string());
                if let Err(says) = file.and_then(|bytes| write(&path, &bytes)) {
                    eprintln!("error: {says}");
                }
                window.send_viewport_cmd(ViewportCommand::Close);
            });
        }
    }
}

/// Starts a recording.
///
/// # Errors
/// The system starts no thread.
pub fn record(subject: Subject, take: Take, ctx: &Context) -> Result<Recording, String> {
    let ctx = ctx.clone();
    Recording::start(subject, take, begin, move || ctx.request_repaint())
}

/// Creates the file of a recording. The file must not exist.
fn begin(path: &Path, plan: &Plan) -> Result<Recorder, String> {
    if path.exists() {
        return Err(format!("there is {} already: choose another name", path.display()));
    }
    Recorder::create(path, plan).map_err(|error| error.to_string())
}

/// Whether the recording is complete.
///
/// # Errors
/// The recording failed.
pub fn go_on(recording: &mut Recording, _: &Context) -> Result<bool, String> {
    recording.done()
}

/// Returns the scenes, trajectories and folders of a folder: folders first, in the order of their names.
fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten().take(20 * NAMES);
    let name = |entry: std::fs::DirEntry| {
        let name = entry.file_name().into_string().ok().filter(|name| !name.starts_with('.'))?;
        let is_folder = entry.path().is_dir();
        let opens = Path::new(&name).extension().is_some_and(|end| end == "toml") || Trajectories::are_in(&name);
        (is_folder || opens).then(|| if is_folder { format!("{name}/") } else { name })
    };
    let mut names: Vec<String> = entries.filter_map(name).collect();
    names.sort_by_key(|name| (!name.ends_with('/'), name.to_lowercase()));
    names.truncate(NAMES);
    names
}

/// Returns the message for a saved file.
fn saved(path: &Path) -> String {
    format!("saved: {}", std::path::absolute(path).unwrap_or_else(|_| path.into()).display())
}

/// Returns the message for a complete recording.
pub fn recorded(path: &Path) -> String {
    format!("recorded: {}", std::path::absolute(path).unwrap_or_else(|_| path.into()).display())
}

/// Returns an unused file name with an ending such as `.mp4`: `name`, or else `name-2` and so on.
pub fn unused(name: &str, ending: &str) -> PathBuf {
    let numbered = (2..).map(|k| PathBuf::from(format!("{name}-{k}{ending}")));
    let mut paths = std::iter::once(PathBuf::from(format!("{name}{ending}"))).chain(numbered);
    paths.find(|path| !path.exists()).unwrap_or_default()
}

/// Writes the state to the file of the options.
pub fn tell(options: &Options, state: &str) {
    if let Some(path) = &options.state {
        // a test that reads the file notices that it is missing
        let _ = std::fs::write(path, state);
    }
}

/// Writes a new file in the current folder. Returns the message for the user.
///
/// # Errors
/// The file cannot be written.
pub fn hand_over(name: &str, kind: &str, bytes: &[u8]) -> Result<String, String> {
    let path = unused(name, &format!(".{kind}"));
    write(&path, bytes)?;
    Ok(saved(&path))
}

/// Returns the new addresses: a window has none.
pub fn addresses(_: &Context) -> Receiver<String> {
    channel().1
}

/// Returns an error: a window has no address.
///
/// # Errors
/// Always.
pub fn address(_: &str) -> Result<String, String> {
    Err("a window has no address: share the scene's file".into())
}

/// Writes a file atomically: it is complete, or unchanged.
fn write(path: &Path, bytes: &[u8]) -> Result<(), String> {
    let written = Output::create(path).and_then(|mut file| {
        file.put(bytes)?;
        file.finish()
    });
    written.map_err(|error| error.to_string())
}
