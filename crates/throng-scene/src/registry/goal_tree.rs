//! The goals of a group, as a scene chooses them: goals of all agents, goals of single agents, and combinations.

use super::given::made_by_plugin;
use super::goal_rule::{AgentJourney, AgentStart, GoalRule};
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::random::Random;
use crate::scene::Number;
use std::sync::Arc;

/// The goals of a group. `S` is a goal that agents share.
pub(crate) enum GoalTree<S = SharedGoal> {
    /// The same goal for all agents.
    Same(S),
    /// A goal for each agent.
    Each(GoalOfEach, Vec<S>),
    /// A sequence of goals, each with the seconds to wait there; and whether it repeats.
    Stops(Vec<(GoalTree<S>, Option<Number>)>, bool),
    /// For each agent, the nearest of these goals.
    Nearest(Vec<GoalTree<S>>),
    /// For each agent, one of these goals, drawn by weight. The numbers are the running sums of the weights.
    Choice(Vec<(GoalTree<S>, f64)>),
}

/// A goal that agents share.
pub(crate) struct SharedGoal {
    pub goal: throng::Goal,
    /// The path to it in the scene.
    pub path: Path,
    /// Its name in messages.
    pub what: &'static str,
}

/// A rule that gives each agent its goal.
#[derive(Clone)]
pub(crate) struct GoalOfEach {
    pub rule: Arc<dyn GoalRule>,
    /// The path to it in the scene.
    pub path: Path,
    /// Its kind and name.
    pub what: String,
    /// Whether it is a stop of a journey.
    pub is_stop: bool,
    /// Its position among the rules of the group: each has random numbers of its own.
    pub number: u64,
}

impl GoalOfEach {
    /// Returns the journey of an agent. It has a goal.
    pub fn journey(&self, agent: &AgentStart, random: &mut Random) -> Result<AgentJourney, Problem> {
        let journey = made_by_plugin(&self.path, &self.what, || Ok(self.rule.goal(agent, random)))?;
        let problem = |kind: Kind, message: &str| {
            Err(Problem::new(&self.path, kind, format!("{}: the journey of agent {} {message}", self.what, agent.k)))
        };
        match journey.stops.iter().find(|(_, wait)| !(0.0..=f64::from(f32::MAX)).contains(wait)) {
            _ if journey.stops.is_empty() => problem(Kind::MissingKey, "has no goal"),
            _ if journey.repeat && self.is_stop => {
                problem(Kind::Conflict, "is without end, so that it cannot be a stop")
            }
            Some((_, wait)) => problem(Kind::OutOfRange, &format!("waits {wait} seconds, but must wait 0 or more")),
            None => Ok(journey),
        }
    }
}

impl<S> GoalTree<S> {
    /// Returns the tree with other shared goals, which `change` makes in the order of the scene.
    pub fn try_map<T>(self, change: &mut dyn FnMut(S) -> Result<T, Problem>) -> Result<GoalTree<T>, Problem> {
        Ok(match self {
            Self::Same(shared) => GoalTree::Same(change(shared)?),
            Self::Each(each, shared) => GoalTree::Each(each, shared.into_iter().map(change).collect::<Result<_, _>>()?),
            Self::Stops(stops, repeat) => {
                let mut one = |(goal, wait): (Self, _)| Ok((goal.try_map(change)?, wait));
                GoalTree::Stops(stops.into_iter().map(&mut one).collect::<Result<_, Problem>>()?, repeat)
            }
            Self::Nearest(goals) => {
                GoalTree::Nearest(goals.into_iter().map(|goal| goal.try_map(change)).collect::<Result<_, _>>()?)
            }
            Self::Choice(goals) => {
                let mut one = |(goal, sum): (Self, _)| Ok((goal.try_map(change)?, sum));
                GoalTree::Choice(goals.into_iter().map(&mut one).collect::<Result<_, Problem>>()?)
            }
        })
    }

    /// Whether agents choose the nearest of several goals somewhere in it.
    pub fn chooses_nearest(&self) -> bool {
        match self {
            Self::Same(_) | Self::Each(..) => false,
            Self::Stops(stops, _) => stops.iter().any(|(goal, _)| goal.chooses_nearest()),
            Self::Nearest(_) => true,
            Self::Choice(goals) => goals.iter().any(|(goal, _)| goal.chooses_nearest()),
        }
    }
}
