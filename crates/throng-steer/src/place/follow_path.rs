//! Path following: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use crate::Arrive;
use crate::single::{SLOWING_DISTANCE, approach, settling_time};
use glam::Vec3;
use std::sync::Arc;
use throng::Error;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::space::{OnPath, PathDirection, Pathway, Segment};
use throng::steer::{Behaviour, SteeringInput, SteeringReason, Target, TraceRecorder};

/// Moves along a path (Reynolds 1999).
///
/// It moves in either direction, and stops at the end of an open path. Nothing to correct while the agent moves in the
/// right direction and will still be on the path: other behaviours, such as [`MoveForward`](crate::MoveForward), set the
/// speed there.
///
/// The behaviour remembers the agent's distance along the path and searches the nearest point only near that distance:
/// where a path crosses itself the agent stays on its arm.
///
/// ```
/// use glam::Vec3;
/// use throng::space::{PathDirection, Pathway};
/// use throng::steer::{Behaviour, SteeringInput, TraceRecorder};
/// use throng_steer::FollowPath;
///
/// let path = Pathway::new(&[Vec3::Y * -5.0, Vec3::ZERO, Vec3::X * 9.0], 1.0, false)?;
/// let steer = |follow: FollowPath| follow.steer(&SteeringInput::default(), &mut [0.0; 3], &mut TraceRecorder::default());
/// assert!(steer(FollowPath::new(path.clone())).expect("it stands").force.x > 0.0);
/// let back = FollowPath { direction: PathDirection::Backward, ..FollowPath::new(path) };
/// assert!(steer(back).expect("it stands").force.y < 0.0);
/// # Ok::<(), throng::Error>(())
/// ```
#[parameters]
#[derive(Clone, Debug)]
pub struct FollowPath {
    /// The name of the path.
    ///
    /// In code, the path: metres in the coordinates of the [`SteeringInput`].
    #[parameter(required)]
    pub path: Arc<Pathway>,
    /// Whether it moves in the order of the path's points or against it.
    pub direction: PathDirection,
    /// How far ahead it looks, and how far ahead along the path the point is that it seeks, seconds at its speed.
    #[parameter(default = 0.5, unit = "s", above = 0)]
    pub horizon: f32,
    /// Distance from the end of an open path at which it starts to slow down, metres.
    #[parameter(default = SLOWING_DISTANCE, unit = "m", least = 0)]
    pub slowing_distance: f32,
    /// Part of the path's radius to which it is led back if it is about to leave the path; 1: it keeps to the edge that it
    /// reaches in bends.
    ///
    /// 1: the correction ends as soon as the agent will stay on the path, as in the paper. Less than 1: the agent is led
    /// farther in.
    #[parameter(default = 1.0, least = 0, most = 1)]
    pub inner: f32,
}

/// Least speed for the distance of the aim, as a part of the top speed.
const SLOW: f32 = 0.5;

impl Behaviour for FollowPath {
    /// Whether the distance along the path is known; that distance, metres; whether the agent is being led back.
    fn memory(&self) -> usize {
        3
    }

    fn steer(&self, view: &SteeringInput<'_>, memory: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let [known, along, led_back] = memory else { return None };
        let path = &*self.path;
        let reach = view.vehicle.max_speed * self.horizon;
        let known_along = (*known > 0.0).then_some(*along);
        let now = self.find(view.position(), known_along, reach);
        (*known, *along) = (1.0, now.along);
        let left = match self.direction {
            PathDirection::Forward => path.length() - now.along,
            PathDirection::Backward => now.along,
        };
        let ahead = view.motion.speed().max(SLOW * view.vehicle.max_speed) * self.horizon;
        let aim = path.at(now.along + ahead * self.direction.sign());
        self.tell(now, ahead, why);
        if !path.is_cyclic() && left <= ahead {
            let arrive = Arrive { slowing_distance: self.slowing_distance, ..Arrive::new(Target::Point(aim)) };
            return arrive.steer(view, &mut [], why).or_else(|| Some(view.reach(Vec3::ZERO)));
        }
        let future = view.motion.position_in(self.horizon);
        why.note(|| SteeringReason::Expects { now: view.position(), then: future });
        let slows = self.slowing_distance.max(view.vehicle.max_speed * settling_time(view, 0.0));
        if !path.is_cyclic() && left < slows {
            why.note(|| SteeringReason::Aim(aim));
            let offset = view.to(aim).normalize_or_zero() * left;
            return Some(view.reach(approach(view, offset, Vec3::ZERO, self.slowing_distance)));
        }
        let then = path.nearest_near(future, now.along, reach);
        why.note(|| SteeringReason::Projects { from: future, to: then.point });
        let beside = future.distance(then.point);
        let leaves = if *led_back > 0.0 { beside > self.inner * (beside - then.outside) } else { then.outside > 0.0 };
        *led_back = f32::from(leaves);
        match self.walked(now.along, then.along) > 0.0 {
            _ if leaves => view.seek(aim, why),
            true => None,
            // an agent that stands or moves the wrong way goes along the path from its position
            false => view.seek(aim + (view.position() - now.point), why),
        }
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}

impl FollowPath {
    /// Returns the agent's point on the path. `known` is its last distance along the path, used while it is still near.
    fn find(&self, position: Vec3, known: Option<f32>, reach: f32) -> OnPath {
        let near = known.map(|along| self.path.nearest_near(position, along, reach));
        near.filter(|near| near.outside <= reach).unwrap_or_else(|| self.path.nearest(position))
    }

    /// Records the stretch of the path ahead, from the agent's point on the path to the end of the look-ahead.
    fn tell(&self, now: OnPath, ahead: f32, why: &mut TraceRecorder<'_>) {
        if !why.is_requested() {
            return;
        }
        let (path, sign) = (&*self.path, self.direction.sign());
        let off = |corner: &Segment| {
            let off = (corner.along - now.along) * sign;
            let off = if path.is_cyclic() { off.rem_euclid(path.length()) } else { off };
            (off > 0.0 && off < ahead).then_some((off, corner.start))
        };
        let mut corners: Vec<(f32, Vec3)> = path.segments().iter().filter_map(off).collect();
        corners.sort_by(|a, b| a.0.total_cmp(&b.0));
        let ends = [now.point, path.at(now.along + ahead * sign)];
        let corners = ends[..1].iter().copied().chain(corners.into_iter().map(|corner| corner.1)).chain([ends[1]]);
        let corners: Vec<Vec3> = corners.collect();
        corners.iter().for_each(|&corner| why.note(|| SteeringReason::Via(corner)));
        for ends in corners.windows(2) {
            let [from, to] = [ends[0], ends[1]];
            let radius = path.radius_at(path.nearest(from.midpoint(to)).along, self.direction);
            why.note(|| SteeringReason::Stretch { from, to, radius });
        }
    }

    /// Returns the distance in the path's direction from one distance along the path to another; on a ring, the shorter
    /// way round.
    fn walked(&self, from: f32, to: f32) -> f32 {
        let (length, walked) = (self.path.length(), to - from);
        let half = 0.5 * length;
        let shorter = if self.path.is_cyclic() { (walked + half).rem_euclid(length) - half } else { walked };
        shorter * self.direction.sign()
    }
}
