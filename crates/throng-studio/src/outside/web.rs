//! In a web page.

use crate::Options;
use crate::document::Document;
use crate::play::{Player, Shown};
use crate::record::{Recording, Subject, Take};
use eframe::egui::Context;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;
use throng_draw::record::{Plan, Recorder};
use throng_record::Output;
use throng_scene::{Plugins, gallery};
use wasm_bindgen::{JsCast, JsValue};

/// A page gives so much of each frame to the simulation.
const SLICE: Duration = Duration::from_millis(10);

/// A name of the gallery or of the plug-ins, as a document.
///
/// # Errors
/// There is no such scene.
pub fn open(scene: &str, plugins: &Arc<Plugins>) -> Result<Document, String> {
    crate::share::open(scene)
        .or_else(|| Document::named(scene, plugins))
        .ok_or_else(|| gallery::scene(scene).err().map_or_else(String::new, |error| error.to_string()))
}

/// A page has no files.
pub fn is_film(_: &str) -> bool {
    false
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
