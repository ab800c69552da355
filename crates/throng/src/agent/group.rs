//! What the agents of a group share.

use crate::Error;
use crate::avoid::{LocalModel, Orca, Unavoiding};
use crate::field::Governed;
use crate::motion::{Locomotion, Vehicle, WrapAround};
use crate::steer::{Barriers, Branch};
use std::sync::Arc;

/// What the agents of a group share: their local model, how far they look, and their manners.
#[derive(Clone, Debug)]
pub struct Group {
    /// Name, for people.
    pub name: String,
    /// How the preferred velocity becomes a safe one.
    pub model: Arc<dyn LocalModel>,
    /// How far an agent looks for others, metres between centres (cores, of bodies that are no discs). Limit: > 0.
    pub neighbour_distance: f32,
    /// How many of the nearest it takes into account, 1 to 1000. For those who avoid nobody also [`EVERYBODY`](Self::EVERYBODY)
    /// within `neighbour_distance`; or 0, nobody, and then nobody is looked for, nor are those measured who come close.
    pub neighbours: usize,
    /// Whether agents look ahead: they go where there is room, keep a time gap to the agent ahead, and turn from agents that
    /// come the other way. Without it they head straight along their ways, and leave all else to the local model.
    pub look_ahead: bool,
    /// Breadth across its way within which an agent has another ahead of it, metres, and no less than its body's: shoulders
    /// are broader than a body is deep, and turn where it is narrow. Limit: 0 to 10.
    pub shoulders: f32,
    /// Room that an agent likes to keep from agents that come the other way or stay where they are, metres; the nearer they
    /// are, the less of it counts. Limit: 0 to 10.
    pub personal_space: f32,
    /// Time in which an agent that looks ahead comes to the velocity it would like, seconds: it accelerates by the difference
    /// divided by it, across its way by half of it (Moussaïd et al. 2009 measured 0.54 ± 0.05 s along the way). 0: at once, as
    /// hard as it can. Agents that a field governs follow it at once, and models with a delay of their own do without. Limit:
    /// 0 to 10.
    pub relaxation_time: f32,
    /// Greatest angle by which an agent that looks ahead turns from one that comes the other way, radians. An undecided
    /// meeting is passed on the right; negative: on the left. Agents that do not look ahead are turned by it all the time.
    /// Limit: -0.5 to 0.5.
    pub keep_right: f32,
    /// Whether agents that block each other's ways agree who steps aside (MODELS 1.10, narrow places).
    pub resolve: bool,
    /// A field that governs where its agents go, beside their own ways or in place of them. They neither make detours nor agree
    /// who goes first: that they do not get on may be the field's doing. Not for those who steer: they [follow a
    /// flow](crate::steer::FollowFlow).
    pub field: Option<Governed>,
    /// What its agents steer by, instead of walking along their ways: the velocity that their vehicles come to have is
    /// the preferred one.
    pub steering: Option<Branch>,
    /// The vehicle of those who steer.
    pub vehicle: Vehicle,
    /// A ball that those who steer leave on one side and enter on the other; `None`: space goes on. Only without the
    /// guard: nobody knows who is on the other side.
    pub wrap_around: Option<WrapAround>,
    /// Surfaces in space that nobody of the group gets into, guarded or not, and from which side they are seen: columns from
    /// outside, a cage from inside. A body counts as the ball that holds it at any heading. Who would get in goes along
    /// them, or stops; who starts in one is led out, and counted as an [overlap](crate::Summary::overlaps) until then. They
    /// stand still and hide nobody: to see them coming is for [behaviours](crate::steer::AvoidObstacles). Not for those who
    /// wrap around.
    pub solid: Barriers,
    /// Whether the [guard](crate::guard) keeps its agents from overlapping others and walls. Two who are both of
    /// groups without it may overlap; nobody else may.
    pub guard: bool,
}

impl Group {
    /// As [`neighbours`](Self::neighbours): everybody near. What flocks want: however dense they are, they are fast, and those
    /// of one plain [`Flocking`](crate::steer::Flocking) fastest.
    pub const EVERYBODY: usize = usize::MAX;

    /// Whether a world can have it.
    pub(crate) fn check(&self) -> Result<(), Error> {
        Error::unless_positive("neighbour distance", self.neighbour_distance)?;
        let count = self.neighbours;
        let all_or_none = matches!(count, 0 | Self::EVERYBODY) && !self.model.avoids();
        let counts = (1..=1000).contains(&count) || all_or_none;
        let limit = "from 1 to 1000, or 0 or everybody for those who avoid nobody";
        Error::unless(counts, "neighbours", count as f64, limit)?;
        Error::unless(self.keep_right.abs() <= 0.5, "keep right", self.keep_right, "from -0.5 to 0.5 rad")?;
        self.check_look_ahead()?;
        self.model.check()?;
        self.check_field(&self.field)?;
        if let Some(steering) = &self.steering {
            steering.check()?;
            self.vehicle.check()?;
            if let Some(wrap_around) = &self.wrap_around {
                wrap_around.check()?;
                if self.guard {
                    let why = "it wraps around, where nobody can be certain: leave it without the guard".into();
                    return Err(Error::Shape { what: "the group".into(), why });
                }
            }
        }
        if self.wrap_around.is_some() && !self.solid.0.is_empty() {
            let why = "it wraps around, where a solid may be in the way: leave one of them away".into();
            return Err(Error::Shape { what: "the group".into(), why });
        }
        Ok(())
    }

    /// Whether a field can govern it.
    pub(crate) fn check_field(&self, field: &Option<Governed>) -> Result<(), Error> {
        let Some(field) = field else { return Ok(()) };
        field.check()?;
        if self.steering.is_some() {
            let why = "it steers, so no field can govern it beside that: let it follow the flow".into();
            return Err(Error::Shape { what: "the group".into(), why });
        }
        Ok(())
    }

    /// Whether its agents steer up and down, and so look there.
    pub(crate) fn steers_in_space(&self) -> bool {
        self.steering.is_some() && self.vehicle.locomotion != Locomotion::Ground
    }

    /// How many of the nearest are to be found for each of its agents.
    pub(crate) fn nearest(&self) -> usize {
        if self.neighbours == Self::EVERYBODY { 0 } else { self.neighbours }
    }

    /// Vehicles that go as they are steered: without manners, and nobody else has a say in it, be it that they overlap.
    ///
    /// ```
    /// use throng::motion::Vehicle;
    /// use throng::steer::Wander;
    /// use throng::{Group, Settings, World};
    /// let cars = Group { name: "cars".into(), ..Group::vehicles(Wander::default(), Vehicle::default()) };
    /// World::new(Settings::default())?.add_group(cars)?;
    /// # Ok::<(), throng::Error>(())
    /// ```
    pub fn vehicles(steering: impl Into<Branch>, vehicle: Vehicle) -> Self {
        Self {
            model: Arc::new(Unavoiding),
            steering: Some(steering.into()),
            vehicle,
            look_ahead: false,
            keep_right: 0.0,
            resolve: false,
            guard: false,
            ..Self::default()
        }
    }
}

impl Default for Group {
    fn default() -> Self {
        Self {
            name: "agents".into(),
            model: Arc::new(Orca::default()),
            neighbour_distance: 8.0,
            neighbours: 10,
            look_ahead: true,
            shoulders: 0.415,
            personal_space: 0.4,
            relaxation_time: 0.45,
            keep_right: 20.0_f32.to_radians(),
            resolve: true,
            field: None,
            steering: None,
            vehicle: Vehicle::default(),
            wrap_around: None,
            solid: Barriers::default(),
            guard: true,
        }
    }
}
