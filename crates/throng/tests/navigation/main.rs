//! The navigation mesh and its paths, against slow and simple oracles.

mod ground;
mod mesh;
mod oracle;
mod paths;
mod plans;
mod routes;
mod sight;
