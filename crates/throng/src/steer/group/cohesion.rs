//! Cohesion: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use super::Neighbourhood;
use crate::Error;
use crate::motion::Steering;
use crate::steer::{Behaviour, Reason, View, Why};
use glam::Vec3;

/// Goes to the middle of those who are near.
///
/// ```
/// use throng::steer::{Cohesion, Neighbourhood};
/// let sheep = Cohesion { near: Neighbourhood { distance: 9.0, ..Neighbourhood::default() }, full: 3.0 };
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cohesion {
    /// Of whom.
    pub near: Neighbourhood,
    /// How far off the middle is, metres, from where it has all of the force; 0: always all, as OpenSteer has it, and then it
    /// may tremble. Limit: >= 0.
    pub full: f32,
}

impl Behaviour for Cohesion {
    fn steer(&self, view: &View<'_>, _: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        self.near.tell(view, why);
        let (count, sum) = self.near.of(view).fold((0.0, Vec3::ZERO), |(n, sum), other| (n + 1.0, sum + other.offset));
        if count == 0.0 {
            return None;
        }
        let middle = sum * (1.0 / count);
        why.note(|| Reason::Aim(view.position() + middle));
        view.urge(middle, self.full)
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless(self.full >= 0.0, "full pull", self.full, "0 or more")?;
        self.near.check()
    }
}
