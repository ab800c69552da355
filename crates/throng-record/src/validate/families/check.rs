//! Requirements on every scene of a family.

use super::Trial;
use crate::pedestrian::Area;
use glam::DVec2;
use std::collections::VecDeque;
use std::fmt;
use throng::{Goal, Status, World};
use throng_scene::{Error, Scene};

/// A violated requirement of a trial.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TrialFlaw {
    /// Number of agents that had not arrived when the scene ended.
    NotArrived(usize),
    /// Number of agents that stood although nothing before them had a reason to stop: on a ring where all walk in the
    /// same direction.
    Stands(usize),
    /// Number of agents that walked for 30 s without progress.
    Oscillates(usize),
    /// Number of agents that had arrived in an area and were outside it at the end.
    OutsideGoal(usize),
    /// Number of overlaps of bodies.
    Overlaps(u64),
}

impl TrialFlaw {
    /// The kinds, in the order of the columns of a table.
    pub const KINDS: [&str; 5] = ["not arrived", "stands", "oscillates", "outside goal", "overlaps"];

    /// Returns the kind: an index into [`KINDS`](Self::KINDS).
    pub fn kind(&self) -> usize {
        match self {
            Self::NotArrived(_) => 0,
            Self::Stands(_) => 1,
            Self::Oscillates(_) => 2,
            Self::OutsideGoal(_) => 3,
            Self::Overlaps(_) => 4,
        }
    }
}

impl fmt::Display for TrialFlaw {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::NotArrived(count) | Self::Stands(count) | Self::Oscillates(count) | Self::OutsideGoal(count) => {
                write!(f, "{} {count}", Self::KINDS[self.kind()])
            }
            Self::Overlaps(count) => write!(f, "overlaps {count}"),
        }
    }
}

impl Trial {
    /// Returns the scene.
    ///
    /// # Errors
    /// The text is not a scene: an error in the family.
    pub fn scene(&self) -> Result<Scene, Error> {
        self.text.parse()
    }

    /// Runs a scene of this trial, possibly changed, and returns the violated requirements. Returns `None` if
    /// `goes_on`, which is called after every step, returns `false`.
    ///
    /// # Errors
    /// The scene cannot be built.
    pub fn check(scene: &Scene, mut goes_on: impl FnMut(&World) -> bool) -> Result<Option<Vec<TrialFlaw>>, Error> {
        let (mut world, _) = scene.build()?;
        let endless = scene.time.until == throng_scene::Until::Limit;
        let mut watched = Watched::default();
        while !scene.time.over(&world) {
            world.step();
            watched.step(&world);
            if !goes_on(&world) {
                return Ok(None);
            }
        }
        Ok(Some(watched.flaws(&world, endless)))
    }
}

/// Length of the observed window, seconds.
const WINDOW: usize = 30;
/// Path length in a window beyond which an agent walks instead of queueing, m.
const WALKED: f64 = 4.0;
/// Distance from the start of a window below which an agent has made no progress, m.
const NOWHERE: f64 = 0.8;
/// Distance on a ring in a window below which an agent stands, m.
const STANDS: f64 = 1.0;
/// Rounding error of positions at the edge of an area, m.
const ROUNDING: f64 = 1e-3;

/// The motion of every agent, by number.
#[derive(Debug, Default)]
struct Watched {
    agents: Vec<CheckedAgent>,
    seconds: u64,
}

/// The motion of an agent.
#[derive(Clone, Debug, Default)]
struct CheckedAgent {
    last: Option<DVec2>,
    walked: f64,
    /// Position and path length at each of the last seconds.
    window: VecDeque<(DVec2, f64)>,
    oscillates: bool,
    stands: bool,
}

impl Watched {
    fn step(&mut self, world: &World) {
        let second = (world.time() + 1e-9) as u64;
        let full = second > self.seconds;
        self.seconds = second;
        let columns = world.relative_columns();
        for row in 0..columns.len() {
            let number = columns.number[row] as usize;
            if self.agents.len() <= number {
                self.agents.resize(number + 1, CheckedAgent::default());
            }
            let Some(place) = world.position(world.id(row)) else { continue };
            self.agents[number].step(place.truncate(), full, columns.status[row]);
        }
    }

    fn flaws(&self, world: &World, endless: bool) -> Vec<TrialFlaw> {
        let summary = world.summary();
        let count = |is: fn(&CheckedAgent) -> bool| self.agents.iter().filter(|agent| is(agent)).count();
        let stands = if endless { count(|agent| agent.stands) } else { 0 };
        let left = if endless { 0 } else { summary.agents.saturating_sub(summary.arrived) };
        let all = [
            (left > 0, TrialFlaw::NotArrived(left)),
            (stands > 0, TrialFlaw::Stands(stands)),
            (count(|agent| agent.oscillates) > 0, TrialFlaw::Oscillates(count(|agent| agent.oscillates))),
            (outside_goal(world) > 0, TrialFlaw::OutsideGoal(outside_goal(world))),
            (summary.overlaps > 0, TrialFlaw::Overlaps(summary.overlaps)),
        ];
        all.into_iter().filter_map(|(found, flaw)| found.then_some(flaw)).collect()
    }
}

impl CheckedAgent {
    fn step(&mut self, place: DVec2, full_second: bool, status: Status) {
        self.walked += self.last.map_or(0.0, |last| last.distance(place));
        self.last = Some(place);
        if status != Status::Walking {
            self.window.clear();
        } else if full_second {
            self.window.push_back((place, self.walked));
            if self.window.len() > WINDOW + 1 {
                self.window.pop_front();
            }
            if let Some(&(start, before)) = self.window.front().filter(|_| self.window.len() == WINDOW + 1) {
                let farthest = self.window.iter().map(|(at, _)| at.distance(start)).fold(0.0, f64::max);
                self.oscillates |= self.walked - before > WALKED && farthest < NOWHERE;
                self.stands |= farthest < STANDS;
            }
        }
    }
}

/// Returns the number of agents that have arrived in an area and are not in it.
fn outside_goal(world: &World) -> usize {
    let goals = world.goals();
    let outside = |row: &usize| {
        let (status, id) = (world.relative_columns().status[*row], world.id(*row));
        let last = world.journey(world.relative_columns().journey[*row]).stops.last();
        let Some(Goal::Area { corners }) = last.map(|stop| &goals[stop.goal.index()]) else { return false };
        let (Some(area), Some(place)) = (Area::new(corners.clone()), world.position(id)) else { return false };
        status == Status::Arrived && !area.contains(place.truncate()) && distance(&area, place.truncate()) > ROUNDING
    };
    (0..world.relative_columns().len()).filter(outside).count()
}

/// Returns the distance of a point outside an area to its edge.
fn distance(area: &Area, place: DVec2) -> f64 {
    let corners = area.corners();
    let to_side = |(a, b): (&DVec2, &DVec2)| {
        let side = *b - *a;
        place.distance(*a + ((place - *a).dot(side) / side.length_squared()).clamp(0.0, 1.0) * side)
    };
    corners.iter().zip(corners.iter().cycle().skip(1)).map(to_side).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether an agent at these positions, four per second, oscillates, and whether it stands.
    fn watched(at: impl Fn(f64) -> DVec2) -> (bool, bool) {
        let mut agent = CheckedAgent::default();
        for k in 0..200u32 {
            agent.step(at(0.25 * f64::from(k)), k % 4 == 0, Status::Walking);
        }
        (agent.oscillates, agent.stands)
    }

    #[test]
    fn an_agent_that_dances_oscillates_and_one_in_a_queue_does_not() {
        assert_eq!(watched(|time| DVec2::X * 0.3 * (4.0 * time).sin()), (true, true));
        assert_eq!(watched(|time| DVec2::X * 0.02 * time), (false, true));
        assert_eq!(watched(|time| DVec2::X * 0.2 * time), (false, false));
        // around a pillar of 3 m: the agent returns to its start, but makes progress
        assert_eq!(watched(|time| 3.0 * DVec2::from_angle(time / 3.0)), (false, false));
    }

    #[test]
    fn flaws_of_a_bad_scene_are_found() {
        // an agent cannot walk through the wall; the other agent arrives
        let scene: Scene = "time = { step = 0.1, limit = 20 }\nwalkable.rectangles = [{ center = [0, 0], size = [4, 4] }, { center = [10, 0], size = [4, 4] }]\n\
                            [[group]]\nplace.points = [[0, 0], [8.5, 0]]\ngoal.area.rectangle = { center = [11, 0], size = [2, 2] }"
            .parse()
            .unwrap();
        assert_eq!(Trial::check(&scene, |_| true).unwrap(), Some(vec![TrialFlaw::NotArrived(1)]));
        assert_eq!(Trial::check(&scene, |world| world.steps() < 3).unwrap(), None);
    }
}
