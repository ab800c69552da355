//! Geometry that checks and fills a scene. World coordinates, f64.

mod polygon;
mod solid;
mod spacing;

pub(crate) use polygon::{
    bounds, contains, crossing, distance_to_segment, grown, outline_of_region, points, rectangle, signed_area,
};
pub(crate) use solid::{Solid, Touch};
pub(crate) use spacing::Spacing;

pub(crate) use glam::{DVec2, DVec3};
