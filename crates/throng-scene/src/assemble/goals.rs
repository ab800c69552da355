//! The goals of the agents: goals shared by a group, goals of single agents, and journeys made of them.

use super::annulus;
use super::ground::{has_room, obstacle_name, short, show};
use super::limits::HIGHEST;
use super::place::Middle;
use super::plan::PlannedJourney;
use super::size::Size;
use crate::error::Kind;
use crate::file::{Path, Problem};
use crate::geometry::{DVec2, DVec3, Solid, Touch, bounds, contains, distance_to_segment, outline_of_region};
use crate::random::{Purpose, Random};
use crate::scene::{Annulus, Goal, Number, Region, Scene, Stop};
use std::collections::HashMap;
use throng::navigate::{Area, NavMesh, PathSearch};

/// A goal of a scene, prepared for its group: shared goals are already goals of the plan.
enum GoalTarget {
    Shared(usize),
    Point(Each),
    Stops(Vec<(GoalTarget, Option<Number>)>, bool),
    /// The goals of the sectors of an annulus, and whether laps run clockwise.
    Lap(Vec<GoalTarget>, Annulus, bool),
    Nearest(Vec<GoalTarget>),
    /// Goals with the running sums of their weights.
    Choice(Vec<(GoalTarget, f64)>),
}

/// A point for each agent.
struct Each {
    path: Path,
    tolerance: f64,
    rule: Rule,
}

enum Rule {
    Listed(Vec<DVec2>),
    Opposite(Middle),
    Shift(DVec3),
}

/// The maximum number of alternative journeys: an agent with more keeps to the goals that were nearest at the start.
const MOST_ALTERNATIVES: usize = 64;

/// The stops of a journey, whether it repeats, and the stops with a choice of goals.
type Known = (Vec<(usize, u32)>, bool, Vec<(usize, Vec<usize>)>);

/// Collects goals and journeys.
pub(super) struct Goals<'a> {
    pub scene: &'a Scene,
    pub solid: &'a Solid,
    pub place: GoalPlace<'a>,
    pub goals: Vec<throng::Goal>,
    pub journeys: Vec<PlannedJourney>,
    /// Indices of journeys that are alternatives to each other.
    pub choices: Vec<Vec<usize>>,
    /// Indices of goals that several agents can share.
    shared: Vec<usize>,
    known: HashMap<Known, usize>,
}

/// The properties of an agent that determine its goals.
struct Walker {
    k: usize,
    start: DVec3,
    radius: f64,
    choice: Random,
    wait: Random,
    /// Stops with a choice of goals, and the indices of these goals.
    among: Vec<(usize, Vec<usize>)>,
}

/// Ground and obstacles, in the form that the world takes.
pub(super) type GoalPlace<'a> = (&'a [throng::Walkable], &'a [throng::Obstacle]);

impl<'a> Goals<'a> {
    pub fn new(scene: &'a Scene, solid: &'a Solid, place: GoalPlace<'a>) -> Self {
        Self {
            scene,
            solid,
            place,
            goals: vec![],
            journeys: vec![],
            choices: vec![],
            shared: vec![],
            known: HashMap::new(),
        }
    }

    /// Returns the journeys of a group's agents (`None`: the agent stays). `middle` is the centre of the group's place.
    pub fn journeys_of(
        &mut self,
        i: usize,
        starts: &[DVec3],
        sizes: &[Size],
        middle: Middle,
    ) -> Result<Vec<Option<usize>>, Problem> {
        let group = &self.scene.groups[i];
        let Some(goal) = &group.goal else { return Ok(vec![None; starts.len()]) };
        let path = Path::of("group").index(i).key("goal");
        let largest = sizes.iter().fold(0.0_f64, |most, size| most.max(size.clearance_radius));
        let target = self.prepare(goal, &path, largest, middle, starts.len())?;
        let mut ways = target.chooses_nearest().then(|| Ways::new(self.place, largest, starts, &self.goals)).flatten();
        let mut out = Vec::with_capacity(starts.len());
        for (k, (start, size)) in starts.iter().zip(sizes).enumerate() {
            let random = |purpose| Random::new(self.scene.seed, i as u64, k as u64, purpose);
            let mut walker = Walker {
                k,
                start: *start,
                radius: size.clearance_radius,
                choice: random(Purpose::Choice),
                wait: random(Purpose::StopWait),
                among: vec![],
            };
            let first = group.wait.map_or(0.0, |wait| random(Purpose::Wait).draw(&wait));
            let mut stops = vec![];
            if first > 0.0 {
                let tolerance = size.clearance_radius.max(0.1) as f32;
                stops.push((self.add(walker.goal(*start, tolerance)), first as f32));
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

    /// Adds a goal that several agents share, unless it exists.
    fn add_shared(&mut self, goal: throng::Goal) -> GoalTarget {
        let known = self.shared.iter().copied().find(|&known| self.goals[known] == goal);
        GoalTarget::Shared(known.unwrap_or_else(|| {
            let added = self.add(goal);
            self.shared.push(added);
            added
        }))
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

    fn prepare(
        &mut self,
        goal: &Goal,
        path: &Path,
        radius: f64,
        middle: Middle,
        n: usize,
    ) -> Result<GoalTarget, Problem> {
        Ok(match goal {
            Goal::Point(point) => {
                let at = DVec2::from_array(point.at);
                self.check_point(&path.key("point"), at, point.tolerance, radius, "the goal")?;
                self.add_shared(throng::Goal::Point { at, tolerance: point.tolerance as f32 })
            }
            Goal::Air(air) => {
                let at = DVec3::from_array(air.at);
                self.check_point(&path.key("air"), at.truncate(), air.tolerance, radius, "the goal")?;
                self.add_shared(throng::Goal::Air { at, tolerance: air.tolerance as f32 })
            }
            Goal::Area(region) => {
                let corners = self.check_region(&path.key("area"), region, radius, "the goal's area")?;
                self.add_shared(throng::Goal::Area { corners })
            }
            Goal::Exit(region) => {
                let corners = self.check_region(&path.key("exit"), region, radius, "the exit")?;
                self.add_shared(throng::Goal::Exit { corners })
            }
            Goal::Points(points) => {
                if points.at.len() != n {
                    let message = format!("goal.points lists {} points for {n} agents", points.at.len());
                    return Err(
                        Problem::new(&path.key("points"), Kind::Conflict, message).hint("give one for each agent")
                    );
                }
                let listed = points.at.iter().map(|p| DVec2::from_array(*p)).collect();
                GoalTarget::Point(Each {
                    path: path.key("points"),
                    tolerance: points.tolerance,
                    rule: Rule::Listed(listed),
                })
            }
            Goal::Opposite(opposite) => GoalTarget::Point(Each {
                path: path.key("opposite"),
                tolerance: opposite.tolerance,
                rule: Rule::Opposite(Middle { at: opposite.center.map_or(middle.at, DVec2::from_array), ..middle }),
            }),
            Goal::Shift(shift) => GoalTarget::Point(Each {
                path: path.key("shift"),
                tolerance: shift.tolerance,
                rule: Rule::Shift(DVec2::from_array(shift.by).extend(shift.rise)),
            }),
            Goal::Journey(stops) => self.prepare_stops(stops, &path.key("journey"), false, radius, middle, n)?,
            Goal::Cycle(stops) => self.prepare_stops(stops, &path.key("cycle"), true, radius, middle, n)?,
            Goal::Lap(lap) => {
                let path = path.key("lap");
                let ring = annulus::of_lap(lap, self.scene, &path)?;
                let mut sector = |corners: Vec<DVec2>| {
                    self.check_room(&path, &corners, radius, "a sector of the ring")?;
                    Ok(self.add_shared(throng::Goal::Area { corners }))
                };
                let sectors: Result<_, Problem> = annulus::sectors(&ring).into_iter().map(&mut sector).collect();
                GoalTarget::Lap(sectors?, ring, lap.clockwise)
            }
            Goal::Nearest(goals) => {
                let path = path.key("nearest");
                let each = |(i, goal)| self.prepare(goal, &path.index(i), radius, middle, n);
                GoalTarget::Nearest(goals.iter().enumerate().map(each).collect::<Result<_, _>>()?)
            }
            Goal::Choice(goals) => {
                let path = path.key("choice");
                let mut sum = 0.0;
                let mut targets = vec![];
                for (i, weighted) in goals.iter().enumerate() {
                    sum += weighted.weight;
                    targets.push((self.prepare(&weighted.goal, &path.index(i).key("goal"), radius, middle, n)?, sum));
                }
                GoalTarget::Choice(targets)
            }
        })
    }

    fn prepare_stops(
        &mut self,
        stops: &[Stop],
        path: &Path,
        repeat: bool,
        radius: f64,
        middle: Middle,
        n: usize,
    ) -> Result<GoalTarget, Problem> {
        let one = |(i, stop): (usize, &Stop)| {
            Ok((self.prepare(&stop.goal, &path.index(i).key("goal"), radius, middle, n)?, stop.wait))
        };
        Ok(GoalTarget::Stops(stops.iter().enumerate().map(one).collect::<Result<_, Problem>>()?, repeat))
    }

    /// Adds the stops of one agent. Returns whether they repeat.
    fn resolve(
        &mut self,
        target: &GoalTarget,
        walker: &mut Walker,
        ways: &mut Option<Ways>,
        wait: f32,
        stops: &mut Vec<(usize, f32)>,
    ) -> Result<bool, Problem> {
        match target {
            GoalTarget::Shared(goal) => stops.push((*goal, wait)),
            GoalTarget::Point(each) => {
                let at = each.at(walker);
                let what = format!("the goal of agent {}", walker.k);
                self.check_point(&each.path, at.truncate(), each.tolerance, walker.radius, &what)?;
                if !(0.0..=HIGHEST).contains(&at.z) {
                    let message =
                        format!("{what} is {} m above the ground, but must be from 0 to {HIGHEST}", short(at.z));
                    return Err(Problem::new(&each.path, Kind::OutOfRange, message));
                }
                stops.push((self.add(walker.goal(at, each.tolerance as f32)), wait));
            }
            GoalTarget::Stops(list, repeat) => {
                for (target, wait) in list {
                    let wait = wait.map_or(0.0, |wait| walker.wait.draw(&wait)) as f32;
                    self.resolve(target, walker, ways, wait, stops)?;
                }
                return Ok(*repeat);
            }
            GoalTarget::Lap(sectors, ring, clockwise) => {
                for sector in annulus::order(ring, *clockwise, walker.start.truncate()) {
                    self.resolve(&sectors[sector], walker, ways, 0.0, stops)?;
                }
                return Ok(true);
            }
            GoalTarget::Nearest(targets) => {
                // if no goal can be reached on foot, the straight distance decides
                let mut least = (f64::INFINITY, f64::INFINITY);
                let mut nearest = targets.first();
                for target in targets {
                    let straight = self.distance(target, walker, &mut None);
                    let far = (self.distance(target, walker, ways), straight);
                    if far < least {
                        (least, nearest) = (far, Some(target));
                    }
                }
                let shared = targets.iter().map(|target| match target {
                    GoalTarget::Shared(goal) => Some(*goal),
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
            GoalTarget::Choice(targets) => {
                let drawn = walker.choice.unit() * targets.last().map_or(0.0, |(_, sum)| *sum);
                if let Some((target, _)) = targets.iter().find(|(_, sum)| drawn < *sum).or(targets.last()) {
                    return self.resolve(target, walker, ways, wait, stops);
                }
            }
        }
        Ok(false)
    }

    /// Returns the distance from an agent's start to a target, on the ground: along `ways` around walls, or straight.
    fn distance(&self, target: &GoalTarget, walker: &Walker, ways: &mut Option<Ways>) -> f64 {
        let start = walker.start.truncate();
        match target {
            GoalTarget::Shared(goal) => match (self.goals[*goal].corners(), ways) {
                (None, Some(ways)) => ways.length_to_point(start, self.goals[*goal].middle()),
                (None, None) => self.goals[*goal].middle().distance(start),
                (Some(corners), ways) => {
                    if contains(corners, start) {
                        return 0.0;
                    }
                    if let Some(ways) = ways {
                        return ways.length_to_area(start, *goal, corners);
                    }
                    let ends = corners.iter().zip(corners.iter().cycle().skip(1));
                    ends.fold(f64::INFINITY, |least, (a, b)| least.min(distance_to_segment(start, *a, *b)))
                }
            },
            GoalTarget::Point(each) => match ways {
                Some(ways) => ways.length_to_point(start, each.at(walker).truncate()),
                None => each.at(walker).truncate().distance(start),
            },
            GoalTarget::Stops(list, _) => {
                list.first().map_or(f64::INFINITY, |(first, _)| self.distance(first, walker, ways))
            }
            GoalTarget::Lap(sectors, ring, clockwise) => {
                let first = annulus::order(ring, *clockwise, start).next();
                first.map_or(f64::INFINITY, |first| self.distance(&sectors[first], walker, ways))
            }
            GoalTarget::Nearest(targets) => {
                targets.iter().map(|target| self.distance(target, walker, ways)).fold(f64::INFINITY, f64::min)
            }
            GoalTarget::Choice(targets) => {
                targets.iter().map(|(target, _)| self.distance(target, walker, ways)).fold(f64::INFINITY, f64::min)
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

    /// Checks that a body fits somewhere in a region. Returns the corners of the region.
    fn check_region(&self, path: &Path, region: &Region, radius: f64, what: &str) -> Result<Vec<DVec2>, Problem> {
        let corners = outline_of_region(region);
        self.check_room(path, &corners, radius, what)?;
        Ok(corners)
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

impl GoalTarget {
    /// Whether agents choose the nearest of several goals somewhere in it.
    fn chooses_nearest(&self) -> bool {
        match self {
            Self::Shared(_) | Self::Point(_) | Self::Lap(..) => false,
            Self::Stops(list, _) => list.iter().any(|(target, _)| target.chooses_nearest()),
            Self::Nearest(_) => true,
            Self::Choice(list) => list.iter().any(|(target, _)| target.chooses_nearest()),
        }
    }
}

/// Shortest paths of bodies of one size.
struct Ways {
    mesh: NavMesh,
    search: PathSearch,
    /// The areas of goals on the mesh, by the indices of the goals.
    areas: HashMap<usize, Option<Area>>,
}

impl Ways {
    /// Returns `None` if nothing is in the way, or if no ground is left to walk on.
    fn new((walkable, obstacles): GoalPlace, radius: f64, starts: &[DVec3], goals: &[throng::Goal]) -> Option<Self> {
        if walkable.is_empty() && obstacles.is_empty() {
            return None;
        }
        let [low, high] =
            bounds(starts.iter().map(|start| start.truncate()).chain(goals.iter().map(throng::Goal::middle)))?;
        // as the world does: a millimetre wider than the body
        let mesh = NavMesh::build(walkable, obstacles, radius + 0.001, (low, high)).ok()?;
        Some(Self { mesh, search: PathSearch::new(), areas: HashMap::new() })
    }

    fn length_to_point(&mut self, from: DVec2, to: DVec2) -> f64 {
        self.mesh.path(&mut self.search, from, to).map_or(f64::INFINITY, |path| path.length)
    }

    fn length_to_area(&mut self, from: DVec2, goal: usize, corners: &[DVec2]) -> f64 {
        let Self { mesh, search, areas } = self;
        let area = areas.entry(goal).or_insert_with(|| mesh.area(corners).ok());
        let path = area.as_ref().and_then(|area| mesh.path_to(search, from, area).ok());
        path.map_or(f64::INFINITY, |path| path.length)
    }
}

impl Walker {
    /// Returns a goal of this agent alone: in the air if the point or the agent's start is in the air.
    fn goal(&self, at: DVec3, tolerance: f32) -> throng::Goal {
        if self.start.z == 0.0 && at.z == 0.0 {
            throng::Goal::Point { at: at.truncate(), tolerance }
        } else {
            throng::Goal::Air { at, tolerance }
        }
    }
}

impl Each {
    /// Returns the agent's goal, at its own altitude if the rule defines none.
    fn at(&self, walker: &Walker) -> DVec3 {
        match &self.rule {
            Rule::Listed(points) => points[walker.k].extend(walker.start.z),
            Rule::Opposite(Middle { at, altitude }) => {
                2.0 * at.extend(altitude.unwrap_or(walker.start.z)) - walker.start
            }
            Rule::Shift(by) => walker.start + *by,
        }
    }
}
