//! What keeps unsaved work: a question before it would be lost, and a draft that outlives the studio.

mod draft;
mod leaving;
mod remembered;

pub use draft::Draft;
pub use leaving::{Answer, Leaving};
pub use remembered::{remember, remembered};
