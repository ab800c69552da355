//! The studio in a web page.

use crate::{App, Options};
use throng_scene::Plugins;
use wasm_bindgen::JsCast;

/// Starts the studio on the page's canvas `studio`; the scene is what stands behind `#` in the address,
/// as [`Options::of_address`] reads it.
pub fn open(plugins: Plugins) {
    wasm_bindgen_futures::spawn_local(async {
        if let Err(says) = start(plugins).await {
            let body = web_sys::window().and_then(|window| window.document()).and_then(|document| document.body());
            body.into_iter().for_each(|body| body.set_inner_text(&says));
        }
    });
}

async fn start(plugins: Plugins) -> Result<(), String> {
    let window = web_sys::window().ok_or("there is no window")?;
    let canvas = window.document().and_then(|document| document.get_element_by_id("studio"));
    let canvas = canvas.and_then(|canvas| canvas.dyn_into().ok()).ok_or("the page has no canvas `studio`")?;
    let hash = window.location().hash().unwrap_or_default();
    let options = Options { plugins, ..Options::of_address(hash.trim_start_matches('#'))? };
    let create: eframe::AppCreator =
        Box::new(move |creation| Ok(Box::new(App::new(&creation.egui_ctx, creation.storage, options)?)));
    let started = eframe::WebRunner::new().start(canvas, eframe::WebOptions::default(), create).await;
    started.map_err(|error| format!("the studio does not start: {error:?}"))
}
