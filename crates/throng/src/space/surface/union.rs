//! Several surfaces as one.

use super::sweep::rounding;
use super::{Bounds, Bvh, Surface, SurfaceHit, SurfacePoint, Sweep};
use crate::error::Error;
use glam::Vec3;
use std::sync::Arc;

/// Several surfaces as one: inside is what is inside any of them. Outside and at the surface the distance is exact.
/// Deep inside several that overlap it is that to the surface of one of them, and the way out may be longer; so a ball
/// inside gets from one member into the next only where it fits into one of them as a whole. A ray is not held up.
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
    /// The union of at least one surface.
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

    /// The nearest of all members: the deepest that a point is inside of, else the one with the least distance.
    fn nearest(&self, point: Vec3) -> (SurfacePoint, usize) {
        let look = |member: u32| {
            let near = self.members[member as usize].query(point);
            (near.distance, (near, member as usize))
        };
        let nowhere = SurfacePoint { point, normal: Vec3::X, distance: f32::INFINITY };
        self.bvh.nearest(point, look).map_or((nowhere, 0), |found| found.1)
    }

    /// Where a ball inside touches the surface of the union: out of one member after the other, until none is left
    /// that it is in as a whole.
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
