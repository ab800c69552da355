//! What stands round the view: each panel shows a part of what is known, and tells what people ask for.

mod bar;
mod gallery;
mod help;
mod icon;
mod leaving;
mod meters;
mod plots;
mod summary;
mod text;
mod thumbnails;
mod why;

pub use bar::bar;
pub use gallery::{Gallery, beside};
pub use help::help;
pub use leaving::leaving;
pub use meters::{Meters, Tool};
pub use plots::plots;
pub use summary::summary;
pub use text::{Asked, text};
pub use why::Why;
