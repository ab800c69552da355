//! The course of an agent, and the braking that keeps the agent from going through surfaces.

use crate::single::settling_time;
use glam::Vec3;
use throng::motion::{Basis, Steering};
use throng::steer::SteeringInput;

/// The way ahead of an agent: a cylinder about its velocity, or about its forward direction at speed 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Course<'a> {
    view: &'a SteeringInput<'a>,
    /// Forward is the direction of motion.
    pub basis: Basis,
    /// Body radius and gap together.
    pub radius: f32,
    /// Length of the cylinder, metres.
    pub reach: f32,
}

/// Part of the braking force that an agent counts on: the rest is for turns.
const BRAKES: f32 = 0.5;
/// The reach is at least this multiple of the distance covered while the agent turns by one radian.
const TURNS: f32 = 2.0;

impl<'a> Course<'a> {
    /// Returns the course of an agent that keeps a gap and looks some seconds ahead, or farther if it turns slowly.
    pub fn new(view: &'a SteeringInput<'a>, gap: f32, seconds: f32) -> Self {
        let basis = view.motion.basis;
        let direction = view.velocity().try_normalize().unwrap_or(basis.forward);
        let vehicle = &view.vehicle;
        // the highest speed that is possible after the step
        let speed = (view.motion.speed() + vehicle.max_force / vehicle.mass * view.seconds).min(vehicle.max_speed);
        let turning = speed * vehicle.mass / vehicle.max_force.min(vehicle.forces.side);
        let turning = turning.max(1.0 / vehicle.max_turn_rate.radians()) + vehicle.smoothing + view.seconds;
        let reach = speed * seconds.max(TURNS * turning);
        Self { view, basis: basis.turned_to(direction, basis.up), radius: view.radius + gap, reach }
    }

    /// Returns the component of a direction that turns the course, of length 1; to the right if that component is 0.
    pub fn aside(&self, direction: Vec3) -> Vec3 {
        let across = self.view.passable(self.basis.lateral(direction));
        if across.length() > HEAD_ON { across.normalize() } else { -self.basis.side }
    }

    /// Returns a force with the corrections that keep the agent from approaching surfaces faster than it can brake. The
    /// corrections come first: the force keeps what is left of the force limit. Each surface is a point and the normal
    /// there, on the agent's side.
    pub fn held_off(&self, force: Vec3, surfaces: impl IntoIterator<Item = (Vec3, Vec3)>) -> Steering {
        let (view, vehicle) = (self.view, &self.view.vehicle);
        let chosen = view.velocity() + force * (view.seconds / vehicle.mass);
        let mut velocity = chosen;
        for (point, free) in surfaces {
            let closing = -velocity.dot(free);
            let room = (view.position() - point).dot(free) - self.radius - closing * vehicle.smoothing;
            let push = view.passable(free);
            let excess = closing - self.closing_speed(room);
            if excess > 0.0 && push.length() > HEAD_ON {
                velocity += push * (excess / push.length_squared());
            }
        }
        let brakes = (velocity - chosen) * (vehicle.mass / view.seconds);
        (brakes + force.clamp_length_max((vehicle.max_force - brakes.length()).max(0.0))).into()
    }

    /// Returns the highest speed towards a surface at this distance; braking starts in the next step.
    fn closing_speed(&self, room: f32) -> f32 {
        if room < 0.0 {
            return (room / settling_time(self.view, 0.0)).max(-self.view.vehicle.max_speed);
        }
        let braking = BRAKES * self.view.vehicle.max_braking();
        let step = 0.5 * braking * self.view.seconds;
        (step * step + 2.0 * braking * room).sqrt() - step
    }
}

/// Sine of the angle below which a direction counts as head-on and has no side.
const HEAD_ON: f32 = 0.01;
