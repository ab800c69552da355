//! Pictures and video of worlds.
//!
//! [`Film`] turns the moments of a recording into a file of the kind its name says: MP4 or GIF, PNG or SVG, a folder of
//! PNG files, or any other video that an installed ffmpeg writes; a [`Sheet`] shows several recordings side by side, and a
//! [`Contact`] sheet a still of each of many.
//! [`Painter`] paints single moments into memory, with the look that [`Style`] describes; [`Figure`] draws why one
//! agent goes where it goes; [`sink`] holds the kinds of output for pictures of any origin, [`record`]
//! writes all files of a run while it goes on.

mod annotate;
mod base64;
mod camera;
mod cells;
mod color;
mod contact;
mod error;
mod figure;
mod film;
mod flow;
mod image;
mod insect;
mod legend;
mod look;
mod mark;
mod painter;
mod picture;
mod place;
mod plan;
mod projector;
mod raster;
pub mod record;
mod ribbon;
mod rounded;
mod said;
mod shape;
mod sheet;
pub mod sink;
mod space;
mod style;
mod svg;
mod text;
mod trail;

pub use annotate::{Annotation, Annotations, Annotator};
pub use base64::base64;
pub use camera::{Camera, WorldBox};
pub use color::{Color, PALETTE, palette, ramp, wheel};
pub use contact::{Contact, Section};
pub use error::Error;
pub use figure::Figure;
pub use film::{Film, Still};
pub use flow::{FlowLayer, FlowMarks, FlowStyle};
pub use image::Image;
pub use look::{Coat, Look};
pub use mark::{Anchor, Mark, Stroke};
pub use painter::Painter;
pub use place::points_to_go;
pub use projector::Projector;
pub use shape::{Shape, Vertex};
pub use sheet::{Sheet, columns, title_height};
pub use sink::FrameSink;
pub use space::{Chase, Followed, Following, Lens, Sight, Viewpoint};
pub use style::{ColorBy, Form, Projection, Style, Theme};
pub use text::Typeface;
pub use trail::{Track, Trails};
