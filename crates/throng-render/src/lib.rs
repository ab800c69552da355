//! Pictures of scenes in three dimensions, rendered by the processor.
//!
//! A [`Scene`] has ground, bodies of triangles, and lines; a [`View`] is a perspective; [`Picture::render`] makes the
//! picture: with a depth buffer of four samples a pixel, a sun with soft shadows, the light of the sky with ambient
//! occlusion, materials, glass, and haze. It needs no graphics card and no system library, and the bytes of a picture are
//! the same for any number of threads.
//!
//! The steps, in the order of the code in [`Picture::render`]:
//!
//! 1. Triangles are placed before the viewpoint, cut, and sorted into bands of rows (`geometry`).
//! 2. Bands are covered in parallel: each sample keeps the nearest triangle (`raster`, `samples`).
//! 3. A map from the sun gives shadows (`shadow`); neighbouring pixels give ambient occlusion (`occlusion`).
//! 4. Each pixel is coloured once for each triangle that it sees, several pixels at once (`shade`, `simd`).
//! 5. Lines and glass are laid over (`layers`, `lines`).
//! 6. A curve maps light to bytes (`tone`).

mod coarse;
mod front;
mod geometry;
mod layers;
mod light;
mod lines;
mod material;
mod mesh;
mod occlusion;
mod parallel;
mod raster;
mod render;
mod samples;
mod scene;
mod shade;
mod shadow;
mod simd;
mod tone;
mod view;

pub use light::{Haze, Light, Sky, Sun};
pub use material::{Material, Pattern};
pub use mesh::{Mesh, MeshError};
pub use render::{Picture, SizeError};
pub use scene::{Area, Body, Line, LineEnd, Scene};
pub use tone::linear;
pub use view::View;
