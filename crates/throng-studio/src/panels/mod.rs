//! What stands round the view: each panel shows a part of what is known, and tells what people ask for.

mod bar;
mod gallery;
mod help;
mod icon;
mod models;
mod summary;
mod text;
mod thumbnails;
mod tuning;
mod why;

pub use bar::bar;
pub use gallery::{Gallery, beside};
pub use help::help;
pub use models::{beside_by, name_of_models};
pub use summary::summary;
pub use text::{Asked, text};
pub use tuning::{Tuned, Tuning};
pub use why::Why;
