//! Protection of unsaved work: a question before it would be lost, and a draft that survives the studio.

mod draft;
mod leaving;
mod remembered;

pub use draft::Draft;
pub use leaving::{Answer, Leaving, Unfinished};
pub use remembered::{remember, remembered};
