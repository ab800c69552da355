//! Recording: a scene played once more from its start, beside the one that people watch, into a file.
//!
//! A [`Job`] makes the steps and writes; in a window it works in a thread of its own, in a web page a slice of each frame:
//! either is a [`Recording`]. What it writes is what `throng run` writes of the same scene and seed.

mod job;
mod source;
mod take;
#[cfg(not(target_arch = "wasm32"))]
mod threaded;

pub use job::Job;
pub use source::{Source, Subject, Which};
pub use take::{Format, Take};
#[cfg(not(target_arch = "wasm32"))]
pub use threaded::Threaded;

/// A recording under way; dropped, it stops and leaves nothing.
#[cfg(not(target_arch = "wasm32"))]
pub type Recording = Threaded;
/// A recording under way; dropped, it stops and leaves nothing.
#[cfg(target_arch = "wasm32")]
pub type Recording = Job;

/// What begins the file of a recording.
pub type Begin = fn(&std::path::Path, &throng_draw::record::Plan) -> Result<throng_draw::record::Recorder, String>;
