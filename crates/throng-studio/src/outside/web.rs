//! The platform of the web page.

use super::Asks;
use super::files::chosen;
use crate::Options;
use crate::document::Document;
use crate::play::{Player, RunMoment};
use crate::record::{Recording, Subject, Take};
use eframe::egui::{Context, DroppedFileHandle};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::Duration;
use throng_draw::record::{Plan, Recorder};
use throng_record::Output;
use throng_record::formats::FORMATS;
use wasm_bindgen::closure::Closure;
use wasm_bindgen::{JsCast, JsValue};
use wasm_bindgen_futures::JsFuture;

/// The time that the simulation gets in each frame.
const SLICE: Duration = Duration::from_millis(10);

/// The largest file, bytes. Larger files do not fit into the memory of a page.
const MOST: f64 = 512e6;

/// Files that are read together: names and contents.
type Batch = Vec<(String, Result<Vec<u8>, String>)>;

/// A dialog of the system. A page has none but [`Folder::pick`].
#[derive(Debug)]
pub enum Dialog {}

impl Dialog {
    /// Whether there are dialogs.
    pub const EXISTS: bool = false;

    /// Returns `None`: a page opens no dialog for a name.
    pub fn open(_: &str, _: Asks, _: &str, _: &Context) -> Option<Self> {
        None
    }

    /// Returns the chosen file.
    pub fn answer(&self) -> Option<Result<PathBuf, Option<&'static str>>> {
        match *self {}
    }
}

/// The files last dropped on the page or picked.
pub struct Folder {
    files: BTreeMap<String, Arc<[u8]>>,
    coming: (Sender<Batch>, Receiver<Batch>),
}

impl Default for Folder {
    fn default() -> Self {
        Self { files: BTreeMap::new(), coming: channel() }
    }
}

impl Folder {
    /// Whether the file exists.
    pub fn holds(&self, file: &Path) -> bool {
        file.to_str().is_some_and(|name| self.files.contains_key(name))
    }

    /// Returns the text of a file, `None` if the file does not exist.
    pub fn text(&self, file: &Path) -> Option<Result<String, String>> {
        let bytes = self.files.get(file.to_str()?)?;
        Some(String::from_utf8(bytes.to_vec()).map_err(|_| super::files::not_in_page(file)))
    }

    /// Returns a document with this text. The document has no file, because a page cannot write files.
    pub fn document(&self, file: &str, text: String) -> Document {
        let stem = Path::new(file).file_stem().and_then(|stem| stem.to_str());
        Document::new(stem.unwrap_or("scene"), text)
    }

    /// Returns `None`: a page imports no files of other programs.
    pub fn import(&self, _: &Path) -> Option<Result<Document, String>> {
        None
    }

    /// Returns `None`: a page does not remember files.
    pub fn path(&self, _: &str) -> Option<String> {
        None
    }

    /// Returns the place of downloads, and no names.
    pub fn list(&mut self, _: &str) -> (String, Vec<String>) {
        ("the downloads of the browser".into(), Vec::new())
    }

    /// Returns the content of a file.
    pub fn bytes(&self, file: &str) -> Option<Arc<[u8]>> {
        self.files.get(file).cloned()
    }

    /// Reads the files dropped on the page.
    pub fn take(&mut self, dropped: &[DroppedFileHandle], ctx: &Context) {
        self.read(dropped.iter().filter_map(|file| file.web_file().cloned()).collect(), ctx);
    }

    fn read(&self, files: Vec<web_sys::File>, ctx: &Context) {
        read(files, self.coming.0.clone(), ctx.clone());
    }

    /// Returns the file to open. Only the last batch of files is kept.
    ///
    /// # Errors
    /// The browser cannot read a file.
    pub fn came(&mut self) -> Option<Result<String, String>> {
        let batch = self.coming.1.try_iter().last()?;
        let names: Vec<_> = batch.iter().map(|(name, _)| name.clone()).collect();
        let files = batch.into_iter().map(|(name, bytes)| Ok((name, bytes?.into())));
        match files.collect::<Result<_, String>>() {
            Ok(files) => self.files = files,
            Err(says) => return Some(Err(says)),
        }
        chosen(&names).map(Ok)
    }

    /// Opens the file picker of the browser. Returns whether there is one.
    pub fn pick(&self, ctx: &Context) -> bool {
        let document = web_sys::window().and_then(|window| window.document());
        let input = document.and_then(|document| document.create_element("input").ok());
        let Some(input) = input.and_then(|input| input.dyn_into::<web_sys::HtmlInputElement>().ok()) else {
            return false;
        };
        input.set_type("file");
        let films = FORMATS.iter().filter(|format| format.is_read()).map(|format| format!(",.{}", format.ending));
        input.set_accept(&format!(".toml{}", films.collect::<String>()));
        input.set_multiple(true);
        let (sender, ctx, picked) = (self.coming.0.clone(), ctx.clone(), input.clone());
        let done = Closure::once_into_js(move || {
            let files = picked.files();
            let files = files.iter().flat_map(|files| (0..files.length()).filter_map(|at| files.get(at)));
            read(files.collect(), sender, ctx);
        });
        input.set_onchange(Some(done.unchecked_ref()));
        input.click();
        true
    }
}

/// Reads files asynchronously, and wakes the page when they are available.
fn read(files: Vec<web_sys::File>, sender: Sender<Batch>, ctx: Context) {
    if files.is_empty() {
        return;
    }
    wasm_bindgen_futures::spawn_local(async move {
        let mut batch = Vec::new();
        for file in files {
            let bytes = if file.size() > MOST {
                Err(format!("{} is too large for a page: open it with the program", file.name()))
            } else {
                let bytes = JsFuture::from(file.array_buffer()).await;
                bytes.map(|bytes| js_sys::Uint8Array::new(&bytes).to_vec()).map_err(|error| {
                    format!("the browser cannot read {}: {}", file.name(), js_sys::Error::from(error).message())
                })
            };
            batch.push((file.name(), bytes));
        }
        // sending fails only after the studio has closed
        let _ = sender.send(batch);
        ctx.request_repaint();
    });
}

/// Reads a file of the page's folder.
///
/// # Errors
/// The file is missing.
pub async fn fetch(file: &str) -> Result<Vec<u8>, String> {
    let get = async {
        let window = web_sys::window().ok_or("there is no window")?;
        let response: web_sys::Response = JsFuture::from(window.fetch_with_str(file)).await?.dyn_into()?;
        if !response.ok() {
            return Err(JsValue::from_str(&format!("the server answers {}", response.status())));
        }
        let bytes = JsFuture::from(response.array_buffer()?).await?;
        Ok(js_sys::Uint8Array::new(&bytes).to_vec())
    };
    get.await.map_err(|error: JsValue| format!("{file} is missing, copy the whole folder of the page: {error:?}"))
}

/// Sends the thumbnail of a scene and wakes the page. Sends nothing if there is none.
pub fn thumbnail(name: &str, ctx: &Context) -> Receiver<Vec<u8>> {
    let (sender, receiver) = channel();
    let (file, ctx) = (format!("thumbnails/{name}.png"), ctx.clone());
    wasm_bindgen_futures::spawn_local(async move {
        if let Ok(bytes) = fetch(&file).await {
            // sending fails only after the studio has closed
            let _ = sender.send(bytes);
            ctx.request_repaint();
        }
    });
    receiver
}

/// Creates a player that works between the frames of the page.
///
/// # Errors
/// None on this platform.
pub fn player(_: &Context) -> Result<Player, String> {
    Ok(Player::default())
}

/// Gives the player its time slice.
pub fn work(player: &mut Player, ctx: &Context) {
    player.work(SLICE);
    if player.idle().is_some() {
        ctx.request_repaint();
    }
}

/// Computes a value at once: a page has no threads.
pub fn beside<T: 'static>(_: &Context, make: impl FnOnce() -> T + 'static) -> Receiver<T> {
    let (sender, receiver) = channel();
    // the receiver exists in this function
    let _ = sender.send(make());
    receiver
}

/// The platform state of the document. A page watches no files.
pub struct Outside;

impl Outside {
    /// Creates the state.
    pub fn new(_: &Document) -> Self {
        Self
    }

    /// Returns `None`: a page watches no files.
    pub fn changed(&mut self, _: &Context) -> Option<String> {
        None
    }

    /// Downloads the text. Returns the message for the user.
    ///
    /// # Errors
    /// The browser refuses.
    pub fn save(&mut self, document: &mut Document) -> Result<String, String> {
        let says = hand_over(&document.name, "toml", document.text().as_bytes())?;
        document.mark_saved();
        Ok(says)
    }

    /// Downloads the text under another name. Returns the message for the user.
    ///
    /// # Errors
    /// The browser refuses.
    pub fn save_as(&mut self, document: &mut Document, name: &str, _: bool) -> Result<String, String> {
        let name = if name.contains('.') { name.to_owned() } else { format!("{name}.toml") };
        download(&name, document.text().as_bytes())
            .map_err(|error| format!("the browser does not save it: {error:?}"))?;
        document.mark_saved();
        Ok(recorded(Path::new(&name)))
    }

    /// Does nothing: the browser takes screenshots.
    pub fn screenshot(&mut self, _: &Context, _: &Options, _: &RunMoment) {}
}

/// Publishes the state as `globalThis.throng`.
pub fn tell(_: &Options, state: &str) {
    if let Ok(value) = js_sys::JSON::parse(state) {
        // fails only where the global object is frozen, and no test runs there
        let _ = js_sys::Reflect::set(&js_sys::global(), &JsValue::from_str("throng"), &value);
    }
}

/// Starts a recording.
///
/// # Errors
/// The scene cannot be built.
pub fn record(subject: Subject, take: Take, _: &Context) -> Result<Recording, String> {
    Recording::new(&subject, &take, begin)
}

/// Creates the file of a recording. The file is downloaded when it is complete.
fn begin(path: &Path, plan: &Plan) -> Result<Recorder, String> {
    let hand = |path: &Path, bytes: Vec<u8>| {
        download(&path.display().to_string(), &bytes).map_err(|error| std::io::Error::other(format!("{error:?}")))
    };
    Recorder::to(Output::handed(path, hand), plan).map_err(|error| error.to_string())
}

/// Gives the recording its time slice. Returns whether it is complete.
///
/// # Errors
/// The recording failed.
pub fn go_on(recording: &mut Recording, ctx: &Context) -> Result<bool, String> {
    ctx.request_repaint();
    recording.work(SLICE)
}

/// Returns the message for a complete recording.
pub fn recorded(path: &Path) -> String {
    format!("downloaded: {}", path.display())
}

/// Returns the name: browsers number files that exist.
pub fn unused(name: &str, ending: &str) -> PathBuf {
    PathBuf::from(format!("{name}{ending}"))
}

/// Downloads a file. Returns the message for the user.
///
/// # Errors
/// The browser refuses.
pub fn hand_over(name: &str, kind: &str, bytes: &[u8]) -> Result<String, String> {
    let file = format!("{name}.{kind}");
    download(&file, bytes).map_err(|error| format!("{file} cannot be downloaded: {error:?}"))?;
    Ok(format!("downloaded: {file}"))
}

fn download(file: &str, bytes: &[u8]) -> Result<(), JsValue> {
    let parts = js_sys::Array::new();
    parts.push(&js_sys::Uint8Array::from(bytes));
    let url = web_sys::Url::create_object_url_with_blob(&web_sys::Blob::new_with_u8_array_sequence(&parts)?)?;
    let document = web_sys::window().and_then(|window| window.document()).ok_or("there is no document")?;
    let link: web_sys::HtmlAnchorElement = document.create_element("a")?.dyn_into()?;
    link.set_href(&url);
    link.set_download(file);
    link.click();
    web_sys::Url::revoke_object_url(&url)
}

/// Returns what follows the `#` of the page's address whenever the user changes it, and wakes the page.
pub fn addresses(ctx: &Context) -> Receiver<String> {
    let ((sender, receiver), ctx) = (channel(), ctx.clone());
    let changed = Closure::<dyn FnMut()>::new(move || {
        // sending fails only after the studio has closed
        let _ = sender.send(hash());
        ctx.request_repaint();
    });
    if let Some(window) = web_sys::window() {
        window.set_onhashchange(Some(changed.as_ref().unchecked_ref()));
        // the page lives as long as the studio
        changed.forget();
    }
    receiver
}

/// Returns what follows the `#` of the page's address.
pub fn hash() -> String {
    let hash = web_sys::window().and_then(|window| window.location().hash().ok()).unwrap_or_default();
    let hash = hash.trim_start_matches('#');
    // browsers escape quotes of lists
    js_sys::decode_uri_component(hash).map_or_else(|_| hash.to_owned(), String::from)
}

/// Puts a link after the `#` of the page's address, and returns the address.
///
/// # Errors
/// The browser refuses.
pub fn address(link: &str) -> Result<String, String> {
    let place = |link: &str| -> Result<String, JsValue> {
        let window = web_sys::window().ok_or("there is no window")?;
        // replaces the history entry, so that "back" leaves the page
        window.history()?.replace_state_with_url(&JsValue::NULL, "", Some(&format!("#{link}")))?;
        window.location().href()
    };
    place(link).map_err(|error| format!("there is no link: {error:?}"))
}
