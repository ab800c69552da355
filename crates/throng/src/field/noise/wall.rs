//! Walls: surfaces that noise flows along, at rest or moving.

use super::ramp;
use crate::Error;
use crate::lanes::LANES;
use crate::space::surface::{Bounds, Moved, Pose, Surface};
use glam::Vec3;
use std::fmt;
use std::sync::Arc;

/// Where a rigid thing is, and how it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rigid {
    /// How it lies in space.
    pub pose: Pose,
    /// The velocity of where its own origin is, m/s.
    pub velocity: Vec3,
    /// Its angular velocity, rad/s about each axis.
    pub spin: Vec3,
}

/// How a rigid thing moves by and by. Functions of time are such.
pub trait Motion: Send + Sync {
    /// Where it is, and how fast it moves, at a time, seconds since the start. Velocity and spin must be those with which the pose
    /// changes: they are what flows past it is made of.
    fn at(&self, time: f64) -> Rigid;
}

impl<F: Fn(f64) -> Rigid + Send + Sync> Motion for F {
    fn at(&self, time: f64) -> Rigid {
        self(time)
    }
}

/// A surface that a field flows along, never through, on either side: an obstacle for those outside, a container for those inside.
#[derive(Clone)]
pub struct Wall {
    surface: Arc<dyn Surface>,
    width: f32,
    /// Beyond it is no influence, if the wall is at rest.
    bounds: Bounds,
    motion: Option<Arc<dyn Motion>>,
}

impl Wall {
    /// A wall at rest, whose influence ends at a distance of `width`, metres: about the length of the noise.
    ///
    /// # Errors
    /// A width that is not greater than 0 and finite.
    pub fn new(surface: impl Surface + 'static, width: f32) -> Result<Self, Error> {
        Error::unless_positive("the width of a wall's influence", width)?;
        let bounds = surface.bounds().grown(width);
        Ok(Self { surface: Arc::new(surface), width, bounds, motion: None })
    }

    /// A rigid wall that moves: its surface lies round its own origin. The field meets its velocity, along its normal, on it.
    ///
    /// ```
    /// use glam::Vec3;
    /// use throng::field::{Rigid, Wall};
    /// use throng::space::surface::{Pose, Sphere};
    /// let straight_on = |time: f64| {
    ///     let velocity = Vec3::X * 0.5;
    ///     let pose = Pose::at(velocity * time as f32).expect("times are finite");
    ///     Rigid { pose, velocity, spin: Vec3::ZERO }
    /// };
    /// let ball = Wall::moving(Sphere::new(Vec3::ZERO, 0.3)?, 0.5, straight_on)?;
    /// # Ok::<(), throng::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn moving(surface: impl Surface + 'static, width: f32, motion: impl Motion + 'static) -> Result<Self, Error> {
        Ok(Self { motion: Some(Arc::new(motion)), ..Self::new(surface, width)? })
    }
}

impl fmt::Debug for Wall {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { surface, width, motion, .. } = self;
        f.debug_struct("Wall")
            .field("surface", surface)
            .field("width", width)
            .field("moves", &motion.is_some())
            .finish()
    }
}

/// What walls, and an amplitude, make of a potential at a place: it is multiplied, and something is added to its curl.
#[derive(Clone, Copy)]
pub(super) struct Influence {
    pub factor: f32,
    pub slope: Vec3,
    /// A velocity.
    pub more: Vec3,
}

impl Influence {
    pub const NONE: Self = Self { factor: 1.0, slope: Vec3::ZERO, more: Vec3::ZERO };

    /// With an amplitude too. What walls add stays: they move as they do.
    pub fn scale(&mut self, amplitude: (f32, Vec3)) {
        (self.factor, self.slope) = times((self.factor, self.slope), amplitude);
    }
}

/// What the potentials of rigid motion of several walls come to: the sum of `share_i psi_i` with `share_i = (1 - |a_i|) prod a_j^2` over
/// all others `j`, so that on each wall only its own has a share. The sum of shares, and the curl, go along.
#[derive(Clone, Copy)]
struct Blend {
    /// The product of all `a_j^2` so far.
    others: (f32, Vec3),
    shares: (f32, Vec3),
    potential: Vec3,
    curl: Vec3,
}

impl Blend {
    const NONE: Self =
        Self { others: (1.0, Vec3::ZERO), shares: (0.0, Vec3::ZERO), potential: Vec3::ZERO, curl: Vec3::ZERO };

    /// Adds a wall with this ramp, and the potential and velocity with which it moves, if it does.
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

    /// The curl of `(1 - |a|)` times what the shares make of the potentials, `a` the product of all ramps.
    fn velocity(&self, (a, slope): (f32, Vec3)) -> Vec3 {
        let (shares, shares_slope) = self.shares;
        // nobody is near, or two walls meet
        if shares <= f32::MIN_POSITIVE {
            return Vec3::ZERO;
        }
        let part = (1.0 - a.abs()) / shares;
        let part_slope = (-slope * a.signum() - shares_slope * part) / shares;
        self.curl * part + part_slope.cross(self.potential)
    }
}

/// The product of two factors, and its gradient.
fn times(one: (f32, Vec3), other: (f32, Vec3)) -> (f32, Vec3) {
    (one.0 * other.0, other.1 * one.0 + one.1 * other.0)
}

/// What walls make of a potential at some places, in space or, if `flat`, in the plane of what lies at their height.
pub(super) fn influences(walls: &[Wall], places: &[Vec3], time: f64, flat: bool, out: &mut [Influence; LANES]) {
    let level = |v: Vec3| if flat { v.with_z(0.0) } else { v };
    let mut blends = [Blend::NONE; LANES];
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
    /// A vector potential of its velocity at a place, and that velocity. In the plane only what moves within it counts.
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
