//! Looking ahead: the direction in which there is free space, and the speed at which an agent can walk there.
//!
//! After the vision heuristics of Moussaïd, Helbing, Theraulaz, How simple rules determine pedestrian behavior and
//! crowd disasters, PNAS 108:6884 (2011), with the speed of Seyfried, Steffen, Klingsch, Boltes, The fundamental
//! diagram of pedestrian movement revisited (2005):
//!
//! 1. *Speed.* An agent walks no faster than the gap to the agent ahead, divided by its time gap.
//! 2. *Direction.* An agent compares directions around the direction of its path. In each direction it would walk, at
//!    the speed that the gaps permit, until it meets a wall, or a neighbour that keeps its velocity. The agent takes
//!    the direction that brings it nearest to a point straight ahead at the limit of its sight.
//! 3. *Side.* An agent turns slightly from agents that come the opposite way, to the side on which they pass, and to
//!    the right if the side is undecided.
//!
//! Only agents that stand or go the same way count for the choice of direction, unless the agent makes no progress:
//! then all agents count. An agent that makes progress compares no directions while other agents come the opposite way
//! or are about to cross its path: so lanes form, and each agent keeps to its lane. Agents with a 3D local model never
//! compare directions. Agents hidden by a wall do not count.

use super::crowd_ahead::{CrowdAhead, MetNeighbour, Viewpoint};
use super::walls_ahead::WallsAhead;
use crate::agent::MARGIN;
use crate::agent::{Cycles, Group};
use crate::navigate::Surroundings;
use crate::parallel;
use crate::random::{Purpose, unit};
use crate::space::time_to_disc;
use crate::world::State;
use fearless_simd::{Level, Simd, dispatch};
use glam::Vec2;
use std::ops::Range;

/// Angles between the path and the directions that are compared, degrees. An agent turns back only when it is
/// impatient.
const ANGLES: [f32; 7] = [10.0, 20.0, 35.0, 50.0, 70.0, 85.0, 115.0];
/// Number of directions that are compared: straight ahead, and these angles to both sides.
const DIRECTIONS: usize = 1 + 2 * ANGLES.len();
/// Seconds that an agent looks ahead, and within which agents that are about to cross its path count.
const SIGHT: f32 = 4.0;
const SIGHT_CROSSING: f32 = 2.0;
/// Distance beyond the clearance of walls at which walls are no longer considered, metres.
const SIGHT_WALLS: f32 = 2.0;
/// Least speed that a gap permits, m/s. Without it the last agents of an arch before a door wait for each other.
const LEAST_SPEED: f32 = 0.05;
/// Cost of a direction at a right angle to the present direction of motion, in lengths of sight. It keeps an agent on
/// the side on which it began to pass.
const TURNING: f32 = 0.3;
/// Part of the path direction in the present direction of motion of a standing agent. It keeps a waiting crowd still.
const STEADY: f32 = 0.25;
/// An agent without progress adds random costs to directions, so it tries other directions when its path is blocked.
/// `IMPATIENCE` is the greatest cost, in lengths of sight; it is reached after `PATIENCE` seconds without progress.
/// After twice that time the agent walks in any direction rather than stand, so a crowd of agents that block each other
/// dissolves from its rim. After `PATIENT_AGAIN` times that time the agent is patient again and tries its path anew.
const IMPATIENCE: f32 = 0.5;
const PATIENCE: f32 = 5.0;
const PATIENT_AGAIN: f32 = 6.0;
/// Seconds for which an agent keeps its random costs.
const WHIM: f64 = 1.0;
/// Seconds without progress up to which an agent keeps to its lane while streams meet. Afterwards all agents count for
/// the choice of direction.
const GETS_ON: f32 = 2.0;
/// Lateral distance, metres, within which the passing side of an agent that comes the opposite way is undecided.
const UNDECIDED: f32 = 0.3;
/// Least time in which an agent makes room for an agent that comes the opposite way, seconds.
const SOONEST: f32 = 0.1;

/// The result of an agent's look ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LookAhead {
    /// Cosine and sine of the angle by which it turns to the right of its path.
    pub turn: Vec2,
    /// Speed that the gap ahead permits, m/s. If no agent hinders it: its preferred speed or more.
    pub speed: f32,
}

impl LookAhead {
    /// Straight ahead at the preferred speed.
    const FREE: Self = Self { turn: Vec2::X, speed: f32::INFINITY };

    /// Returns a turn to the right by an angle, radians, at the preferred speed.
    fn turned_by(angle: f32) -> Self {
        if angle == 0.0 {
            return Self::FREE;
        }
        let (sin, cos) = libm::sincosf(angle);
        Self { turn: Vec2::new(cos, sin), ..Self::FREE }
    }

    /// Returns a direction after the turn.
    pub fn turned(&self, direction: Vec2) -> Vec2 {
        let Vec2 { x: cos, y: sin } = self.turn;
        Vec2::new(cos * direction.x + sin * direction.y, cos * direction.y - sin * direction.x)
    }
}

/// Scratch memory of a thread.
#[derive(Clone, Debug, Default)]
pub(crate) struct LookAheadScratch {
    crowd: CrowdAhead,
    walls: WallsAhead,
}

/// What is the same for all agents in a step.
struct LookAheadShared {
    /// Whether all bodies are discs, and their radius if all have the same.
    discs: bool,
    radius: Option<f32>,
    /// Whether any agent is above the ground.
    in_space: bool,
    /// The directions to compare, for an agent that turns from no oncoming agent.
    directions: [LookAhead; DIRECTIONS],
}

/// The free space that neighbours leave an agent in a direction.
#[derive(Clone, Copy)]
struct FreeDistance {
    /// Seconds until it meets a neighbour at its preferred speed.
    time: f32,
    /// Speed that the gaps ahead permit.
    speed: f32,
}

/// The neighbours that an agent looks at, and the parameters of looking.
struct LookAheadInput<'a> {
    crowd: &'a mut CrowdAhead,
    /// Preferred speed.
    speed: f32,
    time_gap: f32,
    /// Seconds that it looks ahead.
    seconds: f32,
    /// Whether agents come the opposite way or are about to cross its path.
    streams_meet: bool,
}

impl LookAheadInput<'_> {
    /// Returns the seconds until an agent with this velocity meets a neighbour, at most `seconds`.
    #[inline(always)]
    fn time<S: Simd>(&self, simd: S, velocity: Vec2) -> f32 {
        self.crowd.time(simd, velocity, self.seconds)
    }

    /// Returns the speed that the gaps ahead permit in a direction, at most the preferred speed.
    #[inline(always)]
    fn gap_speed<S: Simd>(&self, simd: S, direction: Vec2) -> f32 {
        let speed = self.crowd.gap_speed(simd, direction, (self.time_gap, self.speed), self.streams_meet);
        speed.max(LEAST_SPEED)
    }

    /// Returns the free space in a direction.
    #[inline(always)]
    fn room<S: Simd>(&self, simd: S, direction: Vec2) -> FreeDistance {
        FreeDistance { time: self.time(simd, direction * self.speed), speed: self.gap_speed(simd, direction) }
    }

    /// Whether no neighbour hinders an agent at its preferred speed.
    fn is_free(&self, room: FreeDistance) -> bool {
        room.time >= self.seconds && room.speed >= self.speed
    }
}

/// The results of the agents' looks ahead.
#[derive(Clone, Debug, Default)]
pub(crate) struct LooksAhead {
    /// By row, of own agents; empty if no agent looks ahead.
    all: Vec<LookAhead>,
    scratch: Vec<LookAheadScratch>,
}

impl LooksAhead {
    /// Lets all agents of this world look ahead, once a step.
    pub fn run(&mut self, around: Surroundings<'_>) {
        let state = around.state;
        let looks = state.groups_in_use().any(|group| group.look_ahead || group.keep_right != 0.0);
        self.all.resize(if looks { state.own().len() } else { 0 }, LookAhead::FREE);
        let (discs, in_space) = (state.agents.all_discs(), state.agents.any_flies());
        let radius = state.agents.radius.uniform().filter(|_| discs);
        let common = LookAheadShared { discs, radius, in_space, directions: directions(0.0) };
        let level = state.instructions.level().unwrap_or(Level::baseline());
        parallel::costly_ranges_with(&mut self.all[..], &mut self.scratch, |scratch, rows, ahead| {
            dispatch!(level, simd => around.look_ahead_of_rows(simd, rows, ahead, &common, scratch));
        });
    }

    /// Returns the result of an agent's look ahead.
    #[inline]
    pub fn of(&self, row: usize) -> LookAhead {
        self.all.get(row).copied().unwrap_or(LookAhead::FREE)
    }

    /// Records that the rows were moved along cycles.
    pub fn permute(&mut self, cycles: &Cycles) {
        if !self.all.is_empty() {
            cycles.turn(&mut self.all);
        }
    }

    /// Records that the agent of a row is removed. The agent of the last row takes its row.
    pub fn remove(&mut self, row: usize) {
        if row < self.all.len() {
            self.all.swap_remove(row);
        }
    }
}

impl Surroundings<'_> {
    #[inline(always)]
    fn look_ahead_of_rows<S: Simd>(
        &self,
        simd: S,
        rows: Range<usize>,
        ahead: &mut [LookAhead],
        common: &LookAheadShared,
        scratch: &mut LookAheadScratch,
    ) {
        for (row, ahead) in rows.zip(ahead) {
            *ahead = self.ahead_of(simd, row, common, scratch);
        }
    }

    /// Computes the result of an agent's look ahead.
    #[inline(always)]
    fn ahead_of<S: Simd>(
        &self,
        simd: S,
        row: usize,
        common: &LookAheadShared,
        scratch: &mut LookAheadScratch,
    ) -> LookAhead {
        let agents = &self.state.agents;
        let group = &self.state.local_groups[agents.group[row].index()];
        let own = &self.shown[row];
        let (way, speed) = (&own.way, agents.preferred_speed[row]);
        if !group.look_ahead {
            // an agent that is blocked for long tries any side
            let blocked = group.keep_right != 0.0 && self.state.without_progress(row) >= PATIENCE;
            let aside = if blocked { (self.state.whim(row, 0) - 0.5) * std::f32::consts::PI } else { 0.0 };
            return LookAhead::turned_by(group.keep_right + aside);
        }
        if way.direction == Vec2::ZERO || speed <= 0.0 || self.neighbours(row).is_empty() {
            return LookAhead::FREE;
        }
        let LookAheadScratch { crowd, walls } = scratch;
        walls.forget();
        let at = agents.position[row].as_dvec2();
        let in_space = common.in_space && self.state.model(row).looks_in_space();
        let gets_on = self.state.without_progress(row) < GETS_ON;
        self.see_crowd(row, common, in_space, crowd);
        let Group { personal_space, shoulders, .. } = *group;
        crowd.sort(simd, &Viewpoint { way: way.direction, gets_on, personal_space, shoulders });
        let mut hidden = |offset: Vec2| {
            if in_space {
                return false;
            }
            walls.find(&self.state.walls, at, || self.state.range_of_walls(row));
            walls.hide(offset)
        };
        // nothing beyond the point where it stops matters
        let to_goal = if way.stops() { way.remaining / speed } else { f32::INFINITY };
        let mut oncoming = Oncoming { time: SIGHT.min(to_goal), turn: 0.0, any: false };
        let mut crosses = false;
        for MetNeighbour { row: other, offset, velocity, radii, space, is_opposite } in crowd.met() {
            let relative = way.direction * speed - velocity;
            if is_opposite {
                if !hidden(offset) {
                    let share = if agents.avoids(other, row) { self.state.share(row, other, 0.0) } else { 1.0 };
                    oncoming.meet((offset, relative), radii + 2.0 * space, speed, share, group.keep_right);
                }
            } else if !crosses {
                crosses = time_to_disc(offset, relative, radii) < SIGHT_CROSSING && !hidden(offset);
            }
        }
        let streams_meet = oncoming.any || crosses;
        let straight = LookAhead::turned_by(oncoming.turn);
        let direction = straight.turned(way.direction);
        if in_space {
            return straight;
        }
        let seconds = SIGHT.min(to_goal);
        let sight = LookAheadInput { crowd, speed, time_gap: agents.time_gap[row], seconds, streams_meet };
        // walls matter only if a neighbour would hinder the agent
        if streams_meet && gets_on {
            let mut gap_speed = sight.gap_speed(simd, direction);
            if gap_speed < speed && sight.crowd.forget(hidden) {
                gap_speed = sight.gap_speed(simd, direction);
            }
            return LookAhead { speed: gap_speed, ..straight };
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

    /// Gathers the neighbours of an agent.
    #[inline(always)]
    fn see_crowd(&self, row: usize, common: &LookAheadShared, in_space: bool, crowd: &mut CrowdAhead) {
        let (agents, shown) = (&self.state.agents, self.shown);
        let own = &shown[row];
        // a long body turns its narrow side forward; the local model takes its length into account
        let breadth = |row: usize| match common.radius {
            Some(radius) => radius,
            None if common.discs => agents.radius[row],
            None => agents.body(row).clearance_radius(),
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
            // agents on the same journey stand close together where it ends
            let close = their.way.walks() || agents.journey[row] == agents.journey[other];
            let radii = (own_breadth + breadth(other)) * (1.0 + MARGIN);
            crowd.push(other, (offset, their.velocity()), &their.way, radii, close);
        }
    }

    /// Returns the direction in which an agent gets farthest.
    #[inline(always)]
    fn freest<S: Simd>(
        &self,
        simd: S,
        row: usize,
        sight: &LookAheadInput<'_>,
        (way, side, straight): (Vec2, f32, FreeDistance),
        queues: bool,
        (common, walls): (&LookAheadShared, &mut WallsAhead),
    ) -> LookAhead {
        let (agents, range) = (&self.state.agents, sight.speed * sight.seconds);
        let group = &self.state.local_groups[agents.group[row].index()];
        let at = agents.position[row].as_dvec2();
        walls.find(&self.state.walls, at, || self.state.range_of_walls(row));
        walls.keep(self.state.clear_of_walls(row));
        let course = agents.velocity[row] / sight.speed;
        let course = course + way * (STEADY * (1.0 - course.length()).max(0.0));
        let patience = (self.state.without_progress(row) / PATIENCE) % PATIENT_AGAIN;
        let (impatience, restlessness) = (IMPATIENCE * patience.min(1.0), (patience - 1.0).clamp(0.0, 1.0));
        // finite where restlessness is 1, since it is multiplied by a sine that may be 0
        let beyond = (restlessness / (1.0 - restlessness * restlessness).sqrt()).min(f32::MAX);
        let mut best = (f32::INFINITY, LookAhead::FREE);
        let turned = (side != 0.0).then(|| directions(side));
        for (index, &ahead) in (0..).zip(turned.as_ref().unwrap_or(&common.directions)) {
            let Vec2 { x: cos, y: sin } = ahead.turn;
            let direction = ahead.turned(way);
            let turning = course.length() - course.dot(direction);
            let whim = if impatience > 0.0 { impatience * self.state.whim(row, index) } else { 0.0 };
            let added = range * (TURNING * turning + whim);
            // it walks until the cost would rise; without restlessness, to where it is nearest to the point straight
            // ahead
            let most = range * (cos + beyond * sin.abs()).clamp(0.0, 1.0);
            let walked = |free: f32| free.min(most);
            let cost = |free: f32| {
                let walked = walked(free);
                let left = (range * range + walked * walked - 2.0 * range * walked * cos).max(0.0).sqrt();
                added + left - restlessness * walked
            };
            // each test costs more time than the test before
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
                // beside a queue it walks as far as that helps, and no faster than lets it stop there
                let useful = if index == 0 || !queues { f32::INFINITY } else { walked(free) / group.relaxation_time };
                best = (cost, LookAhead { speed: speed.min(useful.max(LEAST_SPEED)), ..ahead });
            }
        }
        best.1
    }
}

impl State {
    /// Returns the distance from its centre within which an agent that looks ahead considers walls, metres.
    fn range_of_walls(&self, row: usize) -> f32 {
        SIGHT_WALLS + self.clear_of_walls(row)
    }

    /// Returns the distance that an agent's centre keeps from walls where there is space: half the breadth of its
    /// shoulders, or the clearance radius of its body if that is more.
    fn clear_of_walls(&self, row: usize) -> f32 {
        self.agents.body(row).clearance_radius().max(0.5 * self.local_groups[self.agents.group[row].index()].shoulders)
    }

    /// Returns a random number in [0, 1) for one of the directions that an agent compares. The agent keeps the number
    /// for `WHIM` seconds.
    fn whim(&self, row: usize, direction: u64) -> f32 {
        let while_kept = (self.time() / WHIM) as u64;
        unit(self.settings.seed, self.agents.number[row], while_kept << 8 | direction, Purpose::Whim)
    }

    /// Returns a random direction in the plane, which an agent keeps for `WHIM` seconds.
    pub(crate) fn any_side(&self, row: usize) -> Vec2 {
        let (sin, cos) = libm::sincosf(std::f32::consts::TAU * self.whim(row, u64::from(u8::MAX)));
        Vec2::new(cos, sin)
    }
}

/// Returns the directions that an agent compares if it turns to the right by an angle, radians. The first is straight
/// ahead.
fn directions(side: f32) -> [LookAhead; DIRECTIONS] {
    std::array::from_fn(|index| {
        let angle = match index.checked_sub(1) {
            Some(index) if index % 2 == 0 => ANGLES[index / 2],
            Some(index) => -ANGLES[index / 2],
            None => 0.0,
        };
        LookAhead::turned_by(angle.to_radians() + side)
    })
}

/// The first oncoming agent that the agent meets.
struct Oncoming {
    /// Seconds until the two are nearest to each other.
    time: f32,
    /// Angle to the right that makes room for it, radians.
    turn: f32,
    /// Whether any agent ahead comes the opposite way.
    any: bool,
}

impl Oncoming {
    /// Takes an oncoming agent into account: its offset, the relative velocity, and the distance to keep. The agent
    /// makes its share of the room and turns by at most `most`.
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
