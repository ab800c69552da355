//! The studio in a web page.

use crate::outside::fetch;
use crate::{App, Options};
use eframe::egui::{FontData, FontDefinitions, FontFamily};
use std::panic::PanicHookInfo;
use std::sync::Arc;
use throng_draw::Typeface;
use throng_scene::Plugins;
use wasm_bindgen::JsCast;

/// What the browser keeps from when the studio stopped to when it starts again.
const STOPPED: &str = "throng.stopped";

/// Starts the studio on the page's canvas `studio`; the scene is what stands behind `#` in the address,
/// as [`Options::of_address`] reads it. What goes wrong is said by the page's element `said`.
///
/// A panic ends the studio, as pages cannot catch any: it is told, and the next time the scene is opened without being played.
pub fn open(plugins: Plugins) {
    std::panic::set_hook(Box::new(stopped));
    wasm_bindgen_futures::spawn_local(async {
        if let Err(says) = start(plugins).await {
            say(&says);
        }
    });
}

async fn start(plugins: Plugins) -> Result<(), String> {
    let window = web_sys::window().ok_or("there is no window")?;
    let canvas = window.document().and_then(|document| document.get_element_by_id("studio"));
    let canvas = canvas.and_then(|canvas| canvas.dyn_into().ok()).ok_or("the page has no canvas `studio`")?;
    let hash = window.location().hash().unwrap_or_default();
    let mut options = Options { plugins, ..Options::of_address(hash.trim_start_matches('#'))? };
    if let Some(kept) = storage().filter(|kept| kept.get_item(STOPPED).is_ok_and(|item| item.is_some())) {
        options.rest = true;
        // a browser that keeps it has it looked at once more
        let _ = kept.remove_item(STOPPED);
    }
    let [text, code] = [fetch("fonts/ubuntu-light.ttf").await?, fetch("fonts/hack-regular.ttf").await?];
    options.typeface = Typeface::new("Ubuntu Light", text.clone()).map_err(|error| error.to_string())?;
    let fonts = fonts(text, code);
    let create: eframe::AppCreator = Box::new(move |creation| {
        creation.egui_ctx.set_fonts(fonts);
        Ok(Box::new(App::new(&creation.egui_ctx, creation.storage, options)?))
    });
    let started = eframe::WebRunner::new().start(canvas, eframe::WebOptions::default(), create).await;
    started.map_err(|error| format!("the studio does not start: {error:?}"))
}

/// The fonts of panels, and of what is code.
fn fonts(text: Vec<u8>, code: Vec<u8>) -> FontDefinitions {
    let mut fonts = FontDefinitions::empty();
    for (name, bytes) in [("text", text), ("code", code)] {
        fonts.font_data.insert(name.into(), Arc::new(FontData::from_owned(bytes)));
    }
    fonts.families.insert(FontFamily::Proportional, vec!["text".into()]);
    fonts.families.insert(FontFamily::Monospace, vec!["code".into(), "text".into()]);
    fonts
}

/// Tells of a panic, and remembers it.
fn stopped(panic: &PanicHookInfo<'_>) {
    if let Some(kept) = storage() {
        // where nothing is kept the scene is played again
        let _ = kept.set_item(STOPPED, "");
    }
    say(&format!("throng has stopped: {panic}\n\nLoad the page again: what you have written is kept."));
}

/// Shows something in the middle of the page.
fn say(says: &str) {
    let document = web_sys::window().and_then(|window| window.document());
    if let Some(said) = document.and_then(|document| document.get_element_by_id("said")) {
        said.set_text_content(Some(says));
        // an element that is no longer hidden is what was wanted
        let _ = said.remove_attribute("hidden");
    }
}

fn storage() -> Option<web_sys::Storage> {
    web_sys::window()?.local_storage().ok()?
}
