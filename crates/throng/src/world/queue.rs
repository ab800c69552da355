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
            let offset = agents.position[other] - agents.position[row];
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
            let offset = agents.position[other] - agents.position[row];
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
