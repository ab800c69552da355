//! Queueing: who is on the way behind others waits for them, and does not push.

use super::World;
use crate::agent::Status;
use crate::avoid::MARGIN;
use glam::Vec2;

/// Cosine of the angle within which two go the same way; beyond its negative they go opposite ways.
const SAME_WAY: f32 = 0.3;
/// Part of the sum of radii that who is followed may be aside.
const FOLLOW_WIDTH: f32 = 0.8;
/// Seconds in which who follows closes up.
const FOLLOW_TIME: f32 = 0.05;
/// Cosine of the angle within which somebody is ahead: on the way to the same goal, and to another.
const AHEAD: f32 = 0.3;
const RIGHT_AHEAD: f32 = 0.7;

impl World {
    /// The speed at which an agent follows those right ahead who go the same way: theirs, once it has closed up. Who
    /// queues does not push, nor mill about. In counterflow nobody queues: there one squeezes by.
    pub(super) fn following_speed(&self, row: usize, direction: Vec2) -> f32 {
        let agents = &self.agents;
        let others = || self.neighbours(row).iter().map(|near| near.row as usize);
        if others().any(|other| self.step.ways[other].direction.dot(direction) < -SAME_WAY) {
            return f32::INFINITY;
        }
        let speeds = others().filter_map(|other| {
            let radii = agents.radius[row] + agents.radius[other];
            let offset = agents.offset(row, other);
            let aside = offset.perp_dot(direction).abs();
            (aside < FOLLOW_WIDTH * radii && self.leads(other, offset, direction)).then(|| {
                let gap = (offset.length() - radii * (1.0 + MARGIN)).max(0.0);
                agents.velocity[other].dot(direction).max(0.0) + gap / FOLLOW_TIME
            })
        });
        speeds.fold(f32::INFINITY, f32::min)
    }

    /// Whether somebody close ahead is on the way to the same goal, or goes the same way. Of two with the same goal at
    /// most one queues, so that never each waits for the other.
    pub(super) fn queues(&self, row: usize, direction: Vec2) -> bool {
        let agents = &self.agents;
        let way = &self.step.ways[row];
        self.neighbours(row).iter().any(|near| {
            let other = near.row as usize;
            let theirs = &self.step.ways[other];
            let offset = agents.offset(row, other);
            let distance = offset.length();
            let close = distance - agents.radius[row] - agents.radius[other] < 2.0 * agents.radius[row];
            let ahead = offset.dot(direction) / distance;
            if !close || agents.status[other] != Status::Walking {
                false
            } else if theirs.goal == way.goal {
                ahead > AHEAD && theirs.remaining < way.remaining
            } else {
                ahead > RIGHT_AHEAD && self.leads(other, offset, direction)
            }
        })
    }

    /// Whether the one at `offset` goes ahead of who wants to go in `direction`: the same way, and away. Of two, at
    /// most one goes ahead of the other, so that never each waits for the other.
    pub(super) fn leads(&self, other: usize, offset: Vec2, direction: Vec2) -> bool {
        let theirs = self.step.ways[other].direction;
        theirs.dot(direction) > SAME_WAY && offset.dot(theirs) > 0.0 && offset.dot(direction) > 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::{Settings, Way};
    use crate::{Agent, GoalId};
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
        world.perceive();
        world.step.ways = all
            .iter()
            .map(|one| Way {
                goal: Some(GoalId(one.goal)),
                direction: direction(one),
                remaining: f32::from(one.remaining) * 0.5,
            })
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
            let follows = [0, 1].map(|row| world.following_speed(row, directions[row]).is_finite());
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
        assert!((world.following_speed(0, east) - 0.3).abs() < 1e-5, "closed up");
        assert_eq!(world.following_speed(1, east), f32::INFINITY, "nobody is ahead");
        assert!(world.queues(0, east) && !world.queues(1, east));
        let (world, _) = crowd([walker(0.0, 0), walker(0.5, 0)]);
        assert!(world.following_speed(0, east) > 1.3, "a gap is closed");
    }

    #[test]
    fn nobody_follows_in_counterflow() {
        let two = [walker(0.0, 0), walker(0.42, 0)];
        let (world, [east, _]) = crowd(two);
        assert!(world.following_speed(0, east) < 1.3);
        for (direction, follows) in [(12, false), (9, false), (6, true), (3, true)] {
            let (world, [east, ..]) = crowd([two[0], two[1], walker(1.5, direction)]);
            let speed = world.following_speed(0, east);
            assert_eq!(speed.is_finite(), follows, "somebody comes at {} degrees", direction * 15);
        }
    }
}
