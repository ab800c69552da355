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
use super::crowd_ahead::{CrowdAhead, Eye, Met};
use super::walls_ahead::WallsAhead;
use crate::agent::Group;
use crate::avoid::{MARGIN, time_to_disc};
use crate::parallel;
use crate::random::{Purpose, unit};
use fearless_simd::{Level, Simd, dispatch};
use glam::Vec2;
use std::ops::Range;

/// Angles between the way and the directions that are compared, degrees. Only impatience leads an agent back.
const ANGLES: [f32; 7] = [10.0, 20.0, 35.0, 50.0, 70.0, 85.0, 115.0];
/// Directions that are compared: straight on, and these angles to both sides.
const DIRECTIONS: usize = 1 + 2 * ANGLES.len();
/// Seconds that an agent sees ahead, and within which agents that are about to cross its way count.
const SIGHT: f32 = 4.0;
const SIGHT_CROSSING: f32 = 2.0;
/// Metres from the wall of sight beyond which walls are not looked for.
const SIGHT_WALLS: f32 = 2.0;
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

/// What an agent found when it looked ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ahead {
    /// Cosine and sine of the angle by which it turns from its way to the right.
    pub turn: Vec2,
    /// Speed that the gap ahead allows, m/s; as fast as it likes, or infinite, if no agent hinders it.
    pub speed: f32,
}

impl Ahead {
    /// Straight on, as fast as it likes.
    const FREE: Self = Self { turn: Vec2::X, speed: f32::INFINITY };

    /// As fast as it likes, turned to the right by an angle, radians.
    fn turned_by(angle: f32) -> Self {
        if angle == 0.0 {
            return Self::FREE;
        }
        let (sin, cos) = libm::sincosf(angle);
        Self { turn: Vec2::new(cos, sin), ..Self::FREE }
    }

    /// A direction after the turn.
    pub fn turned(&self, direction: Vec2) -> Vec2 {
        let Vec2 { x: cos, y: sin } = self.turn;
        Vec2::new(cos * direction.x + sin * direction.y, cos * direction.y - sin * direction.x)
    }
}

/// What a thread keeps from agent to agent.
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch {
    crowd: CrowdAhead,
    walls: WallsAhead,
}

/// What is the same for all agents in a step.
struct Common {
    /// Whether all bodies are discs, and their radius if all have the same.
    discs: bool,
    radius: Option<f32>,
    /// Whether any agent is above the ground.
    in_space: bool,
    /// The directions that are compared, for an agent that turns from no other.
    directions: [Ahead; DIRECTIONS],
}

/// The room that neighbours leave an agent in a direction.
#[derive(Clone, Copy)]
struct Room {
    /// Seconds until it meets one, if it walks as fast as it likes.
    time: f32,
    /// Speed that the gaps ahead allow.
    speed: f32,
}

/// What an agent looks at, and how.
struct Sight<'a> {
    crowd: &'a mut CrowdAhead,
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
    #[inline(always)]
    fn time<S: Simd>(&self, simd: S, velocity: Vec2) -> f32 {
        self.crowd.time(simd, velocity, self.seconds)
    }

    /// Speed that the gaps ahead allow in a direction, as fast as it likes at most.
    #[inline(always)]
    fn gap_speed<S: Simd>(&self, simd: S, direction: Vec2) -> f32 {
        let speed = self.crowd.gap_speed(simd, direction, (self.time_gap, self.speed), self.streams_meet);
        speed.max(LEAST_SPEED)
    }

    /// The room in a direction.
    #[inline(always)]
    fn room<S: Simd>(&self, simd: S, direction: Vec2) -> Room {
        Room { time: self.time(simd, direction * self.speed), speed: self.gap_speed(simd, direction) }
    }

    /// Whether no neighbour hinders an agent that walks as fast as it likes.
    fn is_free(&self, room: Room) -> bool {
        room.time >= self.seconds && room.speed >= self.speed
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
        let (discs, in_space) = (self.agents.all_discs(), self.agents.anybody_flies());
        let radius = self.agents.radius.uniform().filter(|_| discs);
        let common = Common { discs, radius, in_space, directions: directions(0.0) };
        let level = self.instructions.level().unwrap_or(Level::baseline());
        parallel::ranges_with(&mut ahead[..], &mut scratch, |scratch, rows, ahead| {
            dispatch!(level, simd => world.look_ahead_of_rows(simd, rows, ahead, &common, scratch));
        });
        (self.step.ahead, self.step.looking) = (ahead, scratch);
    }

    #[inline(always)]
    fn look_ahead_of_rows<S: Simd>(
        &self,
        simd: S,
        rows: Range<usize>,
        ahead: &mut [Ahead],
        common: &Common,
        scratch: &mut Scratch,
    ) {
        for (row, ahead) in rows.zip(ahead) {
            *ahead = self.ahead_of(simd, row, common, scratch);
        }
    }

    /// What an agent found.
    #[inline]
    pub(super) fn ahead(&self, row: usize) -> Ahead {
        self.step.ahead.get(row).copied().unwrap_or(Ahead::FREE)
    }

    /// What one agent finds.
    #[inline(always)]
    fn ahead_of<S: Simd>(&self, simd: S, row: usize, common: &Common, scratch: &mut Scratch) -> Ahead {
        let agents = &self.agents;
        let group = &self.groups[agents.group[row].index()];
        let own = &self.step.shown[row];
        let (way, speed) = (&own.way, agents.preferred_speed[row]);
        if !group.look_ahead {
            // one that is blocked for long tries any side
            let blocked = group.keep_right != 0.0 && self.without_progress(row) >= PATIENCE;
            let aside = if blocked { (self.whim(row, 0) - 0.5) * std::f32::consts::PI } else { 0.0 };
            return Ahead::turned_by(group.keep_right + aside);
        }
        if way.direction == Vec2::ZERO || speed <= 0.0 || self.neighbours(row).is_empty() {
            return Ahead::FREE;
        }
        let Scratch { crowd, walls } = scratch;
        walls.forget();
        let at = agents.position[row].as_dvec2();
        let in_space = common.in_space && self.model(row).looks_in_space();
        let gets_on = self.without_progress(row) < GETS_ON;
        self.see_crowd(row, common, in_space, crowd);
        let Group { personal_space, shoulders, .. } = *group;
        crowd.sort(simd, &Eye { way: way.direction, gets_on, personal_space, shoulders });
        let mut hidden = |offset: Vec2| {
            if in_space {
                return false;
            }
            walls.find(&self.walls, at, || self.range_of_walls(row));
            walls.hide(offset)
        };
        // nothing beyond the point where it stops concerns it
        let to_goal = if way.stops() { way.remaining / speed } else { f32::INFINITY };
        let mut oncoming = Oncoming { time: SIGHT.min(to_goal), turn: 0.0, any: false };
        let mut crosses = false;
        for Met { row: other, offset, velocity, radii, space, is_opposite } in crowd.met() {
            let relative = way.direction * speed - velocity;
            if is_opposite {
                if !hidden(offset) {
                    let share = if agents.avoids(other, row) { self.share(row, other, 0.0) } else { 1.0 };
                    oncoming.meet((offset, relative), radii + 2.0 * space, speed, share, group.keep_right);
                }
            } else if !crosses {
                crosses = time_to_disc(offset, relative, radii) < SIGHT_CROSSING && !hidden(offset);
            }
        }
        let streams_meet = oncoming.any || crosses;
        let straight = Ahead::turned_by(oncoming.turn);
        let direction = straight.turned(way.direction);
        if in_space {
            return straight;
        }
        let seconds = SIGHT.min(to_goal);
        let sight = Sight { crowd, speed, time_gap: agents.time_gap[row], seconds, streams_meet };
        // walls are looked at only where an agent would hinder it
        if streams_meet && gets_on {
            let mut gap_speed = sight.gap_speed(simd, direction);
            if gap_speed < speed && sight.crowd.forget(hidden) {
                gap_speed = sight.gap_speed(simd, direction);
            }
            return Ahead { speed: gap_speed, ..straight };
        }
        let mut room = sight.room(simd, direction);
        if !sight.is_free(room) && sight.crowd.forget(hidden) {
            room = sight.room(simd, direction);
        }
        if sight.is_free(room) {
            return straight;
        }
        let queues = room.speed < speed && !oncoming.any;
        self.freest(simd, row, &sight, (way.direction, oncoming.turn, room), queues, (common, walls))
    }

    /// Lets an agent see its neighbours.
    #[inline(always)]
    fn see_crowd(&self, row: usize, common: &Common, in_space: bool, crowd: &mut CrowdAhead) {
        let (agents, shown) = (&self.agents, &self.step.shown);
        let own = &shown[row];
        // a long body turns its narrow side to where it goes; how long it is the local model knows
        let breadth = |row: usize| match common.radius {
            Some(radius) => radius,
            None if common.discs => agents.radius[row],
            None => agents.body(row).girth(),
        };
        let own_breadth = breadth(row);
        crowd.clear();
        for &other in self.neighbours(row) {
            let other = other as usize;
            if in_space && agents.passes_clear(row, other) {
                continue;
            }
            if crowd.is_full() {
                break;
            }
            let their = &shown[other];
            let offset = if common.discs { their.position() - own.position() } else { agents.offset(row, other) };
            // agents on one journey stand close where it ends
            let close = their.way.walks() || agents.journey[row] == agents.journey[other];
            let radii = (own_breadth + breadth(other)) * (1.0 + MARGIN);
            crowd.push(other, (offset, their.velocity()), &their.way, radii, close);
        }
    }

    /// The direction in which an agent gets farthest.
    #[inline(always)]
    fn freest<S: Simd>(
        &self,
        simd: S,
        row: usize,
        sight: &Sight<'_>,
        (way, side, straight): (Vec2, f32, Room),
        queues: bool,
        (common, walls): (&Common, &mut WallsAhead),
    ) -> Ahead {
        let (agents, range) = (&self.agents, sight.speed * sight.seconds);
        let group = &self.groups[agents.group[row].index()];
        let at = agents.position[row].as_dvec2();
        walls.find(&self.walls, at, || self.range_of_walls(row));
        walls.keep(self.clear_of_walls(row));
        let course = agents.velocity[row] / sight.speed;
        let course = course + way * (STEADY * (1.0 - course.length()).max(0.0));
        let patience = (self.without_progress(row) / PATIENCE) % PATIENT_AGAIN;
        let (impatience, restlessness) = (IMPATIENCE * patience.min(1.0), (patience - 1.0).clamp(0.0, 1.0));
        // finite where restlessness is 1: times the sine of no angle it is 0
        let beyond = (restlessness / (1.0 - restlessness * restlessness).sqrt()).min(f32::MAX);
        let mut best = (f32::INFINITY, Ahead::FREE);
        let turned = (side != 0.0).then(|| directions(side));
        for (index, &ahead) in (0..).zip(turned.as_ref().unwrap_or(&common.directions)) {
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
            let time = if index == 0 { straight.time } else { sight.time(simd, velocity) };
            if cost(sight.speed * time) >= best.0 {
                continue;
            }
            let speed = if index == 0 { straight.speed } else { sight.gap_speed(simd, direction) }.min(sight.speed);
            if cost(speed * time) >= best.0 {
                continue;
            }
            let free = sight.speed * walls.time(velocity, speed * time / sight.speed);
            let cost = cost(free);
            if cost < best.0 {
                // beside a queue it walks as far as that helps, and no faster than it comes to rest there
                let useful = if index == 0 || !queues { f32::INFINITY } else { walked(free) / group.relaxation_time };
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

/// The directions that an agent compares if it turns to the right by an angle, radians; the first is straight on.
fn directions(side: f32) -> [Ahead; DIRECTIONS] {
    std::array::from_fn(|index| {
        let angle = match index.checked_sub(1) {
            Some(index) if index % 2 == 0 => ANGLES[index / 2],
            Some(index) => -ANGLES[index / 2],
            None => 0.0,
        };
        Ahead::turned_by(angle.to_radians() + side)
    })
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
