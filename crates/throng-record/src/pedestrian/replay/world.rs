//! The world of a replay.

use super::scene::room;
use super::{RecordedPeople, ReplayScene};
use crate::Frame;
use crate::pedestrian::{People, Walk};
use glam::{DVec2, Vec2};
use throng::{Agent, AgentId, AgentRef, Error, Goal, GroupId, Journey, JourneyId, Status, Stop, Summary, World};

/// Rounding error of times, seconds.
const ROUNDING: f64 = 1e-9;

/// A replay of recorded pedestrians.
///
/// Every pedestrian enters in the first step that ends at or after its first recorded time, at its recorded position.
/// If it overlaps another agent, the [guard](throng::guard) separates them. If it would stand in an obstacle, it enters
/// beside the obstacle. On its way an agent stands at every [pause](super::Pause) until the pause is over; an agent
/// that has not reached the pause by then continues. An agent that has arrived leaves, at once or with its recording
/// ([`ReplayScene::stay`], [`Walker::stays`](super::Walker::stays)).
#[derive(Debug)]
pub struct Replay<'a> {
    stage: &'a ReplayScene,
    cast: &'a RecordedPeople,
    world: World,
    group: GroupId,
    start: f64,
    /// Walks of all pedestrians that enter, in order; `entered` counts those that have entered.
    queue: Vec<usize>,
    entered: usize,
    /// The agents that are present, and their positions at the end of the last step.
    here: Vec<ReplayedPerson>,
    /// Times at which positions are recorded, ascending; `taken` counts those that have passed.
    times: Vec<f64>,
    taken: usize,
    out: Replayed,
}

#[derive(Debug)]
struct ReplayedPerson {
    walk: usize,
    id: AgentId,
    place: DVec2,
    /// End of the pause to which the agent walks or at which it stands; `None`: it walks to its goal.
    pauses_until: Option<f64>,
}

/// The result of a replay.
#[derive(Clone, Debug, Default)]
pub struct Replayed {
    /// Positions at the requested times, by walk of the [`RecordedPeople`]; empty for an agent that was absent at all of them.
    pub walks: Vec<Walk>,
    /// Times of arrival, by walk.
    pub arrived: Vec<Option<f64>>,
    /// Times and positions of leaving, by walk; usually between two of the requested times.
    pub left: Vec<Option<(f64, DVec2)>>,
    /// Number of agents that entered.
    pub entered: usize,
    /// Number of agents that overlapped another agent when they entered.
    pub overlapping: usize,
    /// Number of agents that entered beside an obstacle in which they would have stood.
    pub moved: usize,
    /// Number of agents that could not enter: no free position within 2 m.
    pub refused: usize,
    /// Number of agents with a goal in an obstacle, which walk to the nearest free position.
    pub goals_moved: usize,
    /// Number of agents that could not reach their goals.
    pub stranded: usize,
    /// The summary of the world.
    pub summary: Summary,
}

impl Replayed {
    /// Returns the agents that were present, as pedestrians.
    pub fn people(&self) -> People {
        People::new(self.walks.iter().filter(|walk| !walk.times.is_empty()).cloned().collect())
    }
}

impl<'a> Replay<'a> {
    /// Starts at a time of the recording; pedestrians enter at their recorded times. Positions are recorded at these
    /// `times`, ascending.
    ///
    /// # Errors
    /// The world rejects the place or an agent.
    pub fn new(stage: &'a ReplayScene, cast: &'a RecordedPeople, start: f64, times: Vec<f64>) -> Result<Self, Error> {
        Self::begin(stage, cast, stage.world()?, start, times, |_| true)
    }

    /// Starts at a time of the recording, in a `world` that [`ReplayScene::world`] made, with the pedestrians that are
    /// present then; no others enter.
    ///
    /// # Errors
    /// The world rejects an agent.
    pub fn restart(
        stage: &'a ReplayScene,
        cast: &'a RecordedPeople,
        world: World,
        start: f64,
        times: Vec<f64>,
    ) -> Result<Self, Error> {
        Self::begin(stage, cast, world, start, times, |walk| walk.at(start).is_some())
    }

    fn begin(
        stage: &'a ReplayScene,
        cast: &'a RecordedPeople,
        mut world: World,
        start: f64,
        times: Vec<f64>,
        comes: impl Fn(&Walk) -> bool,
    ) -> Result<Self, Error> {
        let walks = &cast.people.walks;
        let group = world.add_group(stage.group.clone())?;
        let mut queue: Vec<usize> = (0..walks.len()).filter(|&walk| comes(&walks[walk])).collect();
        // a stable sort keeps the order by number at equal times
        queue.sort_by(|&a, &b| walks[a].times[0].total_cmp(&walks[b].times[0]));
        let nowhere = |walk: &Walk| Walk { times: Vec::new(), places: Vec::new(), ..*walk };
        let out = Replayed {
            walks: walks.iter().map(nowhere).collect(),
            arrived: vec![None; walks.len()],
            left: vec![None; walks.len()],
            ..Replayed::default()
        };
        let taken = times.partition_point(|&time| time < start - ROUNDING);
        let mut replay =
            Self { stage, cast, world, group, start, queue, entered: 0, here: Vec::new(), times, taken, out };
        replay.enter(taken)?;
        replay.taken = replay.reached();
        Ok(replay)
    }

    /// Returns the current time of the recording, seconds.
    pub fn time(&self) -> f64 {
        self.start + self.world.time()
    }

    /// Returns the world.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// Whether all agents have entered and left.
    pub fn is_over(&self) -> bool {
        self.entered == self.queue.len() && self.here.is_empty()
    }

    /// Returns the number of agents that have left, including those that could not enter.
    pub fn gone(&self) -> usize {
        self.entered - self.here.len()
    }

    /// Advances the world by a step. Then agents that are due leave and enter.
    ///
    /// # Errors
    /// The world rejects an agent.
    pub fn step(&mut self) -> Result<(), Error> {
        let before = self.time();
        self.world.step();
        let (now, first) = (self.time(), self.taken);
        self.taken = self.reached();
        let mut here = std::mem::take(&mut self.here);
        here.retain_mut(|one| {
            let Some(row) = self.world.row(one.id) else { return false };
            let (status, place) = (
                self.world.relative_columns().status[row],
                self.world.position(one.id).unwrap_or(one.place.extend(0.0)),
            );
            let walk = &mut self.out.walks[one.walk];
            for &time in &self.times[first..self.taken] {
                let share = ((time - before) / (now - before)).clamp(0.0, 1.0);
                walk.times.push(time);
                walk.places.push(one.place.lerp(place.truncate(), share));
            }
            one.place = place.truncate();
            if one.pauses_until.is_some() {
                return true;
            }
            let arrived = status == Status::Arrived;
            if arrived {
                self.out.arrived[one.walk].get_or_insert(now);
            }
            let over = arrived || status == Status::Stranded;
            let stays = status == Status::Stranded || self.stage.stay || self.cast.walkers[one.walk].stays;
            let recorded_left =
                self.cast.people.walks[one.walk].times.last().is_none_or(|&last| last <= now + ROUNDING);
            let leaves = over && (!stays || recorded_left);
            if leaves {
                self.out.stranded += usize::from(status == Status::Stranded);
                self.out.left[one.walk] = Some((now, place.truncate()));
                self.world.remove_agent(one.id);
            }
            !leaves
        });
        for one in &mut here {
            if one.pauses_until.is_some_and(|until| until <= now + ROUNDING) {
                let (agent, pauses_until) =
                    (self.world.agent(one.id).map(AgentRef::to_agent).ok_or(Error::Gone)?, self.pauses_until(one.walk));
                let journey = self.journey(one.walk)?;
                self.world.replace(one.id, Agent { journey, ..agent })?;
                one.pauses_until = pauses_until;
            }
        }
        self.here = here;
        self.enter(first)
    }

    /// Returns the end of the next pause of a walk.
    fn pauses_until(&self, walk: usize) -> Option<f64> {
        self.cast.walkers[walk].pauses_after(self.time() + ROUNDING).first().map(|pause| pause.until)
    }

    /// Returns the journey of a walk from now on: to the next pause, where the agent waits at least until its end, or
    /// to the goal. A position in an obstacle is moved to the nearest free one.
    fn journey(&mut self, walk: usize) -> Result<JourneyId, Error> {
        let now = self.time();
        let walker = &self.cast.walkers[walk];
        let next = walker.pauses_after(now + ROUNDING).first();
        let (at, wait) = next.map_or((walker.goal, 0.0), |pause| (pause.place, (pause.until - now) as f32));
        let at = self.free(walk, at);
        let goal = self.world.add_goal(Goal::Point { at, tolerance: self.stage.near as f32 })?;
        self.world.add_journey(Journey { stops: vec![Stop { goal, wait }], repeat: false })
    }

    /// Returns the nearest position at which the body of a walk has room; the position itself if there is none.
    fn free(&self, walk: usize, at: DVec2) -> DVec2 {
        room(&self.world, at, self.cast.people.walks[walk].radius).unwrap_or(at)
    }

    /// Returns the number of times that have passed.
    fn reached(&self) -> usize {
        let now = self.time();
        self.times.partition_point(|&time| time <= now + ROUNDING)
    }

    /// Adds the pedestrians that are due; `first` is the index of the first time since the last step.
    fn enter(&mut self, first: usize) -> Result<(), Error> {
        let (now, cast) = (self.time(), self.cast);
        while let Some(&index) = self.queue.get(self.entered) {
            let walk = &cast.people.walks[index];
            if walk.times[0] > now + ROUNDING {
                break;
            }
            self.entered += 1;
            let row = walk.times.partition_point(|&time| time <= now + ROUNDING) - 1;
            // a pedestrian that has left by the end of the step is skipped
            let Some(place) = walk.at(now) else { continue };
            let Some(id) = self.admit(index, place, cast.velocity(index, row))? else { continue };
            let reached = self.reached();
            let out = &mut self.out.walks[index];
            for &time in &self.times[first..reached] {
                if let Some(place) = walk.at(time) {
                    out.times.push(time);
                    out.places.push(place);
                }
            }
            self.here.push(ReplayedPerson { walk: index, id, place, pauses_until: self.pauses_until(index) });
        }
        Ok(())
    }

    /// Adds a pedestrian if there is room on the ground.
    fn admit(&mut self, index: usize, at: DVec2, velocity: DVec2) -> Result<Option<AgentId>, Error> {
        let (walk, walker) = (&self.cast.people.walks[index], &self.cast.walkers[index]);
        let Some(position) = room(&self.world, at, walk.radius) else {
            self.out.refused += 1;
            return Ok(None);
        };
        let radius = walk.radius as f32;
        let goal_moved = self.free(index, walker.goal) != walker.goal;
        let alone = self.world.is_free(position.extend(0.0), radius);
        let journey = self.journey(index)?;
        let (speed, mut motor) = (walker.speed as f32, self.stage.agent.motor);
        motor.set_max_speed(motor.max_speed().max(speed));
        let velocity: Vec2 = velocity.as_vec2();
        let heading = (velocity.length() > 0.1).then(|| velocity.y.atan2(velocity.x));
        let id = self.world.add_agent(Agent {
            position: position.extend(0.0),
            velocity,
            heading,
            group: self.group,
            journey,
            radius,
            preferred_speed: speed,
            number: Some(walk.number),
            motor,
            ..self.stage.agent.clone()
        })?;
        self.out.entered += 1;
        self.out.overlapping += usize::from(!alone);
        self.out.moved += usize::from(position != at);
        self.out.goals_moved += usize::from(goal_moved);
        Ok(Some(id))
    }

    /// Sets `frame` to the agents now, at the time of the recording.
    pub fn capture(&self, frame: &mut Frame) {
        frame.capture(&self.world);
        (frame.time, frame.arrived, frame.total) = (self.time(), self.gone(), self.cast.people.walks.len());
        for body in &mut frame.bodies {
            (body.group, body.goal) = (0, None);
        }
    }

    /// Returns the result.
    pub fn finish(self) -> Replayed {
        Replayed { summary: self.world.summary(), ..self.out }
    }
}
