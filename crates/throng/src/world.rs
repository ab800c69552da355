//! The world: what is there.

use crate::Error;
use crate::agent::{Agent, AgentId, GoalId, Group, GroupId, JourneyId, ObstacleId};
use crate::navigate::{Goal, Journey};
use crate::space::{Obstacle, Walkable};
use glam::DVec2;

/// How a step is divided.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub enum SubSteps {
    /// By a rule that depends only on the world's state: sizes, speeds and how close people are.
    #[default]
    Auto,
    /// Always into this many. [Limit: >= 1]
    Fixed(u32),
}

/// What a world is made with.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Seconds a step covers. [Limit: > 0]
    pub step: f64,
    /// How a step is divided.
    pub sub_steps: SubSteps,
    /// Seed of everything random.
    pub seed: u64,
    /// World coordinates of the local origin: choose it near the middle of the scene.
    pub origin: DVec2,
}

impl Default for Settings {
    fn default() -> Self {
        Self { step: 1.0 / 60.0, sub_steps: SubSteps::Auto, seed: 1, origin: DVec2::ZERO }
    }
}

/// The world.
#[derive(Debug)]
pub struct World {
    agents: Vec<Agent>,
}

#[allow(missing_docs, unused_variables)]
impl World {
    pub fn new(settings: Settings) -> Result<Self, Error> {
        Ok(Self { agents: vec![] })
    }
    pub fn add_group(&mut self, group: Group) -> Result<GroupId, Error> {
        Ok(GroupId(0))
    }
    pub fn add_goal(&mut self, goal: Goal) -> Result<GoalId, Error> {
        Ok(GoalId(0))
    }
    pub fn add_journey(&mut self, journey: Journey) -> Result<JourneyId, Error> {
        Ok(JourneyId(0))
    }
    pub fn add_obstacle(&mut self, obstacle: Obstacle) -> Result<ObstacleId, Error> {
        Ok(ObstacleId(0))
    }
    /// Several areas: their union
    pub fn set_walkable(&mut self, areas: Vec<Walkable>) -> Result<(), Error> {
        Ok(())
    }
    pub fn add_agent(&mut self, agent: Agent) -> Result<AgentId, Error> {
        self.agents.push(agent);
        Ok(AgentId { slot: 0, generation: 0 })
    }
    /// Enters at `time` seconds, as soon as its place is free.
    pub fn schedule_agent(&mut self, time: f64, agent: Agent) -> Result<(), Error> {
        self.agents.push(agent);
        Ok(())
    }
}
