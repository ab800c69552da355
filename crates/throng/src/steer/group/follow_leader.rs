//! Leader following: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use super::{Neighbourhood, Separation};
use crate::Error;
use crate::motion::Steering;
use crate::steer::single::keep;
use crate::steer::{Behaviour, Mark, Neighbour, Reason, Target, View, Who, Why};
use glam::Vec3;

/// Goes behind a leader, out of the way of whoever leads, apart from other followers and the leader; in a bunch, or in single
/// file.
///
/// ```
/// use throng::steer::{FollowLeader, Target};
/// let ducklings = FollowLeader { single_file: true, gap: 0.5, ..FollowLeader::from(Target::Agent(0)) };
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FollowLeader {
    /// Whom.
    pub leader: Target,
    /// Everybody behind the next of the group in the order of numbers, that is the one with the greatest number below its
    /// own that it sees; the first behind the leader.
    pub single_file: bool,
    /// How far behind, metres. Limit: >= 0.
    pub gap: f32,
    /// How far ahead of the leader its way is to be free, metres. Limit: >= 0.
    pub free: f32,
    /// How far to either side of it, metres. Limit: >= 0.
    pub width: f32,
    /// How far away it begins to slow down, metres. Limit: >= 0.
    pub slowing_distance: f32,
    /// How far apart followers are, metres. Limit: > 0.
    pub spacing: f32,
}

impl From<Target> for FollowLeader {
    fn from(leader: Target) -> Self {
        Self { leader, single_file: false, gap: 1.0, free: 3.0, width: 0.6, slowing_distance: 2.0, spacing: 0.8 }
    }
}

/// How many others at the spacing push with all of the force.
const FULL: f32 = 2.0;

impl Behaviour for FollowLeader {
    fn steer(&self, view: &View<'_>, memory: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let leader = self.leader.find(view)?;
        if let Some(aside) = self.out_of_the_way(view, &leader) {
            why.note(|| Reason::Aim(view.position() + aside));
            return view.go(aside);
        }
        let next = if self.single_file { next_in_file(view).unwrap_or(leader) } else { leader };
        let follow = keep(view, &next, Vec3::NEG_X * self.gap, self.slowing_distance, why);
        let near = Neighbourhood { distance: self.spacing, who: Who::OwnGroup, ..Neighbourhood::default() };
        let full = FULL / self.spacing;
        let apart = Separation { near, full, ..Separation::default() }.steer(view, memory, why);
        // others push into the leader whoever is next to it, whatever group that is of
        let offset = view.to(leader.position);
        let distance = offset.length();
        let off = if distance < self.spacing { view.urge(-offset / (distance * distance), full) } else { None };
        let force = |said: Option<Steering>| said.map_or(Vec3::ZERO, |said| said.force);
        Some((follow.force + force(apart) + force(off)).into())
    }

    fn check(&self) -> Result<(), Error> {
        let lengths = [
            ("gap", self.gap),
            ("free way", self.free),
            ("width of the free way", self.width),
            ("slowing distance", self.slowing_distance),
        ];
        for (what, length) in lengths {
            Error::unless(length >= 0.0, what, length, "0 or more")?;
        }
        Error::unless_positive("spacing", self.spacing)
    }
}

impl FollowLeader {
    /// The way to the nearer side of the leader's way, for who is on it.
    fn out_of_the_way(&self, view: &View<'_>, leader: &Mark) -> Option<Vec3> {
        let from = view.passable(view.position() - leader.position);
        let ahead = from.dot(leader.basis.forward);
        let beside = view.passable(leader.basis.lateral(from));
        if ahead <= 0.0 || ahead > self.free || beside.length() > self.width {
            return None;
        }
        // in the middle half of them go left
        let side = if view.dice.number.is_multiple_of(2) { leader.basis.side } else { -leader.basis.side };
        Some(if beside == Vec3::ZERO { side } else { beside })
    }
}

fn next_in_file(view: &View<'_>) -> Option<Mark> {
    let before = |other: &&Neighbour| Who::OwnGroup.counts(view, other) && other.number < view.dice.number;
    let next = view.neighbours.iter().filter(before).max_by_key(|other| other.number)?;
    Some(Mark::of(view, next))
}
