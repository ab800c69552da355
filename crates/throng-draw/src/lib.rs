//! Pictures and video of worlds.
//!
//! [`Film`] turns the moments of a recording into a file; the name determines its kind: MP4 or GIF, PNG or SVG, a
//! folder of PNG files, or any other video that an installed ffmpeg writes. A [`Sheet`] shows several recordings side
//! by side, and a [`Contact`] sheet shows a still of each of many recordings. [`Painter`] paints single moments into
//! memory, in the look that [`Style`] describes. [`Figure`] draws why one agent chooses its velocity. [`sink`] holds
//! the kinds of output for pictures of any origin. [`record`] writes all files of a run while it proceeds. [`page`] has the parts of web
//! pages, with a player of recordings.

mod annotate;
mod camera;
mod cells;
mod color;
mod contact;
mod error;
mod exposure;
mod figure;
mod film;
mod flow;
mod from_scene;
#[cfg(test)]
mod harness;
mod image;
mod insect;
mod legend;
mod look;
pub mod page;
mod painter;
mod picture;
mod place;
mod plan;
mod primitive;
mod projector;
mod raster;
pub mod record;
mod ribbon;
mod rounded;
mod shape;
mod sheet;
pub mod sink;
mod space;
mod style;
mod svg;
mod text;
mod trail;
mod vehicle;

pub use annotate::{Annotation, Annotations, Annotator};
pub use camera::{Camera, WorldBox};
pub use color::{Color, PALETTE, PALETTE_ON_DARK, palette, ramp, wheel};
pub use contact::{Contact, Section};
pub use error::Error;
pub use exposure::MotionBlur;
pub use figure::Figure;
pub use film::{Film, Still};
pub use flow::{FlowLayer, FlowMarks, FlowStyle};
pub use image::Image;
pub use look::{Coat, Look};
pub use painter::Painter;
pub use place::points_to_go;
pub use primitive::{Anchor, Primitive, Stroke};
pub use projector::Projector;
pub use shape::{Shape, Vertex};
pub use sheet::{Sheet, columns, title_height};
pub use sink::FrameSink;
pub use space::{CameraKey, Chase, FilmCamera, Followed, Following, Lens, Motion, Sight, Sun, Viewpoint};
pub use style::{AgentShape, ColorBy, Projection, Style, Theme};
pub use text::Typeface;
pub use trail::{AgentTrail, Trails};
