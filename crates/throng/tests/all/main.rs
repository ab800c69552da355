//! Tests of the library as its users call it.

mod avoid;
#[path = "../shared/draw.rs"]
mod draw;
mod field;
mod guard;
mod navigation;
mod pathway;
mod perceive;
mod pipeline;
#[path = "../shared/polygons.rs"]
mod polygons;
#[path = "../shared/kept.rs"]
mod results;
mod steer;
mod surfaces;
mod swarm;
mod world;
