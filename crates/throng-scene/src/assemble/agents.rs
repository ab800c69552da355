//! The bodies and speeds of each agent.

use super::motor::vehicle;
use super::size::Size;
use crate::geometry::DVec2;
use crate::random::{Purpose, Random};
use crate::registry::ChosenModel;
use crate::scene::{self, Group, Neighbours, Number, Preset, Scene};
use glam::Vec2;
use throng::Agent;
use throng::agent::Guidance;
use throng::motion::{Holonomic, Motor, TwoWheels, Vehicle, WrapAround};

/// Draws the values that differ between agents.
pub(super) struct AgentDraw<'a> {
    scene: &'a Scene,
    group: usize,
    /// The vehicle, if it is the motor.
    vehicle: Option<Vehicle>,
}

impl<'a> AgentDraw<'a> {
    pub fn new(scene: &'a Scene, group: usize) -> Self {
        let given = &scene.groups[group];
        let vehicle = (given.moved_by() == scene::Motor::Vehicle).then(|| vehicle(given));
        Self { scene, group, vehicle }
    }

    fn group(&self) -> &Group {
        &self.scene.groups[self.group]
    }

    fn number(&self, k: usize, purpose: Purpose, number: &Number) -> f64 {
        match number {
            Number::Constant(x) => *x,
            number => Random::new(self.scene.seed, self.group as u64, k as u64, purpose).draw(number),
        }
    }

    /// Returns a number of the k-th agent, if the scene gives it.
    fn optional(&self, k: usize, purpose: Purpose, number: &Option<Number>) -> Option<f32> {
        number.map(|number| self.number(k, purpose, &number) as f32)
    }

    /// Returns the size of the k-th agent.
    pub fn size(&self, k: usize) -> Size {
        Size::of(&self.group().body, |purpose, number| self.number(k, purpose, number))
    }

    /// Returns the start height of the k-th agent above its place, metres.
    pub fn altitude(&self, k: usize) -> f64 {
        self.group().altitude.map_or(0.0, |altitude| self.number(k, Purpose::Altitude, &altitude))
    }

    /// Returns the preferred and the greatest speed of the k-th agent.
    fn speeds(&self, k: usize) -> (f32, f32) {
        let group = self.group();
        if let Some(vehicle) = self.vehicle {
            return (vehicle.max_speed, vehicle.max_speed);
        }
        let preferred = self.number(k, Purpose::PreferredSpeed, &group.speed.preferred) as f32;
        let max = match &group.speed.max {
            Some(max) => self.number(k, Purpose::MaxSpeed, max) as f32,
            None => Holonomic::default().max_speed.max(preferred),
        };
        (preferred, max)
    }

    /// Returns the motor of the k-th agent.
    fn motor(&self, k: usize, max_speed: f32) -> Motor {
        if let Some(vehicle) = self.vehicle {
            return vehicle.into();
        }
        let (group, standard) = (self.group(), Holonomic::default());
        let drawn = |purpose, number| self.optional(k, purpose, number);
        let max_acceleration = drawn(Purpose::Acceleration, &group.acceleration).unwrap_or(standard.max_acceleration);
        let max_turn_rate = drawn(Purpose::TurnRate, &group.turn_rate).map_or(standard.max_turn_rate, f32::to_radians);
        let tracking_error = match group.moved_by() {
            scene::Motor::Holonomic => 0.0,
            _ => drawn(Purpose::TrackingError, &group.tracking_error).unwrap_or(TwoWheels::default().tracking_error),
        };
        if tracking_error > 0.0 {
            TwoWheels { max_speed, max_acceleration, max_turn_rate, tracking_error }.into()
        } else {
            Holonomic { max_speed, max_acceleration, max_turn_rate }.into()
        }
    }

    /// Returns the k-th agent, without its place, body, ids and number.
    pub fn agent(&self, k: usize) -> Agent {
        let group = self.group();
        let (preferred, max) = self.speeds(k);
        let standard = Agent::default();
        let optional = |purpose, number| self.optional(k, purpose, number);
        let heading = optional(Purpose::Heading, &group.heading).map(f32::to_radians);
        let start_speed = optional(Purpose::StartSpeed, &group.start_speed).unwrap_or(0.0);
        let ahead = heading.map_or(Vec2::ZERO, |heading| {
            let (sin, cos) = libm::sincosf(heading);
            Vec2::new(cos, sin)
        });
        let bits = |layers: &[u8]| layers.iter().fold(0u32, |bits, layer| bits | 1 << u32::from(*layer).min(31));
        Agent {
            heading,
            velocity: ahead * start_speed,
            preferred_speed: preferred.min(max),
            motor: self.motor(k, max),
            time_gap: optional(Purpose::TimeGap, &group.time_gap).unwrap_or(standard.time_gap),
            priority: group.priority as f32,
            governed: group
                .field
                .as_ref()
                .and_then(|field| field.ratio)
                .map_or(1.0, |ratio| self.number(k, Purpose::Governed, &ratio) as f32),
            layers: bits(&group.layers),
            avoids: group.avoids.as_ref().map_or(u32::MAX, |layers| bits(layers)),
            ..standard
        }
    }
}

/// Angle by which agents that imitate those of the labs turn to the right, radians.
const ANIMATED_SIDE: f32 = 8.0_f64.to_radians() as f32;

/// Returns the shared properties of a group's agents. Interaction rules are off for agents that steer, unless the scene
/// sets them.
#[allow(clippy::needless_update)] // The library may know more of groups and models than scenes say.
pub(super) fn shared(
    group: &Group,
    name: String,
    ChosenModel { model, neighbours, neighbour_distance }: ChosenModel,
    guidance: Guidance,
    origin: DVec2,
) -> throng::Group {
    let steering = &guidance.behaviour;
    let walks = steering.is_none();
    let neighbours = match neighbours {
        Neighbours::Nearest(count) => count as usize,
        Neighbours::All => throng::Group::ALL_NEIGHBOURS,
    };
    // the neighbour search reaches as far as the behaviour needs
    let range = steering.as_ref().filter(|_| group.avoid.is_none()).and_then(|steering| steering.perception_range());
    let (neighbours, neighbour_distance) = match range {
        None => (neighbours, neighbour_distance as f32),
        Some(0.0) => (0, neighbour_distance as f32),
        Some(reach) => (throng::Group::ALL_NEIGHBOURS, reach),
    };
    let usual = throng::Group::default();
    let animated = group.preset == Preset::Animation;
    let look_ahead = group.look_ahead.unwrap_or(walks && !animated);
    let side = match (animated, look_ahead) {
        (true, _) => ANIMATED_SIDE,
        (false, true) => usual.keep_right,
        (false, false) => 0.0,
    };
    throng::Group {
        name,
        origin,
        guard: group.guard.unwrap_or(walks && model.wants_guard()),
        model,
        neighbour_distance,
        neighbours,
        look_ahead,
        shoulders: group.shoulders.map_or(usual.shoulders, |metres| metres as f32),
        personal_space: group.personal_space.map_or(usual.personal_space, |metres| metres as f32),
        relaxation_time: group.relaxation_time.map_or(usual.relaxation_time, |seconds| seconds as f32),
        keep_right: group.keep_right.map_or(side, |degrees| degrees.to_radians() as f32),
        resolve: group.resolve.unwrap_or(walks),
        guidance,
        wrap_around: group.wrap_around.map(|ball| wrap_around(ball, origin)),
        ..usual
    }
}

/// Returns the sphere that the agents leave on one side and enter on the other.
fn wrap_around(said: scene::WrapAround, origin: DVec2) -> WrapAround {
    let [x, y, z] = said.center.0;
    WrapAround { center: (DVec2::new(x, y) - origin).as_vec2().extend(z as f32), radius: said.radius as f32 }
}
