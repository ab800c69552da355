//! The studio in a window.

use crate::{App, Options};
use eframe::egui::ViewportBuilder;
use std::path::PathBuf;

/// What the studio is told on the command line.
#[derive(clap::Parser, Clone, Debug)]
#[command(name = "throng-studio", version, about = "See, direct and debug crowds")]
pub struct Arguments {
    /// The scene: a name of the gallery (see `throng list`) or a scene file [default: the one that was open last]
    #[arg(value_name = "SCENE")]
    pub scene: Option<String>,

    /// Writes what is shown to a file, as JSON, for tests
    #[arg(long, value_name = "FILE")]
    pub state: Option<PathBuf>,

    /// Writes a picture of the window to a file (.png), and closes it
    #[arg(long, value_name = "FILE")]
    pub screenshot: Option<PathBuf>,

    /// Shows the scene at a step, paused [with --screenshot: 0]
    #[arg(long, value_name = "N")]
    pub at_step: Option<u64>,
}

impl From<Arguments> for Options {
    fn from(arguments: Arguments) -> Self {
        let Arguments { scene, state, screenshot, at_step } = arguments;
        let at_step = at_step.or(screenshot.as_ref().map(|_| 0));
        Self { scene, state, screenshot, at_step, ..Self::default() }
    }
}

/// Opens the window, until people close it.
///
/// # Errors
/// There is no screen, or no OpenGL; in words.
pub fn open(options: Options) -> Result<(), String> {
    let native = eframe::NativeOptions {
        viewport: ViewportBuilder::default()
            .with_title("throng")
            .with_app_id("throng")
            .with_inner_size([1280.0, 800.0]),
        depth_buffer: 24,
        multisampling: 4,
        // a picture looks the same whoever takes it
        persist_window: options.screenshot.is_none(),
        ..eframe::NativeOptions::default()
    };
    let create: eframe::AppCreator = Box::new(move |creation| {
        let storage = creation.storage.filter(|_| options.screenshot.is_none());
        Ok(Box::new(App::new(&creation.egui_ctx, storage, options)?))
    });
    eframe::run_native("throng", native, create).map_err(|error| error.to_string())
}
