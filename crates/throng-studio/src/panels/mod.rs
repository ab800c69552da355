//! What stands round the view: each panel shows a part of what is known, and tells what people ask for.

mod bar;
mod chosen;
mod gallery;
mod help;
mod icon;
mod key;
mod layers;
mod leaving;
mod meters;
mod models;
mod naming;
mod plots;
mod record;
mod summary;
mod text;
mod thumbnails;
mod tools;
mod tuning;
mod why;

pub use bar::bar;
pub use chosen::Chosen;
pub use gallery::{Gallery, beside};
pub use help::help;
pub use key::key;
pub use layers::layers;
pub use leaving::leaving;
pub use meters::{Meters, Tool};
pub use models::{beside_by, name_of_models};
pub use naming::Naming;
pub use plots::plots;
pub use record::{Beside, Record, Recorded, Wish};
pub use summary::summary;
pub use text::{Asked, text};
pub use tools::{tool_options, tools};
pub use tuning::{Tuned, Tuning};
pub use why::Why;
