//! How far ahead of a quarry a pursuer aims.

use throng::Error;
use throng::steer::{Kinematics, SteeringInput};

/// How many seconds ahead the position of a quarry or a menace is predicted (Reynolds, Steering behaviors for
/// autonomous characters, GDC 1999, "Pursuit").
///
/// ```
/// use throng_steer::Prediction;
/// let still = Prediction::Constant(0.0);
/// assert!(still.check().is_ok());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Prediction {
    /// A constant number of seconds. Limit: >= 0.
    Constant(f32),
    /// In proportion to the distance.
    Distance {
        /// Seconds per metre: Reynolds' turning parameter. Limit: >= 0.
        per_metre: f32,
        /// The upper bound, seconds. Limit: >= 0.
        most: f32,
    },
    /// The time in which the agent covers the distance, by nine cases: whether the quarry is ahead, aside or behind,
    /// and whether it goes the same way, across, or the opposite way (OpenSteer's steerForPursuit). The time jumps from
    /// one case to the next, and the aim with it; the vehicle smooths the jump. The other predictions are continuous.
    Cases {
        /// The upper bound, seconds. Limit: >= 0.
        most: f32,
    },
}

impl Default for Prediction {
    fn default() -> Self {
        Self::Cases { most: 10.0 }
    }
}

/// OpenSteer's factors on the time to cover the distance. Rows: the quarry is ahead, aside or behind. Columns: it goes
/// the same way, across, or the opposite way.
const CASES: [[f32; 3]; 3] = [[4.0, 1.8, 0.85], [1.0, 0.8, 4.0], [0.5, 2.0, 2.0]];
/// Cosine of the angle between two cases.
const BETWEEN: f32 = std::f32::consts::FRAC_1_SQRT_2;

impl Prediction {
    /// Returns the seconds ahead for an agent that chases a quarry.
    pub fn of_quarry(&self, view: &SteeringInput<'_>, quarry: &Kinematics) -> f32 {
        let offset = view.to(quarry.position);
        let distance = offset.length();
        match *self {
            Self::Constant(seconds) => seconds,
            Self::Distance { per_metre, most } => (distance * per_metre).min(most),
            Self::Cases { most } => {
                let case = |cosine: f32| {
                    if cosine > BETWEEN {
                        0
                    } else if cosine < -BETWEEN {
                        2
                    } else {
                        1
                    }
                };
                let ahead = case(view.forward().dot(offset) / distance.max(f32::MIN_POSITIVE));
                let parallel = case(view.forward().dot(quarry.basis.forward));
                time_to_cover(distance, view.motion.speed(), CASES[ahead][parallel], most)
            }
        }
    }

    /// Returns the seconds ahead for an agent that flees from a menace: the time in which the menace would reach the
    /// agent (OpenSteer's steerForEvasion).
    pub fn of_menace(&self, view: &SteeringInput<'_>, menace: &Kinematics) -> f32 {
        match *self {
            Self::Cases { most } => {
                time_to_cover(view.to(menace.position).length(), menace.velocity.length(), 1.0, most)
            }
            _ => self.of_quarry(view, menace),
        }
    }

    /// Checks the parameters.
    ///
    /// # Errors
    /// [`Error::Limit`] names the parameter.
    pub fn check(&self) -> Result<(), Error> {
        let (per_metre, most) = match *self {
            Self::Constant(seconds) => (0.0, seconds),
            Self::Distance { per_metre, most } => (per_metre, most),
            Self::Cases { most } => (0.0, most),
        };
        Error::unless(per_metre >= 0.0, "prediction per metre", per_metre, "0 or more")?;
        Error::unless(most >= 0.0 && most.is_finite(), "prediction", most, "0 or more and finite")
    }
}

/// Returns a multiple of distance over speed, at most `most`; `most` at speed 0.
fn time_to_cover(distance: f32, speed: f32, times: f32, most: f32) -> f32 {
    let time = distance * times;
    if time < most * speed { time / speed } else { most }
}
