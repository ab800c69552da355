//! Where an agent is going, and how it is kept from going through what is in the way.

use crate::motion::{Basis, Steering};
use crate::steer::View;
use crate::steer::single::settling_time;
use glam::Vec3;

/// The way ahead of an agent: a cylinder about its velocity, or about where it faces at rest.
#[derive(Clone, Copy, Debug)]
pub(super) struct Course<'a> {
    view: &'a View<'a>,
    /// Ahead is where it goes.
    pub basis: Basis,
    /// Radius of its body and the gap that it keeps.
    pub radius: f32,
    /// How far it looks.
    pub reach: f32,
}

/// Part of its brakes that an agent counts on: the rest is for turns.
const BRAKES: f32 = 0.5;
/// It looks so many times farther than it goes until it has turned by a radian.
const TURNS: f32 = 2.0;

impl<'a> Course<'a> {
    /// Of one who keeps a gap and looks so many seconds ahead, or more if it turns slowly.
    pub fn new(view: &'a View<'a>, gap: f32, seconds: f32) -> Self {
        let basis = view.motion.basis;
        let direction = view.velocity().try_normalize().unwrap_or(basis.forward);
        let vehicle = &view.vehicle;
        // as fast as it may be after the step
        let speed = (view.motion.speed() + vehicle.max_force / vehicle.mass * view.seconds).min(vehicle.max_speed);
        let turning = speed * vehicle.mass / vehicle.max_force.min(vehicle.forces.side);
        let turning = turning.max(1.0 / vehicle.max_turn_rate) + vehicle.smoothing + view.seconds;
        let reach = speed * seconds.max(TURNS * turning);
        Self { view, basis: basis.turned_to(direction, basis.up), radius: view.radius + gap, reach }
    }

    /// The part of a force's direction that turns the course, of length 1; to the right if it has none.
    pub fn aside(&self, direction: Vec3) -> Vec3 {
        let across = self.view.passable(self.basis.lateral(direction));
        if across.length() > HEAD_ON { across.normalize() } else { -self.basis.side }
    }

    /// A force, and what must be added to it, or put in its place, so that the agent comes nearer to surfaces no faster
    /// than it can brake. Each is told by a point of it and the normal there, on the agent's side.
    pub fn held_off(&self, force: Vec3, surfaces: impl IntoIterator<Item = (Vec3, Vec3)>) -> Steering {
        let (view, vehicle) = (self.view, &self.view.vehicle);
        let wish = view.velocity() + force * (view.seconds / vehicle.mass);
        let mut velocity = wish;
        for (point, free) in surfaces {
            let closing = -velocity.dot(free);
            let room = (view.position() - point).dot(free) - self.radius - closing * vehicle.smoothing;
            let push = view.passable(free);
            let excess = closing - self.closing_speed(room);
            if excess > 0.0 && push.length() > HEAD_ON {
                velocity += push * (excess / push.length_squared());
            }
        }
        let brakes = (velocity - wish) * (vehicle.mass / view.seconds);
        (brakes + force.clamp_length_max((vehicle.max_force - brakes.length()).max(0.0))).into()
    }

    /// How fast it may come nearer to what has so much room before it: it brakes from the next step on.
    fn closing_speed(&self, room: f32) -> f32 {
        if room < 0.0 {
            return (room / settling_time(self.view, 0.0)).max(-self.view.vehicle.max_speed);
        }
        let braking = BRAKES * self.view.vehicle.max_braking();
        let step = 0.5 * braking * self.view.seconds;
        (step * step + 2.0 * braking * room).sqrt() - step
    }
}

/// Sine of the angle below which a direction has no side.
const HEAD_ON: f32 = 0.01;
