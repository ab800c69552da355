//! Path following: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use crate::Error;
use crate::motion::Steering;
use crate::space::{OnPath, Pathway, Segment, Way};
use crate::steer::single::{approach, settling_time};
use crate::steer::{Arrive, Behaviour, Reason, Target, View, Why};
use glam::Vec3;
use std::sync::Arc;

/// Goes along a path, either way, and rests at the end of an open one. Nothing to correct while it goes the right way and
/// will still be on the path: what it does there, slowly or in haste, other behaviours say
/// ([`MoveForward`](crate::steer::MoveForward), say).
///
/// It remembers how far along it is, and looks for itself near there only: where a path crosses itself it stays on its arm.
///
/// ```
/// use glam::Vec3;
/// use throng::space::{Pathway, Way};
/// use throng::steer::{Behaviour, FollowPath, View, Why};
///
/// let path = Pathway::new(&[Vec3::Y * -5.0, Vec3::ZERO, Vec3::X * 9.0], 1.0, false)?;
/// let steer = |follow: FollowPath| follow.steer(&View::default(), &mut [0.0; 3], &mut Why::default());
/// assert!(steer(FollowPath::from(path.clone())).expect("it stands").force.x > 0.0);
/// let back = FollowPath { way: Way::Backward, ..FollowPath::from(path) };
/// assert!(steer(back).expect("it stands").force.y < 0.0);
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct FollowPath {
    /// Which path, metres in the coordinates of the [`View`].
    pub path: Arc<Pathway>,
    /// In which direction.
    pub way: Way,
    /// How far ahead it looks, and how far along the path the point is that it seeks, seconds at its speed. Limit: > 0.
    pub seconds: f32,
    /// How far from the end of an open path it begins to slow down, metres. Limit: >= 0.
    pub slowing_distance: f32,
    /// Part of the radius within which who is about to leave the path is led back. 1: it is left alone as soon as it stays on
    /// the path, and so keeps to the edge that bends lead it to, as in the paper; less: it comes farther in. Limit: 0 to 1.
    pub inner: f32,
}

impl From<Pathway> for FollowPath {
    fn from(path: Pathway) -> Self {
        Arc::new(path).into()
    }
}

impl From<Arc<Pathway>> for FollowPath {
    fn from(path: Arc<Pathway>) -> Self {
        Self { path, way: Way::Forward, seconds: 0.5, slowing_distance: 1.0, inner: 1.0 }
    }
}

/// Part of the top speed at least by which it tells how far ahead the point is that it seeks.
const SLOW: f32 = 0.5;

impl Behaviour for FollowPath {
    /// Whether it knows how far along the path it is, and how far, metres; whether it is being led back.
    fn memory(&self) -> usize {
        3
    }

    fn steer(&self, view: &View<'_>, memory: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let [known, along, led_back] = memory else { return None };
        let path = &*self.path;
        let reach = view.vehicle.max_speed * self.seconds;
        let known_along = (*known > 0.0).then_some(*along);
        let now = self.find(view.position(), known_along, reach);
        (*known, *along) = (1.0, now.along);
        let left = match self.way {
            Way::Forward => path.length() - now.along,
            Way::Backward => now.along,
        };
        let ahead = view.motion.speed().max(SLOW * view.vehicle.max_speed) * self.seconds;
        let aim = path.at(now.along + ahead * self.way.sign());
        self.tell(now, ahead, why);
        if !path.is_cyclic() && left <= ahead {
            let arrive = Arrive { slowing_distance: self.slowing_distance, ..Arrive::from(Target::Point(aim)) };
            return arrive.steer(view, &mut [], why).or_else(|| Some(view.reach(Vec3::ZERO)));
        }
        let future = view.motion.position_in(self.seconds);
        why.note(|| Reason::Expects(future));
        let slows = self.slowing_distance.max(view.vehicle.max_speed * settling_time(view, 0.0));
        if !path.is_cyclic() && left < slows {
            why.note(|| Reason::Aim(aim));
            let offset = view.to(aim).normalize_or_zero() * left;
            return Some(view.reach(approach(view, offset, Vec3::ZERO, self.slowing_distance)));
        }
        let then = path.nearest_near(future, now.along, reach);
        let beside = future.distance(then.point);
        let leaves = if *led_back > 0.0 { beside > self.inner * (beside - then.outside) } else { then.outside > 0.0 };
        *led_back = f32::from(leaves);
        match self.walked(now.along, then.along) > 0.0 {
            _ if leaves => view.seek(aim, why),
            true => None,
            // who stands, or goes the other way, goes along it from where it is
            false => view.seek(aim + (view.position() - now.point), why),
        }
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless_positive("horizon", self.seconds)?;
        Error::unless((0.0..=1.0).contains(&self.inner), "inner part of the path", self.inner, "from 0 to 1")?;
        Error::unless(self.slowing_distance >= 0.0, "slowing distance", self.slowing_distance, "0 or more")
    }
}

impl FollowPath {
    /// Where on the path an agent is that was at a distance along it, if that is known and still near.
    fn find(&self, position: Vec3, known: Option<f32>, reach: f32) -> OnPath {
        let near = known.map(|along| self.path.nearest_near(position, along, reach));
        near.filter(|near| near.outside <= reach).unwrap_or_else(|| self.path.nearest(position))
    }

    /// Says which part of the path it follows: from where it is beside it, as far as it looks.
    fn tell(&self, now: OnPath, ahead: f32, why: &mut Why<'_>) {
        if !why.is_asked() {
            return;
        }
        let (path, sign) = (&*self.path, self.way.sign());
        let off = |corner: &Segment| {
            let off = (corner.along - now.along) * sign;
            let off = if path.is_cyclic() { off.rem_euclid(path.length()) } else { off };
            (off > 0.0 && off < ahead).then_some((off, corner.start))
        };
        let mut corners: Vec<(f32, Vec3)> = path.segments().iter().filter_map(off).collect();
        corners.sort_by(|a, b| a.0.total_cmp(&b.0));
        let ends = [now.point, path.at(now.along + ahead * sign)];
        let way = ends[..1].iter().copied().chain(corners.into_iter().map(|corner| corner.1)).chain([ends[1]]);
        way.for_each(|corner| why.note(|| Reason::Via(corner)));
    }

    /// How far it is from one distance along the path to another in its direction; on a ring, the shorter way round.
    fn walked(&self, from: f32, to: f32) -> f32 {
        let (length, walked) = (self.path.length(), to - from);
        let half = 0.5 * length;
        let shorter = if self.path.is_cyclic() { (walked + half).rem_euclid(length) - half } else { walked };
        shorter * self.way.sign()
    }
}
