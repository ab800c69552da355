//! The studio in a web page.

use crate::outside::fetch;
use crate::{App, Options};
use eframe::egui::{FontData, FontDefinitions, FontFamily};
use std::panic::PanicHookInfo;
use std::sync::Arc;
use throng_draw::Typeface;
use throng_scene::Plugins;
use wasm_bindgen::JsCast;

/// The storage key that marks a failure of the studio until its next start.
const STOPPED: &str = "throng.stopped";

/// Starts the studio on the canvas `studio` of the page. The part of the address after `#` selects the scene
/// ([`Options::of_address`]). Errors appear in the element `said` of the page.
///
/// A panic ends the studio, because a page cannot catch panics. The page shows the panic. At its next start the studio
/// opens the scene without playing it.
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
        // if the browser keeps the mark, the next scene opens without playing too
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

/// Returns the fonts of panels and of code.
fn fonts(text: Vec<u8>, code: Vec<u8>) -> FontDefinitions {
    let mut fonts = FontDefinitions::empty();
    for (name, bytes) in [("text", text), ("code", code)] {
        fonts.font_data.insert(name.into(), Arc::new(FontData::from_owned(bytes)));
    }
    fonts.families.insert(FontFamily::Proportional, vec!["text".into()]);
    fonts.families.insert(FontFamily::Monospace, vec!["code".into(), "text".into()]);
    fonts
}

/// Shows a panic and marks the failure in the storage.
fn stopped(panic: &PanicHookInfo<'_>) {
    if let Some(kept) = storage() {
        // without storage, the next start plays the scene
        let _ = kept.set_item(STOPPED, "");
    }
    say(&format!("throng has stopped: {panic}\n\nLoad the page again: what you have written is kept."));
}

/// Shows a message in the centre of the page.
fn say(says: &str) {
    let document = web_sys::window().and_then(|window| window.document());
    if let Some(said) = document.and_then(|document| document.get_element_by_id("said")) {
        said.set_text_content(Some(says));
        // fails only if the element is already visible
        let _ = said.remove_attribute("hidden");
    }
}

fn storage() -> Option<web_sys::Storage> {
    web_sys::window()?.local_storage().ok()?
}
