//! In a web page.

use crate::Options;
use crate::document::Document;
use crate::play::{Player, Shown};
use eframe::egui::Context;
use std::time::Duration;
use throng_scene::gallery;
use wasm_bindgen::{JsCast, JsValue};

/// A page gives so much of each frame to the simulation.
const SLICE: Duration = Duration::from_millis(10);

/// A name of the gallery, as a document.
///
/// # Errors
/// There is no such scene.
pub fn open(scene: &str) -> Result<Document, String> {
    Document::gallery(scene)
        .ok_or_else(|| gallery::scene(scene).err().map_or_else(String::new, |error| error.to_string()))
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

    /// There are no files.
    ///
    /// # Errors
    /// Always.
    pub fn save(&mut self, _: &mut Document) -> Result<(), String> {
        Err("a web page has no files: copy the text".into())
    }

    /// Gives the text as a download.
    ///
    /// # Errors
    /// The browser does not let it.
    pub fn save_as(&mut self, document: &mut Document, name: &str) -> Result<(), String> {
        let name = if name.contains('.') { name.to_owned() } else { format!("{name}.toml") };
        download(&name, document.text()).map_err(|error| format!("the browser does not save it: {error:?}"))?;
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

fn download(name: &str, text: &str) -> Result<(), JsValue> {
    let none = || JsValue::from_str("there is no page");
    let page = web_sys::window().and_then(|window| window.document()).ok_or_else(none)?;
    let blob = web_sys::Blob::new_with_str_sequence(&js_sys::Array::of1(&text.into()))?;
    let address = web_sys::Url::create_object_url_with_blob(&blob)?;
    let link: web_sys::HtmlAnchorElement = page.create_element("a")?.unchecked_into();
    link.set_href(&address);
    link.set_download(name);
    link.click();
    web_sys::Url::revoke_object_url(&address)
}
