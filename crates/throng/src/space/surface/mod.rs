//! Surfaces in space, and what steering asks of them: the nearest point, what is ahead, inside or outside.
//!
//! Containment, wall following, obstacle avoidance and hiding see no shapes, only this protocol (Reynolds, *Steering
//! Behaviors for Autonomous Characters*, GDC 1999, the sections on these behaviours): a [`Surface`] answers with the
//! nearest point, its normal and the signed distance, and with the first thing that a ball touches on its way. A
//! [`Barrier`] adds from which side it is seen: the inside of a solid is a container.
//!
//! Everything is in metres, in a space with z up; the plane of those on foot is z = 0, and [`Prism::ground`] makes
//! ground plans of polygons. Coordinates are `f32`, relative to an origin of the caller's choice.
//!
//! ```
//! use glam::Vec3;
//! use throng::space::surface::{Barrier, SeenFrom, Sphere, Surface};
//!
//! let ball = Sphere::new(Vec3::new(10.0, 0.5, 0.0), 2.0)?;
//! let near = ball.query(Vec3::new(10.0, 0.5, 5.0));
//! assert_eq!((near.point, near.normal, near.distance), (Vec3::new(10.0, 0.5, 2.0), Vec3::Z, 3.0));
//!
//! let seen = Barrier::new(ball, SeenFrom::Outside);
//! let ahead = seen.ahead(Vec3::ZERO, Vec3::X, 0.5, 20.0).expect("it is in the way");
//! assert!((ahead.distance - (10.0 - 6.0f32.sqrt())).abs() < 1e-4);
//! assert!(ahead.steer_hint.y < 0.0, "its middle is on the left: pass on the right");
//! # Ok::<(), throng::Error>(())
//! ```

mod barrier;
mod bounds;
mod bvh;
mod capsule;
mod cuboid;
mod cylinder;
mod extrude;
mod facets;
mod heights;
mod mesh;
mod moved;
mod plane;
mod prism;
mod sphere;
mod sweep;
mod topology;
mod triangle;
mod union;
mod upright;

pub use barrier::{Barrier, PathIntersection, Room, SeenFrom};
pub use bounds::Bounds;
pub(crate) use bvh::Bvh;
pub use capsule::Capsule;
pub use cuboid::Cuboid;
pub use cylinder::Cylinder;
pub use heights::HeightField;
pub use mesh::Mesh;
pub use moved::{Moved, Pose};
pub use plane::Plane;
pub use prism::Prism;
pub use sphere::Sphere;
pub use sweep::Sweep;
pub(crate) use sweep::rounding;
pub use union::Union;

use glam::Vec3;
use std::fmt::Debug;
use std::sync::Arc;

/// Something with a surface: a solid, or a sheet with two sides and no inside.
///
/// Points that are not finite get answers without meaning, never a panic.
pub trait Surface: Debug + Send + Sync {
    /// The point of the surface nearest to `point`.
    fn query(&self, point: Vec3) -> SurfacePoint;

    /// Where a ball first touches the surface from the side on which its centre starts. One that touches at the start
    /// and moves on into it touches at distance 0. What it touches at the start and moves away from does not count; a
    /// surface of several parts (walls, triangles, members) tells this part by part.
    fn sweep(&self, sweep: &Sweep) -> Option<SurfaceHit>;

    /// A box that holds the surface, and the solid if there is one.
    fn bounds(&self) -> Bounds;

    /// It as flat polygons, to be drawn: corners go counter-clockwise seen from outside. Of what has no end, the part
    /// within a box. None where nothing is to be drawn.
    fn facets(&self, _within: &Bounds) -> Vec<Vec<Vec3>> {
        Vec::new()
    }

    /// Where a ray first crosses the surface, from outside or inside, within `reach` metres. `direction` is a unit
    /// vector. A start on the surface itself, give or take rounding, counts as either side.
    fn ray(&self, origin: Vec3, direction: Vec3, reach: f32) -> Option<SurfaceHit> {
        self.sweep(&Sweep { origin, direction, radius: 0.0, reach })
    }
}

/// The point of a surface that is nearest to another, `p`. `p = point + normal * distance`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// The nearest point of the surface; of several, one of them.
    pub point: Vec3,
    /// Unit vector out of the solid along which `p` and the nearest point are apart: where the distance grows fastest.
    /// Of a sheet it points to the side that `p` is on.
    pub normal: Vec3,
    /// Distance between `p` and the surface, metres: negative inside a solid, never negative for a sheet.
    pub distance: f32,
}

impl SurfacePoint {
    /// Whether `p` is inside the solid.
    pub fn is_inside(&self) -> bool {
        self.distance < 0.0
    }

    /// The normal on the side of `p`.
    pub fn free(&self) -> Vec3 {
        if self.is_inside() { -self.normal } else { self.normal }
    }
}

/// What a moving ball, or a ray, touches first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceHit {
    /// How far the centre of the ball goes until then, metres.
    pub distance: f32,
    /// The point of the surface that it touches.
    pub point: Vec3,
    /// Unit normal there, out of the solid; of a sheet, to the side that the ball comes from.
    pub normal: Vec3,
    /// Whether the ball comes from outside the solid; true for sheets.
    pub from_outside: bool,
}

impl SurfaceHit {
    /// The same touch of a sheet as that of a solid whose boundary the sheet is.
    fn of_solid(self, from_outside: bool) -> Self {
        let normal = if from_outside { self.normal } else { -self.normal };
        Self { normal, from_outside, ..self }
    }
}

/// What holds a surface is one.
macro_rules! holders {
    ($($holder:ty,)*) => { $(
        impl<S: Surface + ?Sized> Surface for $holder {
            fn query(&self, point: Vec3) -> SurfacePoint {
                (**self).query(point)
            }

            fn sweep(&self, sweep: &Sweep) -> Option<SurfaceHit> {
                (**self).sweep(sweep)
            }

            fn bounds(&self) -> Bounds {
                (**self).bounds()
            }

            fn facets(&self, within: &Bounds) -> Vec<Vec<Vec3>> {
                (**self).facets(within)
            }
        }
    )* };
}

holders! {
    &S,
    Box<S>,
    Arc<S>,
}
