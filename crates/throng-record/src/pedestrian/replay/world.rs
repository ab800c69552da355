//! The world that recorded people enter.

use super::stage::room;
use super::{Cast, Stage};
use crate::Frame;
use crate::pedestrian::{People, Walk};
use glam::{DVec2, Vec2};
use throng::{Agent, AgentId, Error, Goal, GroupId, Journey, JourneyId, Status, Stop, Summary, World};

/// Rounding of times, seconds.
const ROUNDING: f64 = 1e-9;

/// Recorded people walk once more.
///
/// Everybody enters with the first step that ends when they had come, where they were then; who overlaps somebody there is parted from
/// them by the [guard](throng::guard), who would stand in something solid enters beside it. On its way an agent stands at every
/// [pause](super::Pause) until that is over; an agent that has not come there by then goes on. Who has arrived leaves, at once or with the
/// recorded one ([`Stage::stay`], [`Walker::stays`](super::Walker::stays)).
#[derive(Debug)]
pub struct Replay<'a> {
    stage: &'a Stage,
    cast: &'a Cast,
    world: World,
    group: GroupId,
    start: f64,
    /// Walks of those who are to enter, in order; how many of them have.
    queue: Vec<usize>,
    entered: usize,
    /// Who is there, by walk, and where they were at the end of the last step.
    here: Vec<Here>,
    /// When everybody's place is taken down, ascending; how often it was.
    times: Vec<f64>,
    taken: usize,
    out: Replayed,
}

#[derive(Debug)]
struct Here {
    walk: usize,
    id: AgentId,
    place: DVec2,
    /// When the pause is over that the agent goes to or stands at; `None`: it goes to its goal.
    pauses_until: Option<f64>,
}

/// What came of a replay.
#[derive(Clone, Debug, Default)]
pub struct Replayed {
    /// Where everybody was at the times that were asked for, by walk of the [`Cast`]; empty for who was not there.
    pub walks: Vec<Walk>,
    /// When everybody arrived, by walk.
    pub arrived: Vec<Option<f64>>,
    /// When and where everybody left, by walk: mostly between two of the times that were asked for.
    pub left: Vec<Option<(f64, DVec2)>>,
    /// How many entered.
    pub entered: usize,
    /// How many of them overlapped somebody there.
    pub overlapping: usize,
    /// How many would have stood in something solid, and entered beside it.
    pub moved: usize,
    /// How many could not enter: all places within 2 m are solid.
    pub refused: usize,
    /// How many have goals in something solid, and go to the place nearest to it.
    pub goals_moved: usize,
    /// How many cannot reach their goals.
    pub stranded: usize,
    /// The world's own figures.
    pub summary: Summary,
}

impl Replayed {
    /// Those who were there, as people.
    pub fn people(&self) -> People {
        People::new(self.walks.iter().filter(|walk| !walk.times.is_empty()).cloned().collect())
    }
}

impl<'a> Replay<'a> {
    /// Begins at a time of the recording; everybody enters in their turn. Places are taken down at these `times`, ascending.
    ///
    /// # Errors
    /// What the world refuses.
    pub fn new(stage: &'a Stage, cast: &'a Cast, start: f64, times: Vec<f64>) -> Result<Self, Error> {
        Self::begin(stage, cast, stage.world()?, start, times, |_| true)
    }

    /// Begins at a time of the recording, in `world`, which [`Stage::world`] has made, with those who are there then, and nobody else
    /// comes.
    ///
    /// # Errors
    /// What the world refuses.
    pub fn restart(stage: &'a Stage, cast: &'a Cast, world: World, start: f64, times: Vec<f64>) -> Result<Self, Error> {
        Self::begin(stage, cast, world, start, times, |walk| walk.at(start).is_some())
    }

    fn begin(
        stage: &'a Stage,
        cast: &'a Cast,
        mut world: World,
        start: f64,
        times: Vec<f64>,
        comes: impl Fn(&Walk) -> bool,
    ) -> Result<Self, Error> {
        let walks = &cast.people.walks;
        let group = world.add_group(stage.group.clone())?;
        let mut queue: Vec<usize> = (0..walks.len()).filter(|&walk| comes(&walks[walk])).collect();
        // stable: those who come at once stay by number
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

    /// The time of the recording that it has come to, seconds.
    pub fn time(&self) -> f64 {
        self.start + self.world.time()
    }

    /// The world as it is.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// Whether everybody has come and gone.
    pub fn is_over(&self) -> bool {
        self.entered == self.queue.len() && self.here.is_empty()
    }

    /// How many have gone, those included who could not come.
    pub fn gone(&self) -> usize {
        self.entered - self.here.len()
    }

    /// Moves everybody on by a step of the world; then those leave and enter whose turn it is.
    ///
    /// # Errors
    /// What the world refuses of who enters.
    pub fn step(&mut self) -> Result<(), Error> {
        let before = self.time();
        self.world.step();
        let (now, first) = (self.time(), self.taken);
        self.taken = self.reached();
        let mut here = std::mem::take(&mut self.here);
        here.retain_mut(|one| {
            let Some(row) = self.world.row(one.id) else { return false };
            let (status, place) = (self.world.agents().status[row], self.world.position(one.id).unwrap_or(one.place));
            let walk = &mut self.out.walks[one.walk];
            for &time in &self.times[first..self.taken] {
                let share = ((time - before) / (now - before)).clamp(0.0, 1.0);
                walk.times.push(time);
                walk.places.push(one.place.lerp(place, share));
            }
            one.place = place;
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
                self.out.left[one.walk] = Some((now, place));
                self.world.remove_agent(one.id);
            }
            !leaves
        });
        for one in &mut here {
            if one.pauses_until.is_some_and(|until| until <= now + ROUNDING) {
                let (agent, pauses_until) = (self.world.agent(one.id).ok_or(Error::Gone)?, self.pauses_until(one.walk));
                let journey = self.journey(one.walk)?;
                self.world.replace(one.id, Agent { journey, ..agent })?;
                one.pauses_until = pauses_until;
            }
        }
        self.here = here;
        self.enter(first)
    }

    /// When the pause is over that is next for a walk.
    fn pauses_until(&self, walk: usize) -> Option<f64> {
        self.cast.walkers[walk].pauses_after(self.time() + ROUNDING).first().map(|pause| pause.until)
    }

    /// The journey of a walk from now on: to the next pause, where the agent waits at least until that is over, or to the goal. A place in
    /// something solid is moved to the nearest free one.
    fn journey(&mut self, walk: usize) -> Result<JourneyId, Error> {
        let now = self.time();
        let walker = &self.cast.walkers[walk];
        let next = walker.pauses_after(now + ROUNDING).first();
        let (at, wait) = next.map_or((walker.goal, 0.0), |pause| (pause.place, (pause.until - now) as f32));
        let at = self.free(walk, at);
        let goal = self.world.add_goal(Goal::Point { at, tolerance: self.stage.near as f32 })?;
        self.world.add_journey(Journey { stops: vec![Stop { goal, wait }], repeat: false })
    }

    /// The place nearest to another at which the body of a walk has room; that itself where there is none.
    fn free(&self, walk: usize, at: DVec2) -> DVec2 {
        room(&self.world, at, self.cast.people.walks[walk].radius).unwrap_or(at)
    }

    /// How many of the times have come.
    fn reached(&self) -> usize {
        let now = self.time();
        self.times.partition_point(|&time| time <= now + ROUNDING)
    }

    /// Lets in those whose time has come; of the times since the last step the first is `first`.
    fn enter(&mut self, first: usize) -> Result<(), Error> {
        let (now, cast) = (self.time(), self.cast);
        while let Some(&index) = self.queue.get(self.entered) {
            let walk = &cast.people.walks[index];
            if walk.times[0] > now + ROUNDING {
                break;
            }
            self.entered += 1;
            let row = walk.times.partition_point(|&time| time <= now + ROUNDING) - 1;
            // of who is gone by the end of the step nothing is to be seen
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
            self.here.push(Here { walk: index, id, place, pauses_until: self.pauses_until(index) });
        }
        Ok(())
    }

    /// Adds somebody, if there is room on the ground.
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
        let speed = walker.speed as f32;
        let velocity: Vec2 = velocity.as_vec2();
        let heading = (velocity.length() > 0.1).then(|| velocity.y.atan2(velocity.x));
        let id = self.world.add_agent(Agent {
            position,
            velocity,
            heading,
            group: self.group,
            journey,
            radius,
            preferred_speed: speed,
            max_speed: self.stage.agent.max_speed.max(speed),
            number: Some(walk.number),
            ..self.stage.agent.clone()
        })?;
        self.out.entered += 1;
        self.out.overlapping += usize::from(!alone);
        self.out.moved += usize::from(position != at);
        self.out.goals_moved += usize::from(goal_moved);
        Ok(Some(id))
    }

    /// Makes `frame` show who is there now, at the time of the recording.
    pub fn capture(&self, frame: &mut Frame) {
        frame.capture(&self.world);
        (frame.time, frame.arrived, frame.total) = (self.time(), self.gone(), self.cast.people.walks.len());
        for body in &mut frame.bodies {
            (body.group, body.goal) = (0, None);
        }
    }

    /// What came of it.
    pub fn finish(self) -> Replayed {
        Replayed { summary: self.world.summary(), ..self.out }
    }
}
