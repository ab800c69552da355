//! Fields that lead round walls.

use super::ForPlace;
use glam::{DVec2, Vec2, Vec3};
use std::fmt;
use std::sync::Arc;
use throng::Error;
use throng::field::{FactorMap, Field, FieldSpine};
use throng::parameters::parameters;
use throng::space::{NearWalls, Place, Walls};

/// Nearest points of walls closer than this, metres, count as one point.
const SAME: f64 = 1e-6;

/// A field corrected near walls: its component into a wall is removed, gradually within the width and completely at the
/// wall. The part removed is `1 - smoothstep(distance / width)`. The speed stays the same.
///
/// ```
/// use glam::{DVec2, Vec3};
/// use std::sync::Arc;
/// use throng::Obstacle;
/// use throng::field::Field;
/// use throng_field::{AroundWalls, Uniform};
/// use throng::space::Walls;
/// let walls = Walls::new(&[], &[Obstacle::Circle { center: DVec2::ZERO, radius: 2.0 }], DVec2::ZERO);
/// let field = AroundWalls::new(Arc::new(Uniform(Vec3::X)), walls, 1.5)?;
/// assert_eq!(field.velocity(Vec3::new(-5.0, 0.1, 0.0), 0.0), Vec3::X);
/// let beside = field.velocity(Vec3::new(-2.0, 0.1, 0.0), 0.0);
/// assert!(beside.y > 0.99, "the field turns aside");
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone)]
pub struct AroundWalls {
    field: Arc<dyn Field>,
    walls: Walls,
    width: f64,
}

impl AroundWalls {
    /// Creates the corrected field. The correction starts `width` metres from a wall; the walls are in metres from the
    /// origin.
    ///
    /// # Errors
    /// A width that is not greater than 0 and finite.
    pub fn new(field: Arc<dyn Field>, walls: Walls, width: f64) -> Result<Self, Error> {
        Error::unless(
            width > 0.0 && width.is_finite(),
            "width of a field's margin",
            width,
            "greater than 0 and finite",
        )?;
        Ok(Self { field, walls, width })
    }

    /// Returns the corrected velocity at a place.
    fn corrected(&self, at: DVec2, velocity: Vec2, near: &mut NearWalls) -> Vec2 {
        if velocity == Vec2::ZERO || self.walls.are_far(at, self.width) {
            return velocity;
        }
        self.walls.near(at, self.width, near);
        // edges that meet at a corner, and the two sides of a thin wall, share a nearest point, which counts once
        let mut last = DVec2::INFINITY;
        let edges = near.edges.iter().filter_map(|&(distance, edge)| {
            let edge = &self.walls.edges()[edge as usize];
            let nearest = edge.nearest(at);
            let is_new = nearest.distance_squared(last) > SAME * SAME;
            last = nearest;
            // on the wall itself: the direction away from the solid side, which is on the left of the edge
            let out = || (at - nearest).try_normalize().unwrap_or(-edge.direction.as_dvec2().perp());
            is_new.then(|| (distance, out()))
        });
        let discs = near.discs.iter().map(|&(distance, disc)| {
            (distance.max(0.0), (at - self.walls.discs()[disc as usize].center).normalize_or(DVec2::X))
        });
        let left = edges.chain(discs).fold(velocity.as_dvec2(), |left, (distance, out)| {
            let part = distance / self.width;
            let taken = 1.0 - part * part * (3.0 - 2.0 * part);
            left - out * (taken * left.dot(out).min(0.0))
        });
        if left == velocity.as_dvec2() {
            return velocity;
        }
        // in a corner only rounding errors remain, which give no direction
        let speed = f64::from(velocity.length());
        if left.length() < 1e-3 * speed { Vec2::ZERO } else { (left.normalize() * speed).as_vec2() }
    }
}

impl Field for AroundWalls {
    fn velocity(&self, place: Vec3, time: f64) -> Vec3 {
        let velocity = self.field.velocity(place, time);
        let left = self.corrected(place.truncate().as_dvec2(), velocity.truncate(), &mut NearWalls::default());
        left.extend(velocity.z)
    }

    fn row(&self, (first, step): (DVec2, f64), from: usize, time: f64, out: &mut [Vec2]) {
        self.field.row((first, step), from, time, out);
        let mut near = NearWalls::default();
        for (velocity, index) in out.iter_mut().zip(from..) {
            *velocity = self.corrected(first + DVec2::X * (index as f64 * step), *velocity, &mut near);
        }
    }

    fn cover(&self) -> Option<Arc<dyn FactorMap>> {
        self.field.cover()
    }

    fn spine(&self) -> Option<FieldSpine> {
        self.field.spine()
    }
}

/// A field that is deflected around obstacles.
///
/// Near them its component into them is removed. The obstacles are all obstacles and edges of the ground of a scene.
#[parameters(name = "around_walls")]
pub(super) struct AroundAllWalls {
    /// The field.
    #[parameter(required)]
    of: Arc<dyn Field>,
    /// Distance from which on it is deflected, metres.
    #[parameter(default = 1.0, unit = "m", above = 0)]
    width: f64,
}

impl ForPlace for AroundAllWalls {
    fn for_place(self, place: &Place, origin: DVec2) -> Result<impl Field + 'static, Error> {
        AroundWalls::new(self.of, Walls::new(&place.areas, place.obstacles(), origin), self.width)
    }
}

impl fmt::Debug for AroundWalls {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("AroundWalls").field("width", &self.width).finish_non_exhaustive()
    }
}
