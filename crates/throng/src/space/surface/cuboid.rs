//! Boxes, and rectangular plates: boxes of thickness 0.

use super::sweep::touch_convex;
use super::{Bounds, Surface, SurfaceHit, SurfacePoint, Sweep};
use crate::error::Error;
use glam::{Vec2, Vec3};

/// A solid box, or a rectangular plate with two sides, parallel to the axes and centred at the origin.
/// [`Moved`](super::Moved) gives it a position and orientation.
///
/// ```
/// use glam::{Quat, Vec2, Vec3};
/// use throng::space::surface::{Cuboid, Moved, Pose, Surface};
///
/// // a screen 4 m wide and 2 m high across the x axis
/// let turned = Pose::new(Vec3::new(5.0, 0.0, 1.0), Quat::from_rotation_y(std::f32::consts::FRAC_PI_2))?;
/// let screen = Moved::new(Cuboid::rectangle(Vec2::new(2.0, 4.0))?, turned);
/// let hit = screen.ray(Vec3::new(0.0, 1.5, 1.0), Vec3::X, 10.0).expect("it is in the way");
/// assert!((hit.distance - 5.0).abs() < 1e-5 && hit.normal.x < -0.999);
/// assert_eq!(screen.ray(Vec3::new(0.0, 2.5, 1.0), Vec3::X, 10.0), None);
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Cuboid {
    /// Half extents.
    half: Vec3,
}

impl Cuboid {
    /// Returns a solid box with these full extents, metres.
    ///
    /// # Errors
    /// [`Error::Limit`] if an extent is not greater than 0 and finite.
    pub fn new(size: Vec3) -> Result<Self, Error> {
        size.to_array().into_iter().try_for_each(|x| Error::unless_positive("an extent of a box", x))?;
        Ok(Self { half: size * 0.5 })
    }

    /// Returns a rectangle of thickness 0 in the plane z = 0 with these full extents along x and y, metres. It has two
    /// sides and no inside.
    ///
    /// # Errors
    /// [`Error::Limit`] if an extent is not greater than 0 and finite.
    pub fn rectangle(size: Vec2) -> Result<Self, Error> {
        size.to_array().into_iter().try_for_each(|x| Error::unless_positive("an extent of a rectangle", x))?;
        Ok(Self { half: size.extend(0.0) * 0.5 })
    }

    /// Returns the first contact of a ball inside: with the first of the walls that it moves towards.
    fn sweep_inside(&self, sweep: &Sweep) -> SurfaceHit {
        let room = (self.half - sweep.radius).max(Vec3::ZERO);
        let to_wall = |axis: usize| {
            let (from, speed) = (sweep.origin[axis], sweep.direction[axis]);
            // parallel to the wall it never reaches it
            if speed == 0.0 { f32::INFINITY } else { (room[axis] - from * speed.signum()).max(0.0) / speed.abs() }
        };
        let times = Vec3::new(to_wall(0), to_wall(1), to_wall(2));
        let axis = times.min_position();
        let sign = sweep.direction[axis].signum();
        let mut point = sweep.at(times[axis]).clamp(-self.half, self.half);
        point[axis] = self.half[axis] * sign;
        SurfaceHit { distance: times[axis], point, normal: Vec3::AXES[axis] * sign, from_outside: false }
    }
}

impl Surface for Cuboid {
    fn query(&self, p: Vec3) -> SurfacePoint {
        let beyond = p.abs() - self.half;
        let sign = p.map(|x| if x < 0.0 { -1.0 } else { 1.0 });
        let outside = beyond.max(Vec3::ZERO);
        if outside != Vec3::ZERO {
            let distance = outside.length();
            return SurfacePoint { point: p.clamp(-self.half, self.half), normal: outside / distance * sign, distance };
        }
        let axis = beyond.max_position();
        let (normal, distance) = (Vec3::AXES[axis] * sign, beyond[axis]);
        SurfacePoint { point: p - normal * distance, normal, distance }
    }

    fn sweep(&self, sweep: &Sweep) -> Option<SurfaceHit> {
        if self.query(sweep.origin).is_inside() {
            Some(self.sweep_inside(sweep)).filter(|hit| hit.distance <= sweep.reach)
        } else {
            touch_convex(|p| self.query(p), sweep)
        }
    }

    fn facets(&self, _: &Bounds) -> Vec<Vec<Vec3>> {
        let face = |axis: usize, sign: f32| {
            let (u, v) = (Vec3::AXES[(axis + 1) % 3] * sign, Vec3::AXES[(axis + 2) % 3]);
            let corner = |a: f32, b: f32| (Vec3::AXES[axis] * sign + u * a + v * b) * self.half;
            vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)]
        };
        if self.half.z == 0.0 {
            return vec![face(2, 1.0)];
        }
        (0..6).map(|k| face(k / 2, if k % 2 == 0 { 1.0 } else { -1.0 })).collect()
    }

    fn bounds(&self) -> Bounds {
        Bounds { low: -self.half, high: self.half }
    }
}
