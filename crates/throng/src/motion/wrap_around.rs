//! A world without edges: an agent that leaves it on one side enters it on the opposite side.

use crate::Error;
use glam::Vec3;

/// A ball that wraps around: an agent that leaves it is moved by the diameter, through the centre (OpenSteer,
/// `sphericalWrapAround`), as soon as there is room for it there.
///
/// ```
/// use glam::Vec3;
/// use throng::motion::WrapAround;
/// let ball = WrapAround { center: Vec3::X, radius: 5.0 };
/// assert_eq!(ball.back(Vec3::new(7.0, 0.0, 0.0)), Some(Vec3::new(-3.0, 0.0, 0.0)));
/// assert_eq!(ball.back(Vec3::new(4.0, 2.0, 0.0)), None, "it is within");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WrapAround {
    /// Centre, metres from the origin.
    pub center: Vec3,
    /// Radius, metres. Limit: > 0.
    pub radius: f32,
}

impl WrapAround {
    /// Returns the opposite place of a place beyond the surface; `None` for a place within.
    pub fn back(&self, place: Vec3) -> Option<Vec3> {
        let offset = place - self.center;
        let out = offset.length();
        (out > self.radius && out.is_finite()).then(|| place - offset * (2.0 * self.radius / out))
    }

    /// Returns the ball, at this height, that has the same section there; of radius NaN, which nothing is outside of, if
    /// the ball does not reach that height.
    pub(crate) fn at_height(&self, z: f32) -> Self {
        let above = z - self.center.z;
        Self { center: self.center.with_z(z), radius: (self.radius * self.radius - above * above).sqrt() }
    }

    /// Checks the parameters.
    ///
    /// # Errors
    /// [`Error::Limit`] for a centre that is not finite, or a radius that is not greater than 0.
    pub fn check(&self) -> Result<(), Error> {
        for x in self.center.to_array() {
            Error::unless_finite("a coordinate of the middle to wrap around", x.into())?;
        }
        Error::unless_positive("radius to wrap around", self.radius)
    }
}
