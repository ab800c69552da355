//! Tether: what keeps a wanderer near a place (UnitySteer's SteerForTether).

use crate::Error;
use crate::motion::Steering;
use crate::steer::{Behaviour, Target, View, Why};

/// Comes back when it is too far from a place, or from somebody. Nothing to correct within the length of the tether.
///
/// ```
/// use throng::steer::{Behaviour, Target, Tether, View, Why};
/// let dog = Tether { to: Target::Point(glam::Vec3::X), length: 2.0 };
/// assert_eq!(dog.steer(&View::default(), &mut [], &mut Why::default()), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tether {
    /// Whom or what it keeps near to.
    pub to: Target,
    /// How far it may go, metres. Limit: >= 0.
    pub length: f32,
}

impl Behaviour for Tether {
    fn steer(&self, view: &View<'_>, _: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let center = self.to.find(view)?.position;
        if view.to(center).length() > self.length { view.seek(center, why) } else { None }
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless(self.length >= 0.0, "length of the tether", self.length, "0 or more")
    }
}
