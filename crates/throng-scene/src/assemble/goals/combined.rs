//! Goals made of other goals.

use crate::assemble::limits::{Limit, check, check_number};
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::registry::{BuildGoal, Goal, GoalContext, GoalTree};
use crate::scene::{ChoiceGoal, CycleGoal, JourneyGoal, NearestGoal, Stop};

impl BuildGoal for JourneyGoal {
    fn make(self, at: &GoalContext) -> Result<GoalTree, Problem> {
        stops(&self.0, false, at)
    }

    fn parts(&self) -> Vec<(Path, &Goal)> {
        self.0.iter().enumerate().map(|(i, stop)| (entry(i), &stop.goal)).collect()
    }
}

impl BuildGoal for CycleGoal {
    fn make(self, at: &GoalContext) -> Result<GoalTree, Problem> {
        stops(&self.0, true, at)
    }

    fn parts(&self) -> Vec<(Path, &Goal)> {
        self.0.iter().enumerate().map(|(i, stop)| (entry(i), &stop.goal)).collect()
    }
}

impl BuildGoal for NearestGoal {
    fn make(self, at: &GoalContext) -> Result<GoalTree, Problem> {
        not_empty(at, self.0.len())?;
        let each = |(i, goal)| at.make(goal, at.path.index(i));
        Ok(GoalTree::Nearest(self.0.iter().enumerate().map(each).collect::<Result<_, _>>()?))
    }

    fn parts(&self) -> Vec<(Path, &Goal)> {
        self.0.iter().enumerate().map(|(i, goal)| (Path::default().index(i), goal)).collect()
    }
}

impl BuildGoal for ChoiceGoal {
    fn make(self, at: &GoalContext) -> Result<GoalTree, Problem> {
        not_empty(at, self.0.len())?;
        let mut sum = 0.0;
        let mut goals = vec![];
        for (i, weighted) in self.0.iter().enumerate() {
            let path = at.path.index(i);
            check(&path.key("weight"), weighted.weight, Limit::Between(0.0, 1e9))?;
            sum += weighted.weight;
            goals.push((at.make(&weighted.goal, path.key("goal"))?, sum));
        }
        if sum == 0.0 {
            return Err(Problem::new(&at.path, Kind::OutOfRange, "all weights are 0: nothing can be chosen"));
        }
        Ok(GoalTree::Choice(goals))
    }

    fn parts(&self) -> Vec<(Path, &Goal)> {
        self.0.iter().enumerate().map(|(i, weighted)| (entry(i), &weighted.goal)).collect()
    }
}

/// Returns the goals of a journey.
fn stops(stops: &[Stop], repeat: bool, at: &GoalContext) -> Result<GoalTree, Problem> {
    if at.is_stop {
        let problem = Problem::new(&at.path, Kind::Conflict, "a journey inside a journey");
        return Err(problem.hint("write all the stops into one list"));
    }
    not_empty(at, stops.len())?;
    let inside = GoalContext { is_stop: true, ..at.clone() };
    let one = |(i, stop): (usize, &Stop)| {
        let path = at.path.index(i);
        stop.wait.map_or(Ok(()), |wait| check_number(&path.key("wait"), &wait, Limit::NotNegative))?;
        Ok((inside.make(&stop.goal, path.key("goal"))?, stop.wait))
    };
    Ok(GoalTree::Stops(stops.iter().enumerate().map(one).collect::<Result<_, Problem>>()?, repeat))
}

fn not_empty(at: &GoalContext, length: usize) -> Result<(), Problem> {
    match length {
        0 => {
            let problem = Problem::new(&at.path, Kind::MissingKey, "there is nothing in this list");
            Err(problem.hint("give at least one goal"))
        }
        _ => Ok(()),
    }
}

/// Returns the path to the goal of an entry of a list.
fn entry(i: usize) -> Path {
    Path::default().index(i).key("goal")
}
