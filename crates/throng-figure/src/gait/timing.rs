//! How long and how wide steps are.

use crate::person::Person;

/// Speeds between which neither walking nor running begins, m/s, for a leg of 0.86 m: a walker runs above the second, a
/// runner walks below the first. Source: the transition is at a Froude number v²/(g L) of about 0.5.
pub(crate) const RUN_TO: f64 = 1.8;
/// See [`RUN_TO`].
pub(crate) const RUN_FROM: f64 = 2.0;
/// The shortest cycle of a walk, s.
const SHORTEST: f64 = 0.7;
/// The longest cycle of a walk, s: at low speeds steps become shorter at the same cadence. Source: the walk ratio is
/// constant only above about 60 steps a minute.
const LONGEST: f64 = 2.0;
/// The cycle of steps on the spot, s.
const ON_THE_SPOT: f64 = 1.4;
/// The angle by which the body turns in a step, at most, rad.
const TURN_OF_STEP: f64 = 0.75;
/// The greatest angular speed of a person, rad/s: half a turn in a second.
pub const FASTEST_TURN: f64 = std::f64::consts::PI;

/// The duration of a cycle of two steps and the share of it in which a foot is on the ground.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cycle {
    /// Duration of two steps, s.
    pub duration: f64,
    /// Share of the cycle in which a foot is on the ground, in 0..1: more than 0.5 in walking, less in running.
    pub duty: f64,
}

/// Returns the duration of a cycle of walking, s: 1.346 √(L/v), within 0.7 to 2 s.
///
/// `speed` in m/s; `leg`: length of the leg from the hip to the ankle, m.
///
/// ```
/// // 110 steps a minute at 1.3 m/s
/// let cycle = throng_figure::gait::cycle_duration(1.3, 0.86);
/// assert!((120.0 / cycle - 110.0).abs() < 2.0);
/// ```
pub fn cycle_duration(speed: f64, leg: f64) -> f64 {
    let slow = ON_THE_SPOT + (LONGEST - ON_THE_SPOT) * (speed / 0.3).clamp(0.0, 1.0);
    let law = if speed > 1e-6 { 1.346 * (leg / speed).sqrt() } else { slow };
    law.clamp(SHORTEST, slow)
}

/// Returns the share of a cycle of walking in which a foot is on the ground: 0.752 - 0.143 s / T.
pub fn duty(cycle: f64) -> f64 {
    (0.752 - 0.143 / cycle).clamp(0.52, 0.7)
}

/// Returns the duration of a cycle of running, s: 0.901 - 0.041 v, scaled by the root of the length of the leg.
///
/// Source: Nilsson, Thorstensson, Halbertsma 1985.
pub fn running_cycle(speed: f64, leg: f64) -> f64 {
    (0.901 - 0.041 * speed).max(0.4) * (leg / 0.86).sqrt()
}

/// Returns the share of a cycle of running in which a foot is on the ground: 0.4 at 2 m/s, less at higher speeds.
pub fn running_duty(speed: f64) -> f64 {
    (0.40 - 0.04 * (speed - 2.0)).clamp(0.25, 0.42)
}

/// Returns the cycle of a person.
///
/// `forward` and `sideways` are the speeds along and across the heading, m/s; `turning` is the angular speed, rad/s.
/// Steps backwards are shorter; steps sideways are no longer than 0.25 m; a step turns by at most 43°.
pub fn cycle(person: &Person, forward: f64, sideways: f64, turning: f64, runs: bool) -> Cycle {
    let speed = (forward * forward + sideways * sideways).sqrt();
    let leg = person.leg();
    if runs {
        return Cycle { duration: running_cycle(speed, leg) * person.stride, duty: running_duty(speed) };
    }
    let backwards = if speed > 1e-6 { (-forward / speed).max(0.0) } else { 0.0 };
    let mut duration = cycle_duration(speed, leg) * person.stride * (1.0 - 0.3 * backwards);
    if sideways.abs() > 1e-6 {
        duration = duration.min(0.5 / sideways.abs());
    }
    if turning.abs() > 1e-6 {
        duration = duration.min(2.0 * TURN_OF_STEP / turning.abs());
    }
    let duration = duration.max(SHORTEST);
    Cycle { duration, duty: duty(duration) }
}

/// Returns the distance of the tracks of the two ankles, m: 0.17 standing, 0.10 walking, 0.05 running, more where steps
/// go sideways, for a person of 1.75 m. Source: norms of gait; sideways the feet then stay 8 cm apart.
pub fn step_width(person: &Person, speed: f64, sideways: f64, cycle: f64, runs: bool) -> f64 {
    let scale = person.height / 1.75 * person.width;
    let ahead = if runs { 0.05 } else { 0.17 - 0.07 * (speed / 0.6).clamp(0.0, 1.0) };
    let across = sideways.abs() * cycle / 2.0;
    (ahead * scale).max(across + 0.08 * (across / 0.1).min(1.0))
}
