//! In a web page.

use super::files::chosen;
use crate::Options;
use crate::document::Document;
use crate::play::{Player, Shown};
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

/// A page gives so much of each frame to the simulation.
const SLICE: Duration = Duration::from_millis(10);

/// Bytes of a file at most: more than that has no room in a page.
const MOST: f64 = 512e6;

/// Files that are read together: their names, and what is in them.
type Batch = Vec<(String, Result<Vec<u8>, String>)>;

/// The files that were handed to the page last, by being dropped on it or picked.
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
    /// Whether there is a file.
    pub fn holds(&self, file: &Path) -> bool {
        file.to_str().is_some_and(|name| self.files.contains_key(name))
    }

    /// The text of a file; `None` if there is none.
    pub fn text(&self, file: &Path) -> Option<Result<String, String>> {
        let bytes = self.files.get(file.to_str()?)?;
        Some(String::from_utf8(bytes.to_vec()).map_err(|_| format!("{}: it is no text", file.display())))
    }

    /// The document of a file's text: it is not in a file that the page could write.
    pub fn document(&self, file: &str, text: String) -> Document {
        let stem = Path::new(file).file_stem().and_then(|stem| stem.to_str());
        Document::new(stem.unwrap_or("scene"), text)
    }

    /// A page reads scene files alone.
    pub fn import(&self, _: &Path) -> Option<Result<Document, String>> {
        None
    }

    /// What is in a file.
    pub fn bytes(&self, file: &str) -> Option<Arc<[u8]>> {
        self.files.get(file).cloned()
    }

    /// Takes what is dropped on the page, and reads it.
    pub fn take(&mut self, dropped: &[DroppedFileHandle], ctx: &Context) {
        self.read(dropped.iter().filter_map(|file| file.web_file().cloned()).collect(), ctx);
    }

    fn read(&self, files: Vec<web_sys::File>, ctx: &Context) {
        read(files, self.coming.0.clone(), ctx.clone());
    }

    /// What has come and is to be opened; what came before is let go.
    ///
    /// # Errors
    /// A file that the browser cannot read.
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

    /// Lets people pick files; whether there is a way to.
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

/// Reads files while the page goes on, and wakes it when they are there.
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
        // who does not listen any more has closed the studio
        let _ = sender.send(batch);
        ctx.request_repaint();
    });
}

/// Reads a file of the page's folder.
///
/// # Errors
/// It is not there.
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

/// The file of the gallery's picture of a scene, which wakes the page when it is there; nothing comes if there is none.
pub fn thumbnail(name: &str, ctx: &Context) -> Receiver<Vec<u8>> {
    let (sender, receiver) = channel();
    let (file, ctx) = (format!("thumbnails/{name}.png"), ctx.clone());
    wasm_bindgen_futures::spawn_local(async move {
        if let Ok(bytes) = fetch(&file).await {
            // who does not listen any more has closed the studio
            let _ = sender.send(bytes);
            ctx.request_repaint();
        }
    });
    receiver
}

/// A player that works while the page draws.
///
/// # Errors
/// None here.
pub fn player(_: &Context) -> Result<Player, String> {
    Ok(Player::default())
}

/// Gives the player its slice.
pub fn work(player: &mut Player, ctx: &Context) {
    player.work(SLICE);
    if player.idle().is_some() {
        ctx.request_repaint();
    }
}

/// Makes something at once: a page has no threads.
pub fn beside<T: 'static>(_: &Context, make: impl FnOnce() -> T + 'static) -> Receiver<T> {
    let (sender, receiver) = channel();
    // the other end is here
    let _ = sender.send(make());
    receiver
}

/// Nothing is watched.
pub struct Outside;

impl Outside {
    /// Nothing is watched.
    pub fn new(_: &Document) -> Self {
        Self
    }

    /// There are no files.
    pub fn changed(&mut self, _: &Context) -> Option<String> {
        None
    }

    /// Downloads the text.
    ///
    /// # Errors
    /// The browser refuses.
    pub fn save(&mut self, document: &mut Document) -> Result<(), String> {
        hand_over(&document.name, "toml", document.text().as_bytes())?;
        document.mark_saved();
        Ok(())
    }

    /// Gives the text as a download.
    ///
    /// # Errors
    /// The browser does not let it.
    pub fn save_as(&mut self, document: &mut Document, name: &str) -> Result<(), String> {
        let name = if name.contains('.') { name.to_owned() } else { format!("{name}.toml") };
        download(&name, document.text().as_bytes())
            .map_err(|error| format!("the browser does not save it: {error:?}"))?;
        document.mark_saved();
        Ok(())
    }

    /// Browsers take pictures themselves.
    pub fn screenshot(&mut self, _: &Context, _: &Options, _: &Shown) {}
}

/// Makes what is shown `globalThis.throng`.
pub fn tell(_: &Options, state: &str) {
    if let Ok(value) = js_sys::JSON::parse(state) {
        // a page whose global object is frozen has no tests
        let _ = js_sys::Reflect::set(&js_sys::global(), &JsValue::from_str("throng"), &value);
    }
}

/// Begins to record.
///
/// # Errors
/// The scene cannot be built.
pub fn record(subject: Subject, take: Take, _: &Context) -> Result<Recording, String> {
    Recording::new(&subject, &take, begin)
}

/// Begins the file of a recording, which is downloaded when it is complete.
fn begin(path: &Path, plan: &Plan) -> Result<Recorder, String> {
    let hand = |path: &Path, bytes: Vec<u8>| {
        download(&path.display().to_string(), &bytes).map_err(|error| std::io::Error::other(format!("{error:?}")))
    };
    Recorder::to(Output::handed(path, hand), plan).map_err(|error| error.to_string())
}

/// Gives the recording its slice; whether it is done.
///
/// # Errors
/// There will be none; why.
pub fn go_on(recording: &mut Recording, ctx: &Context) -> Result<bool, String> {
    ctx.request_repaint();
    recording.work(SLICE)
}

/// What there is to say of a recording that is done.
pub fn recorded(path: &Path) -> String {
    format!("downloaded: {}", path.display())
}

/// Browsers find a name that there is not yet.
pub fn unused(name: &str, ending: &str) -> PathBuf {
    PathBuf::from(format!("{name}{ending}"))
}

/// Downloads a file; what there is to say of it.
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

/// Puts a link behind the `#` of the page's address; the address.
///
/// # Errors
/// The browser refuses.
pub fn address(link: &str) -> Result<String, String> {
    let place = |link: &str| -> Result<String, JsValue> {
        let window = web_sys::window().ok_or("there is no window")?;
        // no new entry: who goes back leaves the page
        window.history()?.replace_state_with_url(&JsValue::NULL, "", Some(&format!("#{link}")))?;
        window.location().href()
    };
    place(link).map_err(|error| format!("there is no link: {error:?}"))
}
