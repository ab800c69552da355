//! Fields about a place.

use glam::Vec3;
use throng::field::Field;
use throng::parameters::{SpacePlace, parameters};

/// Around a place, at the same speed everywhere.
///
/// ```
/// use glam::Vec3;
/// use throng::field::Field;
/// use throng_field::Whirl;
/// assert_eq!(Whirl::new(Vec3::ZERO, 2.0_f32).velocity(Vec3::X * 3.0, 0.0), Vec3::Y * 2.0);
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Whirl {
    /// Its middle.
    #[parameter(required, from = SpacePlace)]
    pub center: Vec3,
    /// The speed, m/s; negative: clockwise.
    #[parameter(required, unit = "m/s")]
    pub speed: f32,
}

impl Field for Whirl {
    fn velocity(&self, place: Vec3, _: f64) -> Vec3 {
        (Vec3::Z * self.speed).cross((place - self.center).with_z(0.0).try_normalize().unwrap_or_default())
    }
}

/// To a place, or away from it.
///
/// ```
/// use glam::Vec3;
/// use throng::field::Field;
/// use throng_field::Towards;
/// let home = Towards { slow: 1.0, ..Towards::new(Vec3::ZERO, 2.0_f32) };
/// assert_eq!(home.velocity(Vec3::X * 9.0, 0.0), Vec3::X * -2.0);
/// assert_eq!(home.velocity(Vec3::X * 0.5, 0.0), Vec3::X * -1.0);
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Towards {
    /// The place.
    #[parameter(required, from = SpacePlace)]
    pub at: Vec3,
    /// The speed, m/s; negative: away from it.
    #[parameter(required, unit = "m/s")]
    pub speed: f32,
    /// Within this distance, metres, the speed falls in proportion to the distance.
    #[parameter(default = 0.5, unit = "m", above = 0)]
    pub slow: f32,
    /// Beyond this distance the field is undefined, metres. Without it, it is defined everywhere.
    #[parameter(default = f32::INFINITY, infinite, unit = "m", above = 0)]
    pub within: f32,
}

impl Field for Towards {
    fn velocity(&self, place: Vec3, _: f64) -> Vec3 {
        let way = self.at - place;
        let distance = way.length();
        if distance > self.within { Vec3::ZERO } else { way * (self.speed / distance.max(self.slow)) }
    }
}
