//! What an agent's body is: a rectangle along the heading, rounded.

use super::{Agent, Columns};
use crate::avoid::MARGIN_LONG_STEP;
use crate::space::Core;
use glam::{DVec2, DVec3, Vec2, Vec3};
use serde::{Deserialize, Serialize};

/// Part of the shorter side of a rectangle that the radius of its corners is.
const ROUNDING: f32 = 0.1;

/// A body: everything within `radius` of a rectangle that lies along the heading, the core. Metres.
///
/// ```
/// use throng::{Agent, Body};
/// let car = Agent { max_turn_rate: 0.6, ..Agent::default() }.with_body(Body::rectangle(4.2, 1.8));
/// assert!((car.radius + car.core.x - 2.1).abs() < 1e-6 && (car.radius - 0.18).abs() < 1e-6);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Body {
    /// Half extents of the core along and across the heading; zero for a disc. Limit: 0 to 1000.
    pub core: Vec2,
    /// How far the body reaches beyond its core. Limit: 0.001 to 1000.
    pub radius: f32,
}

impl Body {
    /// A disc.
    pub fn disc(radius: f32) -> Self {
        Self { core: Vec2::ZERO, radius }
    }

    /// A capsule: half discs at both ends. A `length` less than the `width` makes a disc of that width.
    pub fn capsule(length: f32, width: f32) -> Self {
        Self { core: Vec2::new(0.5 * (length - width).max(0.0), 0.0), radius: 0.5 * width }
    }

    /// A rectangle. Its corners are rounded: their radius is a tenth of the shorter side.
    pub fn rectangle(length: f32, width: f32) -> Self {
        let radius = ROUNDING * length.min(width);
        Self { core: Vec2::new(0.5 * length - radius, 0.5 * width - radius), radius }
    }

    /// Radius of the disc about the centre that holds the body at any heading.
    pub fn bound(&self) -> f32 {
        self.radius + self.core.length()
    }

    /// Half of the narrower side: the body passes where a disc of this radius does, once it has turned.
    pub fn girth(&self) -> f32 {
        self.radius + self.core.min_element()
    }
}

impl Agent {
    /// The body.
    pub fn body(&self) -> Body {
        Body { core: self.core, radius: self.radius }
    }

    /// The same agent with another body.
    pub fn with_body(self, Body { core, radius }: Body) -> Self {
        Self { core, radius, ..self }
    }
}

impl Columns {
    /// The body of an agent.
    pub fn body(&self, row: usize) -> Body {
        Body { core: self.core[row], radius: self.radius[row] }
    }

    /// The bodies that occur: one if all are the same.
    pub(crate) fn bodies(&self) -> impl Iterator<Item = Body> {
        let rows = if self.core.uniform().is_some() { self.radius.values().len() } else { self.len() };
        (0..rows).map(|row| self.body(row))
    }

    /// Whether the body is a disc: then its heading touches nobody.
    pub fn is_disc(&self, row: usize) -> bool {
        self.core[row] == Vec2::ZERO
    }

    /// The core of the body, where it is now.
    pub fn core_of(&self, row: usize) -> Core {
        Core::new(self.position[row].as_dvec2(), self.heading[row], self.core[row])
    }

    /// The centre of an agent, and its altitude.
    pub(crate) fn center(&self, row: usize) -> DVec3 {
        self.position[row].as_dvec2().extend(f64::from(self.altitude[row]))
    }

    /// How much higher another is: 0 where one of the two is no disc, since those stand upright without end.
    #[inline]
    pub fn above(&self, row: usize, other: usize) -> f32 {
        let above = self.altitude[other] - self.altitude[row];
        if above == 0.0 || self.is_disc(row) && self.is_disc(other) { above } else { 0.0 }
    }

    /// [`offset`](Self::offset) and [`above`](Self::above) together: bodies touch when it is as long as the sum of their
    /// radii.
    pub fn offset_in_space(&self, row: usize, other: usize) -> Vec3 {
        self.offset(row, other).extend(self.above(row, other))
    }

    /// Whether one is so far above the other that the two pass clear of each other, with all that models add to bodies.
    pub(crate) fn passes_clear(&self, row: usize, other: usize) -> bool {
        let radii = (self.radius[row] + self.radius[other]) * (1.0 + MARGIN_LONG_STEP);
        self.above(row, other).abs() >= radii + (self.tracking_error[row] + self.tracking_error[other])
    }

    /// From the point of an agent's core that is nearest to another's core to that one's nearest point, along the
    /// ground; from centre to centre of discs. Cores that overlap: zero.
    pub fn offset(&self, row: usize, other: usize) -> Vec2 {
        if self.is_disc(row) && self.is_disc(other) {
            return self.position[other] - self.position[row];
        }
        let apart = self.core_of(row).separation(&self.core_of(other));
        (apart.normal * apart.distance.max(0.0)).as_vec2()
    }

    /// Distance of the cores of two bodies over the sum of their radii: 1 when they touch. Where the cores overlap, the
    /// negative of the least shift that parts them takes the place of the distance.
    pub(crate) fn separation(&self, row: usize, other: usize) -> f64 {
        let radii = f64::from(self.radius[row]) + f64::from(self.radius[other]);
        let distance = if self.is_disc(row) && self.is_disc(other) {
            self.center(row).distance(self.center(other))
        } else {
            self.core_of(row).separation(&self.core_of(other)).distance
        };
        distance / radii
    }

    /// The velocity of the point of a body nearest to `from`, its turning included.
    pub(crate) fn velocity_near(&self, row: usize, from: DVec2) -> Vec2 {
        if self.spin[row] == 0.0 {
            return self.velocity[row];
        }
        let arm = self.core_of(row).nearest(from) - self.position[row].as_dvec2();
        self.velocity[row] + arm.as_vec2().perp() * self.spin[row]
    }
}
