//! The studio in a window.

use crate::outside::Files;
use crate::settings::Settings;
use crate::view::Mode;
use crate::{App, Face, Options};
use eframe::egui::ViewportBuilder;
use std::path::PathBuf;
use std::sync::Arc;
use throng_scene::Plugins;

/// The command line of the studio.
#[derive(clap::Parser, Clone, Debug)]
#[command(name = "throng-studio", version, about = "See, direct and debug crowds")]
pub struct Arguments {
    /// Scene: a name of the gallery (see `throng list`) or a scene file [default: the scene opened last]
    #[arg(value_name = "SCENE")]
    pub scene: Option<String>,

    /// Write the displayed state to a file, as JSON, for tests
    #[arg(long, value_name = "FILE")]
    pub state: Option<PathBuf>,

    /// Write a screenshot of the window to a file (.png), and close the window
    #[arg(long, value_name = "FILE")]
    pub screenshot: Option<PathBuf>,

    /// Show the scene at a step, paused [with --screenshot: 0]
    #[arg(long, value_name = "N")]
    pub at_step: Option<u64>,

    /// Select an agent by its number
    #[arg(long, value_name = "N")]
    pub select: Option<u32>,

    /// Camera: plan, orbit, fixed-distance, local-offset, point-of-view, straight-down
    #[arg(long, value_name = "NAME")]
    pub camera: Option<Mode>,

    /// What is around the view: studio, start, present (large type), embed (nothing) [default: studio; start at first]
    #[arg(long, value_name = "NAME", value_parser = face)]
    pub face: Option<Face>,

    /// Change a setting: dark=true, panels.plots=true, coloring=speed, beside=rvo; may be repeated
    #[arg(long, value_name = "KEY=VALUE")]
    pub with: Vec<String>,

    /// Size of the window, in points
    #[arg(long, value_name = "WxH", default_value = "1280x800", value_parser = size)]
    pub size: [f32; 2],
}

impl From<Arguments> for Options {
    fn from(arguments: Arguments) -> Self {
        let Arguments { scene, state, screenshot, at_step, select, camera, face, with, size: _ } = arguments;
        let at_step = at_step.or(screenshot.as_ref().map(|_| 0));
        Self { scene, state, screenshot, at_step, select, camera, face, with, ..Self::default() }
    }
}

fn face(name: &str) -> Result<Face, String> {
    Face::named(name).ok_or_else(|| "studio, start, present or embed is expected".into())
}

/// Parses a size such as `1280x800`. Each side is from 200 to 8192.
fn size(said: &str) -> Result<[f32; 2], String> {
    let side = |text: &str| text.parse().ok().filter(|side: &f32| (200.0..=8192.0).contains(side));
    let sides = said.split_once('x').and_then(|(wide, high)| Some([side(wide)?, side(high)?]));
    sides.ok_or_else(|| "two numbers from 200 to 8192 with an x between are expected, such as 1280x800".into())
}

/// Opens the window and returns when it is closed.
///
/// # Errors
/// An argument is invalid, the scene does not exist, or there is no screen or no OpenGL.
pub fn open(arguments: Arguments, plugins: Plugins) -> Result<(), String> {
    let size = arguments.size;
    let options = Options { plugins, ..arguments.into() };
    // errors of the command line are reported before the window opens
    options.adjust(&mut Settings::default())?;
    if let Some(scene) = &options.scene {
        Files::default().open(scene, &Arc::new(options.plugins.clone()))?;
    }
    let native = eframe::NativeOptions {
        viewport: ViewportBuilder::default().with_title("throng").with_app_id("throng").with_inner_size(size),
        depth_buffer: 24,
        multisampling: 4,
        // a screenshot does not depend on the last window of the user
        persist_window: options.screenshot.is_none(),
        ..eframe::NativeOptions::default()
    };
    let create: eframe::AppCreator = Box::new(move |creation| {
        let storage = creation.storage.filter(|_| options.screenshot.is_none());
        Ok(Box::new(App::new(&creation.egui_ctx, storage, options)?))
    });
    eframe::run_native("throng", native, create).map_err(|error| error.to_string())
}
