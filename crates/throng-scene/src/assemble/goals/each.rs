//! Goals that differ between the agents of a group.

use super::shared::check_tolerance;
use crate::assemble::annulus;
use crate::assemble::check::check_points;
use crate::assemble::limits::{Limit, check, check_point};
use crate::error::Kind;
use crate::file::Problem;
use crate::geometry::{DVec2, DVec3};
use crate::random::Random;
use crate::registry::{AgentJourney, AgentStart, BuildGoal, GoalContext, GoalRule, GoalTree};
use crate::scene::{Annulus, Lap, Opposite, PointsGoal, Shift};

impl BuildGoal for PointsGoal {
    fn make(self, at: &GoalContext) -> Result<GoalTree, Problem> {
        check_points(&at.path.key("at"), &self.at)?;
        check_tolerance(at, self.tolerance)?;
        if self.at.len() != at.n {
            let message = format!("goal.points lists {} points for {} agents", self.at.len(), at.n);
            return Err(Problem::new(&at.path, Kind::Conflict, message).hint("give one for each agent"));
        }
        Ok(at.each(self, "points", vec![]))
    }
}

impl GoalRule for PointsGoal {
    fn goal(&self, agent: &AgentStart, _: &mut Random) -> AgentJourney {
        agent.point(DVec2::from_array(self.at[agent.k]).extend(agent.at.z), self.tolerance).into()
    }
}

impl BuildGoal for Opposite {
    fn make(self, at: &GoalContext) -> Result<GoalTree, Problem> {
        self.center.map_or(Ok(()), |center| check_point(&at.path.key("center"), &center))?;
        check_tolerance(at, self.tolerance)?;
        Ok(at.each(self, "opposite", vec![]))
    }
}

impl GoalRule for Opposite {
    fn goal(&self, agent: &AgentStart, _: &mut Random) -> AgentJourney {
        let center = self.center.map_or(agent.center, |center| DVec2::from_array(center).extend(agent.center.z));
        agent.point(2.0 * center - agent.at, self.tolerance).into()
    }
}

impl BuildGoal for Shift {
    fn make(self, at: &GoalContext) -> Result<GoalTree, Problem> {
        check_point(&at.path.key("by"), &self.by)?;
        check(&at.path.key("rise"), self.rise, Limit::Finite)?;
        check_tolerance(at, self.tolerance)?;
        Ok(at.each(self, "shift", vec![]))
    }
}

impl GoalRule for Shift {
    fn goal(&self, agent: &AgentStart, _: &mut Random) -> AgentJourney {
        let by: DVec3 = DVec2::from_array(self.by).extend(self.rise);
        agent.point(agent.at + by, self.tolerance).into()
    }
}

impl BuildGoal for Lap {
    fn make(self, at: &GoalContext) -> Result<GoalTree, Problem> {
        if at.is_stop {
            let message = "laps are without end, so that they cannot be a stop";
            return Err(Problem::new(&at.path, Kind::Conflict, message).hint("give the group goal.lap alone"));
        }
        let ring = annulus::of_lap(&self, at)?;
        let sectors: Vec<throng::Goal> =
            annulus::sectors(&ring).into_iter().map(|corners| throng::Goal::Area { corners }).collect();
        let shared = sectors.iter().map(|sector| at.shared(sector.clone(), "a sector of the ring")).collect();
        Ok(at.each(Laps { ring, sectors, clockwise: self.clockwise }, "lap", shared))
    }
}

/// Laps of a ring: each agent begins with the sector after that of its start.
struct Laps {
    ring: Annulus,
    sectors: Vec<throng::Goal>,
    clockwise: bool,
}

impl GoalRule for Laps {
    fn goal(&self, agent: &AgentStart, _: &mut Random) -> AgentJourney {
        let order = annulus::order(&self.ring, self.clockwise, agent.at.truncate());
        AgentJourney { stops: order.map(|sector| (self.sectors[sector].clone(), 0.0)).collect(), repeat: true }
    }
}
