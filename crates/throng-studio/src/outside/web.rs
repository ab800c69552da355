//! In a web page.

use crate::Options;
use crate::document::Document;
use crate::play::{Player, Shown};
use eframe::egui::Context;
use std::time::Duration;
use throng_scene::gallery;
use wasm_bindgen::JsValue;

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
