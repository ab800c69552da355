//! The studio: where people see, prototype, direct and debug crowds; in a window, and the same in a web page.
//!
//! | room | what it holds |
//! |---|---|
//! | [`document`] | the scene's text, the one thing that is edited |
//! | [`direct`] | editing it with the mouse in the view |
//! | [`play`] | what plays it: commands in, states out |
//! | [`keep`] | what keeps unsaved work |
//! | [`view`] | cameras, and what is drawn by the graphics processor |
//! | [`tune`] | what can be tuned: the schema of scene files, and what the scene says |
//! | [`panels`] | what stands round the view |
//! | [`record`] | films and tables of what is played |
//! | [`picture`], [`share`] | what people take along |
//! | [`start`] | command lines and addresses |
//! | [`keys`], [`settings`], [`state`] | the keyboard; what is remembered; what tests read |
//!
//! [`App`] puts them together. The text is the one document: what edits a scene edits the text, the player gets the scene
//! that it says, and the view shows what the player has published.

mod app;
pub mod direct;
pub mod document;
pub mod keep;
pub mod keys;
mod outside;
#[cfg(target_arch = "wasm32")]
pub mod page;
pub mod panels;
pub mod picture;
pub mod play;
pub mod record;
pub mod settings;
pub mod share;
pub mod start;
pub mod state;
mod style;
pub mod tune;
pub mod view;
#[cfg(not(target_arch = "wasm32"))]
pub mod window;

pub use app::App;
pub use start::Options;
pub use throng_scene::Plugins;

/// The studio as a program of its own, with what is brought along: in a window, as its command line says, or in a web page.
///
/// ```no_run
/// throng_studio::main(throng_studio::Plugins::new().scene("mine", "[[group]]\nplace.point = [0, 0]\n"));
/// ```
#[cfg(not(target_arch = "wasm32"))]
pub fn main(plugins: Plugins) -> std::process::ExitCode {
    use clap::Parser;
    match window::open(window::Arguments::parse(), plugins) {
        Ok(()) => std::process::ExitCode::SUCCESS,
        Err(says) => {
            eprintln!("error: {says}");
            std::process::ExitCode::FAILURE
        }
    }
}

/// The studio as a program of its own, with what is brought along: in a window, as its command line says, or in a web page.
#[cfg(target_arch = "wasm32")]
pub fn main(plugins: Plugins) -> std::process::ExitCode {
    page::open(plugins);
    std::process::ExitCode::SUCCESS
}
