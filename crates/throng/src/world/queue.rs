//! Queueing: who is on the way behind others waits for them, and does not push.

use super::World;
use crate::avoid::MARGIN;
use crate::parallel;
use glam::Vec2;

/// Cosine of the angle within which two go the same way; beyond its negative they go opposite ways.
const SAME_WAY: f32 = 0.3;
/// Part of the sum of radii that who is followed may be aside.
const FOLLOW_WIDTH: f32 = 0.8;
/// Who walks unhindered, at this part of its preferred speed, and would like to be slower than this part of another's, is
/// overtaken.
const UNHINDERED: f32 = 0.9;
const SLOWER: f32 = 0.8;
/// Seconds in which who follows closes up.
const FOLLOW_TIME: f32 = 0.05;
/// Cosine of the angle within which somebody is ahead: on the way to the same goal, and to another.
const AHEAD: f32 = 0.3;
const RIGHT_AHEAD: f32 = 0.7;

/// How fast an agent may follow those ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Following {
    pub speed: f32,
    /// Row of the slowest of them, if the agent has closed up to it; else `NONE`.
    closed_up: u32,
}

const NONE: u32 = u32::MAX;

impl Following {
    const NOBODY: Self = Self { speed: f32::INFINITY, closed_up: NONE };

    fn next(&self) -> Option<usize> {
        (self.closed_up != NONE).then_some(self.closed_up as usize)
    }
}

/// In a ring where everybody follows the next nobody is first: there nobody follows. `seen` is memory.
fn free_rings(following: &mut [Following], seen: &mut Vec<u32>) {
    seen.clear();
    seen.resize(following.len(), u32::MAX);
    for start in 0..following.len() {
        let mut at = start;
        while seen[at] == u32::MAX
            && let Some(next) = following[at].next()
        {
            seen[at] = start as u32;
            at = next;
        }
        // back where this walk has been: a ring begins here
        while seen[at] == start as u32
            && let Some(next) = following[at].next()
        {
            following[at] = Following::NOBODY;
            at = next;
        }
    }
}

impl World {
    /// Notes whom everybody follows, and how fast.
    pub(super) fn follow_others(&mut self) {
        let mut following = std::mem::take(&mut self.step.following);
        let queues = self.groups_in_use().any(|group| group.queue);
        following.resize(if queues { self.agents.len() } else { 0 }, Following::NOBODY);
        let world = &*self;
        parallel::rows(&mut following, |(), row, out| *out = world.following(row));
        free_rings(&mut following, &mut self.step.seen);
        self.step.following = following;
    }

    /// How fast those ahead let an agent be.
    #[inline]
    pub(super) fn following_speed(&self, row: usize) -> f32 {
        self.step.following.get(row).map_or(f32::INFINITY, |following| following.speed)
    }

    /// How an agent follows those right ahead who go the same way: at their speed, once it has closed up. Who queues
    /// does not push, nor mill about. In counterflow nobody queues: there one squeezes by.
    fn following(&self, row: usize) -> Following {
        let agents = &self.agents;
        let (shown, direction) = (&self.step.shown, self.step.shown[row].way.direction);
        if direction == Vec2::ZERO || !self.groups[agents.group[row].index()].queue {
            return Following::NOBODY;
        }
        // without branches: which of them comes the other way cannot be foreseen
        let along = |other: usize| shown[other].way.direction.dot(direction);
        let least = self.level_neighbours(row).fold(0.0, |least: f32, other| least.min(along(other)));
        if least < -SAME_WAY {
            return Following::NOBODY;
        }
        let all = self.level_neighbours(row).filter_map(|other| {
            let radii = agents.radius[row] + agents.radius[other];
            let offset = agents.offset(row, other);
            let aside = offset.perp_dot(direction).abs();
            let overtaken = agents.travel[other].progress >= UNHINDERED
                && agents.preferred_speed[other] < SLOWER * agents.preferred_speed[row];
            (!overtaken && aside < FOLLOW_WIDTH * radii && self.leads(other, offset, direction)).then(|| {
                let closing = (offset.length() - radii * (1.0 + MARGIN)).max(0.0) / FOLLOW_TIME;
                let speed = agents.velocity[other].dot(direction).max(0.0) + closing;
                Following { speed, closed_up: if closing < agents.preferred_speed[row] { other as u32 } else { NONE } }
            })
        });
        all.fold(Following::NOBODY, |slowest, next| if next.speed < slowest.speed { next } else { slowest })
    }

    /// Whether somebody close ahead is on the way to the same goal, or goes the same way. Of two with the same goal at
    /// most one queues, so that never each waits for the other.
    pub(super) fn queues(&self, row: usize, direction: Vec2) -> bool {
        let agents = &self.agents;
        let way = &self.step.shown[row].way;
        self.level_neighbours(row).any(|other| {
            let theirs = &self.step.shown[other].way;
            let offset = agents.offset(row, other);
            let distance = offset.length();
            let close = distance - agents.radius[row] - agents.radius[other] < 2.0 * agents.radius[row];
            let ahead = offset.dot(direction) / distance;
            if !close || !theirs.walks() {
                false
            } else if theirs.same_goal(way) {
                ahead > AHEAD && theirs.remaining < way.remaining
            } else {
                ahead > RIGHT_AHEAD && self.leads(other, offset, direction)
            }
        })
    }

    /// Neighbours who are not far above or below, whom only models of space see: nobody queues behind those.
    fn level_neighbours(&self, row: usize) -> impl Iterator<Item = usize> {
        let others = self.neighbours(row).iter().map(|&other| other as usize);
        let in_space = self.agents.anybody_flies() && self.model(row).looks_in_space();
        others.filter(move |&other| !in_space || !self.agents.passes_clear(row, other))
    }

    /// Whether the one at `offset` goes ahead of who wants to go in `direction`: the same way, and away. Of two, at
    /// most one goes ahead of the other, so that never each waits for the other.
    pub(super) fn leads(&self, other: usize, offset: Vec2, direction: Vec2) -> bool {
        let theirs = self.step.shown[other].way.direction;
        theirs.dot(direction) > SAME_WAY && offset.dot(theirs) > 0.0 && offset.dot(direction) > 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::Settings;
    use crate::world::way::{Shown, Way};
    use crate::{Agent, GoalId, Status};
    use glam::DVec2;
    use proptest::prelude::*;

    /// Where one of two is, and where it wants to go.
    #[derive(Clone, Copy, Debug)]
    struct One {
        at: (f32, f32),
        velocity: (f32, f32),
        /// Multiples of 15 degrees, that directions along the axes, right angles and opposites come up.
        direction: i32,
        goal: u32,
        /// Half metres: that ties come up.
        remaining: u8,
        radius: f32,
    }

    fn one() -> impl Strategy<Value = One> {
        let at = prop_oneof![
            (-1.0f32..1.0, -1.0f32..1.0),
            (-2i8..3, -2i8..3).prop_map(|(x, y)| (0.4 * f32::from(x), 0.4 * f32::from(y)))
        ];
        (at, (-1.0f32..1.0, -1.0f32..1.0), 0..24, 0u32..2, 0u8..6, 0.1f32..0.4).prop_map(
            |(at, velocity, direction, goal, remaining, radius)| One {
                at,
                velocity,
                direction,
                goal,
                remaining,
                radius,
            },
        )
    }

    /// A world of some who walk, and their directions.
    fn crowd<const N: usize>(all: [One; N]) -> (World, [Vec2; N]) {
        let mut world = World::new(Settings::default()).unwrap();
        let direction = |one: &One| Vec2::from_angle((one.direction as f32 * 15.0).to_radians());
        for one in &all {
            let (position, velocity) = (DVec2::new(one.at.0.into(), one.at.1.into()), one.velocity.into());
            world.add_agent(Agent { position, velocity, radius: one.radius, ..Agent::default() }).unwrap();
        }
        world.agents.status.fill(Status::Walking);
        world.perceive(0.1);
        let way = |one: &One| Way::walking(Some(GoalId(one.goal)), direction(one), f32::from(one.remaining) * 0.5);
        let agents = &world.agents;
        world.step.shown = all
            .iter()
            .zip(0..)
            .map(|(one, row)| Shown::new(agents.position[row], agents.velocity[row], way(one)))
            .collect();
        (world, all.map(|one| direction(&one)))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]

        #[test]
        fn of_two_neither_leads_nor_follows_nor_waits_for_the_other_both_ways(a in one(), b in one()) {
            let (world, directions) = crowd([a, b]);
            let offset = world.agents.position[1] - world.agents.position[0];
            let ahead = [world.leads(1, offset, directions[0]), world.leads(0, -offset, directions[1])];
            prop_assert!(ahead != [true, true], "each leads the other");
            let follows = [0, 1].map(|row| world.following(row).speed.is_finite());
            prop_assert!(follows != [true, true], "each follows the other");
            prop_assert!((0..2).all(|row| !follows[row] || ahead[row]), "who follows is led");
            let queues = [0, 1].map(|row| world.queues(row, directions[row]));
            prop_assert!(queues != [true, true], "each waits for the other");
        }
    }

    fn walker(x: f32, direction: i32) -> One {
        One { at: (x, 0.0), velocity: (0.3, 0.0), direction, goal: 0, remaining: (4.0 - 2.0 * x) as u8, radius: 0.2 }
    }

    #[test]
    fn who_is_behind_follows_at_the_speed_of_who_is_ahead() {
        let (world, [east, _]) = crowd([walker(0.0, 0), walker(0.4 * (1.0 + MARGIN), 0)]);
        assert!((world.following(0).speed - 0.3).abs() < 1e-5, "closed up");
        assert_eq!(world.following(1).speed, f32::INFINITY, "nobody is ahead");
        assert!(world.queues(0, east) && !world.queues(1, east));
        let (world, _) = crowd([walker(0.0, 0), walker(0.5, 0)]);
        assert!(world.following(0).speed > 1.3, "a gap is closed");
    }

    #[test]
    fn nobody_follows_in_counterflow() {
        let two = [walker(0.0, 0), walker(0.42, 0)];
        let (world, _) = crowd(two);
        assert!(world.following(0).speed < 1.3);
        for (direction, follows) in [(12, false), (9, false), (6, true), (3, true)] {
            let (world, _) = crowd([two[0], two[1], walker(1.5, direction)]);
            let speed = world.following(0).speed;
            assert_eq!(speed.is_finite(), follows, "somebody comes at {} degrees", direction * 15);
        }
    }

    #[test]
    fn in_a_ring_nobody_follows_and_who_joins_it_does() {
        // 0, 1 and 2 follow round; 3 and 4 queue behind; 5 leads 6; 7 is alone
        let next = [Some(1), Some(2), Some(0), Some(4), Some(2), None, Some(5), None];
        for rotation in 0..8u32 {
            let turned = |row: u32| (row + rotation) % 8;
            let mut all = [Following::NOBODY; 8];
            for (row, closed_up) in (0..).zip(next) {
                all[turned(row) as usize] = Following { speed: 0.1, closed_up: closed_up.map_or(NONE, turned) };
            }
            free_rings(&mut all, &mut Vec::new());
            let speeds = [0, 1, 2, 3, 4, 6].map(|row| all[turned(row) as usize].speed);
            assert_eq!(speeds, [f32::INFINITY, f32::INFINITY, f32::INFINITY, 0.1, 0.1, 0.1]);
        }
    }
}
