//! Surfaces, compared with brute force: samples of their boundaries, and independent formulas of their inside.

mod barriers;
mod facets;
mod heights;
mod meshes;
mod mistakes;
mod oracle;
mod shapes;
mod unions;
