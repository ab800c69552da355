//! Adds and removes groups, goals, journeys, agents and obstacles. All of it is possible while the world runs.

use super::local::localized;
use super::state::Slots;
use super::{Settings, State, SubSteps, TraceRequest, World};
use crate::agent::{
    Agent, AgentId, Columns, GoalId, Group, GroupId, JourneyId, ObstacleId, ProgressMark, Row, ScriptId, Status,
};
use crate::navigate::{Goal, Journey, Legs, Meshes, Script};
use crate::perceive::SimdLevel;
use crate::space::{Core, Obstacle, Place, Walkable, Walls, check_polygon};
use crate::steer::Stimulus;
use crate::step::Pipeline;
use crate::summary::Tally;
use crate::{Error, Position, world::schedule::Schedule};
use glam::{DVec2, DVec3, Vec2};

/// Distance from the origin, metres, within which a world keeps its guarantees: beyond it `f32` is too coarse.
pub(crate) const FARTHEST: f64 = 20_000.0;

impl World {
    /// Returns an empty world with one [default](Group::default) group and one [journey](JourneyId::STAY) without
    /// stops.
    ///
    /// # Errors
    /// [`Error::Limit`] for a time step or a number of sub-steps out of range, or an origin that is not finite.
    pub fn new(settings: Settings) -> Result<Self, Error> {
        Error::unless(settings.step > 0.0 && settings.step <= 10.0, "time step", settings.step, "in (0, 10] s")?;
        if let SubSteps::Fixed(parts) = settings.sub_steps {
            Error::unless((1..=10_000).contains(&parts), "number of sub-steps", parts, "from 1 to 10000")?;
        }
        Error::unless_finite("origin", settings.origin.x + settings.origin.y)?;
        let state = State {
            settings,
            steps: 0,
            agents: Columns::default(),
            slots: Slots::default(),
            groups: vec![Group::default()],
            local_groups: vec![Group::default()],
            groups_with_agents: Vec::new(),
            goals: Vec::new(),
            journeys: vec![Journey::default()],
            choices: Vec::new(),
            scripts: Vec::new(),
            place: Place::default(),
            schedule: Schedule::default(),
            tally: Tally::default(),
            stranded: Vec::new(),
            standoffs: Vec::new(),
            stimuli: Vec::new(),
            events: Vec::new(),
            own_journeys: super::control::OwnJourneys::default(),
            game: super::play::RulesState::default(),
            adapted: Vec::new(),
            others: crate::halo::Others::default(),
            extent: None,
            walls: Walls::default(),
            meshes: Meshes::default(),
            legs: Legs::new(&[Journey::default()], &[]),
            instructions: SimdLevel::default(),
            traced: TraceRequest::default(),
        };
        let mut step = Pipeline::default();
        // the solids of the default group
        step.guard.solids_mut().add(Vec::new());
        Ok(Self { state, step })
    }

    /// Adds a group.
    ///
    /// # Errors
    /// [`Error::Limit`] names the parameter that is out of range.
    pub fn add_group(&mut self, group: Group) -> Result<GroupId, Error> {
        let local = self.state.checked_group(&group)?;
        self.state.agents.memory.widen(group.guidance.words());
        self.step.guard.solids_mut().add(local.solid.0.clone());
        self.state.local_groups.push(local);
        self.state.groups.push(group);
        Ok(GroupId(self.state.local_groups.len() as u32 - 1))
    }

    /// Adds a goal.
    ///
    /// # Errors
    /// [`Error::Limit`] for a point or tolerance out of range, [`Error::Shape`] for corners that enclose no area.
    pub fn add_goal(&mut self, goal: Goal) -> Result<GoalId, Error> {
        self.state.add_goal(goal)
    }

    /// Adds a journey.
    ///
    /// # Errors
    /// [`Error::Unknown`] for a goal that does not exist, [`Error::Limit`] for a wait that is negative.
    pub fn add_journey(&mut self, journey: Journey) -> Result<JourneyId, Error> {
        self.state.add_journey(journey)
    }

    /// Makes journeys alternatives to each other. An agent on one of them that [looks ahead](Group::look_ahead) changes
    /// to another, from its present leg on, when it expects to reach the goal sooner because fewer agents wait there.
    /// The two journeys must differ only in the goal of that leg.
    ///
    /// ```
    /// use glam::DVec2;
    /// use throng::navigate::{Goal, Journey, Stop};
    /// use throng::{Settings, World};
    /// let mut world = World::new(Settings::default())?;
    /// let mut to = |x: f64| {
    ///     let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    ///     let corners = corners.map(|[dx, y]| DVec2::new(x + dx, y)).to_vec();
    ///     let goal = world.add_goal(Goal::Exit { corners })?;
    ///     world.add_journey(Journey { stops: vec![Stop { goal, wait: 0.0 }], repeat: false })
    /// };
    /// let (left, right) = (to(-10.0)?, to(10.0)?);
    /// world.add_choice(&[left, right])?;
    /// # Ok::<(), throng::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Unknown`] for a journey that does not exist. [`Error::Shape`] for journeys that differ in the number of
    /// stops, for journeys of which only some repeat, and for journeys that already have alternatives.
    pub fn add_choice(&mut self, journeys: &[JourneyId]) -> Result<(), Error> {
        for journey in journeys {
            known("journey", journey.index(), self.state.journeys.len())?;
        }
        let shape = |why: &str| Err(Error::Shape { what: "the choice".into(), why: why.into() });
        let form = |journey: &JourneyId| {
            let Journey { stops, repeat } = &self.state.journeys[journey.index()];
            (stops.len(), *repeat)
        };
        if journeys.windows(2).any(|pair| form(&pair[0]) != form(&pair[1])) {
            return shape("its journeys differ in the number of their stops, or only some of them repeat");
        }
        if self.state.choices.iter().flatten().any(|journey| journeys.contains(journey)) {
            return shape("one of its journeys has alternatives already: list all of them at once");
        }
        self.state.choices.push(journeys.to_vec());
        Ok(())
    }

    /// Adds a script.
    ///
    /// # Errors
    /// [`Error::Limit`] for too few keyframes, times that do not increase, and positions or headings out of range.
    pub fn add_script(&mut self, script: Script) -> Result<ScriptId, Error> {
        script.check()?;
        for keyframe in &script.keyframes {
            self.state.check_position("position of a keyframe", keyframe.at)?;
        }
        self.state.scripts.push(script);
        Ok(ScriptId(self.state.scripts.len() as u32 - 1))
    }

    /// Adds an obstacle. Agents with bodies that it touches are pushed out. Agents that are scheduled to
    /// [enter](Self::schedule_agent) where it stands wait until it is removed.
    ///
    /// # Errors
    /// [`Error::Shape`] for a polygon that crosses itself or encloses nothing, [`Error::Limit`] for a radius out of
    /// range, [`Error::NoRoom`] if the centre of an agent would be inside: no smooth motion leads out.
    pub fn add_obstacle(&mut self, obstacle: Obstacle) -> Result<ObstacleId, Error> {
        self.add_obstacles([obstacle]).map(|ids| ids[0]).map_err(|(_, error)| error)
    }

    /// Adds obstacles, as [`add_obstacle`](Self::add_obstacle) does. Many obstacles take much less time in one call
    /// than in one call each.
    ///
    /// # Errors
    /// The index of the first obstacle that is refused, and the reason. Then no obstacle is added.
    pub fn add_obstacles(
        &mut self,
        obstacles: impl IntoIterator<Item = Obstacle>,
    ) -> Result<Vec<ObstacleId>, (usize, Error)> {
        let obstacles: Vec<Obstacle> = obstacles.into_iter().collect();
        for (index, obstacle) in obstacles.iter().enumerate() {
            self.state.check_obstacle(obstacle).map_err(|error| (index, error))?;
        }
        let first = self.state.place.obstacles.len();
        self.state.place.obstacles.extend(obstacles.into_iter().map(Some));
        if self.state.place.obstacles.len() > first {
            self.place_changed();
        }
        Ok((first..self.state.place.obstacles.len()).map(|index| ObstacleId(index as u32)).collect())
    }

    /// Returns the id of an obstacle that equals this one; the first, if there are several.
    ///
    /// ```
    /// use glam::DVec2;
    /// use throng::{Obstacle, Settings, World};
    /// let mut world = World::new(Settings::default())?;
    /// let pillar = Obstacle::Circle { center: DVec2::ZERO, radius: 1.0 };
    /// let id = world.add_obstacle(pillar.clone())?;
    /// assert_eq!(world.find_obstacle(&pillar), Some(id));
    /// assert!(world.remove_obstacle(id) && world.find_obstacle(&pillar).is_none());
    /// # Ok::<(), throng::Error>(())
    /// ```
    pub fn find_obstacle(&self, obstacle: &Obstacle) -> Option<ObstacleId> {
        let index = self.state.place.obstacles.iter().position(|known| known.as_ref() == Some(obstacle));
        index.map(|index| ObstacleId(index as u32))
    }

    /// Removes an obstacle. Returns false if it does not exist.
    pub fn remove_obstacle(&mut self, id: ObstacleId) -> bool {
        let removed = self.state.place.obstacles.get_mut(id.index()).and_then(Option::take).is_some();
        if removed {
            self.place_changed();
        }
        removed
    }

    /// Gives an obstacle another shape or place: a door that closes, a vehicle that stops elsewhere. For an obstacle that
    /// moves in every step, use an agent with a [`Script`].
    ///
    /// # Errors
    /// Those of [`add_obstacle`](Self::add_obstacle), and [`Error::Unknown`] for an obstacle that does not exist; the world is
    /// unchanged.
    pub fn set_obstacle(&mut self, id: ObstacleId, obstacle: Obstacle) -> Result<(), Error> {
        if self.state.place.obstacles.get(id.index()).is_none_or(Option::is_none) {
            return Err(Error::Unknown { what: "obstacle", index: id.index() });
        }
        self.state.check_obstacle(&obstacle)?;
        self.state.place.obstacles[id.index()] = Some(obstacle);
        self.place_changed();
        Ok(())
    }

    /// Moves an obstacle along the ground by an offset, metres.
    ///
    /// ```
    /// use glam::DVec2;
    /// use throng::{Obstacle, Settings, World};
    /// let mut world = World::new(Settings::default())?;
    /// let id = world.add_obstacle(Obstacle::Circle { center: DVec2::ZERO, radius: 1.0 })?;
    /// world.move_obstacle(id, DVec2::X * 5.0)?;
    /// assert!(world.no_room(DVec2::X * 5.0, 0.2).is_some() && world.no_room(DVec2::ZERO, 0.2).is_none());
    /// # Ok::<(), throng::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`set_obstacle`](Self::set_obstacle).
    pub fn move_obstacle(&mut self, id: ObstacleId, by: DVec2) -> Result<(), Error> {
        let obstacle = self.state.place.obstacles.get(id.index()).cloned().flatten();
        let obstacle = obstacle.ok_or(Error::Unknown { what: "obstacle", index: id.index() })?;
        self.set_obstacle(id, obstacle.moved(by))
    }

    /// Sets the walkable areas; their union is walkable. Without areas, everything outside obstacles is walkable.
    ///
    /// # Errors
    /// [`Error::Shape`] for a boundary that crosses itself or encloses nothing, [`Error::NoRoom`] for an agent that
    /// would be outside.
    pub fn set_walkable(&mut self, areas: Vec<Walkable>) -> Result<(), Error> {
        let areas = Walkable::union(areas)?;
        if !areas.is_empty() {
            let outside = |p| !areas.iter().any(|area| area.contains(p));
            self.state.check_no_agent_at(outside, "it is outside the walkable area")?;
        }
        self.state.place.areas = areas;
        self.place_changed();
        Ok(())
    }

    /// Returns why a disc cannot stand at `at`; `None` if it can.
    pub fn no_room(&self, at: DVec2, radius: f32) -> Option<&'static str> {
        self.state.no_room(at, radius)
    }

    /// Reserves memory for this number of additional agents. It saves the memory that growth would waste.
    pub fn reserve(&mut self, agents: usize) {
        self.state.reserve(agents);
    }

    /// Adds an agent. It may overlap other agents: then the guard parts them smoothly, and
    /// [`overlapping`](Self::overlapping) lists the pair.
    ///
    /// # Errors
    /// [`Error::Limit`] names the parameter that is out of range, [`Error::Unknown`] a group or journey that does not
    /// exist, [`Error::NoRoom`] what occupies the position, [`Error::NumberTaken`] a number that is used twice.
    pub fn add_agent(&mut self, agent: Agent) -> Result<AgentId, Error> {
        let agent = self.state.with_journey(agent)?;
        let number = self.state.number(&agent)?;
        Ok(self.state.put(&agent, number, self.state.time()))
    }

    /// Schedules an agent to enter at `time` seconds, or as soon afterwards as its place is free.
    ///
    /// # Errors
    /// As [`add_agent`](Self::add_agent), and [`Error::Limit`] for a time that is not finite.
    pub fn schedule_agent(&mut self, time: f64, agent: Agent) -> Result<(), Error> {
        Error::unless_finite("time of entry", time)?;
        let agent = self.state.with_journey(agent)?;
        let number = self.state.number(&agent)?;
        self.state.schedule.add(time, Agent { number: Some(number), ..agent });
        Ok(())
    }

    /// Tells steering behaviours of a bang or a shout at a place and a time, seconds since the start:
    /// `throng_steer::Fear` reacts to it.
    ///
    /// ```
    /// use throng::{Settings, World};
    /// let mut world = World::new(Settings::default())?;
    /// world.notify([3.0, 4.0], world.time())?;
    /// # Ok::<(), throng::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Limit`] if the place or the time is not finite.
    pub fn notify(&mut self, place: impl Into<Position>, time: f64) -> Result<(), Error> {
        let place = place.into();
        Error::unless_finite("place of the stimulus", place.0.element_sum())?;
        Error::unless_finite("time of the stimulus", time)?;
        self.state.stimuli.push(Stimulus { position: self.state.settings.to_local(place), time });
        Ok(())
    }

    /// Removes an agent. Returns false if it does not exist.
    pub fn remove_agent(&mut self, id: AgentId) -> bool {
        let Some(row) = self.state.row(id) else { return false };
        self.step.remove(&mut self.state, row);
        true
    }

    /// Rebuilds everything that depends on obstacles and walkable areas.
    pub(super) fn place_changed(&mut self) {
        self.state.place_changed();
        self.step.place_changed();
    }
}

impl State {
    pub(crate) fn reserve(&mut self, agents: usize) {
        self.agents.reserve(agents);
        self.slots.rows.reserve(agents);
        self.slots.generations.reserve(agents);
    }

    pub(crate) fn remove_row(&mut self, row: usize) {
        let slot = self.agents.slot[row] as usize;
        self.unstrand(row);
        self.agents.swap_remove(row);
        let slots = &mut self.slots;
        slots.rows[slot] = u32::MAX;
        slots.generations.set(slot, slots.generations[slot] + 1);
        slots.free.push(slot as u32);
        if let Some(&moved) = self.agents.slot.get(row) {
            slots.rows[moved as usize] = row as u32;
        }
    }

    /// Returns a slot for the row that is added next.
    fn new_slot(&mut self) -> u32 {
        let slot = self.slots.free.pop().unwrap_or_else(|| {
            self.slots.rows.push(u32::MAX);
            self.slots.generations.push(0);
            self.slots.rows.len() as u32 - 1
        });
        self.slots.rows[slot as usize] = self.agents.len() as u32;
        slot
    }

    /// Adds an agent of another world.
    pub(crate) fn put_copy(&mut self, row: Row) {
        let slot = self.new_slot();
        self.agents.push_copy(Row { slot, ..row });
    }

    pub(crate) fn put(&mut self, agent: &Agent, number: u32, now: f64) -> AgentId {
        let slot = self.new_slot();
        let row = self.agents.len() as u32;
        let heading = self.first_heading(agent);
        self.agents.push(agent, self.settings.origin, slot, number, heading, now);
        let status = self.first_status(row as usize);
        self.agents.status[row as usize] = status;
        if status == Status::Arrived {
            self.agents.arrived.set(row as usize, now);
        }
        AgentId { slot, generation: self.slots.generations[slot as usize] }
    }

    /// Rebuilds everything that depends on obstacles and walkable areas.
    fn place_changed(&mut self) {
        self.walls = Walls::new(&self.place.areas, self.place.obstacles(), self.settings.origin);
        self.meshes = Meshes::default();
        self.extent = None;
        for travel in &mut self.agents.travel {
            travel.lose_way();
            travel.set_gap(0.0);
        }
        self.agents.progress_mark.fill(ProgressMark::default());
        // a goal that was out of reach may be reachable now
        for status in &mut self.agents.status {
            if *status == Status::Stranded {
                *status = Status::Walking;
            }
        }
        self.stranded.clear();
        self.end_standoffs();
    }

    /// Returns a group in local coordinates.
    pub(crate) fn checked_group(&self, group: &Group) -> Result<Group, Error> {
        group.check()?;
        if group.has_places() {
            self.check_position("origin of the group", group.origin)?;
        }
        localized(group, self.settings.origin)
    }

    /// Adds a goal.
    ///
    /// # Errors
    /// [`Error::Limit`] for a point or tolerance out of range, [`Error::Shape`] for corners that enclose no area.
    pub(crate) fn add_goal(&mut self, goal: Goal) -> Result<GoalId, Error> {
        self.check_goal(&goal)?;
        self.goals.push(goal);
        Ok(GoalId(self.goals.len() as u32 - 1))
    }

    pub(crate) fn check_goal(&self, goal: &Goal) -> Result<(), Error> {
        match goal {
            Goal::Point { at, tolerance } => {
                self.check_position("goal", *at)?;
                Error::unless_positive("tolerance", *tolerance)
            }
            Goal::Air { at, tolerance } => {
                self.check_position("goal", at.truncate())?;
                check_altitude("altitude of the goal", at.z)?;
                Error::unless_positive("tolerance", *tolerance)
            }
            Goal::Area { corners } | Goal::Exit { corners } => check_polygon("goal area", corners),
        }
    }

    /// Adds a journey.
    ///
    /// # Errors
    /// [`Error::Unknown`] for a goal that does not exist, [`Error::Limit`] for a wait that is negative.
    pub(crate) fn add_journey(&mut self, journey: Journey) -> Result<JourneyId, Error> {
        for stop in &journey.stops {
            known("goal", stop.goal.index(), self.goals.len())?;
            Error::unless(stop.wait >= 0.0 && stop.wait.is_finite(), "wait", stop.wait, "at least 0 s and finite")?;
        }
        self.legs.add(&journey, &self.goals);
        self.journeys.push(journey);
        Ok(JourneyId(self.journeys.len() as u32 - 1))
    }

    pub(super) fn check_obstacle(&self, obstacle: &Obstacle) -> Result<(), Error> {
        match obstacle {
            Obstacle::Circle { center, radius } => {
                self.check_position("centre of the obstacle", *center)?;
                Error::unless(
                    *radius > 0.0 && *radius < FARTHEST,
                    "radius of the obstacle",
                    *radius,
                    "greater than 0",
                )?;
            }
            Obstacle::Polygon { corners } => check_polygon("obstacle", corners)?,
            Obstacle::Wall { points } => {
                for &point in points {
                    self.check_position("point of the wall", point)?;
                }
                if points.len() < 2 || points.iter().all(|p| *p == points[0]) {
                    let why = "it needs at least two different points".into();
                    return Err(Error::Shape { what: "wall".into(), why });
                }
            }
        }
        self.check_no_agent_at(|p| obstacle.covers(p), "it is inside an obstacle")
    }

    /// Returns why a disc cannot stand at `at`; `None` if it can.
    pub(crate) fn no_room(&self, at: DVec2, radius: f32) -> Option<&'static str> {
        self.place.no_room(at, f64::from(radius), &self.walls, self.settings.origin)
    }

    /// Returns why an agent cannot be at its position; `None` if it can. Unguarded agents can be anywhere.
    pub(crate) fn no_room_for(&self, agent: &Agent) -> Option<&'static str> {
        if !self.local_groups[agent.group.index()].guard {
            None
        } else if agent.core == Vec2::ZERO {
            self.no_room(agent.position.truncate(), agent.radius)
        } else {
            let center = agent.position.truncate() - self.settings.origin;
            let core = Core::new(center, self.first_heading(agent), agent.core);
            self.place.no_room_for(agent.position.truncate(), &core, agent.body(), &self.walls)
        }
    }

    /// Returns the heading that an agent starts with: its own heading, or the direction of its first goal.
    pub(crate) fn first_heading(&self, agent: &Agent) -> f32 {
        let towards_goal = || {
            let leg = self.first_leg(agent.journey, agent.position)?;
            let stop = self.journeys[agent.journey.index()].stops[leg as usize];
            direction(self.goals[stop.goal.index()].middle() - agent.position.truncate())
        };
        agent.heading.map(within_a_turn).or_else(towards_goal).unwrap_or(0.0)
    }

    /// Returns the first leg of a journey that leads away from a place: a stop at the place itself does not.
    pub(crate) fn first_leg(&self, journey: JourneyId, place: DVec3) -> Option<u32> {
        let stops = &self.journeys[journey.index()].stops;
        stops.iter().position(|stop| !self.goals[stop.goal.index()].holds(place)).map(|leg| leg as u32)
    }

    /// Checks an agent and returns it with a journey to its goal, if it has a goal.
    pub(crate) fn with_journey(&mut self, mut agent: Agent) -> Result<Agent, Error> {
        self.check(&agent)?;
        if let Some(goal) = agent.goal.take() {
            agent.journey = self.own_journey(goal)?;
        }
        Ok(agent)
    }

    pub(crate) fn check(&self, agent: &Agent) -> Result<(), Error> {
        self.check_position("position", agent.position.truncate())?;
        check_altitude("altitude", agent.position.z)?;
        agent.check()?;
        known("group", agent.group.index(), self.local_groups.len())?;
        known("journey", agent.journey.index(), self.journeys.len())?;
        if let Some(script) = agent.script {
            known("script", script.index(), self.scripts.len())?;
        }
        if let Some(goal) = &agent.goal {
            self.check_goal(goal)?;
        }
        match self.no_room_for(agent) {
            Some(why) => Err(Error::NoRoom { at: agent.position.truncate(), radius: agent.radius, why }),
            None => Ok(()),
        }
    }

    /// Returns an error if an agent is at a blocked point.
    fn check_no_agent_at(&self, blocked: impl Fn(DVec2) -> bool, why: &'static str) -> Result<(), Error> {
        let found = (0..self.agents.len()).find(|&row| blocked(self.world_position(row)));
        found.map_or(Ok(()), |row| {
            Err(Error::NoRoom { at: self.world_position(row), radius: self.agents.radius[row], why })
        })
    }

    pub(crate) fn check_position(&self, what: &'static str, p: DVec2) -> Result<(), Error> {
        Error::unless_finite(what, p.x + p.y)?;
        let far = (p - self.settings.origin).abs().max_element();
        Error::unless(far <= FARTHEST, what, far, "within 20 km of the world's origin")
    }

    fn number(&mut self, agent: &Agent) -> Result<u32, Error> {
        let next = &mut self.slots.next_number;
        let number = agent.number.unwrap_or(*next);
        Error::unless(number < u32::MAX, "number", number, "less than 4294967295")?;
        // numbers mostly come in order: only a number out of order needs a search
        if number < *next && (self.agents.number.contains(&number) || self.schedule.has(number)) {
            return Err(Error::NumberTaken { number });
        }
        *next = (*next).max(number + 1);
        Ok(number)
    }
}

/// Returns the heading along a vector; `None` for the zero vector.
pub(super) fn direction(along: DVec2) -> Option<f32> {
    (along != DVec2::ZERO).then(|| libm::atan2f(along.y as f32, along.x as f32))
}

pub(super) fn check_altitude(what: &'static str, altitude: f64) -> Result<(), Error> {
    Error::unless((0.0..=FARTHEST).contains(&altitude), what, altitude, "from 0 to 20000 m")
}

pub(super) fn known(what: &'static str, index: usize, count: usize) -> Result<(), Error> {
    if index < count { Ok(()) } else { Err(Error::Unknown { what, index }) }
}

/// Returns the same angle between -pi and pi. An angle in this range stays the same to the bit.
fn within_a_turn(angle: f32) -> f32 {
    if angle.abs() <= std::f32::consts::PI {
        return angle;
    }
    let (sin, cos) = libm::sincosf(angle);
    libm::atan2f(sin, cos)
}
