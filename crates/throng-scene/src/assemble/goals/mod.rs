//! The goals of the agents: goals shared by a group, goals of single agents, and journeys made of them.

mod combined;
mod each;
mod key;
mod shared;
mod ways;

pub(super) use shared::check_region;

use super::ground::{check_polygon, has_room, obstacle_name, short, show};
use super::limits::{HIGHEST, MAX_COORDINATE};
use super::place::Middle;
use super::plan::PlannedJourney;
use super::size::Size;
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::geometry::{DVec2, DVec3, Solid, Touch, contains, distance_to_segment};
use crate::random::{Purpose, Random};
use crate::registry::{AgentJourney, AgentStart, GoalOfEach, GoalTree};
use crate::scene::Scene;
use key::GoalKey;
use std::collections::{HashMap, HashSet};
use ways::Ways;

/// The maximum number of alternative journeys: an agent with more keeps to the goals that were nearest at the start.
const MOST_ALTERNATIVES: usize = 64;

/// The stops of a journey, whether it repeats, and the stops with a choice of goals.
type Known = (Vec<(usize, u32)>, bool, Vec<(usize, Vec<usize>)>);

/// The goals of a group, with the indices of goals that agents share.
type Target = GoalTree<usize>;

/// Collects goals and journeys.
pub(super) struct GoalPlanner<'a> {
    pub scene: &'a Scene,
    pub solid: &'a Solid,
    pub place: GoalPlace<'a>,
    pub goals: Vec<throng::Goal>,
    pub journeys: Vec<PlannedJourney>,
    /// Indices of journeys that are alternatives to each other.
    pub choices: Vec<Vec<usize>>,
    /// The indices of goals that several agents can share, by what tells them apart.
    shared: HashMap<GoalKey, usize>,
    /// Those of them that the agents of the group at hand can reach.
    checked: HashSet<usize>,
    /// The greatest clearance radius of the group at hand.
    largest: f64,
    known: HashMap<Known, usize>,
}

/// The properties of an agent that determine its goals.
struct Walker {
    start: AgentStart,
    radius: f64,
    /// The position of its group.
    group: u64,
    choice: Random,
    wait: Random,
    /// Stops with a choice of goals, and the indices of these goals.
    among: Vec<(usize, Vec<usize>)>,
}

/// Ground and obstacles, in the form that the world takes.
pub(super) type GoalPlace<'a> = (&'a [throng::Walkable], &'a [throng::Obstacle]);

impl<'a> GoalPlanner<'a> {
    pub fn new(scene: &'a Scene, solid: &'a Solid, place: GoalPlace<'a>) -> Self {
        Self {
            scene,
            solid,
            place,
            goals: vec![],
            journeys: vec![],
            choices: vec![],
            shared: HashMap::new(),
            checked: HashSet::new(),
            largest: 0.0,
            known: HashMap::new(),
        }
    }

    /// Returns the journeys of a group's agents (`None`: the agent stays). `middle` is the centre of the group's place.
    pub fn journeys_of(
        &mut self,
        i: usize,
        goal: Option<GoalTree>,
        starts: &[DVec3],
        sizes: &[Size],
        middle: Middle,
    ) -> Result<Vec<Option<usize>>, Problem> {
        let group = &self.scene.groups[i];
        let Some(goal) = goal else { return Ok(vec![None; starts.len()]) };
        self.checked.clear();
        self.largest = sizes.iter().fold(0.0_f64, |most, size| most.max(size.clearance_radius));
        let target = goal.try_map(&mut |shared| self.add_shared(shared.goal, &shared.path, shared.what))?;
        let mut ways =
            target.chooses_nearest().then(|| Ways::new(self.place, self.largest, starts, &self.goals)).flatten();
        let mut out = Vec::with_capacity(starts.len());
        for (k, (start, size)) in starts.iter().zip(sizes).enumerate() {
            let random = |purpose| Random::new(self.scene.seed, i as u64, k as u64, purpose);
            let center = middle.at.extend(middle.altitude.unwrap_or(start.z));
            let mut walker = Walker {
                start: AgentStart { k, n: starts.len(), at: *start, center },
                radius: size.clearance_radius,
                group: i as u64,
                choice: random(Purpose::Choice),
                wait: random(Purpose::StopWait),
                among: vec![],
            };
            let first = group.wait.map_or(0.0, |wait| random(Purpose::Wait).draw(&wait));
            let mut stops = vec![];
            if first > 0.0 {
                let tolerance = size.clearance_radius.max(0.1);
                stops.push((self.add(walker.start.point(*start, tolerance)), first as f32));
            }
            let repeat = self.resolve(&target, &mut walker, &mut ways, 0.0, &mut stops)?;
            out.push(Some(self.journey(stops, repeat, &walker.among)));
        }
        Ok(out)
    }

    fn add(&mut self, goal: throng::Goal) -> usize {
        self.goals.push(goal);
        self.goals.len() - 1
    }

    /// Adds a goal that agents of the group share, unless it exists, and checks that they can reach it.
    fn add_shared(&mut self, goal: throng::Goal, path: &Path, what: &str) -> Result<usize, Problem> {
        let key = GoalKey::of(&goal);
        let index = match self.shared.get(&key) {
            Some(index) => *index,
            None => {
                let added = self.add(goal);
                self.shared.insert(key, added);
                added
            }
        };
        if self.checked.insert(index) {
            self.check_reach(&self.goals[index], path, self.largest, what)?;
        }
        Ok(index)
    }

    /// Adds a journey and its alternatives: `among` lists the stops with a choice of goals, and these goals.
    fn journey(&mut self, stops: Vec<(usize, f32)>, repeat: bool, among: &[(usize, Vec<usize>)]) -> usize {
        let journeys = self.journeys.len();
        let own = self.one_journey(stops.clone(), repeat, among);
        let count = among.iter().fold(1_usize, |count, (_, goals)| count.saturating_mul(goals.len()));
        if own < journeys || among.is_empty() || count > MOST_ALTERNATIVES {
            return own;
        }
        let mut all = vec![stops];
        for (stop, goals) in among {
            let with = |stops: &Vec<(usize, f32)>, goal: usize| {
                let mut stops = stops.clone();
                stops[*stop].0 = goal;
                stops
            };
            all = all.iter().flat_map(|stops| goals.iter().map(move |&goal| with(stops, goal))).collect();
        }
        let choice = all.into_iter().map(|stops| self.one_journey(stops, repeat, among)).collect();
        self.choices.push(choice);
        own
    }

    fn one_journey(&mut self, stops: Vec<(usize, f32)>, repeat: bool, among: &[(usize, Vec<usize>)]) -> usize {
        let key = (stops.iter().map(|(goal, wait)| (*goal, wait.to_bits())).collect(), repeat, among.to_vec());
        let journeys = &mut self.journeys;
        *self.known.entry(key).or_insert_with(|| {
            journeys.push(PlannedJourney { stops, repeat });
            journeys.len() - 1
        })
    }

    /// Adds the stops of one agent. Returns whether they repeat.
    fn resolve(
        &mut self,
        target: &Target,
        walker: &mut Walker,
        ways: &mut Option<Ways>,
        wait: f32,
        stops: &mut Vec<(usize, f32)>,
    ) -> Result<bool, Problem> {
        match target {
            Target::Same(goal) => stops.push((*goal, wait)),
            Target::Each(each, _) => return self.resolve_each(each, walker, wait, stops),
            Target::Stops(list, repeat) => {
                for (target, wait) in list {
                    let wait = wait.map_or(0.0, |wait| walker.wait.draw(&wait)) as f32;
                    self.resolve(target, walker, ways, wait, stops)?;
                }
                return Ok(*repeat);
            }
            Target::Nearest(targets) => {
                // if no goal can be reached on foot, the straight distance decides
                let mut least = (f64::INFINITY, f64::INFINITY);
                let mut nearest = targets.first();
                for target in targets {
                    let straight = self.distance(target, walker, &mut None)?;
                    let far = (self.distance(target, walker, ways)?, straight);
                    if far < least {
                        (least, nearest) = (far, Some(target));
                    }
                }
                let shared = targets.iter().map(|target| match target {
                    Target::Same(goal) => Some(*goal),
                    _ => None,
                });
                if let Some(mut goals) = shared.collect::<Option<Vec<usize>>>() {
                    goals.sort_unstable();
                    goals.dedup();
                    if goals.len() > 1 {
                        walker.among.push((stops.len(), goals));
                    }
                }
                if let Some(target) = nearest {
                    return self.resolve(target, walker, ways, wait, stops);
                }
            }
            Target::Choice(targets) => {
                let drawn = walker.choice.unit() * targets.last().map_or(0.0, |(_, sum)| *sum);
                if let Some((target, _)) = targets.iter().find(|(_, sum)| drawn < *sum).or(targets.last()) {
                    return self.resolve(target, walker, ways, wait, stops);
                }
            }
        }
        Ok(false)
    }

    /// Adds the stops that a rule gives an agent. Returns whether they repeat. The agent waits `wait` seconds longer at
    /// the last.
    fn resolve_each(
        &mut self,
        each: &GoalOfEach,
        walker: &Walker,
        wait: f32,
        stops: &mut Vec<(usize, f32)>,
    ) -> Result<bool, Problem> {
        let journey = self.journey_by(each, walker)?;
        for (goal, seconds) in journey.stops {
            let goal = match goal {
                throng::Goal::Point { .. } | throng::Goal::Air { .. } => {
                    self.check_reach(&goal, &each.path, walker.radius, &walker.goal_name())?;
                    self.add(goal)
                }
                throng::Goal::Area { .. } | throng::Goal::Exit { .. } => {
                    self.add_shared(goal, &each.path, "the goal's area")?
                }
            };
            stops.push((goal, seconds as f32));
        }
        if let Some((_, seconds)) = stops.last_mut() {
            *seconds += wait;
        }
        Ok(journey.repeat)
    }

    /// Returns the journey that a rule gives an agent. Its numbers are checked.
    fn journey_by(&self, each: &GoalOfEach, walker: &Walker) -> Result<AgentJourney, Problem> {
        let (group, k) = (walker.group, walker.start.k as u64);
        let mut random = Random::part(self.scene.seed, group, k, Purpose::Goal, each.number);
        let journey = each.journey(&walker.start, &mut random)?;
        for (goal, _) in &journey.stops {
            if !self.shared.contains_key(&GoalKey::of(goal)) {
                check_numbers(goal, &each.path, &walker.goal_name())?;
            }
        }
        Ok(journey)
    }

    /// Returns the distance from an agent's start to a target, on the ground: along `ways` around walls, or straight.
    fn distance(&self, target: &Target, walker: &Walker, ways: &mut Option<Ways>) -> Result<f64, Problem> {
        let nearer =
            |least: f64, target: &Target| self.distance(target, walker, ways).map(|distance| least.min(distance));
        match target {
            Target::Same(goal) => Ok(self.distance_to(&self.goals[*goal], walker, ways)),
            Target::Each(each, _) => {
                let journey = self.journey_by(each, walker)?;
                Ok(self.distance_to(&journey.stops[0].0, walker, ways))
            }
            Target::Stops(list, _) => list.iter().take(1).map(|(first, _)| first).try_fold(f64::INFINITY, nearer),
            Target::Nearest(targets) => targets.iter().try_fold(f64::INFINITY, nearer),
            Target::Choice(targets) => targets.iter().map(|(target, _)| target).try_fold(f64::INFINITY, nearer),
        }
    }

    /// Returns the distance from an agent's start to a goal.
    fn distance_to(&self, goal: &throng::Goal, walker: &Walker, ways: &mut Option<Ways>) -> f64 {
        let start = walker.start.at.truncate();
        match (goal.corners(), ways) {
            (None, Some(ways)) => ways.length_to_point(start, goal.middle()),
            (None, None) => goal.middle().distance(start),
            (Some(corners), _) if contains(corners, start) => 0.0,
            (Some(corners), Some(ways)) => ways.length_to_area(start, goal, corners),
            (Some(corners), None) => {
                let ends = corners.iter().zip(corners.iter().cycle().skip(1));
                ends.fold(f64::INFINITY, |least, (a, b)| least.min(distance_to_segment(start, *a, *b)))
            }
        }
    }

    /// Checks that a body can reach a goal: stand within the tolerance of a point, or somewhere in an area.
    fn check_reach(&self, goal: &throng::Goal, path: &Path, radius: f64, what: &str) -> Result<(), Problem> {
        match goal {
            throng::Goal::Point { at, tolerance } => self.check_point(path, *at, (*tolerance).into(), radius, what),
            throng::Goal::Air { at, tolerance } => {
                self.check_point(path, at.truncate(), (*tolerance).into(), radius, what)
            }
            throng::Goal::Area { corners } | throng::Goal::Exit { corners } => {
                self.check_room(path, corners, radius, what)
            }
        }
    }

    /// Checks that a body can stand within the tolerance of a point.
    fn check_point(&self, path: &Path, at: DVec2, tolerance: f64, radius: f64, what: &str) -> Result<(), Problem> {
        let wall = |touch: Touch| match touch {
            Touch::OffGround => "off the walkable ground".to_owned(),
            Touch::Edge(_) => "a wall".to_owned(),
            Touch::Inside(o) | Touch::Obstacle(o, _) => obstacle_name(&self.scene.obstacles[o].name, o),
        };
        if let Some(touch) = self.solid.touch(at, 0.0) {
            let message = match touch {
                Touch::OffGround => format!("{what}, {}, is off the walkable ground", show(at)),
                touch => format!("{what}, {}, is inside {}", show(at), wall(touch)),
            };
            return Err(Problem::new(path, Kind::GoalInWall, message).hint("move the goal to where an agent can stand"));
        }
        let needed = radius - tolerance;
        if needed > 0.0
            && let Some(touch @ (Touch::Edge(distance) | Touch::Obstacle(_, distance))) =
                self.solid.touch(at, needed * (1.0 - 1e-6))
        {
            let message = format!(
                "{what}, {}, is {} m from {}: a body of radius {} cannot come within {} m of it",
                show(at),
                short(distance),
                wall(touch),
                short(radius),
                short(tolerance)
            );
            return Err(Problem::new(path, Kind::GoalInWall, message)
                .hint("move the goal away from the wall, or give it a larger tolerance"));
        }
        Ok(())
    }

    /// Checks that a body fits somewhere in a polygon.
    fn check_room(&self, path: &Path, corners: &[DVec2], radius: f64, what: &str) -> Result<(), Problem> {
        if has_room(self.solid, corners, radius * (1.0 - 1e-6)) {
            return Ok(());
        }
        let problem = |message: String| Problem::new(path, Kind::GoalInWall, message);
        Err(if has_room(self.solid, corners, 0.0) {
            let message =
                format!("{what} lies so near the walls that a body of radius {} cannot enter it", short(radius));
            problem(message).hint("it counts as entered when the body's centre is inside: make it reach further in")
        } else {
            problem(format!("{what} lies in a wall or off the walkable ground"))
                .hint("move it, or make it reach onto the ground")
        })
    }
}

impl Walker {
    /// Returns the name of its goal in messages.
    fn goal_name(&self) -> String {
        format!("the goal of agent {}", self.start.k)
    }
}

/// Checks the numbers of a goal that a rule gives. `what` is its name in messages.
fn check_numbers(goal: &throng::Goal, path: &Path, what: &str) -> Result<(), Problem> {
    let refused = |message: String| Err(Problem::new(path, Kind::OutOfRange, format!("{what} {message}")));
    let tolerance = |tolerance: f32| match tolerance > 0.0 && tolerance.is_finite() {
        true => Ok(()),
        false => refused(format!("has a tolerance of {tolerance}, but it must be more than 0")),
    };
    let is_place = |at: &DVec2| at.is_finite() && at.abs().max_element() <= MAX_COORDINATE;
    match goal {
        throng::Goal::Point { at, .. } if !is_place(at) => refused(format!("is at {}, which is no place", show(*at))),
        throng::Goal::Air { at, .. } if !is_place(&at.truncate()) => {
            refused(format!("is at {}, which is no place", show(at.truncate())))
        }
        throng::Goal::Air { at, .. } if !(0.0..=HIGHEST).contains(&at.z) => {
            refused(format!("is {} m above the ground, but must be from 0 to {HIGHEST}", short(at.z)))
        }
        throng::Goal::Point { tolerance: distance, .. } | throng::Goal::Air { tolerance: distance, .. } => {
            tolerance(*distance)
        }
        throng::Goal::Area { corners } | throng::Goal::Exit { corners } => {
            match corners.iter().find(|corner| !is_place(corner)) {
                Some(corner) => refused(format!("has a corner at {}, which is no place", show(*corner))),
                None => check_polygon(path, &corners.iter().map(DVec2::to_array).collect::<Vec<_>>(), what),
            }
        }
    }
}
