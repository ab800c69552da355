//! Tests of pictures against ray casting, and of their promises.

mod depth;
mod light;
mod limits;
mod scene;
