//! Steering requests of a vehicle.

use glam::Vec3;

/// The result of steering for a vehicle in a step.
///
/// ```
/// use glam::Vec3;
/// use throng::motion::Steering;
/// let aside = Steering { facing: Some(Vec3::X), ..Steering::from(Vec3::Y) };
/// assert_eq!((aside.force, aside.facing), (Vec3::Y, Some(Vec3::X)));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Steering {
    /// The force, newtons: mass times an acceleration. The vehicle limits it.
    pub force: Vec3,
    /// A direction to face, of any length; `None` to face the direction of motion.
    pub facing: Option<Vec3>,
}

impl From<Vec3> for Steering {
    fn from(force: Vec3) -> Self {
        Self { force, facing: None }
    }
}
