//! Recording: a scene is run again from its start into a file, independently of the displayed run.
//!
//! A [`Job`] makes the steps and writes the file. In a window it works in its own thread, in a web page for a time
//! slice of each frame. Both are a [`Recording`]. The output equals that of `throng run` for the same scene and seed.

mod job;
mod source;
mod take;
#[cfg(not(target_arch = "wasm32"))]
mod threaded;

pub use job::Job;
pub use source::{Source, Subject, Which};
pub use take::{Format, Take};
#[cfg(not(target_arch = "wasm32"))]
pub use threaded::ThreadedJob;

/// A recording under way. Dropping it before it is complete removes its file.
#[cfg(not(target_arch = "wasm32"))]
pub type Recording = ThreadedJob;
/// A recording under way. Dropping it before it is complete removes its file.
#[cfg(target_arch = "wasm32")]
pub type Recording = Job;

/// Creates the output of a recording.
pub type Begin = fn(&std::path::Path, &throng_draw::record::Plan) -> Result<throng_draw::record::Recorder, String>;
