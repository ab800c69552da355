//! Looking ahead: in which direction there is room, and how fast an agent can walk there.
//!
//! After the vision heuristics of Moussaïd, Helbing, Theraulaz, How simple rules determine pedestrian behavior and crowd
//! disasters, PNAS 108:6884 (2011), with the speed of Seyfried, Steffen, Klingsch, Boltes, The fundamental diagram of
//! pedestrian movement revisited (2005):
//!
//! 1. *Speed.* An agent walks no faster than the gap to the agent ahead, divided by its time gap.
//! 2. *Direction.* It compares directions round its way. In each it walks, at the speed that the gaps allow there, until it
//!    meets a neighbour that keeps its velocity, or a wall. It takes the direction that brings it nearest to a point straight
//!    ahead at the end of its sight.
//! 3. *Side.* It turns a little from agents that come the other way, to the side on which they pass, to the right if that is
//!    undecided.
//!
//! Only agents that stand or go the same way count for the direction, unless the agent does not get on: then all do. An agent
//! compares no directions while others come the other way, or are about to cross its way, as long as it gets on: so lanes form,
//! and each keeps to its own. Agents with a model in space never compare directions. Agents that a wall hides do not count.

use super::World;
use super::avoid::is_between;
use super::way::SAME_WAY;
use crate::agent::Group;
use crate::avoid::{MARGIN, time_to_disc, time_to_segment};
use crate::parallel;
use crate::random::{Purpose, unit};
use crate::space::{Met, Wall, Walls};
use glam::{DVec2, Vec2};

/// Angles between the way and the directions that are compared, degrees. Only impatience leads an agent back.
const ANGLES: [f32; 7] = [10.0, 20.0, 35.0, 50.0, 70.0, 85.0, 115.0];
/// Seconds that an agent sees ahead, and within which agents that are about to cross its way count.
const SIGHT: f32 = 4.0;
const SIGHT_CROSSING: f32 = 2.0;
/// Metres from the wall of sight beyond which walls are not looked for.
const SIGHT_WALLS: f32 = 2.0;
/// Metres by which an agent may come nearer to a wall than it is, where it has less room than it likes.
const NEARER: f32 = 0.01;
/// Gap at which all of the personal space is kept, metres: the nearer two agents are, the less of it they claim.
const ROOMY: f32 = 1.5;
/// Exponent of the part of the shoulders that do not overlap, among streams that meet: it is 2 elsewhere.
const STEPS_ASIDE: f32 = 0.55;
/// Speed that a gap never takes, m/s: without it the last agents of an arch before a door wait for each other.
const LEAST_SPEED: f32 = 0.05;
/// Cost of a direction at a right angle to the present one, in lengths of sight: an agent keeps to the side on which it
/// began to pass.
const TURNING: f32 = 0.3;
/// Part of its way that counts as its present direction, for an agent that stands: a crowd that waits does not dance.
const STEADY: f32 = 0.25;
/// Greatest cost, in lengths of sight, that an agent adds at random to directions when it does not get on, and the seconds
/// without progress after which it does: an agent tries other directions when its way is blocked. After twice as many seconds it
/// walks in any direction rather than stand. So a crowd of agents that block each other dissolves from its rim. After so many
/// times as many seconds it is patient again, and tries its way anew.
const IMPATIENCE: f32 = 0.5;
const PATIENCE: f32 = 5.0;
const PATIENT_AGAIN: f32 = 6.0;
/// Seconds that it keeps them.
const WHIM: f64 = 1.0;
/// Seconds without progress up to which an agent keeps to its lane while streams meet; then all agents count for the direction.
const GETS_ON: f32 = 2.0;
/// Metres to the side within which it is undecided on which side an agent that comes the other way passes.
const UNDECIDED: f32 = 0.3;
/// Least time in which an agent makes room for one that comes the other way, seconds.
const SOONEST: f32 = 0.1;
/// Speed below which an agent stands, m/s: it is in the way, wherever it wants to go.
const STANDS: f32 = 0.1;
/// Neighbours that an agent takes into account, at most.
const MOST: usize = 16;

/// What an agent found when it looked ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ahead {
    /// Cosine and sine of the angle by which it turns from its way to the right.
    pub turn: Vec2,
    /// Speed that the gap ahead allows, m/s; infinite if there is no agent ahead.
    pub speed: f32,
}

impl Ahead {
    /// Straight on, as fast as it likes.
    const FREE: Self = Self { turn: Vec2::X, speed: f32::INFINITY };

    /// As fast as it likes, turned to the right by an angle, radians.
    fn turned_by(angle: f32) -> Self {
        let (sin, cos) = libm::sincosf(angle);
        Self { turn: Vec2::new(cos, sin), ..Self::FREE }
    }

    /// A direction after the turn.
    pub fn turned(&self, direction: Vec2) -> Vec2 {
        let Vec2 { x: cos, y: sin } = self.turn;
        Vec2::new(cos * direction.x + sin * direction.y, cos * direction.y - sin * direction.x)
    }
}

/// A neighbour that counts for the direction.
#[derive(Clone, Copy, Debug, Default)]
struct Seen {
    offset: Vec2,
    velocity: Vec2,
    /// Sum of the radii, with the margin of the local models.
    radii: f32,
    /// The same, with the personal space that it keeps from one that stays where it is.
    wanted: f32,
    /// Distance across the way of an agent within which it is ahead: the breadth of shoulders.
    breadth: f32,
    /// Where it wants to go; zero if it stands.
    direction: Vec2,
}

impl Seen {
    /// Speed that the gap to it allows an agent that walks in `direction`. The time gap counts as far as the shoulders of the
    /// two overlap across the direction: nearly whole until they hardly do; among streams that meet, only where they nearly
    /// do whole, for there agents step aside all the time.
    fn speed(&self, direction: Vec2, time_gap: f32, streams_meet: bool) -> f32 {
        let along = self.offset.dot(direction);
        let aside = self.offset.perp_dot(direction).abs();
        if self.direction.dot(direction) < SAME_WAY || along <= 0.0 || aside >= self.breadth {
            return f32::INFINITY;
        }
        let gap = along - (self.radii * self.radii - aside * aside).max(0.0).sqrt();
        let part = aside / self.breadth;
        let overlap = 1.0 - if streams_meet { libm::powf(part, STEPS_ASIDE) } else { part * part };
        gap.max(0.0) / (time_gap * overlap)
    }
}

/// The walls near an agent: what a thread keeps from agent to agent.
#[derive(Clone, Debug, Default)]
pub(super) struct WallsAhead {
    met: Met,
    /// Whether the walls near the present agent were found, and the distance of the nearest from its centre.
    found: bool,
    nearest: f32,
    /// Distances of the edges, and their ends, from the agent's centre.
    edges: Vec<(f32, Vec2, Vec2)>,
    /// Centres of the discs, from the agent's centre, and their radii.
    discs: Vec<(Vec2, f32)>,
    /// Distance that the agent's centre keeps from them, metres.
    clearance: f32,
}

impl WallsAhead {
    /// Finds the walls within `range` of `at`, unless they were found since the last `forget`.
    fn find(&mut self, walls: &Walls, at: DVec2, range: f32) {
        let Self { met, found, nearest, edges, discs, .. } = self;
        if std::mem::replace(found, true) {
            return;
        }
        *nearest = range;
        edges.clear();
        discs.clear();
        walls.visit_once(at, f64::from(range), met, |wall| match wall {
            Wall::Edge(edge) => {
                let start = (edge.start - at).as_vec2();
                // seen from behind, it is hidden by what is solid
                if edge.direction.perp_dot(start) < 0.0 {
                    return;
                }
                let distance = edge.nearest(at).distance(at) as f32;
                if distance <= range {
                    *nearest = nearest.min(distance);
                    edges.push((distance, start, (edge.end - at).as_vec2()));
                }
            }
            Wall::Disc(disc) => {
                let (center, radius) = ((disc.center - at).as_vec2(), disc.radius as f32);
                let distance = center.length() - radius;
                if distance <= range {
                    *nearest = nearest.min(distance);
                    discs.push((center, radius));
                }
            }
        });
    }

    /// Forgets the walls near the last agent.
    fn forget(&mut self) {
        self.found = false;
    }

    /// Keeps the agent's centre this far from walls, as far as it is now.
    fn keep(&mut self, clearance: f32) {
        self.clearance = clearance.min(self.nearest - NEARER).max(0.0);
    }

    /// Whether an edge lies between the agent and what is at `offset`.
    fn hide(&self, offset: Vec2) -> bool {
        let reach = offset.length();
        self.edges.iter().any(|&(distance, start, end)| distance < reach && is_between(start, end, offset))
    }

    /// Seconds until an agent with this velocity meets a wall, `most` at most.
    fn time(&self, velocity: Vec2, most: f32) -> f32 {
        let (clearance, speed) = (self.clearance, velocity.length());
        let discs = self.discs.iter().map(|&(center, radius)| time_to_disc(center, velocity, radius + clearance));
        let mut time = discs.fold(most, f32::min);
        for &(distance, start, end) in &self.edges {
            if distance - clearance < speed * time {
                time = time.min(time_to_segment(start, end, velocity, clearance));
            }
        }
        time
    }
}

/// What an agent looks at, and how.
struct Sight<'a> {
    seen: &'a [Seen],
    /// Preferred speed.
    speed: f32,
    time_gap: f32,
    /// Seconds that it sees ahead.
    seconds: f32,
    /// Whether agents come the other way, or are about to cross its way.
    streams_meet: bool,
}

impl Sight<'_> {
    /// Seconds until an agent with this velocity meets a neighbour, as far as it sees.
    fn time(&self, velocity: Vec2) -> f32 {
        let times = self.seen.iter().map(|n| time_to_disc(n.offset, velocity - n.velocity, n.wanted));
        times.fold(self.seconds, f32::min)
    }

    /// Whether no neighbour hinders an agent that walks this way as fast as it likes.
    fn is_free(&self, direction: Vec2) -> bool {
        self.time(direction * self.speed) >= self.seconds && self.gap_speed(direction) >= self.speed
    }

    /// Speed that the gaps ahead allow in a direction.
    fn gap_speed(&self, direction: Vec2) -> f32 {
        let speeds = self.seen.iter().map(|n| n.speed(direction, self.time_gap, self.streams_meet));
        speeds.fold(f32::INFINITY, f32::min).max(LEAST_SPEED)
    }
}

impl World {
    /// Lets all agents look ahead. They do so once a step.
    pub(super) fn look_ahead(&mut self) {
        let looks = self.groups_in_use().any(|group| group.look_ahead || group.keep_right != 0.0);
        let mut ahead = std::mem::take(&mut self.step.ahead);
        let mut scratch = std::mem::take(&mut self.step.looking);
        ahead.resize(if looks { self.agents.len() } else { 0 }, Ahead::FREE);
        let world = &*self;
        parallel::ranges_with(&mut ahead[..], &mut scratch, |walls, rows, ahead| {
            rows.zip(ahead).for_each(|(row, ahead)| *ahead = world.ahead_of(row, walls));
        });
        (self.step.ahead, self.step.looking) = (ahead, scratch);
    }

    /// What an agent found.
    #[inline]
    pub(super) fn ahead(&self, row: usize) -> Ahead {
        self.step.ahead.get(row).copied().unwrap_or(Ahead::FREE)
    }

    fn ahead_of(&self, row: usize, walls: &mut WallsAhead) -> Ahead {
        let agents = &self.agents;
        let group = &self.groups[agents.group[row].index()];
        let (way, speed) = (&self.step.shown[row].way, agents.preferred_speed[row]);
        if !group.look_ahead {
            // one that is blocked for long tries any side
            let blocked = group.keep_right != 0.0 && self.without_progress(row) >= PATIENCE;
            let aside = if blocked { (self.whim(row, 0) - 0.5) * std::f32::consts::PI } else { 0.0 };
            return Ahead::turned_by(group.keep_right + aside);
        }
        if way.direction == Vec2::ZERO || speed <= 0.0 || self.neighbours(row).is_empty() {
            return Ahead::FREE;
        }
        walls.forget();
        let at = agents.position[row].as_dvec2();
        let in_space = agents.anybody_flies() && self.model(row).looks_in_space();
        let mut hidden = |offset: Vec2| {
            if in_space {
                return false;
            }
            walls.find(&self.walls, at, self.range_of_walls(row));
            walls.hide(offset)
        };
        // nothing beyond the point where it stops concerns it
        let to_goal = if way.stops() { way.remaining / speed } else { f32::INFINITY };
        let (mut seen, mut count) = ([Seen::default(); MOST], 0);
        let gets_on = self.without_progress(row) < GETS_ON;
        let mut oncoming = Oncoming { time: SIGHT.min(to_goal), turn: 0.0, any: false };
        let mut crosses = false;
        // a long body turns its narrow side to where it goes; how long it is the local model knows
        let discs = agents.all_discs();
        let breadth = |row: usize| if discs { agents.radius[row] } else { agents.body(row).girth() };
        let level = |other: &usize| !in_space || !agents.passes_clear(row, *other);
        for other in self.neighbours(row).iter().map(|&other| other as usize).filter(level).take(MOST) {
            let their = &self.step.shown[other].way;
            let offset = agents.offset(row, other);
            let radii = (breadth(row) + breadth(other)) * (1.0 + MARGIN);
            // the nearer, the less of it they claim
            let space = || group.personal_space * ((offset.length() - radii).max(0.0) / ROOMY).min(1.0);
            let velocity = agents.velocity[other];
            let goes_along = !their.walks()
                || their.direction.dot(way.direction) > SAME_WAY
                || velocity.length_squared() < STANDS * STANDS;
            let is_ahead = offset.dot(way.direction) > 0.0;
            if goes_along || (is_ahead && !gets_on) {
                // agents on one journey stand close where it ends
                let close = their.walks() || agents.journey[row] == agents.journey[other];
                let wanted = if close { radii } else { radii + space() };
                let breadth = if goes_along { radii.max(group.shoulders) } else { radii };
                seen[count] = Seen { offset, velocity, radii, wanted, breadth, direction: their.direction };
                count += 1;
            }
            if is_ahead && !goes_along {
                let relative = way.direction * speed - velocity;
                if their.is_opposite(way) {
                    if !hidden(offset) {
                        let share = if agents.avoids(other, row) { self.share(row, other, 0.0) } else { 1.0 };
                        oncoming.meet((offset, relative), radii + 2.0 * space(), speed, share, group.keep_right);
                    }
                } else if !crosses {
                    crosses = time_to_disc(offset, relative, radii) < SIGHT_CROSSING && !hidden(offset);
                }
            }
        }
        let streams_meet = oncoming.any || crosses;
        let straight = Ahead::turned_by(oncoming.turn);
        let direction = straight.turned(way.direction);
        let seconds = SIGHT.min(to_goal);
        let sight = Sight { seen: &seen[..count], speed, time_gap: agents.time_gap[row], seconds, streams_meet };
        if in_space || sight.is_free(direction) {
            return straight;
        }
        // walls are looked at only where an agent would hinder it
        let (mut clear, mut kept) = ([Seen::default(); MOST], 0);
        for one in seen[..count].iter().filter(|one| !hidden(one.offset)) {
            clear[kept] = *one;
            kept += 1;
        }
        let sight = Sight { seen: &clear[..kept], ..sight };
        if kept < count && sight.is_free(direction) {
            return straight;
        }
        let gap_speed = sight.gap_speed(direction);
        if streams_meet && gets_on {
            return Ahead { speed: gap_speed, ..straight };
        }
        self.freest(row, &sight, (way.direction, oncoming.turn), gap_speed < speed && !oncoming.any, walls)
    }

    /// The direction in which an agent gets farthest.
    fn freest(
        &self,
        row: usize,
        sight: &Sight<'_>,
        (way, side): (Vec2, f32),
        queues: bool,
        walls: &mut WallsAhead,
    ) -> Ahead {
        let (agents, range) = (&self.agents, sight.speed * sight.seconds);
        let group = &self.groups[agents.group[row].index()];
        let at = agents.position[row].as_dvec2();
        walls.find(&self.walls, at, self.range_of_walls(row));
        walls.keep(self.clear_of_walls(row));
        let course = agents.velocity[row] / sight.speed;
        let course = course + way * (STEADY * (1.0 - course.length()).max(0.0));
        let patience = (self.without_progress(row) / PATIENCE) % PATIENT_AGAIN;
        let (impatience, restlessness) = (IMPATIENCE * patience.min(1.0), (patience - 1.0).clamp(0.0, 1.0));
        // finite where restlessness is 1: times the sine of no angle it is 0
        let beyond = (restlessness / (1.0 - restlessness * restlessness).sqrt()).min(f32::MAX);
        let mut best = (f32::INFINITY, Ahead::FREE);
        let sides = ANGLES.iter().flat_map(|&angle| [angle, -angle]);
        for (index, angle) in (0..).zip([0.0].into_iter().chain(sides)) {
            let ahead = Ahead::turned_by(angle.to_radians() + side);
            let Vec2 { x: cos, y: sin } = ahead.turn;
            let direction = ahead.turned(way);
            let turning = course.length() - course.dot(direction);
            let whim = if impatience > 0.0 { impatience * self.whim(row, index) } else { 0.0 };
            let added = range * (TURNING * turning + whim);
            // it walks until the cost would rise: without restlessness, to where it is nearest to the point straight ahead
            let most = range * (cos + beyond * sin.abs()).clamp(0.0, 1.0);
            let walked = |free: f32| free.min(most);
            let cost = |free: f32| {
                let walked = walked(free);
                let left = (range * range + walked * walked - 2.0 * range * walked * cos).max(0.0).sqrt();
                added + left - restlessness * walked
            };
            // each test is dearer than the one before
            if cost(range) >= best.0 {
                continue;
            }
            let velocity = direction * sight.speed;
            let time = sight.time(velocity);
            if cost(sight.speed * time) >= best.0 {
                continue;
            }
            let speed = sight.gap_speed(direction).min(sight.speed);
            if cost(speed * time) >= best.0 {
                continue;
            }
            let free = sight.speed * walls.time(velocity, speed * time / sight.speed);
            let cost = cost(free);
            if cost < best.0 {
                // beside a queue it walks as far as that helps, and no faster than it comes to rest there
                let useful = if angle == 0.0 || !queues { f32::INFINITY } else { walked(free) / group.relaxation_time };
                best = (cost, Ahead { speed: speed.min(useful.max(LEAST_SPEED)), ..ahead });
            }
        }
        best.1
    }

    /// How far an agent that looks ahead sees walls, metres from its centre.
    fn range_of_walls(&self, row: usize) -> f32 {
        SIGHT_WALLS + self.clear_of_walls(row)
    }

    /// Distance of its centre from walls that an agent keeps where it has the room: half of its shoulders, or of its body.
    fn clear_of_walls(&self, row: usize) -> f32 {
        self.agents.body(row).girth().max(0.5 * self.groups[self.agents.group[row].index()].shoulders)
    }

    /// A number in [0, 1) for one of the directions that an agent compares, which it keeps for a while.
    fn whim(&self, row: usize, direction: u64) -> f32 {
        let while_kept = (self.time() / WHIM) as u64;
        unit(self.settings.seed, self.agents.number[row], while_kept << 8 | direction, Purpose::Whim)
    }

    /// A direction in the plane, which an agent keeps for a while.
    pub(super) fn any_side(&self, row: usize) -> Vec2 {
        let (sin, cos) = libm::sincosf(std::f32::consts::TAU * self.whim(row, u64::from(u8::MAX)));
        Vec2::new(cos, sin)
    }
}

/// The agent that comes the other way and is met first.
struct Oncoming {
    /// Seconds until the two are nearest to each other.
    time: f32,
    /// Angle that makes room for it, radians to the right.
    turn: f32,
    /// Whether any agent ahead comes the other way.
    any: bool,
}

impl Oncoming {
    /// Takes an agent into account: where it is and the relative velocity, and the distance to keep. The agent makes its
    /// share of the room, and turns by `most` at most.
    fn meet(&mut self, (offset, relative): (Vec2, Vec2), wanted: f32, speed: f32, share: f32, most: f32) {
        self.any = true;
        let closing = relative.length_squared().max(1e-6);
        let time = offset.dot(relative) / closing;
        // positive: it passes on the left
        let miss = relative.perp_dot(offset) / closing.sqrt();
        if (0.0..self.time).contains(&time) && miss.abs() < wanted {
            let side = if miss.abs() < UNDECIDED { most.signum() } else { miss.signum() };
            let aside = share * (wanted - miss * side) / time.max(SOONEST);
            (self.time, self.turn) = (time, side * (aside / speed).min(most.abs()));
        }
    }
}

impl Group {
    /// Whether the parameters of looking ahead are within their limits.
    pub(crate) fn check_look_ahead(&self) -> Result<(), crate::Error> {
        let (shoulders, space, relaxation) = (self.shoulders, self.personal_space, self.relaxation_time);
        crate::Error::unless((0.0..=10.0).contains(&relaxation), "relaxation time", relaxation, "from 0 to 10 s")?;
        crate::Error::unless((0.0..=10.0).contains(&shoulders), "shoulders", shoulders, "from 0 to 10 m")?;
        crate::Error::unless((0.0..=10.0).contains(&space), "personal space", space, "from 0 to 10 m")
    }
}
