//! The studio: an application to view, prototype, direct and debug crowds, in a window or in a web page.
//!
//! | module | content |
//! |---|---|
//! | [`document`] | the text of the scene, the only editable representation |
//! | [`direct`] | editing the scene with the mouse in the view |
//! | [`intervene`] | changing the running scene with the mouse in the view |
//! | [`lesson`] | lessons: steps, votes, checks of exercises |
//! | [`play`] | the player: commands in, states out |
//! | [`keep`] | protection of unsaved work |
//! | [`view`] | cameras, and what the graphics processor draws |
//! | [`tune`] | tunable parameters: the schema of scene files and the values of the scene |
//! | [`panels`] | the panels around the view |
//! | [`record`] | videos and tables of a run |
//! | [`picture`], [`share`] | pictures and links |
//! | [`Face`] | what is around the view: the studio, a start page, nothing |
//! | [`start`] | command lines and addresses |
//! | [`keys`], [`settings`], [`state`] | the keyboard, persistent settings, the state that tests read |
//!
//! [`App`] combines them. Every edit of the scene changes the text. The player receives the scene of the text, and the
//! view shows the state that the player publishes.

mod app;
pub mod direct;
pub mod document;
mod face;
pub mod intervene;
pub mod keep;
pub mod keys;
pub mod lesson;
mod opened;
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
pub use face::Face;
pub use start::Options;
pub use throng_scene::Plugins;

/// Runs the studio as a program with these plug-ins. Native builds open a window according to the command line, web
/// builds start in the page.
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

/// Runs the studio as a program with these plug-ins. Native builds open a window according to the command line, web
/// builds start in the page.
#[cfg(target_arch = "wasm32")]
pub fn main(plugins: Plugins) -> std::process::ExitCode {
    page::open(plugins);
    std::process::ExitCode::SUCCESS
}
