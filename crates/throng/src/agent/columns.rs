//! The state of the agents: a column for each property, a row for each agent.

use super::row::RowColumn;
use super::{Agent, Column, ColumnValue, Cycles, GroupId, JourneyId, Memory, ProgressMark, Rounding, ScriptId, Status};
use crate::motion::{Attitude, Holonomic, Motor, TwoWheels, Vehicle};
use crate::navigate::RouteProgress;
use glam::{DVec2, Vec2, Vec3};
use serde::{Deserialize, Serialize};

trait Permute {
    fn permute(&mut self, cycles: &Cycles);
}

impl<T> Permute for Vec<T> {
    fn permute(&mut self, cycles: &Cycles) {
        cycles.turn(self);
    }
}

impl Permute for Memory {
    fn permute(&mut self, cycles: &Cycles) {
        self.permute(cycles);
    }
}

impl<T: ColumnValue> Permute for Column<T> {
    fn permute(&mut self, cycles: &Cycles) {
        self.permute(cycles);
    }
}

macro_rules! columns {
    ($($(#[$meta:meta])* $name:ident: $type:ty,)*) => {
        /// The state of the agents. All columns have the same length. Rows are in no particular order, and the order
        /// changes from step to step: identify an agent by its number or id.
        #[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
        pub struct Columns {
            $($(#[$meta])* pub $name: $type,)*
        }

        /// The values of all columns in a row: an agent on its way from one world to another.
        #[derive(Clone, Debug, Serialize, Deserialize)]
        pub(crate) struct Row {
            $($(#[$meta])* pub $name: <$type as RowColumn>::Value,)*
        }

        impl Columns {
            /// Removes a row; the last row takes its place.
            pub(crate) fn swap_remove(&mut self, row: usize) {
                $(self.$name.swap_remove(row);)*
            }

            /// Reserves memory for more agents.
            pub(crate) fn reserve(&mut self, additional: usize) {
                $(self.$name.reserve(additional);)*
            }

            /// Moves rows along cycles.
            pub(crate) fn permute(&mut self, cycles: &Cycles) {
                $(Permute::permute(&mut self.$name, cycles);)*
            }

            /// Removes all rows from this one on.
            pub(crate) fn truncate(&mut self, rows: usize) {
                $(self.$name.truncate(rows);)*
            }

            /// Returns a copy of a row.
            pub(crate) fn copy(&self, row: usize) -> Row {
                Row { $($name: self.$name.value(row),)* }
            }

            /// Adds a copy of a row of another world.
            pub(crate) fn push_copy(&mut self, row: Row) {
                $(self.$name.push_value(row.$name);)*
            }

            /// Whether all columns have the same length.
            pub(crate) fn is_whole(&self) -> bool {
                [$(self.$name.len()),*].iter().all(|&len| len == self.len()) && self.memory.is_whole()
            }
        }
    };
}

columns! {
    /// Slot of the agent's [`AgentId`](super::AgentId).
    slot: Vec<u32>,
    /// Number of the agent. Ties, random draws and hashes depend on it.
    number: Vec<u32>,
    /// Centre, metres from the world's origin.
    position: Vec<Vec2>,
    /// What rounding has taken from the position, metres: see [`Rounding`](super::Rounding).
    rounding: Column<Rounding>,
    /// Height of the centre above the ground, metres; 0 for agents that walk.
    altitude: Column<f32>,
    /// Velocity along the ground: the motion in the last sub-step, before positions were rounded.
    velocity: Vec<Vec2>,
    /// Vertical velocity.
    vertical_velocity: Column<f32>,
    /// Direction of the body, radians counter-clockwise from +x, -pi to pi.
    heading: Vec<f32>,
    /// Attitude of vehicles.
    attitude: Column<Attitude>,
    /// Memory of the behaviours of agents that steer.
    memory: Memory,
    /// Angular velocity of the body in the last sub-step, radians a second. It is 0 for discs: their rotation does not
    /// affect contacts.
    spin: Column<f32>,
    /// Radius of the body, or of its rounding.
    radius: Column<f32>,
    /// Half extents of the core of the body; zero for discs.
    core: Column<Vec2>,
    /// Speed at which it walks when nothing hinders it.
    preferred_speed: Column<f32>,
    /// The vehicle that moves it, if that is its motor.
    vehicle: Column<Option<Vehicle>>,
    /// Maximum speed.
    max_speed: Column<f32>,
    /// Maximum acceleration; infinite for vehicles, which limit it themselves.
    max_acceleration: Column<f32>,
    /// Maximum turn rate.
    max_turn_rate: Column<f32>,
    /// Time gap to the agent ahead, seconds.
    time_gap: Column<f32>,
    /// Distance by which it may deviate from its chosen path while it turns; 0 for motors without two wheels.
    tracking_error: Column<f32>,
    /// Right of way.
    priority: Column<f32>,
    /// Factor on the ratio with which the field of its group governs it.
    governed: Column<f32>,
    /// Layers it is on.
    layers: Column<u32>,
    /// Layers it avoids.
    avoids: Column<u32>,
    /// Its group.
    group: Column<GroupId>,
    /// Its journey.
    journey: Column<JourneyId>,
    /// The script it follows.
    script: Column<Option<ScriptId>>,
    /// Status of its trip, as its neighbours read it in this step.
    status: Vec<Status>,
    /// The preferred velocity that the program gives, if it does.
    commanded: Column<Option<Vec3>>,
    /// Numbers for the program's own use.
    user_data: Column<u64>,
    /// Progress of its journey.
    travel: Vec<RouteProgress>,
    /// When it last made progress, and what has hindered it since.
    progress_mark: Vec<ProgressMark>,
    /// Time at which it entered, seconds.
    entered: Column<f64>,
    /// Time at which it first reached the end of its journey; infinite before.
    arrived: Column<f64>,
    /// Seconds for which it has walked.
    on_way: Column<f64>,
    /// Distance walked or flown, metres.
    walked: Vec<f64>,
    /// Sum of the turns of its heading, either way, radians.
    turned: Vec<f64>,
    /// Sum of the turns of its direction of motion, either way, radians.
    course_turned: Vec<f64>,
    /// Length of the shortest path of the legs begun so far, metres.
    shortest: Vec<f64>,
}

impl Columns {
    /// Returns the number of agents.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Whether there are no agents.
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }

    /// Whether any agent is above the ground.
    pub fn any_flies(&self) -> bool {
        self.altitude.values().iter().any(|&altitude| altitude != 0.0)
    }

    /// Whether rounding may have taken anything from any position.
    pub(crate) fn are_rounded(&self) -> bool {
        !self.rounding.uniform().is_some_and(|rounding| rounding.same(Rounding::NONE))
    }

    /// Whether all agents are discs.
    pub fn all_discs(&self) -> bool {
        self.core.values().iter().all(|&core| core == Vec2::ZERO)
    }

    /// Returns the speed of an agent, in space.
    pub fn speed(&self, row: usize) -> f32 {
        self.velocity_in_space(row).length()
    }

    /// Returns the velocity of an agent, in space.
    pub(crate) fn velocity_in_space(&self, row: usize) -> Vec3 {
        self.velocity[row].extend(self.vertical_velocity[row])
    }

    pub(crate) fn push(&mut self, agent: &Agent, origin: DVec2, slot: u32, number: u32, heading: f32, now: f64) {
        let limits = agent.motor.limits();
        self.slot.push(slot);
        self.number.push(number);
        self.position.push((agent.position.truncate() - origin).as_vec2());
        self.rounding.push(Rounding::NONE);
        self.altitude.push(agent.position.z as f32);
        self.velocity.push(agent.velocity);
        self.vertical_velocity.push(0.0);
        self.heading.push(heading);
        self.attitude.push(if limits.vehicle.is_some() { Attitude::heading(heading) } else { Attitude::default() });
        self.memory.push();
        self.spin.push(0.0);
        self.radius.push(agent.radius);
        self.core.push(agent.core);
        self.preferred_speed.push(agent.preferred_speed);
        self.vehicle.push(limits.vehicle);
        self.max_speed.push(limits.max_speed);
        self.max_acceleration.push(limits.max_acceleration);
        self.max_turn_rate.push(limits.max_turn_rate);
        self.tracking_error.push(limits.tracking_error);
        self.time_gap.push(agent.time_gap);
        self.priority.push(agent.priority);
        self.governed.push(agent.governed);
        self.layers.push(agent.layers);
        self.avoids.push(agent.avoids);
        self.group.push(agent.group);
        self.journey.push(agent.journey);
        self.script.push(agent.script);
        self.status.push(Status::Walking);
        self.commanded.push(None);
        self.user_data.push(agent.user_data);
        self.travel.push(RouteProgress::default());
        self.progress_mark.push(ProgressMark::default());
        self.entered.push(now);
        self.arrived.push(f64::INFINITY);
        self.on_way.push(0.0);
        self.walked.push(0.0);
        self.turned.push(0.0);
        self.course_turned.push(0.0);
        self.shortest.push(0.0);
    }

    /// Returns the motor of an agent.
    pub fn motor(&self, row: usize) -> Motor {
        let (max_speed, max_acceleration) = (self.max_speed[row], self.max_acceleration[row]);
        let (max_turn_rate, tracking_error) = (self.max_turn_rate[row], self.tracking_error[row]);
        match self.vehicle[row] {
            Some(vehicle) => vehicle.into(),
            None if tracking_error > 0.0 => {
                TwoWheels { max_speed, max_acceleration, max_turn_rate, tracking_error }.into()
            }
            None => Holonomic { max_speed, max_acceleration, max_turn_rate }.into(),
        }
    }

    /// Returns the time constant, at least `least` seconds, with which an agent can approach a place without overshoot.
    pub(crate) fn approach_time(&self, row: usize, least: f32, seconds: f32) -> f32 {
        self.vehicle[row].map_or(least, |vehicle| least.max(vehicle.settling_time(seconds)))
    }

    /// Returns the greatest speed with which an agent approaches a place, `distance` metres away, to stop there: it brakes
    /// with half of its deceleration, which leaves half for turning, and takes at least `time` seconds.
    pub(crate) fn stopping_speed(&self, row: usize, distance: f32, time: f32) -> f32 {
        let most = self.vehicle[row].map_or(self.max_acceleration[row], |vehicle| vehicle.max_braking());
        (most * distance).sqrt().min(distance / time)
    }

    /// Sets the motor of an agent.
    pub(crate) fn set_motor(&mut self, row: usize, motor: Motor) {
        let limits = motor.limits();
        if limits.vehicle.is_some() && self.vehicle[row].is_none() {
            self.attitude.set(row, Attitude::heading(self.heading[row]));
        }
        self.vehicle.set(row, limits.vehicle);
        self.max_speed.set(row, limits.max_speed);
        self.max_acceleration.set(row, limits.max_acceleration);
        self.max_turn_rate.set(row, limits.max_turn_rate);
        self.tracking_error.set(row, limits.tracking_error);
    }

    /// Whether every agent avoids every other agent.
    pub(crate) fn all_avoid(&self) -> bool {
        let common = |all: &[u32]| all.iter().fold(u32::MAX, |common, each| common & each);
        common(self.avoids.values()) & common(self.layers.values()) != 0
    }

    /// Whether two agents collide with each other: at least one of them avoids the other.
    pub(crate) fn meet(&self, row: usize, other: usize) -> bool {
        self.avoids(row, other) || self.avoids(other, row)
    }

    /// Whether `row` avoids `other`.
    pub(crate) fn avoids(&self, row: usize, other: usize) -> bool {
        self.avoids[row] & self.layers[other] != 0
    }
}
