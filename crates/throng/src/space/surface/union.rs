//! Unions of surfaces.

use super::sweep::rounding;
use super::{Bounds, Bvh, Surface, SurfaceHit, SurfacePoint, Sweep};
use crate::error::Error;
use glam::Vec3;
use std::sync::Arc;

/// The union of surfaces: a point is inside if it is inside any of them. Outside and at the surface the distance is
/// exact. Deep inside several members that overlap it is the distance to the surface of one of them, and the way out
/// may be longer. So a ball inside passes from one member to the next only where one of them contains the whole ball. A
/// ray is not restricted.
///
/// ```
/// use glam::Vec3;
/// use std::sync::Arc;
/// use throng::space::surface::{Sphere, Surface, Union};
///
/// let ball = |x: f32| Sphere::new(Vec3::X * x, 1.0).map(|ball| Arc::new(ball) as Arc<dyn Surface>);
/// let peanut = Union::new(vec![ball(0.0)?, ball(1.5)?])?;
/// let hit = peanut.ray(Vec3::ZERO, Vec3::X, 10.0).expect("it leaves the peanut");
/// assert!((hit.distance - 2.5).abs() < 1e-5 && !hit.from_outside);
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Union {
    members: Vec<Arc<dyn Surface>>,
    bvh: Bvh,
}

impl Union {
    /// Returns the union of at least one surface.
    ///
    /// # Errors
    /// [`Error::Shape`] if there are none.
    pub fn new(members: Vec<Arc<dyn Surface>>) -> Result<Self, Error> {
        if members.is_empty() {
            return Err(Error::Shape { what: "a union of surfaces".into(), why: "it has no surfaces".into() });
        }
        let boxes: Vec<Bounds> = members.iter().map(|member| member.bounds()).collect();
        Ok(Self { bvh: Bvh::new(&boxes), members })
    }

    /// Returns the nearest member: the one that a point is deepest inside of, else the one at the least distance.
    fn nearest(&self, point: Vec3) -> (SurfacePoint, usize) {
        let look = |member: u32| {
            let near = self.members[member as usize].query(point);
            (near.distance, (near, member as usize))
        };
        let nowhere = SurfacePoint { point, normal: Vec3::X, distance: f32::INFINITY };
        self.bvh.nearest(point, look).map_or((nowhere, 0), |found| found.1)
    }

    /// Returns the contact of a ball inside with the surface of the union: the ball leaves one member after another
    /// until no member contains the whole ball.
    fn sweep_inside(&self, sweep: &Sweep) -> Option<SurfaceHit> {
        let (mut distance, mut last) = (0.0, None);
        for _ in 0..=4 * self.members.len() {
            let (near, member) = self.nearest(sweep.at(distance));
            if last.is_some() && near.distance >= -sweep.radius - 4.0 * rounding(near.point) {
                break;
            }
            let rest = Sweep { origin: sweep.at(distance), ..sweep.until(sweep.reach - distance) };
            let hit = self.members[member].sweep(&rest)?;
            distance += hit.distance;
            last = Some(SurfaceHit { distance, ..hit });
        }
        last
    }
}

impl Surface for Union {
    fn query(&self, point: Vec3) -> SurfacePoint {
        self.nearest(point).0
    }

    fn sweep(&self, sweep: &Sweep) -> Option<SurfaceHit> {
        self.bvh.bounds().entry(sweep)?;
        if self.query(sweep.origin).is_inside() {
            return self.sweep_inside(sweep);
        }
        self.bvh.first_touched(sweep, |member, sweep| self.members[member as usize].sweep(sweep))
    }

    fn facets(&self, within: &Bounds) -> Vec<Vec<Vec3>> {
        self.members.iter().flat_map(|member| member.facets(within)).collect()
    }

    fn bounds(&self) -> Bounds {
        self.bvh.bounds()
    }
}
