//! The studio in a window.

use crate::view::Mode;
use crate::{App, Options};
use eframe::egui::ViewportBuilder;
use std::path::PathBuf;
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

    /// Change a setting: dark=true, panels.plots=true, coloring=Speed, beside=rvo; may be repeated
    #[arg(long, value_name = "KEY=VALUE")]
    pub with: Vec<String>,

    /// Size of the window, in points
    #[arg(long, value_name = "WxH", default_value = "1280x800", value_parser = size)]
    pub size: [f32; 2],
}

impl From<Arguments> for Options {
    fn from(arguments: Arguments) -> Self {
        let Arguments { scene, state, screenshot, at_step, select, camera, with, size: _ } = arguments;
        let at_step = at_step.or(screenshot.as_ref().map(|_| 0));
        Self { scene, state, screenshot, at_step, select, camera, with, ..Self::default() }
    }
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
/// There is no screen, or no OpenGL.
pub fn open(arguments: Arguments, plugins: Plugins) -> Result<(), String> {
    let size = arguments.size;
    let options = Options { plugins, ..arguments.into() };
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
