//! Tests of the library as its users call it.

#[path = "../shared/area.rs"]
mod area;
mod avoid;
#[path = "../shared/draw.rs"]
mod draw;
mod guard;
#[path = "../shared/irregular.rs"]
mod irregular;
mod navigation;
#[path = "../shared/oracle.rs"]
mod oracle;
mod pathway;
mod perceive;
mod pipeline;
#[path = "../shared/polygons.rs"]
mod polygons;
#[path = "../shared/kept.rs"]
mod results;
mod surfaces;
mod vehicle;
#[path = "../shared/vehicles.rs"]
mod vehicles;
mod world;
