//! How far ahead of a quarry a pursuer aims.

use throng::parameters::parameters;
use throng::steer::{Kinematics, SteeringInput};

/// How far ahead the position of another agent is predicted (Reynolds 1999, "Pursuit").
///
/// ```
/// use throng::parameters::Value;
/// use throng_steer::Prediction;
/// let still = Prediction::Constant(0.0);
/// assert!(still.check_limits().is_ok());
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Prediction {
    /// A constant number of seconds.
    #[parameter(unit = "s", least = 0)]
    Constant(f32),
    /// A time in proportion to the distance.
    Distance {
        /// Seconds a metre: Reynolds' turning parameter.
        #[parameter(required, unit = "s/m", least = 0)]
        per_metre: f32,
        /// Greatest time, seconds.
        #[parameter(required, unit = "s", least = 0)]
        most: f32,
    },
    /// The time in which the agent covers the distance, times a factor by the position (ahead, aside or behind) and the
    /// heading of the other agent.
    ///
    /// Nine cases (OpenSteer's steerForPursuit). The time jumps from one case to the next, and the aim with it; the
    /// vehicle smooths the jump. The other predictions are continuous.
    Cases {
        /// Greatest time, seconds.
        #[parameter(default = LONGEST, unit = "s", least = 0)]
        most: f32,
    },
}

/// Default greatest time, seconds.
const LONGEST: f32 = 10.0;

impl Default for Prediction {
    fn default() -> Self {
        Self::Cases { most: LONGEST }
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
}

/// Returns a multiple of distance over speed, at most `most`; `most` at speed 0.
fn time_to_cover(distance: f32, speed: f32, times: f32, most: f32) -> f32 {
    let time = distance * times;
    if time < most * speed { time / speed } else { most }
}
