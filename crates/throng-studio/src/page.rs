//! The studio in a web page.

use crate::outside::{Mirror, fetch, hash};
use crate::{App, Face, Options};
use eframe::egui::{Event, FontData, FontDefinitions, FontFamily};
use std::panic::PanicHookInfo;
use std::sync::Arc;
use throng_draw::Typeface;
use throng_scene::Plugins;
use wasm_bindgen::JsCast;

/// The storage key that marks a failure of the studio until its next start.
const STOPPED: &str = "throng.stopped";

/// Starts the studio on the canvas `studio` of the page. The part of the address after `#` selects the scene
/// ([`Options::of_address`]), the part after `?` the [face](Face::named). Without a scene the page begins with the start
/// page. A scene waits for the user if the browser asks for reduced motion. Errors appear in the element `said` of the page.
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
    let mut options = Options { plugins, ..Options::of_address(&hash())? };
    let query = window.location().search().unwrap_or_default();
    let named = query.trim_start_matches('?').split('&').find_map(Face::named);
    options.face = options.face.or(named).or(options.scene.is_none().then_some(Face::Start));
    let face = options.face;
    let still =
        window.match_media("(prefers-reduced-motion: reduce)").ok().flatten().is_some_and(|query| query.matches());
    options.paused = still || options.face == Some(Face::Embed);
    if let Some(kept) = storage().filter(|kept| kept.get_item(STOPPED).is_ok_and(|item| item.is_some())) {
        options.rest = true;
        // if the browser keeps the mark, the next scene opens without playing too
        let _ = kept.remove_item(STOPPED);
    }
    let text = fetch("fonts/ubuntu-light.ttf").await?;
    options.typeface = Typeface::new("Ubuntu Light", text.clone()).map_err(|error| error.to_string())?;
    let create: eframe::AppCreator = Box::new(move |creation| {
        creation.egui_ctx.set_fonts(fonts(text.clone(), None));
        creation.egui_ctx.add_plugin(Mirror::new(&creation.egui_ctx)?);
        let ctx = creation.egui_ctx.clone();
        // the first picture does not wait for the font of code
        wasm_bindgen_futures::spawn_local(async move {
            match fetch("fonts/hack-regular.ttf").await {
                Ok(code) => ctx.set_fonts(fonts(text, Some(code))),
                Err(says) => say(&says),
            }
            ctx.request_repaint();
        });
        Ok(Box::new(App::new(&creation.egui_ctx, creation.storage, options)?))
    });
    let mut web = eframe::WebOptions::default();
    if face == Some(Face::Embed) {
        // the wheel scrolls the page around, except with Ctrl
        let own = |event: &Event| !matches!(event, Event::MouseWheel { modifiers, .. } if !modifiers.command);
        (web.should_prevent_default, web.should_stop_propagation) = (Box::new(own), Box::new(own));
    }
    let started = eframe::WebRunner::new().start(canvas, web, create).await;
    started.map_err(|error| format!("the studio does not start: {error:?}"))?;
    // the invisible field that receives typed text has no label of its own
    let field = window.document().and_then(|document| document.query_selector("input:not([id])").ok().flatten());
    field
        .map_or(Ok(()), |field| field.set_attribute("aria-label", "text for the studio"))
        .map_err(|error| format!("{error:?}"))
}

/// Returns the fonts of panels and of code. Without a font of code, code has the font of panels.
fn fonts(text: Vec<u8>, code: Option<Vec<u8>>) -> FontDefinitions {
    let mut fonts = FontDefinitions::empty();
    let mut families = [vec!["text".to_owned()], vec!["text".to_owned()]];
    fonts.font_data.insert("text".into(), Arc::new(FontData::from_owned(text)));
    if let Some(code) = code {
        fonts.font_data.insert("code".into(), Arc::new(FontData::from_owned(code)));
        families[1].insert(0, "code".into());
    }
    let [panels, code] = families;
    fonts.families.insert(FontFamily::Proportional, panels);
    fonts.families.insert(FontFamily::Monospace, code);
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
