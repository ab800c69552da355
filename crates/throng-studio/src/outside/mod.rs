//! Platform-specific code of the window and of the web page: files, threads, and the published state.

mod asks;
#[cfg(not(target_arch = "wasm32"))]
mod dialog;
mod files;
#[cfg(target_arch = "wasm32")]
mod mirror;
#[cfg(not(target_arch = "wasm32"))]
mod native;
#[cfg(target_arch = "wasm32")]
mod web;

pub use asks::Asks;
#[cfg(not(target_arch = "wasm32"))]
pub use dialog::Dialog;
pub use files::Files;
#[cfg(target_arch = "wasm32")]
pub use mirror::Mirror;
#[cfg(not(target_arch = "wasm32"))]
pub use native::*;
#[cfg(target_arch = "wasm32")]
pub use web::*;
