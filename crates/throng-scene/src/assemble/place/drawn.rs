//! Placements that draw a position for each agent.

use super::fixed::level;
use crate::assemble::check::{check_points, check_rectangle};
use crate::assemble::ground::check_polygon;
use crate::assemble::limits::{Limit, MAX_COORDINATE, check, check_point};
use crate::error::Kind;
use crate::file::Problem;
use crate::geometry::{DVec2, DVec3, bounds, contains, points, rectangle};
use crate::random::Random;
use crate::registry::{BuildPlacement, Placement, PlacementContext};
use crate::scene::{DiscPlace, PolygonPlace, Rectangle, RectanglePlace, WalkablePlace};
use std::f64::consts::TAU;
use std::sync::Arc;

/// A shape in which positions are drawn.
struct Drawn {
    shape: Shape,
    gap: f64,
    center: Option<DVec3>,
}

enum Shape {
    /// The centre and the radius.
    Disc(DVec2, f64),
    /// A corner and the two sides from it.
    Parallelogram(DVec2, DVec2, DVec2),
    /// The corners of a polygon, and two corners of the box around it.
    Polygon(Vec<DVec2>, [DVec2; 2]),
    /// Two corners.
    Box([DVec2; 2]),
}

impl Placement for Drawn {
    fn position(&self, _: usize, _: usize, random: &mut Random) -> Option<DVec3> {
        let (a, b) = (random.unit(), random.unit());
        let at = match &self.shape {
            Shape::Disc(center, radius) => {
                let (sin, cos) = libm::sincos(TAU * a);
                *center + radius * libm::sqrt(b) * DVec2::new(cos, sin)
            }
            Shape::Parallelogram(corner, u, v) => *corner + a * *u + b * *v,
            Shape::Polygon(_, [low, high]) | Shape::Box([low, high]) => *low + (*high - *low) * DVec2::new(a, b),
        };
        let is_inside = match &self.shape {
            Shape::Polygon(corners, _) => contains(corners, at),
            _ => true,
        };
        is_inside.then(|| at.extend(0.0))
    }

    fn is_drawn(&self) -> bool {
        true
    }

    fn gap(&self) -> f64 {
        self.gap
    }

    fn center(&self) -> Option<DVec3> {
        self.center
    }
}

impl BuildPlacement for DiscPlace {
    fn make(self, at: &PlacementContext) -> Result<Arc<dyn Placement>, Problem> {
        check_point(&at.path.key("center"), &self.center)?;
        check(&at.path.key("radius"), self.radius, Limit::UpTo(MAX_COORDINATE))?;
        check(&at.path.key("gap"), self.gap, Limit::NotNegative)?;
        let shape = Shape::Disc(DVec2::from_array(self.center), self.radius);
        Ok(Arc::new(Drawn { shape, gap: self.gap, center: Some(level(self.center)) }))
    }
}

impl BuildPlacement for RectanglePlace {
    fn make(self, at: &PlacementContext) -> Result<Arc<dyn Placement>, Problem> {
        let sides = Rectangle { center: self.center, size: self.size, rotation: self.rotation };
        check_rectangle(&at.path, &sides)?;
        check(&at.path.key("gap"), self.gap, Limit::NotNegative)?;
        let corners = rectangle(&sides);
        let shape = Shape::Parallelogram(corners[0], corners[1] - corners[0], corners[3] - corners[0]);
        Ok(Arc::new(Drawn { shape, gap: self.gap, center: Some(level(self.center)) }))
    }
}

impl BuildPlacement for PolygonPlace {
    fn make(self, at: &PlacementContext) -> Result<Arc<dyn Placement>, Problem> {
        let path = at.path.key("corners");
        check_points(&path, &self.corners)?;
        check_polygon(&path, &self.corners, "the place")?;
        check(&at.path.key("gap"), self.gap, Limit::NotNegative)?;
        let corners = points(&self.corners);
        let around = bounds(corners.iter().copied()).unwrap_or_default();
        Ok(Arc::new(Drawn { shape: Shape::Polygon(corners, around), gap: self.gap, center: None }))
    }
}

impl BuildPlacement for WalkablePlace {
    fn make(self, at: &PlacementContext) -> Result<Arc<dyn Placement>, Problem> {
        check(&at.path.key("gap"), self.gap, Limit::NotNegative)?;
        let Some(around) = bounds(at.areas.iter().flat_map(|area| area.outer.iter().copied())) else {
            return Err(Problem::new(&at.path, Kind::MissingKey, "place.walkable needs walkable ground")
                .hint("add a `walkable` to the scene, or use place.rectangle"));
        };
        Ok(Arc::new(Drawn { shape: Shape::Box(around), gap: self.gap, center: None }))
    }
}
