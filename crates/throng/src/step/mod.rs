//! The step: the stages of a sub-step, one after the other, and what is measured in it.

mod measure;
mod pipeline;
mod stage;

pub(crate) use pipeline::Pipeline;
pub use stage::Stage;
