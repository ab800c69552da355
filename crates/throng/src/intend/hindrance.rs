//! The progress of agents, and what hinders them. It is checked twice a second, from how far the agents have come.

use crate::agent::{Hindrance, ProgressMark, SEEN, Status};
use crate::navigate::{NeighbourData, SAME_WAY, Surroundings, Turn};
use crate::parallel;
use crate::perceive::{Perceived, SubStep};
use crate::world::{EventKind, State};
use glam::Vec2;

/// Seconds from one check to the next.
const TICK: f64 = 0.5;
/// Half seconds without progress after which an agent may be queueing, and after which it is blocked.
const SLOW: u16 = 2;
const BLOCKED: u16 = 20;
/// Half seconds without progress after which the summary counts a walk as failed.
const FAILED: u16 = 60;
/// Seconds. An agent that needs more time to walk its radius at its preferred speed is slow, and its limits are longer
/// in proportion.
const RADIUS_TIME: f32 = 0.5;
/// Radii a second. An agent that walks less stands still rather than oscillates.
const RESTLESS: f32 = 1.0;
/// Greatest gap to the agent ahead in a queue, in radii.
const CLOSE: f32 = 3.0;
/// Cosine of the angle within which another agent is ahead.
const AHEAD: f32 = 0.3;

/// Memory for checks of progress.
#[derive(Clone, Debug, Default)]
pub(crate) struct ProgressCheck(Vec<ProgressMark>);

impl ProgressCheck {
    /// Updates the progress of all agents at the end of a step.
    pub fn run(&mut self, state: &mut State, (seen, shown): (Perceived<'_>, &[NeighbourData]), of: SubStep) {
        let end = of.now;
        let half_seconds = |time: f64| (time / TICK + 1e-6).floor();
        let passed = half_seconds(end) - half_seconds(end - state.settings.step);
        if !of.last || passed < 1.0 {
            return;
        }
        let passed = passed.min(f64::from(u16::MAX)) as u16;
        let Self(marks) = self;
        let around = Surroundings { state, near: seen.near, shown };
        marks.resize(state.agents.len(), ProgressMark::default());
        parallel::ranges(&mut marks[state.own()], |rows, marks| {
            rows.zip(marks).for_each(|(row, mark)| *mark = around.progress(row, passed));
        });
        let before = &state.agents.progress_mark;
        let failed = |row: usize| state.has_failed(&marks[row], row) && !state.has_failed(&before[row], row);
        let failed = state.own().filter(|&row| failed(row)).count() as u64;
        // agents that are not judged have an infinite remaining distance
        let judged = marks.iter().zip(state.own()).filter(|(mark, _)| mark.remaining != f32::INFINITY);
        let (looks, backwards) = judged.fold((0, 0), |(looks, backwards), (_, row)| {
            (looks + 1, backwards + u64::from(around.walks_backwards(row)))
        });
        state.tally.without_progress_30s += failed;
        state.tally.looks += looks;
        state.tally.backwards += backwards;
        let is_blocked = |mark: &ProgressMark| mark.hindrance == Hindrance::Blocked;
        for row in state.own().filter(|&row| is_blocked(&marks[row])) {
            if !is_blocked(&state.agents.progress_mark[row]) {
                state.happened(row, EventKind::Stuck, end);
            }
        }
        std::mem::swap(&mut state.agents.progress_mark, marks);
    }
}

impl Surroundings<'_> {
    /// Whether an agent moves against the direction of its path.
    fn walks_backwards(&self, row: usize) -> bool {
        self.state.agents.velocity[row].dot(self.shown[row].way.direction) < -SEEN
    }

    /// Whether the progress of an agent is judged.
    fn is_judged(&self, row: usize) -> bool {
        let agents = &self.state.agents;
        let group = &self.state.local_groups[agents.group[row].index()];
        agents.status[row] == Status::Walking
            && self.shown[row].way.has_goal()
            && agents.preferred_speed[row] > 0.0
            && agents.script[row].is_none()
            && group.guidance.is_journey()
    }

    /// Returns the progress of an agent, `passed` half seconds after the last check.
    fn progress(&self, row: usize, passed: u16) -> ProgressMark {
        let agents = &self.state.agents;
        let before = agents.progress_mark[row];
        if !self.is_judged(row) {
            return ProgressMark::default();
        }
        let (remaining, walked) = (self.shown[row].way.remaining, agents.walked[row] as f32);
        // the path aside of a standoff is another path
        let gets_on = remaining <= before.remaining - agents.radius[row] && agents.travel[row].turn != Turn::Aside;
        let ticks = before.ticks.saturating_add(passed);
        // an agent that queues continues to queue until it makes progress without delay
        let is_slow = ticks >= self.state.patience(row, SLOW) || !gets_on && before.hindrance == Hindrance::Queueing;
        let mark = if before.remaining == f32::INFINITY {
            return ProgressMark { remaining, walked, ..before };
        } else if gets_on {
            ProgressMark { remaining, walked, ticks: 0, ..before }
        } else {
            ProgressMark { ticks, ..before }
        };
        let ahead = is_slow.then(|| self.ahead_in_queue(row)).flatten();
        let shown = self.shown;
        let queue = ahead.filter(|&other| shown[row].way.same_goal(&shown[other].way));
        let queue_ticks = queue.map_or(u8::MAX, |other| agents.progress_mark[other].queue_ticks);
        let mark = ProgressMark { queue_ticks: mark.ticks.min(queue_ticks.into()) as u8, ..mark };
        ProgressMark { hindrance: self.state.hindrance_of(row, &mark, is_slow, ahead), ..mark }
    }

    /// Returns the nearest agent close ahead that goes the same way.
    fn ahead_in_queue(&self, row: usize) -> Option<usize> {
        let (agents, shown) = (&self.state.agents, self.shown);
        let way = &shown[row].way;
        self.neighbours(row).iter().map(|&other| other as usize).find(|&other| {
            let theirs = &shown[other].way;
            let offset = agents.offset(row, other);
            let distance = offset.length();
            let direction = if way.direction == Vec2::ZERO { theirs.direction } else { way.direction };
            let goes_along = theirs.same_goal(way) || theirs.direction.dot(direction) > SAME_WAY;
            let leads = !theirs.same_goal(way) || theirs.remaining < way.remaining;
            let gap = distance - agents.radius[row] - agents.radius[other];
            theirs.walks()
                && goes_along
                && leads
                && gap < CLOSE * agents.radius[row]
                && offset.dot(direction) > AHEAD * distance
        })
    }
}

impl State {
    /// Returns what hinders the agent of a row, as of the last check, at most half a second ago.
    pub(crate) fn hindrance(&self, row: usize) -> Hindrance {
        self.agents.progress_mark[row].hindrance
    }

    /// Returns the seconds since an agent, or an agent with the same goal that it waits for, last made progress; at
    /// most 127.5.
    pub(crate) fn without_progress(&self, row: usize) -> f32 {
        f32::from(self.agents.progress_mark[row].queue_ticks) * TICK as f32
    }

    /// Whether an agent has walked without progress for 30 seconds.
    fn has_failed(&self, mark: &ProgressMark, row: usize) -> bool {
        mark.hindrance == Hindrance::Oscillating && mark.ticks >= self.patience(row, FAILED)
    }

    /// Returns `ticks` half seconds, scaled up for a slow agent.
    fn patience(&self, row: usize, ticks: u16) -> u16 {
        let agents = &self.agents;
        let slow = agents.radius[row] / (agents.preferred_speed[row] * RADIUS_TIME);
        (f32::from(ticks) * slow.max(1.0)) as u16
    }

    fn hindrance_of(&self, row: usize, mark: &ProgressMark, is_slow: bool, ahead: Option<usize>) -> Hindrance {
        let agents = &self.agents;
        let seconds = f32::from(mark.ticks) * TICK as f32;
        let is_late = mark.ticks >= self.patience(row, BLOCKED);
        let walked = agents.walked[row] as f32 - mark.walked;
        if is_late && walked >= RESTLESS * agents.radius[row] * seconds {
            return Hindrance::Oscillating;
        }
        if agents.travel[row].waits_for_room() {
            return Hindrance::WaitingForRoom;
        }
        if !is_slow {
            return Hindrance::None;
        }
        let waits_for_room = |other: usize| agents.progress_mark[other].hindrance == Hindrance::WaitingForRoom;
        let moves = |other: usize| u16::from(agents.progress_mark[other].queue_ticks) < self.patience(other, BLOCKED);
        match ahead {
            Some(other) if waits_for_room(other) => Hindrance::WaitingForRoom,
            Some(other) if moves(other) => Hindrance::Queueing,
            _ if is_late => Hindrance::Blocked,
            _ => Hindrance::None,
        }
    }
}
