//! What is safe: local models turn the preferred velocity into a new one.

mod orca;

pub use orca::Orca;

/// A local model.
pub trait LocalModel: std::fmt::Debug + Send + Sync {}
