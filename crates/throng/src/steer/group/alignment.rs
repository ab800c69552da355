//! Alignment: Reynolds, Steering behaviors for autonomous characters, GDC 1999; OpenSteer's steerForAlignment.

use super::Neighbourhood;
use crate::Error;
use crate::motion::Steering;
use crate::steer::{Behaviour, Reason, View, Why};
use glam::Vec3;

/// Turns to where those who are near face: the mean of their forwards less its own. [`MatchVelocity`](super::MatchVelocity)
/// takes on their speed too.
///
/// ```
/// use throng::steer::{Alignment, Neighbourhood};
/// let bird = Alignment { near: Neighbourhood { most: 7, ..Neighbourhood::default() }, full: 0.5 };
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Alignment {
    /// With whom.
    pub near: Neighbourhood,
    /// How great the difference is, 0 to 2, from which it has all of the force; 0: always all, as OpenSteer has it, and then
    /// it may tremble. Limit: >= 0.
    pub full: f32,
}

impl Behaviour for Alignment {
    fn steer(&self, view: &View<'_>, _: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        self.near.tell(view, why);
        let (count, sum) = self.near.of(view).fold((0.0, Vec3::ZERO), |(n, sum), other| (n + 1.0, sum + other.forward));
        if count == 0.0 {
            return None;
        }
        let mean = sum * (1.0 / count);
        why.note(|| Reason::Wishes(mean));
        view.urge(mean - view.forward(), self.full)
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless(self.full >= 0.0, "full turn", self.full, "0 or more")?;
        self.near.check()
    }
}
