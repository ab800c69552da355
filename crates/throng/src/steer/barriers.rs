//! A list of obstacles and containers.

use crate::space::surface::{Barrier, PathIntersection, SeenFrom, Surface, SurfacePoint};
use glam::Vec3;
use std::sync::Arc;

/// The obstacles and containers that a behaviour queries, metres in the coordinates of its
/// [`SteeringInput`](crate::steer::SteeringInput); clones share the surfaces.
///
/// ```
/// use glam::Vec3;
/// use throng::space::surface::{Plane, SeenFrom, Sphere};
/// use throng::steer::Barriers;
///
/// let ball = Sphere::new(Vec3::X * 5.0, 1.0)?;
/// let wall = Plane::new(Vec3::X * 9.0, -Vec3::X)?;
/// let barriers = Barriers::default().with(wall, SeenFrom::Outside).with(ball, SeenFrom::Outside);
/// let (index, hit) = barriers.ahead(Vec3::ZERO, Vec3::X, 0.5, 20.0).expect("both are in the way");
/// assert_eq!(index, 1, "the ball is nearer");
/// assert!((hit.distance - 3.5).abs() < 1e-4);
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Barriers(
    /// The barriers; behaviours remember a barrier by its index.
    pub Vec<Barrier<Arc<dyn Surface>>>,
);

impl Barriers {
    /// Returns the list with one more surface, seen from one side or from both.
    pub fn with(mut self, surface: impl Surface + 'static, seen_from: SeenFrom) -> Self {
        self.0.push(Barrier::new(Arc::new(surface), seen_from));
        self
    }

    /// Returns the first barrier that a vehicle meets, by index, and the intersection: [`Barrier::ahead`] of all
    /// barriers.
    pub fn ahead(&self, position: Vec3, forward: Vec3, radius: f32, reach: f32) -> Option<(usize, PathIntersection)> {
        let mut first: Option<(usize, PathIntersection)> = None;
        for (index, barrier) in self.0.iter().enumerate() {
            // look no farther than the first intersection so far
            let reach = first.map_or(reach, |(_, hit)| hit.distance);
            match barrier.ahead(position, forward, radius, reach) {
                Some(hit) if hit.distance < reach || first.is_none() => first = Some((index, hit)),
                _ => {}
            }
        }
        first
    }

    /// Returns the nearest point of all surfaces.
    pub fn nearest(&self, position: Vec3) -> Option<SurfacePoint> {
        let near = self.0.iter().map(|barrier| barrier.surface.query(position));
        near.min_by(|a, b| a.distance.abs().total_cmp(&b.distance.abs()))
    }
}
