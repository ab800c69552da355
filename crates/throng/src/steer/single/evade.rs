//! Evasion: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use crate::Error;
use crate::motion::Steering;
use crate::steer::approach::nearest_time;
use crate::steer::{Behaviour, Prediction, Target, View, Why};

/// Goes away from where a menace will be. It looks at most half as far ahead as the menace is nearest: away from a place
/// beyond would be into its arms. One that goes away is where it is.
///
/// ```
/// use throng::steer::{Evade, Target, Who};
/// let prey = Evade { panic_distance: 6.0, ..Evade::from(Target::Nearest(Who::OtherGroups)) };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evade {
    /// From whom.
    pub menace: Target,
    /// How far ahead of it to look.
    pub prediction: Prediction,
    /// How near the menace must be, metres; infinite: however far. Limit: > 0.
    pub panic_distance: f32,
}

impl From<Target> for Evade {
    fn from(menace: Target) -> Self {
        Self { menace, prediction: Prediction::default(), panic_distance: f32::INFINITY }
    }
}

impl Behaviour for Evade {
    fn steer(&self, view: &View<'_>, _: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let menace = self.menace.find(view)?;
        let offset = view.to(menace.position);
        if offset.length() > self.panic_distance {
            return None;
        }
        let nearest = nearest_time(offset, view.passable(menace.velocity)).max(0.0);
        view.flee(menace.position_in(self.prediction.of_menace(view, &menace).min(0.5 * nearest)), why)
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless(self.panic_distance > 0.0, "panic distance", self.panic_distance, "greater than 0")?;
        self.prediction.check()
    }
}
