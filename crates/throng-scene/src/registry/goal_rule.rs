//! The trait of goals that differ between agents.

use crate::random::Random;
use glam::DVec3;
use throng::{Error, Goal};

/// Gives each agent of a group its goal, in world coordinates.
///
/// A plug-in adds one by [`Plugins::goal`](super::Plugins::goal).
///
/// ```
/// use glam::DVec3;
/// use throng::parameters::parameters;
/// use throng_scene::{AgentJourney, AgentStart, GoalRule, Plugins, Random, Scene};
///
/// /// Goes away from the centre of the place.
/// #[parameters]
/// #[derive(Debug)]
/// struct Outwards {
///     /// How far, metres.
///     #[parameter(default = 5.0, unit = "m", above = 0, most = 1000)]
///     by: f64,
/// }
///
/// impl GoalRule for Outwards {
///     fn goal(&self, agent: &AgentStart, _: &mut Random) -> AgentJourney {
///         let outwards = (agent.at - agent.center).normalize_or(DVec3::X);
///         agent.point(agent.at + self.by * outwards, 0.1).into()
///     }
/// }
///
/// let mut scene: Scene = r#"
///     [[group]]
///     count = 4
///     place.ring = { radius = 2 }
///     goal.outwards = { by = 3 }
/// "#
/// .parse()?;
/// Plugins::new().goal::<Outwards>().equip(&mut scene);
/// let goals = scene.plan()?.goals;
/// assert!(goals.iter().all(|goal| (goal.middle().length() - 5.0).abs() < 1e-9));
/// # Ok::<(), throng_scene::Error>(())
/// ```
pub trait GoalRule: Send + Sync {
    /// Returns the goal of an agent, or its journey. Points are the agent's own. Agents with the same area, or the same
    /// exit, share it. It can be called several times for an agent, and then gets the same random numbers.
    fn goal(&self, agent: &AgentStart, random: &mut Random) -> AgentJourney;

    /// Checks what the limits of the parameters do not.
    ///
    /// # Errors
    /// There are no goals with these parameters.
    fn check(&self) -> Result<(), Error> {
        Ok(())
    }
}

/// An agent that gets a goal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AgentStart {
    /// Its number in the group, from 0.
    pub k: usize,
    /// The number of agents of the group.
    pub n: usize,
    /// Where it starts: x, y and the height above the ground, metres, world coordinates.
    pub at: DVec3,
    /// The centre of the group's place. If the place is on the ground, it is at the height of the agent.
    pub center: DVec3,
}

impl AgentStart {
    /// Returns a point as a goal of this agent: in the air if the point or the start of the agent is in the air.
    /// `tolerance` is the distance that counts as arrival, metres.
    pub fn point(&self, at: DVec3, tolerance: f64) -> Goal {
        let tolerance = tolerance as f32;
        match self.at.z == 0.0 && at.z == 0.0 {
            true => Goal::Point { at: at.truncate(), tolerance },
            false => Goal::Air { at, tolerance },
        }
    }
}

/// The goals of an agent, in sequence.
#[derive(Clone, Debug, PartialEq)]
pub struct AgentJourney {
    /// Each goal, and the seconds to wait there. Limit: at least one goal; seconds >= 0.
    pub stops: Vec<(Goal, f64)>,
    /// Whether the journey starts again after the last stop. Such a journey is not a stop of another journey.
    pub repeat: bool,
}

impl From<Goal> for AgentJourney {
    fn from(goal: Goal) -> Self {
        Self { stops: vec![(goal, 0.0)], repeat: false }
    }
}
