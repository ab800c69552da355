//! Surfaces with a position and orientation.

use super::sweep::finite;
use super::{Bounds, Surface, SurfaceHit, SurfacePoint, Sweep};
use crate::error::Error;
use glam::{Mat3, Quat, Vec3};

/// A position and an orientation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    position: Vec3,
    /// A matrix, because products with quaternions are rounded differently on different processors.
    rotation: Mat3,
}

impl Pose {
    /// Returns the pose that rotates by `rotation`, then moves to `position`, metres. The quaternion may have any
    /// length.
    ///
    /// # Errors
    /// [`Error::Limit`] if either is not finite, or the quaternion has length zero.
    pub fn new(position: Vec3, rotation: Quat) -> Result<Self, Error> {
        finite("a position", position)?;
        let [x, y, z, w] = rotation.to_array();
        let length = (x * x + y * y + z * z + w * w).sqrt();
        Error::unless_positive("the length of a rotation", length)?;
        let [x, y, z, w] = [x, y, z, w].map(|part| part / length);
        let x_axis = Vec3::new(1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y));
        let y_axis = Vec3::new(2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x));
        Ok(Self { position, rotation: Mat3::from_cols(x_axis, y_axis, x_axis.cross(y_axis)) })
    }

    /// Returns the pose at a position, not rotated.
    ///
    /// # Errors
    /// [`Error::Limit`] if it is not finite.
    pub fn at(position: Vec3) -> Result<Self, Error> {
        Self::new(position, Quat::IDENTITY)
    }

    /// Returns the pose at a position, rotated about the z axis by `heading`, radians counter-clockwise from +x.
    ///
    /// # Errors
    /// [`Error::Limit`] if either is not finite.
    pub fn on_ground(position: Vec3, heading: f32) -> Result<Self, Error> {
        Error::unless_finite("a heading", heading.into())?;
        let (sin, cos) = libm::sincosf(0.5 * heading);
        Self::new(position, Quat::from_xyzw(0.0, 0.0, sin, cos))
    }

    /// Returns the position of the local origin, metres.
    pub fn position(self) -> Vec3 {
        self.position
    }

    pub(super) fn to_world(self, point: Vec3) -> Vec3 {
        self.rotation * point + self.position
    }

    pub(super) fn to_local(self, point: Vec3) -> Vec3 {
        self.direction_to_local(point - self.position)
    }

    pub(super) fn direction_to_world(self, direction: Vec3) -> Vec3 {
        self.rotation * direction
    }

    pub(super) fn direction_to_local(self, direction: Vec3) -> Vec3 {
        let Mat3 { x_axis, y_axis, z_axis } = self.rotation;
        Vec3::new(direction.dot(x_axis), direction.dot(y_axis), direction.dot(z_axis))
    }
}

/// A surface with a pose. A surface that moves gets a new pose for each moment.
///
/// ```
/// use glam::{Vec2, Vec3};
/// use throng::space::surface::{Moved, Pose, Prism, Surface};
///
/// let slab = Prism::ground(&[Vec2::ZERO, Vec2::new(4.0, 0.0), Vec2::new(4.0, 1.0), Vec2::new(0.0, 1.0)])?;
/// let turned = Moved::new(slab, Pose::on_ground(Vec3::new(10.0, 0.0, 0.0), std::f32::consts::FRAC_PI_2)?);
/// assert!((turned.query(Vec3::new(7.0, 2.0, 0.0)).distance - 2.0).abs() < 1e-5);
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Moved<S> {
    /// The surface in its local coordinates.
    pub surface: S,
    /// Its pose.
    pub pose: Pose,
}

impl<S: Surface> Moved<S> {
    /// Returns the surface, given in local coordinates, at this pose.
    pub fn new(surface: S, pose: Pose) -> Self {
        Self { surface, pose }
    }
}

impl<S: Surface> Surface for Moved<S> {
    fn query(&self, point: Vec3) -> SurfacePoint {
        let near = self.surface.query(self.pose.to_local(point));
        let (point, normal) = (self.pose.to_world(near.point), self.pose.direction_to_world(near.normal));
        SurfacePoint { point, normal, ..near }
    }

    fn sweep(&self, sweep: &Sweep) -> Option<SurfaceHit> {
        let origin = self.pose.to_local(sweep.origin);
        let direction = self.pose.direction_to_local(sweep.direction);
        let hit = self.surface.sweep(&Sweep { origin, direction, ..*sweep })?;
        let (point, normal) = (self.pose.to_world(hit.point), self.pose.direction_to_world(hit.normal));
        Some(SurfaceHit { point, normal, ..hit })
    }

    fn facets(&self, within: &Bounds) -> Vec<Vec<Vec3>> {
        let within = Bounds::around(within.corners().map(|corner| self.pose.to_local(corner)));
        let mut facets = self.surface.facets(&within);
        facets.iter_mut().flatten().for_each(|corner| *corner = self.pose.to_world(*corner));
        facets
    }

    fn bounds(&self) -> Bounds {
        let bounds = self.surface.bounds();
        if !bounds.is_finite() {
            return Bounds::EVERYWHERE;
        }
        Bounds::around(bounds.corners().map(|corner| self.pose.to_world(corner)))
    }
}
