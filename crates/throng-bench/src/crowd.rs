//! The people of a work, where they go, and what is solid: plain data for any simulator.

use glam::DVec2;
use std::sync::Arc;
use throng::avoid::Orca;
use throng::{
    Agent, Error, Goal, GoalId, Group, Journey, JourneyId, Obstacle, Settings, Stop, SubSteps, Walkable, World,
};

/// One person of a [`Crowd`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Person {
    /// Where they stand, metres.
    pub position: DVec2,
    /// Speed at which they would like to walk, m/s.
    pub preferred_speed: f64,
    /// Which of [`Crowd::ways`] they go; `None`: they stay.
    pub way: Option<usize>,
}

/// The people of a work. All have one radius; they look for the ten nearest within 5 m, and 2 s ahead.
#[derive(Clone, Debug, PartialEq)]
pub struct Crowd {
    /// In the order in which they are added.
    pub people: Vec<Person>,
    /// Radius of everybody, metres.
    pub radius: f64,
    /// Places to go to.
    pub goals: Vec<DVec2>,
    /// Indices of goals, one after the other, then again from the first.
    pub ways: Vec<Vec<usize>>,
    /// The ground; none: everywhere.
    pub walkable: Vec<Walkable>,
    /// What is solid.
    pub obstacles: Vec<Obstacle>,
    /// Seconds of a step.
    pub step: f64,
}

impl Crowd {
    /// Speed nobody exceeds, m/s.
    pub const MAX_SPEED: f64 = 2.0;
    /// How far everybody looks for others, metres.
    pub const NEIGHBOUR_DISTANCE: f64 = 5.0;
    /// How many of the nearest everybody takes into account.
    pub const NEIGHBOURS: usize = 10;
    /// How far everybody looks ahead, seconds.
    pub const TIME_HORIZON: f64 = 2.0;

    /// A crowd in the open, in steps of 0.1 s.
    pub(crate) fn open(people: Vec<Person>, radius: f64, goals: Vec<DVec2>) -> Self {
        let ways = (0..goals.len()).map(|goal| vec![goal]).collect();
        Self { people, radius, goals, ways, walkable: vec![], obstacles: vec![], step: 0.1 }
    }

    /// What every simulator of the kind does and no more: ORCA, velocities change at once, no manners.
    pub fn bare() -> Group {
        Group { look_ahead: false, keep_right: 0.0, resolve: false, ..Self::manners() }
    }

    /// What people do: throng's own group, with the reach of the reference works.
    pub fn manners() -> Group {
        Group {
            model: Arc::new(Orca { time_horizon: Self::TIME_HORIZON as f32, ..Orca::default() }),
            neighbour_distance: Self::NEIGHBOUR_DISTANCE as f32,
            neighbours: Self::NEIGHBOURS,
            ..Group::default()
        }
    }

    /// A world of this crowd, everybody in this group and with this greatest change of velocity a second. Steps are not
    /// divided.
    ///
    /// # Errors
    /// Those of [`World::add_group`] and [`World::add_agent`].
    pub fn world(&self, group: Group, max_acceleration: f32) -> Result<World, Error> {
        let mut world = World::new(Settings { step: self.step, sub_steps: SubSteps::Fixed(1), ..Settings::default() })?;
        world.set_walkable(self.walkable.clone())?;
        world.add_obstacles(self.obstacles.iter().cloned()).map_err(|(_, error)| error)?;
        let group = world.add_group(group)?;
        let goals: Vec<GoalId> = self
            .goals
            .iter()
            .map(|&at| world.add_goal(Goal::Point { at, tolerance: 0.5 }))
            .collect::<Result<_, _>>()?;
        let ways: Vec<JourneyId> = self
            .ways
            .iter()
            .map(|way| {
                let stops = way.iter().map(|&goal| Stop { goal: goals[goal], wait: 0.0 }).collect();
                world.add_journey(Journey { stops, repeat: true })
            })
            .collect::<Result<_, _>>()?;
        world.reserve(self.people.len());
        for person in &self.people {
            world.add_agent(Agent {
                position: person.position,
                group,
                journey: person.way.map_or(JourneyId::STAY, |way| ways[way]),
                radius: self.radius as f32,
                preferred_speed: person.preferred_speed as f32,
                max_speed: Self::MAX_SPEED as f32,
                max_acceleration,
                ..Agent::default()
            })?;
        }
        Ok(world)
    }
}
