//! Fields composed of other fields.

use glam::{Vec2, Vec3};
use std::fmt;
use std::sync::Arc;
use throng::Error;
use throng::field::{FactorMap, Field};
use throng::parameters::parameters;

/// The same velocity everywhere, m/s.
///
/// Wind, a slow current.
///
/// ```
/// use glam::Vec3;
/// use throng::field::Field;
/// use throng_field::Uniform;
/// assert_eq!(Uniform(Vec3::X).velocity(Vec3::ONE, 5.0), Vec3::X);
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uniform(pub Vec3);

impl Field for Uniform {
    fn velocity(&self, _: Vec3, _: f64) -> Vec3 {
        self.0
    }
}

/// A field with a weight: a part of a [`Sum`] or a [`Blend`].
#[derive(Clone)]
pub struct FieldPart {
    /// The field.
    pub field: Arc<dyn Field>,
    /// Weight of the field. Limit: finite; of a [`Blend`] >= 0.
    pub weight: f32,
    /// Factor of the weight at each place. None: 1 everywhere.
    pub map: Option<Arc<dyn FactorMap>>,
}

impl FieldPart {
    /// Creates a part with the same weight everywhere.
    pub fn new(field: impl Field + 'static, weight: f32) -> Self {
        Self { field: Arc::new(field), weight, map: None }
    }

    fn weight_at(&self, place: Vec3) -> f32 {
        self.weight * self.map.as_ref().map_or(1.0, |map| map.at(place.truncate().as_dvec2()))
    }
}

impl fmt::Debug for FieldPart {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Part").field("weight", &self.weight).field("map", &self.map.is_some()).finish_non_exhaustive()
    }
}

/// A part of a sum.
#[parameters]
pub(super) struct SumPart {
    /// The field.
    #[parameter(required)]
    of: Arc<dyn Field>,
    /// Weight of the field.
    #[parameter(default = 1.0)]
    weight: f32,
    /// A map that multiplies the weight. Without it, the weight is the same everywhere.
    map: Option<Arc<dyn FactorMap>>,
}

/// A part of a blend.
#[parameters]
pub(super) struct BlendPart {
    /// The field.
    #[parameter(required)]
    of: Arc<dyn Field>,
    /// Weight of the field.
    #[parameter(default = 1.0, least = 0)]
    weight: f32,
    /// A map that multiplies the weight. Without it, the weight is the same everywhere.
    map: Option<Arc<dyn FactorMap>>,
}

/// The parts of a sum, as files write them.
#[parameters]
pub(super) struct SumParts(Vec<SumPart>);

/// The parts of a blend, as files write them.
#[parameters]
pub(super) struct BlendParts(Vec<BlendPart>);

impl From<SumParts> for Vec<FieldPart> {
    fn from(SumParts(parts): SumParts) -> Self {
        parts.into_iter().map(|SumPart { of, weight, map }| FieldPart { field: of, weight, map }).collect()
    }
}

impl From<BlendParts> for Vec<FieldPart> {
    fn from(BlendParts(parts): BlendParts) -> Self {
        parts.into_iter().map(|BlendPart { of, weight, map }| FieldPart { field: of, weight, map }).collect()
    }
}

/// The sum of fields.
///
/// For example a walk on a moving walkway, or guidance plus turbulence.
///
/// ```
/// use glam::Vec3;
/// use throng::field::Field;
/// use throng_field::{FieldPart, Sum, Uniform};
/// let sum = Sum::new(vec![FieldPart::new(Uniform(Vec3::X), 2.0), FieldPart::new(|place: Vec3, _: f64| -place, 0.5)])?;
/// assert_eq!(sum.velocity(Vec3::Y * 4.0, 0.0), Vec3::new(2.0, -2.0, 0.0));
/// # Ok::<(), throng::Error>(())
/// ```
#[parameters]
#[derive(Clone, Debug)]
pub struct Sum(#[parameter(from = SumParts)] Vec<FieldPart>);

impl Sum {
    /// Creates the sum of these parts.
    ///
    /// # Errors
    /// A weight that is not finite.
    pub fn new(parts: Vec<FieldPart>) -> Result<Self, Error> {
        parts.iter().try_for_each(|part| Error::unless_finite("weight of a field", f64::from(part.weight)))?;
        Ok(Self(parts))
    }
}

impl Field for Sum {
    fn velocity(&self, place: Vec3, time: f64) -> Vec3 {
        self.0.iter().map(|part| part.field.velocity(place, time) * part.weight_at(place)).sum()
    }
}

/// The weighted mean of fields; directions and speeds are averaged separately.
///
/// Two opposed fields do not cancel out. A field that is zero at a place has no weight there. Directions are blended
/// successively, in the order of the parts.
///
/// ```
/// use glam::Vec3;
/// use throng::field::Field;
/// use throng_field::{Blend, FieldPart, Uniform};
/// let both = Blend::new(vec![FieldPart::new(Uniform(Vec3::X * 2.0), 1.0), FieldPart::new(Uniform(Vec3::Y), 1.0)])?;
/// assert!(both.velocity(Vec3::ZERO, 0.0).distance(Vec3::new(1.0, 1.0, 0.0).normalize() * 1.5) < 1e-6);
/// # Ok::<(), throng::Error>(())
/// ```
#[parameters]
#[derive(Clone, Debug)]
pub struct Blend(#[parameter(from = BlendParts)] Vec<FieldPart>);

impl Blend {
    /// Creates the blend of these parts.
    ///
    /// # Errors
    /// A weight that is negative or not finite.
    pub fn new(parts: Vec<FieldPart>) -> Result<Self, Error> {
        let is_weight = |weight: f32| (0.0..f32::INFINITY).contains(&weight);
        parts.iter().map(|part| part.weight).try_for_each(|weight| {
            Error::unless(is_weight(weight), "weight of a field", weight, "0 or more, and finite")
        })?;
        Ok(Self(parts))
    }
}

impl Field for Blend {
    fn velocity(&self, place: Vec3, time: f64) -> Vec3 {
        let (mut mean, mut sum) = (Vec3::ZERO, 0.0);
        for part in &self.0 {
            let weight = part.weight_at(place).max(0.0);
            if weight == 0.0 {
                continue;
            }
            let velocity = part.field.velocity(place, time);
            if velocity != Vec3::ZERO {
                sum += weight;
                mean = between(mean, velocity, weight / sum);
            }
        }
        mean
    }
}

/// Returns a velocity between two, with directions and speeds interpolated separately; `part` goes from 0 (`from`) to 1
/// (`to`). Between two exactly opposed directions it turns left.
pub(super) fn between(from: Vec3, to: Vec3, part: f32) -> Vec3 {
    let (Some(a), Some(b)) = (from.try_normalize(), to.try_normalize()) else {
        return if from == Vec3::ZERO { to } else { from };
    };
    let speed = from.length() + part * (to.length() - from.length());
    let across = b - a * a.dot(b);
    let side = across.try_normalize().unwrap_or_else(|| {
        let left = Vec2::new(-a.y, a.x);
        if left == Vec2::ZERO { Vec3::X } else { left.normalize().extend(0.0) }
    });
    let (sin, cos) = libm::sincosf(part * libm::atan2f(across.length(), a.dot(b)));
    (a * cos + side * sin) * speed
}
