//! Docking: Reynolds, Steering behaviors for autonomous characters, GDC 1999, "Arrival": at a place, in a direction, at
//! a speed, and at a time.

use super::{approach, direction};
use glam::Vec3;
use throng::Error;
use throng::motion::Steering;
use throng::parameters::{Angle, SpacePlace, Value, parameters};
use throng::steer::{Behaviour, SteeringInput, SteeringReason, TraceRecorder};

/// Moves to a place, in a direction, at a speed, at a time (Reynolds 1999, "arrival").
///
/// As ships and lifts do: the agent stops there or passes through at a speed, at a given time or as soon as it can.
///
/// The trajectory is the polynomial of time of least degree that starts with the present place and velocity and ends
/// with the required place, velocity and deceleration. It is computed anew in every step.
///
/// ```
/// use glam::Vec3;
/// use throng::parameters::Angle;
/// use throng::steer::{Behaviour, SteeringInput, TraceRecorder};
/// use throng_steer::Dock;
/// let berth = Dock::new(Vec3::new(9.0, 4.0, 0.0), Angle::degrees(90.0));
/// assert!(berth.steer(&SteeringInput::default(), &mut [0.0; 2], &mut TraceRecorder::default()).is_some());
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dock {
    /// The place.
    #[parameter(required, from = SpacePlace, unit = "m")]
    pub place: Vec3,
    /// Direction of motion at the place, degrees counter-clockwise from +x.
    #[parameter(required, unit = "°")]
    pub heading: Angle,
    /// Elevation of that direction, degrees.
    #[parameter(default = Angle::degrees(0.0), unit = "°", least = -90, most = 90)]
    pub pitch: Angle,
    /// Speed at the place, m/s; 0: it stops there.
    #[parameter(default = 0.0, unit = "m/s", least = 0)]
    pub speed: f32,
    /// Time of arrival, seconds since the start. Without it, as soon as possible.
    #[parameter(unit = "s", least = 0)]
    pub time: Option<f64>,
}

/// A [`Dock`] with a vector for its direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Docking {
    /// The place, metres.
    pub place: Vec3,
    /// The direction, of any length except 0.
    pub direction: Vec3,
    /// The speed at the place, m/s; 0: the agent stays there. Limit: >= 0.
    pub speed: f32,
    /// The time of arrival, seconds since the start; `None`: as soon as possible.
    pub time: Option<f64>,
}

impl Dock {
    fn docking(&self) -> Docking {
        let Self { place, heading, pitch, speed, time } = *self;
        Docking { place, direction: direction(heading, pitch), speed, time }
    }
}

/// Part of the braking force that a vehicle uses at the end.
const BRAKES: f32 = 0.3;
/// Distance behind the place at which the final approach begins, as a part of the initial distance.
const BEHIND: f32 = 1.0;
/// Part of the top force, and of the top speed, that plans use; the rest is in reserve.
const PLANNED: f32 = 0.8;
/// Number of remaining steps below which no plan is computed.
const LAST_STEPS: f32 = 3.5;
/// Seconds before the stop at which the agent turns to its final direction: from then on its velocity hardly has a
/// direction.
const SETTLING: f32 = 0.5;
/// Greatest distance of the stopped agent from the place, metres; beyond it the agent tries again.
const TOLERANCE: f32 = 0.1;
/// Factor from one trial duration of a plan to the next, until a plan is feasible.
const LONGER: f32 = 1.05;
const PLANS: usize = 160;

impl Behaviour for Dock {
    fn memory(&self) -> usize {
        self.docking().memory()
    }

    fn steer(&self, view: &SteeringInput<'_>, memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        self.docking().steer(view, memory, why)
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()?;
        self.docking().check()
    }
}

impl Behaviour for Docking {
    /// Seconds until arrival: 0 before there is a plan, negative after arrival. Then the deceleration at the end.
    fn memory(&self) -> usize {
        2
    }

    fn steer(&self, view: &SteeringInput<'_>, memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let [left, braking] = memory else { return None };
        let due = self.time.map(|time| (time - view.time) as f32);
        if *left == 0.0 || self.missed(view, *left) {
            *left = due.unwrap_or_else(|| self.soonest(view));
            *braking = self.braking(view, *left);
        }
        let (now, end) = (due.unwrap_or(*left), self.end(view, *braking));
        *left = now - view.seconds;
        why.note(|| SteeringReason::Aim(self.place));
        if now > 0.5 * view.seconds {
            // in the last steps there is only time to reach the final velocity
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
        Error::unless(self.speed >= 0.0, "speed", self.speed, "0 or more")
    }
}

impl Docking {
    /// Whether the agent should stand at the place but does not.
    fn missed(&self, view: &SteeringInput<'_>, left: f32) -> bool {
        left < -view.seconds && self.speed == 0.0 && view.to(self.place).length() > TOLERANCE.max(view.radius)
    }

    /// Returns the end of the trajectory, with this deceleration.
    fn end(&self, view: &SteeringInput<'_>, braking: f32) -> End {
        let direction = view.passable(self.direction).normalize_or(view.forward());
        End { offset: view.to(self.place), velocity: direction * self.speed, acceleration: direction * -braking }
    }

    /// Returns the deceleration at the end of a trajectory of this duration; 0 if the agent does not stop at the place.
    fn braking(&self, view: &SteeringInput<'_>, time: f32) -> f32 {
        if self.speed > 0.0 {
            return 0.0;
        }
        (2.0 * BEHIND * view.to(self.place).length() / (time * time)).min(BRAKES * view.vehicle.max_braking())
    }

    /// Returns the shortest of the trial durations that is feasible for the vehicle.
    fn soonest(&self, view: &SteeringInput<'_>) -> f32 {
        let vehicle = &view.vehicle;
        let most = PLANNED * vehicle.max_force / vehicle.mass;
        // A trajectory that ends faster may use the top speed in between: limited to its end speed, or little more, it
        // would make long loops. A trajectory that starts faster may use its start speed.
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

/// The end of the trajectory: its offset from the agent, velocity and acceleration.
#[derive(Clone, Copy)]
struct End {
    offset: Vec3,
    velocity: Vec3,
    acceleration: Vec3,
}

impl End {
    /// Returns the coefficients of the third and fourth power of the remaining time. With the remaining time `s` the
    /// trajectory is `offset - velocity s + acceleration s²/2 + c s³ + d s⁴`; at `s = time` it has the agent's present
    /// position and velocity.
    fn powers(&self, view: &SteeringInput<'_>, time: f32) -> (Vec3, Vec3) {
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
