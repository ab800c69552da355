//! Walls: surfaces, at rest or moving, that noise flows along.

use super::ramp;
use glam::Vec3;
use std::fmt;
use std::sync::Arc;
use throng::Error;
use throng::simd::LANES;
use throng::space::surface::{Bounds, Moved, Pose, Surface};

/// Pose and motion of a rigid body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rigid {
    /// Pose in space.
    pub pose: Pose,
    /// Velocity of the body's origin, m/s.
    pub velocity: Vec3,
    /// Angular velocity, rad/s about each axis.
    pub spin: Vec3,
}

/// The motion of a rigid body over time. Functions of time are motions.
pub trait RigidMotion: Send + Sync {
    /// Returns pose, velocity and spin at a time, seconds since the start. Velocity and spin must be the derivatives of
    /// the pose: the flow past the body is computed from them.
    fn at(&self, time: f64) -> Rigid;
}

impl<F: Fn(f64) -> Rigid + Send + Sync> RigidMotion for F {
    fn at(&self, time: f64) -> Rigid {
        self(time)
    }
}

/// A surface that a field flows along on both sides, never through: an obstacle for agents outside, a container for
/// agents inside.
#[derive(Clone)]
pub struct NoiseWall {
    surface: Arc<dyn Surface>,
    width: f32,
    /// The box outside which a wall at rest has no influence.
    bounds: Bounds,
    motion: Option<Arc<dyn RigidMotion>>,
}

impl NoiseWall {
    /// Creates a wall at rest. Its influence ends at a distance of `width`, metres: use about the length of the noise.
    ///
    /// # Errors
    /// A width that is not greater than 0 and finite.
    pub fn new(surface: impl Surface + 'static, width: f32) -> Result<Self, Error> {
        Error::unless_positive("the width of a wall's influence", width)?;
        let bounds = surface.bounds().grown(width);
        Ok(Self { surface: Arc::new(surface), width, bounds, motion: None })
    }

    /// Creates a moving rigid wall. The surface is relative to the body's origin. On the wall, the field's velocity
    /// along the normal equals the wall's.
    ///
    /// ```
    /// use glam::Vec3;
    /// use throng_field::{NoiseWall, Rigid};
    /// use throng::space::surface::{Pose, Sphere};
    /// let straight_on = |time: f64| {
    ///     let velocity = Vec3::X * 0.5;
    ///     let pose = Pose::at(velocity * time as f32).expect("times are finite");
    ///     Rigid { pose, velocity, spin: Vec3::ZERO }
    /// };
    /// let ball = NoiseWall::moving(Sphere::new(Vec3::ZERO, 0.3)?, 0.5, straight_on)?;
    /// # Ok::<(), throng::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn moving(
        surface: impl Surface + 'static,
        width: f32,
        motion: impl RigidMotion + 'static,
    ) -> Result<Self, Error> {
        Ok(Self { motion: Some(Arc::new(motion)), ..Self::new(surface, width)? })
    }
}

impl fmt::Debug for NoiseWall {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { surface, width, motion, .. } = self;
        f.debug_struct("Wall")
            .field("surface", surface)
            .field("width", width)
            .field("moves", &motion.is_some())
            .finish()
    }
}

/// The influence of walls and an amplitude on a potential at a place: a factor with its gradient, and a term added to
/// the curl.
#[derive(Clone, Copy)]
pub(super) struct Influence {
    pub factor: f32,
    pub slope: Vec3,
    /// The velocity that is added.
    pub more: Vec3,
}

impl Influence {
    pub const NONE: Self = Self { factor: 1.0, slope: Vec3::ZERO, more: Vec3::ZERO };

    /// Multiplies by an amplitude. The velocity that walls add does not change: walls move regardless of it.
    pub fn scale(&mut self, amplitude: (f32, Vec3)) {
        (self.factor, self.slope) = times((self.factor, self.slope), amplitude);
    }
}

/// The sum of the potentials of several walls' rigid motion, `share_i psi_i` with `share_i = (1 - |a_i|) prod a_j^2`
/// over all other walls `j`, so that on each wall only its own potential has a share. The sum of the shares and the
/// curl are accumulated too.
#[derive(Clone, Copy)]
struct PotentialBlend {
    /// The product of all `a_j^2` so far, and its gradient.
    others: (f32, Vec3),
    shares: (f32, Vec3),
    potential: Vec3,
    curl: Vec3,
}

impl PotentialBlend {
    const NONE: Self =
        Self { others: (1.0, Vec3::ZERO), shares: (0.0, Vec3::ZERO), potential: Vec3::ZERO, curl: Vec3::ZERO };

    /// Adds a wall with this ramp; `rigid` is the potential and the velocity of its motion, if it moves.
    fn add(&mut self, (a, slope): (f32, Vec3), rigid: Option<(Vec3, Vec3)>) {
        let square = (a * a, slope * (2.0 * a));
        self.curl = self.curl * square.0 + square.1.cross(self.potential);
        self.potential *= square.0;
        let near = (1.0 - a.abs(), -slope * a.signum());
        let share = times(near, self.others);
        let shares = times(self.shares, square);
        self.shares = (shares.0 + share.0, shares.1 + share.1);
        self.others = times(self.others, square);
        if let Some((potential, velocity)) = rigid {
            self.curl += velocity * share.0 + share.1.cross(potential);
            self.potential += potential * share.0;
        }
    }

    /// Returns the curl of `(1 - |a|)` times the mean of the potentials by their shares, with `a` the product of all
    /// ramps.
    fn velocity(&self, (a, slope): (f32, Vec3)) -> Vec3 {
        let (shares, shares_slope) = self.shares;
        // no wall is near, or two walls meet
        if shares <= f32::MIN_POSITIVE {
            return Vec3::ZERO;
        }
        let part = (1.0 - a.abs()) / shares;
        let part_slope = (-slope * a.signum() - shares_slope * part) / shares;
        self.curl * part + part_slope.cross(self.potential)
    }
}

/// Returns the product of two factors, and its gradient.
fn times(one: (f32, Vec3), other: (f32, Vec3)) -> (f32, Vec3) {
    (one.0 * other.0, other.1 * one.0 + one.1 * other.0)
}

/// Computes the influence of walls at some places: in space, or with `flat` in the horizontal plane of each place.
pub(super) fn influences(walls: &[NoiseWall], places: &[Vec3], time: f64, flat: bool, out: &mut [Influence; LANES]) {
    let level = |v: Vec3| if flat { v.with_z(0.0) } else { v };
    let mut blends = [PotentialBlend::NONE; LANES];
    for wall in walls {
        let rigid = wall.motion.as_ref().map(|motion| motion.at(time));
        for ((&place, blend), out) in places.iter().zip(&mut blends).zip(&mut *out) {
            let near = match rigid {
                None if !wall.bounds.contains(place) => continue,
                None => wall.surface.query(place),
                Some(rigid) => Moved::new(&*wall.surface, rigid.pose).query(place),
            };
            let (value, slope) = ramp(near.distance / wall.width);
            let a = (value, level(near.normal) * (slope / wall.width));
            blend.add(a, rigid.map(|rigid| rigid.potential(place, flat)));
            (out.factor, out.slope) = times((out.factor, out.slope), a);
        }
    }
    (out.iter_mut().zip(&blends)).for_each(|(out, blend)| out.more = blend.velocity((out.factor, out.slope)));
}

impl Rigid {
    /// Returns a vector potential of the body's velocity at a place, and that velocity. With `flat`, only motion within
    /// the horizontal plane counts.
    fn potential(&self, place: Vec3, flat: bool) -> (Vec3, Vec3) {
        let from = place - self.pose.position();
        if flat {
            let (from, velocity, spin) = (from.with_z(0.0), self.velocity.with_z(0.0), self.spin.z);
            let stream = velocity.cross(from).z - 0.5 * spin * from.length_squared();
            return (Vec3::Z * stream, velocity + Vec3::Z.cross(from) * spin);
        }
        let potential = self.velocity.cross(from) * 0.5 - self.spin * (0.5 * from.length_squared());
        (potential, self.velocity + self.spin.cross(from))
    }
}
