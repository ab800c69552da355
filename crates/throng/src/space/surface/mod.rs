//! Surfaces in space, with the queries of steering: the nearest point, the first obstacle ahead, inside or outside.
//!
//! Containment, wall following, obstacle avoidance and hiding do not depend on shapes but on this protocol (Reynolds,
//! *Steering Behaviors for Autonomous Characters*, GDC 1999, the sections on these behaviours). A [`Surface`] returns
//! the nearest point, its normal and the signed distance, and the first contact of a moving ball. A [`Barrier`] adds
//! the side on which agents are: the inside of a solid is a container.
//!
//! Coordinates are in metres with z up. Pedestrians walk in the plane z = 0, and [`Prism::ground`] turns polygons into
//! ground plans. Coordinates are `f32`, relative to an origin of the caller's choice.
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
//! assert!(ahead.steer_hint.y < 0.0, "its centre is on the left: pass on the right");
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

pub use barrier::{Barrier, BarrierClearance, PathIntersection, SeenFrom};
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

/// A surface: that of a solid, or a sheet with two sides and no inside.
///
/// For points that are not finite the results are meaningless, but no method panics.
pub trait Surface: Debug + Send + Sync {
    /// Returns the point of the surface nearest to `point`.
    fn query(&self, point: Vec3) -> SurfacePoint;

    /// Returns the first contact of a moving ball with the surface, on the side on which its centre starts. A ball that
    /// touches at the start and moves on into the surface has a contact at distance 0. A contact at the start from
    /// which the ball moves away does not count. A surface of several parts (walls, triangles, members) applies this to
    /// each part separately.
    fn sweep(&self, sweep: &Sweep) -> Option<SurfaceHit>;

    /// Returns a bounding box of the surface, and of the solid if there is one.
    fn bounds(&self) -> Bounds;

    /// Returns the surface as flat polygons for drawing. Corners are counter-clockwise seen from outside. An infinite
    /// surface is cut off at the box `within`. The result is empty if there is nothing to draw.
    fn facets(&self, _within: &Bounds) -> Vec<Vec<Vec3>> {
        Vec::new()
    }

    /// Returns the first crossing of a ray with the surface, from outside or inside, within `reach` metres. `direction`
    /// is a unit vector. A start within rounding of the surface counts as either side.
    fn ray(&self, origin: Vec3, direction: Vec3, reach: f32) -> Option<SurfaceHit> {
        self.sweep(&Sweep { origin, direction, radius: 0.0, reach })
    }
}

/// The point of a surface nearest to a point `p`. `p = point + normal * distance`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// The nearest point of the surface; if there are several, any of them.
    pub point: Vec3,
    /// Unit vector out of the solid, along the line between `p` and the nearest point: the direction in which the
    /// distance grows fastest. For a sheet it points to the side of `p`.
    pub normal: Vec3,
    /// Distance between `p` and the surface, metres: negative inside a solid, never negative for a sheet.
    pub distance: f32,
}

impl SurfacePoint {
    /// Whether `p` is inside the solid.
    pub fn is_inside(&self) -> bool {
        self.distance < 0.0
    }

    /// Returns the normal on the side of `p`.
    pub fn free(&self) -> Vec3 {
        if self.is_inside() { -self.normal } else { self.normal }
    }
}

/// The first contact of a moving ball or a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceHit {
    /// Distance that the centre of the ball moves before the contact, metres.
    pub distance: f32,
    /// The point of contact on the surface.
    pub point: Vec3,
    /// Unit normal there, out of the solid; for a sheet, to the side from which the ball comes.
    pub normal: Vec3,
    /// Whether the ball comes from outside the solid; true for sheets.
    pub from_outside: bool,
}

impl SurfaceHit {
    /// Returns the contact with a sheet as a contact with the solid that the sheet bounds.
    fn of_solid(self, from_outside: bool) -> Self {
        let normal = if from_outside { self.normal } else { -self.normal };
        Self { normal, from_outside, ..self }
    }
}

/// Implements [`Surface`] for references and smart pointers to surfaces.
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
