//! Which foot steps when, and to where.

use super::{Plant, Step};
use crate::gait::{self, Cycle, RUN_FROM, RUN_TO};
use crate::math::{direction, smooth, wrapped};
use crate::path::{Ahead, Motion};
use crate::person::{Person, Side};
use glam::DVec2;

/// A standing person steps where a foot will be farther than this from its place, m or rad.
const TOLERANCE: f64 = 0.03;
const TOLERANCE_OF_YAW: f64 = 0.17;
/// The share of a cycle after the strike at which the body is over the foot.
const OVER_FOOT: f64 = 0.24;
/// The share of the speed of the body that a foot has when it touches the ground: of a fast walker, and of a runner.
const ARRIVAL: f64 = 0.25;
const ARRIVAL_RUNNING: f64 = 0.3;
/// How far a standing person looks ahead, s.
const OUTLOOK: f64 = 0.4;
/// The shortest swing of a foot, s.
const SHORTEST_SWING: f64 = 0.24;
/// The largest angle between the feet, rad.
const WIDEST: f64 = 1.2;
/// The least distance of an ankle from the line of the other foot, m, for a person of 1.75 m.
const APART: f64 = 0.085;
/// The share of the length of the leg that a hip gets ahead of the toes on the ground.
const REACH: f64 = 0.66;

/// The planner of the steps of a person. It sees the motion of the body ahead.
#[derive(Debug, Clone)]
pub(crate) struct Planner {
    person: Person,
    /// The feet on the ground, left first. The foot of the step that is under way is where it will be put down.
    pub plants: [Plant; 2],
    /// The earliest time of the next lift.
    pub ready: f64,
    last: Side,
    /// Phase of the last strike, in steps.
    count: f64,
    runs: bool,
}

impl Planner {
    /// Returns a person that stands at a motion.
    pub fn new(person: Person, body: Motion, time: f64) -> Planner {
        let still = Motion { velocity: DVec2::ZERO, ..body };
        let plants = Side::BOTH.map(|side| {
            let (ankle, yaw) = home(&person, &still, side, gait::step_width(&person, 0.0, 0.0, 1.0, false));
            Plant::standing(ankle, yaw, time)
        });
        let last = person.lead.other();
        let count = if last == Side::Left { 0.0 } else { 1.0 };
        Planner { person, plants, ready: time, last, count, runs: false }
    }

    /// Whether the person runs.
    pub fn runs(&self) -> bool {
        self.runs
    }

    /// Returns the step that begins at `time`, if a foot is to be moved then. `time` is at least `ready`.
    pub fn decide(&mut self, body: &impl Ahead, time: f64) -> Option<Step> {
        let now = body.at(time);
        let soon = body.at(time + OUTLOOK);
        let speed = soon.velocity.length() / (self.person.leg() / 0.86).sqrt();
        self.runs = speed > if self.runs { RUN_TO } else { RUN_FROM };
        let side = self.side(&now, &soon, time)?;
        let step = self.step(body, side, time);
        self.count += if side == self.last { 2.0 } else { 1.0 };
        self.last = side;
        self.plants[side.index()] = step.plant;
        Some(step)
    }

    /// Returns the foot that is to be moved, if one is.
    fn side(&self, now: &Motion, soon: &Motion, time: f64) -> Option<Side> {
        let width = gait::step_width(&self.person, soon.velocity.length(), 0.0, 1.0, self.runs);
        let excess = Side::BOTH.map(|side| {
            let (ankle, yaw) = home(&self.person, soon, side, width);
            let plant = &self.plants[side.index()];
            let away = ankle.distance(plant.ankle) / TOLERANCE;
            away.max(wrapped(yaw - plant.yaw).abs() / TOLERANCE_OF_YAW)
        });
        let other = self.last.other();
        let moving = soon.velocity.length() > 0.15;
        let away = |side: Side| excess[side.index()] > 1.0;
        // the foot that moved last may move again only when both are on the ground for a while, as when the body stood
        let landed = self.plants[self.last.index()].strike;
        let rested = time > landed + 0.3;
        if !rested || moving && now.velocity.length() > 0.15 {
            return away(other).then_some(other);
        }
        if !away(other) && !away(self.last) {
            return None;
        }
        // from standing: the foot on the side to which the body goes or turns
        let across = direction(now.heading).perp().dot(soon.position - now.position) / TOLERANCE;
        let turn = (soon.heading - now.heading) / TOLERANCE_OF_YAW;
        let drift = across + turn;
        if drift.abs() > 0.5 {
            return Some(if drift > 0.0 { Side::Left } else { Side::Right });
        }
        let [left, right] = excess;
        Some(if (left - right).abs() < 0.5 {
            other
        } else if left > right {
            Side::Left
        } else {
            Side::Right
        })
    }

    /// Returns the step of a foot that is lifted at `time`.
    fn step(&mut self, body: &impl Ahead, side: Side, time: f64) -> Step {
        // the cycle at the middle of the swing, and then of the step
        let lifted = body.at(time);
        let mut cycle = self.cycle(&lifted);
        for _ in 0..2 {
            cycle = self.cycle(&body.at(time + (1.0 - cycle.duty) * cycle.duration));
        }
        let mut strike = time + (1.0 - cycle.duty) * cycle.duration;
        // a runner flies
        if !self.runs {
            let latest = self.reached_until(body, side.other(), time, strike + 0.1);
            strike = strike.min(latest.max(time + SHORTEST_SWING));
        }
        let plant = self.plant(body, side, strike, cycle);
        let roll = self.roll(&lifted);
        let rolling = if self.runs { 0.6 } else { 0.48 } * cycle.duty * cycle.duration;
        self.ready = (strike + (cycle.duty - 0.5) * cycle.duration).max(time + 0.1);
        let count = self.count + if side == self.last { 2.0 } else { 1.0 };
        let phases = [count / 2.0 - (1.0 - cycle.duty), count / 2.0];
        Step { side, lift: time, roll, rolling, plant, phases }
    }

    /// Returns the angle by which the heel of the foot on the ground rises in a motion, rad.
    pub fn roll(&self, motion: &Motion) -> f64 {
        let (forward, _) = along(motion);
        (52.0_f64.to_radians() * (forward / 1.3)).clamp(0.0, if self.runs { 0.8 } else { 1.1 })
    }

    /// Returns the plant of a step that is under way, for a motion that changed since the step was decided.
    pub fn replan(&mut self, body: &impl Ahead, side: Side, strike: f64) -> Plant {
        let cycle = self.cycle(&body.at(strike));
        let plant = self.plant(body, side, strike, cycle);
        self.plants[side.index()] = plant;
        plant
    }

    fn cycle(&self, motion: &Motion) -> Cycle {
        let (forward, sideways) = along(motion);
        gait::cycle(&self.person, forward, sideways, motion.turning, self.runs)
    }

    /// Returns where the foot is put down: where the body is a quarter of a cycle later.
    fn plant(&self, body: &impl Ahead, side: Side, strike: f64, cycle: Cycle) -> Plant {
        let person = &self.person;
        let share = if self.runs { 0.4 * cycle.duty } else { OVER_FOOT };
        let over = body.at(strike + share * cycle.duration);
        let (forward, sideways) = along(&over);
        let speed = over.velocity.length();
        let width = gait::step_width(person, speed, sideways, cycle.duration, self.runs);
        let (mut ankle, yaw) = home(person, &over, side, width);
        // feet open in turns
        let yaw = yaw + side.sign() * (0.25 * cycle.duration * over.turning.abs()).min(0.4);
        let other = &self.plants[side.other().index()];
        let yaw = other.yaw + wrapped(yaw - other.yaw).clamp(-WIDEST, WIDEST);
        // beside the other foot, not on it
        let left = direction(over.heading).perp() * side.sign();
        let apart = if self.runs { 0.6 * width } else { APART * person.height / 1.75 };
        let gap = left.dot(ankle - other.ankle);
        ankle += left * (apart - gap).clamp(0.0, 0.2);
        let pitch = if self.runs { 6.0_f64 } else { (20.0 * forward / 1.3).clamp(-15.0, 22.0) };
        Plant {
            ankle,
            yaw,
            strike,
            lift: f64::INFINITY,
            pitch: pitch.to_radians(),
            landing: 0.16 * cycle.duty * cycle.duration,
            roll: 0.0,
            rolling: 0.2,
            arrival: over.velocity * if self.runs { ARRIVAL_RUNNING } else { ARRIVAL * smooth((speed - 0.5) / 1.0) },
        }
    }

    /// Returns until when the body stays in reach of the foot on the ground, at most until `end`.
    fn reached_until(&self, body: &impl Ahead, side: Side, from: f64, end: f64) -> f64 {
        let person = &self.person;
        let legs = person.legs;
        let plant = &self.plants[side.index()];
        let toes = plant.ankle + direction(plant.yaw) * (legs.ball * person.height);
        let mut time = from.max(plant.strike);
        while time < end {
            let motion = body.at(time);
            let hip = motion.position + direction(motion.heading).perp() * (side.sign() * legs.hip * person.height);
            let away = hip - toes;
            // moving towards the foot is no reason to lift it
            if away.length() > REACH * person.leg() && away.dot(motion.velocity) > 0.0 {
                return time;
            }
            time += 0.02;
        }
        end
    }
}

/// Returns the speeds of a motion along its heading and to its left, m/s.
pub(crate) fn along(motion: &Motion) -> (f64, f64) {
    let ahead = direction(motion.heading);
    (ahead.dot(motion.velocity), ahead.perp().dot(motion.velocity))
}

/// Returns the place and direction of the foot of a body that stands at a motion.
fn home(person: &Person, motion: &Motion, side: Side, width: f64) -> (DVec2, f64) {
    let left = direction(motion.heading).perp();
    (motion.position + left * (side.sign() * width / 2.0), motion.heading + side.sign() * person.turnout)
}
