//! The body of an agent: a rounded rectangle along the heading.

use super::{Agent, Columns};
use crate::space::Core;
use glam::{DVec2, DVec3, Vec2, Vec3};
use serde::{Deserialize, Serialize};

/// Fraction by which [local models](crate::avoid) enlarge two bodies compared with the [guard](crate::guard). Without it the guard must act
/// in every contact, which jams corridors. With 8 % bodies form arches at doors.
pub const MARGIN: f32 = 0.03;
/// [`MARGIN`] for time steps of 0.1 s and longer.
pub const MARGIN_LONG_STEP: f32 = 0.05;

/// Radius of the corners of a rectangle, as a part of its shorter side.
const ROUNDING: f32 = 0.1;

/// A body: all points within `radius` of a rectangle along the heading, the core. Metres.
///
/// ```
/// use throng::motion::Vehicle;
/// use throng::{Agent, Body};
/// let car = Agent::default().motor(Vehicle::default()).with_body(Body::rectangle(4.2, 1.8));
/// assert!((car.radius + car.core.x - 2.1).abs() < 1e-6 && (car.radius - 0.18).abs() < 1e-6);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Body {
    /// Half extents of the core along and across the heading; zero for a disc. Limit: 0 to 1000.
    pub core: Vec2,
    /// Distance that the body extends beyond its core. Limit: 0.001 to 1000.
    pub radius: f32,
}

impl Body {
    /// Returns a disc.
    pub fn disc(radius: f32) -> Self {
        Self { core: Vec2::ZERO, radius }
    }

    /// Returns a capsule: a rectangle with half discs at both ends. A `length` less than the `width` makes a disc of
    /// that width.
    pub fn capsule(length: f32, width: f32) -> Self {
        Self { core: Vec2::new(0.5 * (length - width).max(0.0), 0.0), radius: 0.5 * width }
    }

    /// Returns a rectangle with rounded corners: their radius is a tenth of the shorter side.
    pub fn rectangle(length: f32, width: f32) -> Self {
        let radius = ROUNDING * length.min(width);
        Self { core: Vec2::new(0.5 * length - radius, 0.5 * width - radius), radius }
    }

    /// Returns the bounding radius: the radius of the disc about the centre that contains the body at any heading.
    pub fn bounding_radius(&self) -> f32 {
        self.radius + self.core.length()
    }

    /// Returns the clearance radius, half of the narrower side: the body, turned accordingly, passes where a disc of
    /// this radius passes.
    pub fn clearance_radius(&self) -> f32 {
        self.radius + self.core.min_element()
    }
}

impl Agent {
    /// Returns the body.
    pub fn body(&self) -> Body {
        Body { core: self.core, radius: self.radius }
    }

    /// Returns the same agent with another body.
    pub fn with_body(self, Body { core, radius }: Body) -> Self {
        Self { core, radius, ..self }
    }
}

impl Columns {
    /// Returns the body of an agent.
    pub fn body(&self, row: usize) -> Body {
        Body { core: self.core[row], radius: self.radius[row] }
    }

    /// Returns the bodies that occur: one if all bodies are the same.
    pub(crate) fn bodies(&self) -> impl Iterator<Item = Body> {
        let rows = if self.core.uniform().is_some() { self.radius.values().len() } else { self.len() };
        (0..rows).map(|row| self.body(row))
    }

    /// Whether the body is a disc. The heading of a disc does not affect contacts.
    pub fn is_disc(&self, row: usize) -> bool {
        self.core[row] == Vec2::ZERO
    }

    /// Returns the core of the body at its present position.
    pub fn core_of(&self, row: usize) -> Core {
        Core::new(self.position[row].as_dvec2(), self.heading[row], self.core[row])
    }

    /// Returns the centre of an agent in space.
    pub(crate) fn center(&self, row: usize) -> DVec3 {
        self.position[row].as_dvec2().extend(f64::from(self.altitude[row]))
    }

    /// Returns how much higher another agent is. It is 0 unless both are discs, because other bodies count as upright
    /// columns without end.
    #[inline]
    pub fn above(&self, row: usize, other: usize) -> f32 {
        let above = self.altitude[other] - self.altitude[row];
        if above == 0.0 || self.is_disc(row) && self.is_disc(other) { above } else { 0.0 }
    }

    /// Returns [`offset`](Self::offset) and [`above`](Self::above) as one vector: bodies touch when its length is the
    /// sum of their radii.
    pub fn offset_in_space(&self, row: usize, other: usize) -> Vec3 {
        self.offset(row, other).extend(self.above(row, other))
    }

    /// Whether one agent is so far above the other that the two pass clear of each other, with all margins that local
    /// models add to bodies.
    pub(crate) fn passes_clear(&self, row: usize, other: usize) -> bool {
        let radii = (self.radius[row] + self.radius[other]) * (1.0 + MARGIN_LONG_STEP);
        self.above(row, other).abs() >= radii + (self.tracking_error[row] + self.tracking_error[other])
    }

    /// Returns the offset from the core of one agent to the core of another, between their nearest points, along the
    /// ground. For discs it is the offset of the centres; for overlapping cores it is zero.
    pub fn offset(&self, row: usize, other: usize) -> Vec2 {
        if self.is_disc(row) && self.is_disc(other) {
            return self.position[other] - self.position[row];
        }
        let apart = self.core_of(row).separation(&self.core_of(other));
        (apart.normal * apart.distance.max(0.0)).as_vec2()
    }

    /// Returns the distance of the cores of two bodies, divided by the sum of their radii: 1 when they touch. For
    /// overlapping cores the distance is the negative of the least shift that parts them.
    pub(crate) fn separation(&self, row: usize, other: usize) -> f64 {
        let radii = f64::from(self.radius[row]) + f64::from(self.radius[other]);
        let distance = if self.is_disc(row) && self.is_disc(other) {
            self.center(row).distance(self.center(other))
        } else {
            self.core_of(row).separation(&self.core_of(other)).distance
        };
        distance / radii
    }

    /// Returns the velocity of the point of a body nearest to `from`, including its rotation.
    pub(crate) fn velocity_near(&self, row: usize, from: DVec2) -> Vec2 {
        if self.spin[row] == 0.0 {
            return self.velocity[row];
        }
        let arm = self.core_of(row).nearest(from) - self.position[row].as_dvec2();
        self.velocity[row] + arm.as_vec2().perp() * self.spin[row]
    }
}
