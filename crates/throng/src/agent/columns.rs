//! The agents' state: a column a fact, a row an agent.

use super::{Agent, Column, Cycles, GroupId, JourneyId, Memory, ProgressMark, ScriptId, Status, Value};
use crate::motion::Attitude;
use crate::navigate::Travel;
use glam::{DVec2, Vec2};
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

impl<T: Value> Permute for Column<T> {
    fn permute(&mut self, cycles: &Cycles) {
        self.permute(cycles);
    }
}

macro_rules! columns {
    ($($(#[$meta:meta])* $name:ident: $type:ty,)*) => {
        /// The agents' state. All columns have the same length; rows are in no particular order and change from step to
        /// step: whoever is to be known again is known by number or id.
        #[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
        pub struct Columns {
            $($(#[$meta])* pub $name: $type,)*
        }

        impl Columns {
            /// Removes a row; the last row takes its place.
            pub(crate) fn swap_remove(&mut self, row: usize) {
                $(self.$name.swap_remove(row);)*
            }

            /// Makes room for more agents.
            pub(crate) fn reserve(&mut self, additional: usize) {
                $(self.$name.reserve(additional);)*
            }

            /// Moves rows along cycles.
            pub(crate) fn permute(&mut self, cycles: &Cycles) {
                $(Permute::permute(&mut self.$name, cycles);)*
            }

            /// Whether all columns are of one length.
            pub(crate) fn is_whole(&self) -> bool {
                [$(self.$name.len()),*].iter().all(|&len| len == self.len()) && self.memory.is_whole()
            }
        }
    };
}

columns! {
    /// Slot of the agent's [`AgentId`](super::AgentId).
    slot: Vec<u32>,
    /// The agent's own number: ties, random draws and hashes go by it.
    number: Vec<u32>,
    /// Centre, metres from the world's origin.
    position: Vec<Vec2>,
    /// Height of the centre above the ground, metres; 0 for those who walk.
    altitude: Column<f32>,
    /// Velocity along the ground: the motion of the last sub-step, before positions were rounded.
    velocity: Vec<Vec2>,
    /// Velocity upwards.
    climb: Column<f32>,
    /// Direction of the body, radians counter-clockwise from +x, -pi to pi.
    heading: Vec<f32>,
    /// How those who steer hold themselves.
    attitude: Column<Attitude>,
    /// What the behaviours of those who steer remember.
    memory: Memory,
    /// Radians a second that the body turned in the last sub-step; 0 for discs, whose turning touches nobody.
    spin: Column<f32>,
    /// Radius of the body, or of its rounding.
    radius: Column<f32>,
    /// Half extents of the core of the body; zero for discs.
    core: Column<Vec2>,
    /// Speed it walks at when nothing hinders it.
    preferred_speed: Column<f32>,
    /// Speed it never exceeds.
    max_speed: Column<f32>,
    /// Greatest change of velocity a second.
    max_acceleration: Column<f32>,
    /// Greatest change of heading a second.
    max_turn_rate: Column<f32>,
    /// Time gap to the agent ahead, seconds.
    time_gap: Column<f32>,
    /// How far beside the way it chose it may get while it turns.
    tracking_error: Column<f32>,
    /// Right of way.
    priority: Column<f32>,
    /// How much the field of its group has to say.
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
    /// What it is doing, as others see it in this step.
    status: Vec<Status>,
    /// How its journey goes.
    travel: Vec<Travel>,
    /// When it last got on, and what hinders it since.
    progress_mark: Vec<ProgressMark>,
    /// Time it entered, seconds.
    entered: Column<f64>,
    /// Time it first came to the end of its journey; infinite before.
    arrived: Column<f64>,
    /// Seconds it has been on its way.
    on_way: Column<f64>,
    /// Metres walked or flown.
    walked: Vec<f64>,
    /// Radians its heading has turned, either way.
    turned: Vec<f64>,
    /// Radians the direction of its motion has turned, either way.
    course_turned: Vec<f64>,
    /// Metres of the shortest way of the legs begun so far.
    shortest: Vec<f64>,
}

impl Columns {
    /// Number of agents.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Whether there are no agents.
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }

    /// Whether anybody is off the ground.
    pub fn anybody_flies(&self) -> bool {
        self.altitude.values().iter().any(|&altitude| altitude != 0.0)
    }

    /// Whether everybody is a disc.
    pub fn all_discs(&self) -> bool {
        self.core.values().iter().all(|&core| core == Vec2::ZERO)
    }

    /// How fast an agent is, in space.
    pub fn speed(&self, row: usize) -> f32 {
        self.velocity[row].extend(self.climb[row]).length()
    }

    pub(crate) fn push(&mut self, agent: &Agent, origin: DVec2, slot: u32, number: u32, heading: f32, now: f64) {
        self.slot.push(slot);
        self.number.push(number);
        self.position.push((agent.position - origin).as_vec2());
        self.altitude.push(agent.altitude);
        self.velocity.push(agent.velocity);
        self.climb.push(0.0);
        self.heading.push(heading);
        self.attitude.push(Attitude::default());
        self.memory.push();
        self.spin.push(0.0);
        self.radius.push(agent.radius);
        self.core.push(agent.core);
        self.preferred_speed.push(agent.preferred_speed);
        self.max_speed.push(agent.max_speed);
        self.max_acceleration.push(agent.max_acceleration);
        self.max_turn_rate.push(agent.max_turn_rate);
        self.time_gap.push(agent.time_gap);
        self.tracking_error.push(agent.tracking_error);
        self.priority.push(agent.priority);
        self.governed.push(agent.governed);
        self.layers.push(agent.layers);
        self.avoids.push(agent.avoids);
        self.group.push(agent.group);
        self.journey.push(agent.journey);
        self.script.push(agent.script);
        self.status.push(Status::Walking);
        self.travel.push(Travel::default());
        self.progress_mark.push(ProgressMark::default());
        self.entered.push(now);
        self.arrived.push(f64::INFINITY);
        self.on_way.push(0.0);
        self.walked.push(0.0);
        self.turned.push(0.0);
        self.course_turned.push(0.0);
        self.shortest.push(0.0);
    }

    /// Whether everybody avoids everybody else.
    pub(crate) fn all_avoid(&self) -> bool {
        let common = |all: &[u32]| all.iter().fold(u32::MAX, |common, each| common & each);
        common(self.avoids.values()) & common(self.layers.values()) != 0
    }

    /// Whether `row` avoids `other`.
    pub(crate) fn avoids(&self, row: usize, other: usize) -> bool {
        self.avoids[row] & self.layers[other] != 0
    }
}
