//! Docking: Reynolds, Steering behaviors for autonomous characters, GDC 1999, "Arrival": at a place, in a direction, at a
//! speed, and at a time.

use super::approach;
use crate::Error;
use crate::motion::Steering;
use crate::steer::{Behaviour, Reason, View, Why};
use glam::Vec3;

/// Comes to a place in a direction, as ships and lifts do: to rest there, or through it at a speed; at a time, or when it
/// can.
///
/// The way is the polynomial of time of least degree that begins with the present place and velocity and ends with those
/// wanted, braking along the direction; it is found anew in every step.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::{Behaviour, Dock, View, Why};
/// let berth = Dock { place: Vec3::new(9.0, 4.0, 0.0), direction: Vec3::Y, speed: 0.0, time: None };
/// assert!(berth.steer(&View::default(), &mut [0.0; 2], &mut Why::default()).is_some());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dock {
    /// Where, metres.
    pub place: Vec3,
    /// In which direction, of any length but 0.
    pub direction: Vec3,
    /// How fast it goes there, m/s; 0: it stays. Limit: >= 0.
    pub speed: f32,
    /// When, seconds since the start; `None`: as soon as it can.
    pub time: Option<f64>,
}

/// Part of its brakes that a vehicle uses at the end.
const BRAKES: f32 = 0.3;
/// How far behind the place the last of the way begins, as a part of the distance at first.
const BEHIND: f32 = 1.0;
/// Part of its force, and of its top speed, that plans use: the rest is for what comes between.
const PLANNED: f32 = 0.8;
/// How many steps are too few for a plan.
const LAST_STEPS: f32 = 3.5;
/// So many seconds before it rests it faces as it will: its velocity hardly has a direction then.
const SETTLING: f32 = 0.5;
/// Once it is over by this many metres, at rest: else it tries again.
const TOLERANCE: f32 = 0.1;
/// How plans for when to be there grow, until one is good.
const LONGER: f32 = 1.05;
const PLANS: usize = 160;

impl Behaviour for Dock {
    /// Seconds until it is there: 0 before there is a plan, negative once it is there. How hard it brakes at the end.
    fn memory(&self) -> usize {
        2
    }

    fn steer(&self, view: &View<'_>, memory: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let [left, braking] = memory else { return None };
        let due = self.time.map(|time| (time - view.time) as f32);
        if *left == 0.0 || self.missed(view, *left) {
            *left = due.unwrap_or_else(|| self.soonest(view));
            *braking = self.braking(view, *left);
        }
        let (now, end) = (due.unwrap_or(*left), self.end(view, *braking));
        *left = now - view.seconds;
        why.note(|| Reason::Aim(self.place));
        if now > 0.5 * view.seconds {
            // in the last steps there is no time for more than the velocity
            let acceleration = if now > LAST_STEPS * view.seconds {
                end.acceleration_at(end.powers(view, now), now)
            } else {
                (end.velocity - view.velocity()) / now
            };
            let facing = (self.speed == 0.0 && now < SETTLING).then_some(self.direction);
            return Some(Steering { force: acceleration * view.vehicle.mass, facing });
        }
        let stay = || view.reach(approach(view, end.offset, Vec3::ZERO, 0.0));
        (self.speed == 0.0).then(|| Steering { facing: Some(self.direction), ..stay() })
    }

    fn check(&self) -> Result<(), Error> {
        let length = self.direction.length();
        Error::unless(
            length > 0.0 && length.is_finite(),
            "length of the direction",
            length,
            "greater than 0 and finite",
        )?;
        Error::unless(self.speed >= 0.0, "speed of docking", self.speed, "0 or more")
    }
}

impl Dock {
    /// Whether it should be at rest there, but is not.
    fn missed(&self, view: &View<'_>, left: f32) -> bool {
        left < -view.seconds && self.speed == 0.0 && view.to(self.place).length() > TOLERANCE.max(view.radius)
    }

    /// The way's end, with braking.
    fn end(&self, view: &View<'_>, braking: f32) -> End {
        let direction = view.passable(self.direction).normalize_or(view.forward());
        End { offset: view.to(self.place), velocity: direction * self.speed, acceleration: direction * -braking }
    }

    /// How hard to brake at the end of a way that takes so long; not at all if it goes on.
    fn braking(&self, view: &View<'_>, time: f32) -> f32 {
        if self.speed > 0.0 {
            return 0.0;
        }
        (2.0 * BEHIND * view.to(self.place).length() / (time * time)).min(BRAKES * view.vehicle.max_braking())
    }

    /// The least of some times in which the vehicle can do it.
    fn soonest(&self, view: &View<'_>) -> f32 {
        let vehicle = &view.vehicle;
        let most = PLANNED * vehicle.max_force / vehicle.mass;
        // where it ends faster it may be as fast as it can be between: to be held to the speed of the end, or little more, makes
        // long loops; where it starts faster, as fast as that
        let top = if self.speed > PLANNED * vehicle.max_speed { 1.0 } else { PLANNED };
        let fastest = 1.001 * (top * vehicle.max_speed).max(view.motion.speed()).max(self.speed);
        let can = |time: &f32| {
            let end = self.end(view, self.braking(view, *time));
            let powers = end.powers(view, *time);
            (0..=16).map(|i| *time * i as f32 / 16.0).all(|left| {
                let fast = end.velocity_at(powers, left).length();
                fast <= fastest && end.acceleration_at(powers, left).length() <= most
            })
        };
        let first = (view.to(self.place).length() / vehicle.max_speed).max(vehicle.response).max(view.seconds);
        let mut times = std::iter::successors(Some(first), |time| Some(time * LONGER)).take(PLANS);
        times.find(can).unwrap_or(first)
    }
}

/// How the way ends: where, from the agent, and with what velocity and acceleration.
#[derive(Clone, Copy)]
struct End {
    offset: Vec3,
    velocity: Vec3,
    acceleration: Vec3,
}

impl End {
    /// Coefficients of the third and fourth power of the time that is left: with `s` that time, the way is
    /// `offset - velocity s + acceleration s²/2 + c s³ + d s⁴`, which is here, with the present velocity, at `time`.
    fn powers(&self, view: &View<'_>, time: f32) -> (Vec3, Vec3) {
        let place = (self.velocity * time - self.offset - self.acceleration * (0.5 * time * time)) / time;
        let slope = self.velocity - self.acceleration * time - view.velocity();
        ((place * 4.0 - slope) / (time * time), (slope - place * 3.0) / (time * time * time))
    }

    fn velocity_at(&self, (c, d): (Vec3, Vec3), left: f32) -> Vec3 {
        self.velocity - (self.acceleration + (c * 3.0 + d * (4.0 * left)) * left) * left
    }

    fn acceleration_at(&self, (c, d): (Vec3, Vec3), left: f32) -> Vec3 {
        self.acceleration + (c * 6.0 + d * (12.0 * left)) * left
    }
}
