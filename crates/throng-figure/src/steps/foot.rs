//! The foot on the ground, and on its way from plant to plant.

use super::Plant;
use crate::math::{Quintic, bump, direction, mix, smooth, smooth_max, wrapped};
use crate::person::{Person, Side};
use glam::{DVec2, DVec3};

/// The share of the length of the leg to which a leg on the ground is stretched.
pub(crate) const STRETCH: f64 = 0.993;
/// The angle by which a heel is raised at most, rad.
pub(crate) const STEEPEST: f64 = 1.25;

/// The share of a swing after which a foot that arrives without speed is above its plant: it then only comes down.
const OVER: f64 = 0.95;
/// The speeds at which a foot leaves the ground and comes down, m/s, at least.
const RISE: f64 = 0.2;
const FALL: f64 = 0.3;

/// Where a foot is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FootPose {
    /// Position of the ankle, m.
    pub ankle: DVec3,
    /// Direction, rad.
    pub yaw: f64,
    /// Angle of the foot, rad: positive with the toes raised.
    pub pitch: f64,
    /// Angle of the toes, rad, as of the foot.
    pub toes: f64,
}

/// Returns the pose of a foot on the ground at a time. `hip` is the hip joint of its side, m: the heel rises as the leg
/// needs.
pub(crate) fn stance(person: &Person, plant: &Plant, time: f64, hip: DVec3) -> FootPose {
    let stays = (plant.lift - plant.strike).max(0.02);
    let landing = plant.landing.min(0.3 * stays);
    let fall = 1.0 - smooth((time - plant.strike) / landing);
    let rolling = plant.rolling.min(0.6 * stays);
    let x = ((time - plant.lift) / rolling + 1.0).max(0.0);
    let roll = plant.roll * x * x * (1.6 - 0.6 * x);
    let need = needed_roll(person, plant, hip);
    let allowed = allowed_roll(plant, time);
    let roll = smooth_max(roll, need.min(allowed), 0.12).max(0.0) * (allowed / 0.2).min(1.0);
    let pitch = plant.pitch * fall - roll.min(STEEPEST);
    foot_at(person, plant.ankle, plant.yaw, pitch)
}

/// Returns the angle by which the heel of a foot on the ground may be raised at a time, rad.
pub(crate) fn allowed_roll(plant: &Plant, time: f64) -> f64 {
    let stays = plant.lift - plant.strike;
    if !stays.is_finite() {
        return 0.35 * smooth((time - plant.strike - 0.2) / 0.3);
    }
    let u = (time - plant.strike) / stays.max(0.02);
    let late = (time - plant.lift) / plant.rolling.min(0.6 * stays).max(0.01) + 1.7;
    if u < 0.0 { 0.0 } else { STEEPEST * smooth(late.min(u * 4.0) / 1.2) }
}

/// Returns the pose of a foot with this pitch that touches the ground: with the heel if the pitch is positive, else
/// with the ball.
pub(crate) fn foot_at(person: &Person, flat: DVec2, yaw: f64, pitch: f64) -> FootPose {
    let body = person.legs;
    let h = person.height;
    let (sin, cos) = libm::sincos(pitch);
    // from the point about which the foot turns to the ankle: forward and up
    let (pivot, ankle) = if pitch > 0.0 {
        ((-body.heel * h, 0.0), (body.heel * h, body.ankle * h))
    } else {
        ((body.ball * h, body.toe_height * h), (-body.ball * h, (body.ankle - body.toe_height) * h))
    };
    let forward = pivot.0 + ankle.0 * cos - ankle.1 * sin;
    let up = pivot.1 + ankle.0 * sin + ankle.1 * cos;
    let at = flat + direction(yaw) * forward;
    FootPose { ankle: at.extend(up), yaw, pitch, toes: pitch.max(0.0) }
}

/// Returns the least angle by which the heel is to be raised for the leg to reach from the hip; negative, if there is
/// leg to spare.
fn needed_roll(person: &Person, plant: &Plant, hip: DVec3) -> f64 {
    let body = person.legs;
    let h = person.height;
    let ahead = direction(plant.yaw);
    let toes = (plant.ankle + ahead * (body.ball * h)).extend(body.toe_height * h);
    let away = hip - toes;
    let reach = STRETCH * person.leg();
    let flat = hip - plant.ankle.extend(body.ankle * h);
    if flat.length_squared() < (0.9 * reach) * (0.9 * reach) {
        return -1.0;
    }
    let (forward, up) = (away.truncate().dot(ahead), away.z);
    let (back, height) = (body.ball * h, (body.ankle - body.toe_height) * h);
    let radius = (back * back + height * height).sqrt();
    let least = (reach * reach - away.length_squared() - radius * radius) / (2.0 * radius);
    let size = (forward * forward + up * up).sqrt();
    libm::acos((least / size).clamp(-1.0, 1.0)) - libm::atan2(up, forward) - libm::atan2(height, back)
}

/// A foot on its way through the air.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Swing {
    lift: f64,
    duration: f64,
    /// The share of the swing after which the foot is above its plant.
    over: f64,
    x: Quintic,
    y: Quintic,
    z: Quintic,
    yaw: Quintic,
    pitch: Quintic,
    toes: Quintic,
    /// How far the foot is lifted beyond its ends in the middle, m.
    raise: f64,
    /// The way around the other foot, m.
    aside: DVec2,
}

impl Swing {
    /// Returns the way from a pose and its rates of change (per second) to a plant.
    ///
    /// `other` is the ankle of the foot on the ground, `raise` how far the foot is lifted, m.
    pub fn new(
        person: &Person,
        side: Side,
        (from, rate): (FootPose, FootPose),
        lift: f64,
        to: &Plant,
        other: DVec2,
        raise: f64,
    ) -> Swing {
        let duration = (to.strike - lift).max(0.02);
        let end = foot_at(person, to.ankle, to.yaw, to.pitch);
        let line = |from: f64, rate: f64, to: f64| Quintic::new(from, rate * duration, to, 0.0);
        let speed = to.arrival.length();
        let over = mix(OVER, 1.0, (speed / 0.3).min(1.0));
        let fall = FALL + speed;
        let rise = RISE + 0.15 * rate.ankle.truncate().length();
        let turned = from.yaw + wrapped(end.yaw - from.yaw);
        let mut swing = Swing {
            lift,
            duration,
            over,
            x: Quintic::new(from.ankle.x, rate.ankle.x * duration * over, end.ankle.x, to.arrival.x * duration),
            y: Quintic::new(from.ankle.y, rate.ankle.y * duration * over, end.ankle.y, to.arrival.y * duration),
            z: Quintic::new(from.ankle.z, (rate.ankle.z.max(0.0) + rise) * duration, end.ankle.z, -fall * duration),
            yaw: line(from.yaw, rate.yaw, turned),
            pitch: line(from.pitch, rate.pitch, end.pitch),
            toes: line(from.toes, rate.toes, end.toes),
            raise,
            aside: DVec2::ZERO,
        };
        let scale = person.height / 1.75;
        let left = direction((from.yaw + turned) / 2.0).perp() * side.sign();
        let apart = mix(0.1, 0.07, speed.min(1.0));
        let mut aside = 0.0_f64;
        for part in 3..=7 {
            let u = f64::from(part) / 10.0;
            let foot = swing.at(lift + u * duration);
            let gap = foot.ankle.truncate() - other;
            let across = left.dot(gap);
            let past = (gap.length_squared() - across * across).max(0.0).sqrt();
            let due = apart * scale * (1.0 - past / (0.3 * scale)).clamp(0.0, 1.0).sqrt();
            if across < due {
                aside = aside.max((due - across) / bump(u));
            }
        }
        swing.aside = left * aside.min(0.25);
        // heel and toes clear the ground
        let body = person.legs;
        let h = person.height;
        for part in 1..10 {
            let u = f64::from(part) / 10.0;
            let foot = swing.at(lift + u * duration);
            let (sin, cos) = libm::sincos(foot.pitch);
            let heel = foot.ankle.z - body.heel * h * sin - body.ankle * h * cos;
            let toes = foot.ankle.z + body.ball * h * sin - (body.ankle - body.toe_height) * h * cos;
            let tip = toes + (body.foot - body.heel - body.ball) * h * libm::sin(foot.toes) - body.toe_height * h;
            let due = 0.02 * (bump(u) + 4.0 * u * (1.0 - u)) / 2.0 * scale;
            let lowest = heel.min(toes - body.toe_height * h).min(tip);
            swing.raise += ((due - lowest) / bump(u)).clamp(0.0, 0.15);
        }
        swing
    }

    /// Returns the pose of the foot at a time.
    pub fn at(&self, time: f64) -> FootPose {
        let u = ((time - self.lift) / self.duration).clamp(0.0, 1.0);
        let middle = bump(u);
        let ground = (u / self.over).min(1.0);
        let aside = self.aside * bump(ground);
        let pitch = self.pitch.at(u);
        FootPose {
            ankle: DVec3::new(
                self.x.at(ground) + aside.x,
                self.y.at(ground) + aside.y,
                self.z.at(u) + self.raise * middle,
            ),
            yaw: self.yaw.at(u),
            pitch,
            toes: mix(self.toes.at(u), pitch, 0.8 * middle),
        }
    }
}

impl FootPose {
    /// Returns the rates of change between two poses `step` (s) apart, as a pose.
    pub fn rate(before: &FootPose, after: &FootPose, step: f64) -> FootPose {
        FootPose {
            ankle: (after.ankle - before.ankle) / step,
            yaw: (after.yaw - before.yaw) / step,
            pitch: (after.pitch - before.pitch) / step,
            toes: (after.toes - before.toes) / step,
        }
    }
}
