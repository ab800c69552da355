//! A motion with an extrapolated future.

use super::{Ahead, Motion, Sample};
use crate::gait::FASTEST_TURN;
use crate::math::{direction, wrapped};
use glam::DVec2;

/// Time constants of the filters, s.
const OF_POSITION: f64 = 0.1;
const OF_HEADING: f64 = 0.12;
/// Duration over which a turn is extrapolated, s: how long it goes on is not known.
const OF_TURN: f64 = 0.5;

/// The smoothed motion of an agent of which samples come in. The filters are critically damped and have no lag at
/// constant velocity.
#[derive(Debug, Clone)]
pub(crate) struct Tracker {
    pub time: f64,
    pub motion: Motion,
}

impl Tracker {
    /// Returns a body that stands at the sample.
    pub fn new(sample: Sample) -> Tracker {
        let motion = Motion { position: sample.position, velocity: DVec2::ZERO, heading: sample.heading, turning: 0.0 };
        Tracker { time: sample.time, motion }
    }

    /// Takes a later sample.
    pub fn push(&mut self, sample: Sample) {
        let step = sample.time - self.time;
        let (gain, speed_gain) = gains(step, OF_POSITION);
        let predicted = self.motion.position + self.motion.velocity * step;
        let error = sample.position - predicted;
        self.motion.position = predicted + error * gain;
        self.motion.velocity += error * (speed_gain / step);
        let (gain, speed_gain) = gains(step, OF_HEADING);
        let most = FASTEST_TURN * step;
        let predicted = self.motion.heading + self.motion.turning * step;
        let error = wrapped(sample.heading - predicted);
        let turned = (predicted + error * gain - self.motion.heading).clamp(-most, most);
        self.motion.heading += turned;
        self.motion.turning = (self.motion.turning + error * (speed_gain / step)).clamp(-FASTEST_TURN, FASTEST_TURN);
        self.time = sample.time;
    }
}

/// Returns the gains of a critically damped tracking filter: of the value and of its rate.
fn gains(step: f64, constant: f64) -> (f64, f64) {
    let kept = libm::exp(-step / constant);
    (1.0 - kept * kept, (1.0 - kept) * (1.0 - kept))
}

/// The motion that goes on at constant speed, turning less and less.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Extrapolated {
    pub time: f64,
    pub motion: Motion,
}

impl Ahead for Extrapolated {
    fn at(&self, time: f64) -> Motion {
        let step = time - self.time;
        // the turn that is still to come, and its mean over the step
        let fade = libm::exp(-step.max(0.0) / OF_TURN);
        let turned = if step > 0.0 { self.motion.turning * OF_TURN * (1.0 - fade) } else { self.motion.turning * step };
        let half = direction(turned / 2.0);
        let whole = direction(turned);
        Motion {
            position: self.motion.position + half.rotate(self.motion.velocity) * step,
            velocity: whole.rotate(self.motion.velocity),
            heading: self.motion.heading + turned,
            turning: self.motion.turning * fade,
        }
    }
}
