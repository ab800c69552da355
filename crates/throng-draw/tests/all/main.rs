//! Tests of pictures and video.

mod annotations;
mod common;
mod figures;
mod films;
mod flows;
mod framing;
mod insects;
mod people;
mod pictures;
mod places;
mod shapes;
mod sheets;
mod shells;
mod space;
