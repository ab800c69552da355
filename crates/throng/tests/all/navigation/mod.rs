//! The navigation mesh and its paths, against slow and simple oracles.

mod ground;
mod kept;
mod mesh;
pub mod oracle;
mod paths;
mod routes;
mod sight;
