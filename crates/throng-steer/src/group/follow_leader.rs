//! Leader following: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use super::{Neighbourhood, Separation};
use crate::single::keep;
use glam::Vec3;
use std::f32::consts::TAU;
use throng::Error;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::steer::{
    Behaviour, GroupFilter, Kinematics, Rng, SteeringInput, SteeringNeighbour, SteeringReason, Target, TraceRecorder,
};

/// Follows behind a leader, out of its way (Reynolds 1999).
///
/// It keeps its distance from other followers and from the leader; in a bunch, or in single file.
///
/// ```
/// use throng::steer::Target;
/// use throng_steer::FollowLeader;
/// let ducklings = FollowLeader { single_file: true, gap: 0.5, ..FollowLeader::new(Target::Agent(0)) };
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FollowLeader {
    /// The leader.
    #[parameter(required)]
    pub leader: Target,
    /// Whether followers form a single file, in the order of the group; else they form a bunch.
    ///
    /// In single file each agent follows the agent of its group with the greatest number below its own among its
    /// neighbours, and the leader if there is none.
    pub single_file: bool,
    /// Distance behind the leader or the follower ahead, metres.
    #[parameter(default = 1.0, unit = "m", least = 0)]
    pub gap: f32,
    /// Length of the area ahead of the leader that it keeps free, metres.
    #[parameter(default = 3.0, unit = "m", least = 0)]
    pub free: f32,
    /// Extent of that area to either side, metres.
    #[parameter(default = 0.6, unit = "m", least = 0)]
    pub width: f32,
    /// Distance at which it starts to slow down, metres.
    #[parameter(default = 2.0, unit = "m", least = 0)]
    pub slowing_distance: f32,
    /// Radius of a disc behind the leader in which each follower of a bunch has its own place, metres; 0: the same place
    /// for all.
    #[parameter(default = 0.0, unit = "m", least = 0)]
    pub spread: f32,
    /// Distance between followers, metres.
    #[parameter(default = 0.8, unit = "m", above = 0)]
    pub spacing: f32,
}

/// Number of neighbours at the spacing that together push with the whole force.
const FULL: f32 = 2.0;

impl Behaviour for FollowLeader {
    fn steer(&self, view: &SteeringInput<'_>, memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let leader = self.leader.find(view)?;
        why.note(|| SteeringReason::Rectangle(self.way(&leader)));
        if let Some(aside) = self.out_of_the_way(view, &leader) {
            why.note(|| SteeringReason::Aim(view.position() + aside));
            return view.go(aside);
        }
        let next = if self.single_file { next_in_file(view).unwrap_or(leader) } else { leader };
        let place = Vec3::NEG_X * self.gap + if self.single_file { Vec3::ZERO } else { self.own_place(view.rng) };
        let follow = keep(view, &next, place, self.slowing_distance, why);
        let near = Neighbourhood { distance: self.spacing, groups: GroupFilter::OwnGroup, ..Neighbourhood::default() };
        let full = FULL / self.spacing;
        let apart = Separation { near, full, ..Separation::default() }.steer(view, memory, why);
        // other followers push the agent next to the leader into the leader, so the leader pushes it away, whatever its
        // group
        let offset = view.to(leader.position);
        let distance = offset.length();
        let off = if distance < self.spacing { view.urge(-offset / (distance * distance), full) } else { None };
        let force = |said: Option<Steering>| said.map_or(Vec3::ZERO, |said| said.force);
        let terms = [follow.force, force(apart), force(off)];
        terms.iter().for_each(|&term| why.note(|| SteeringReason::Adds(term / view.vehicle.mass)));
        Some((terms[0] + terms[1] + terms[2]).into())
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}

impl FollowLeader {
    /// Returns the corners of the area ahead of the leader that it keeps free.
    fn way(&self, leader: &Kinematics) -> [Vec3; 4] {
        let corners = [(0.0, self.width), (self.free, self.width), (self.free, -self.width), (0.0, -self.width)];
        corners.map(|(ahead, left)| leader.position + leader.basis.to_world(Vec3::new(ahead, left, 0.0)))
    }

    /// Returns the place of a follower in the disc, from the point of the disc that is nearest to the leader.
    fn own_place(&self, rng: Rng) -> Vec3 {
        let (sin, cos) = libm::sincosf(TAU * rng.at(0).draw(0));
        let out = self.spread * rng.at(0).draw(1).sqrt();
        Vec3::new(out * cos - self.spread, out * sin, 0.0)
    }

    /// Returns the direction to the nearer side of the leader's way if the agent is in that way.
    fn out_of_the_way(&self, view: &SteeringInput<'_>, leader: &Kinematics) -> Option<Vec3> {
        let from = view.passable(view.position() - leader.position);
        let ahead = from.dot(leader.basis.forward);
        let beside = view.passable(leader.basis.lateral(from));
        if ahead <= 0.0 || ahead > self.free || beside.length() > self.width {
            return None;
        }
        // in the middle, agents with even numbers go left, the rest right
        let side = if view.rng.number.is_multiple_of(2) { leader.basis.side } else { -leader.basis.side };
        Some(if beside == Vec3::ZERO { side } else { beside })
    }
}

fn next_in_file(view: &SteeringInput<'_>) -> Option<Kinematics> {
    let before =
        |other: &&SteeringNeighbour| GroupFilter::OwnGroup.counts(view, other) && other.number < view.rng.number;
    let next = view.neighbours.iter().filter(before).max_by_key(|other| other.number)?;
    Some(Kinematics::of(view, next))
}
