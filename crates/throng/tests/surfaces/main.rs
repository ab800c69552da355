//! Surfaces against brute force: samples of their boundaries, and whether points are inside by another formula.

mod barriers;
mod facets;
mod heights;
mod meshes;
mod mistakes;
mod oracle;
mod shapes;
mod unions;
