//! The pedestrians of a work, their ways and the obstacles: plain data for any simulator.

use glam::DVec2;
use std::sync::Arc;
use throng::avoid::Orca;
use throng::motion::Holonomic;
use throng::{
    Agent, Error, Goal, GoalId, Group, Journey, JourneyId, Obstacle, Settings, Stop, SubSteps, Walkable, World,
};

/// A pedestrian of a [`Crowd`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Person {
    /// Initial position, metres.
    pub position: DVec2,
    /// Preferred speed, m/s.
    pub preferred_speed: f64,
    /// Index into [`Crowd::ways`]; `None`: the pedestrian stays.
    pub way: Option<usize>,
}

/// The pedestrians of a work. All have the same radius, and avoid the ten nearest neighbours within 5 m with a time
/// horizon of 2 s.
#[derive(Clone, Debug, PartialEq)]
pub struct Crowd {
    /// The pedestrians, in the order in which they are added.
    pub people: Vec<Person>,
    /// Radius of all pedestrians, metres.
    pub radius: f64,
    /// Goals, metres.
    pub goals: Vec<DVec2>,
    /// Side of the squares around the goals in which agents leave, metres; `None`: agents arrive at the goals and stay.
    pub exit: Option<f64>,
    /// By way: indices of goals, visited in order and repeatedly.
    pub ways: Vec<Vec<usize>>,
    /// The walkable areas; empty: everywhere.
    pub walkable: Vec<Walkable>,
    /// The obstacles.
    pub obstacles: Vec<Obstacle>,
    /// Length of a step, seconds.
    pub step: f64,
}

impl Crowd {
    /// Greatest speed, m/s.
    pub const MAX_SPEED: f64 = 2.0;
    /// Range of the neighbour search, metres.
    pub const NEIGHBOUR_DISTANCE: f64 = 5.0;
    /// Greatest number of neighbours.
    pub const NEIGHBOURS: usize = 10;
    /// Time horizon of the avoidance, seconds.
    pub const TIME_HORIZON: f64 = 2.0;

    /// Creates a crowd on unbounded ground, with steps of 0.1 s.
    pub(crate) fn open(people: Vec<Person>, radius: f64, goals: Vec<DVec2>) -> Self {
        let ways = (0..goals.len()).map(|goal| vec![goal]).collect();
        Self { people, radius, goals, exit: None, ways, walkable: vec![], obstacles: vec![], step: 0.1 }
    }

    /// Returns the group that other simulators have in common: ORCA, velocities that change at once, no interaction
    /// rules.
    pub fn bare() -> Group {
        Group { look_ahead: false, keep_right: 0.0, resolve: false, ..Self::interaction() }
    }

    /// Returns throng's default group, with the neighbour search of the reference works.
    pub fn interaction() -> Group {
        Group {
            model: Arc::new(Orca { time_horizon: Self::TIME_HORIZON as f32, ..Orca::default() }),
            neighbour_distance: Self::NEIGHBOUR_DISTANCE as f32,
            neighbours: Self::NEIGHBOURS,
            ..Group::default()
        }
    }

    /// Returns a world of this crowd, with all agents in this group and with this greatest acceleration. Steps are not
    /// divided.
    ///
    /// # Errors
    /// The errors of [`World::set_walkable`], [`World::add_obstacles`] and [`World::add_agent`].
    pub fn world(&self, group: Group, max_acceleration: f32) -> Result<World, Error> {
        let mut world = World::new(Settings { step: self.step, sub_steps: SubSteps::Fixed(1), ..Settings::default() })?;
        world.set_walkable(self.walkable.clone())?;
        self.add_to(&mut world, group, max_acceleration)?;
        Ok(world)
    }

    /// Adds the obstacles, goals and pedestrians to a world, with all pedestrians in this group and with this greatest
    /// acceleration.
    ///
    /// # Errors
    /// The errors of [`World::add_obstacles`], [`World::add_group`] and [`World::add_agent`].
    pub(crate) fn add_to(&self, world: &mut World, group: Group, max_acceleration: f32) -> Result<(), Error> {
        world.add_obstacles(self.obstacles.iter().cloned()).map_err(|(_, error)| error)?;
        let group = world.add_group(group)?;
        let goals: Vec<GoalId> = self
            .goals
            .iter()
            .map(|&at| {
                world.add_goal(match self.exit {
                    None => Goal::Point { at, tolerance: 0.5 },
                    Some(side) => Goal::Exit { corners: square(at, side).to_vec() },
                })
            })
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
                position: person.position.extend(0.0),
                group,
                journey: person.way.map_or(JourneyId::STAY, |way| ways[way]),
                radius: self.radius as f32,
                preferred_speed: person.preferred_speed as f32,
                motor: Holonomic { max_speed: Self::MAX_SPEED as f32, max_acceleration, ..Holonomic::default() }.into(),
                ..Agent::default()
            })?;
        }
        Ok(())
    }
}

/// Returns the corners of a square around a point.
pub(crate) fn square(middle: DVec2, side: f64) -> [DVec2; 4] {
    [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)].map(|corner| middle + DVec2::from(corner) * side)
}
