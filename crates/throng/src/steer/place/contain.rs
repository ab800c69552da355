//! Containment: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use super::course::Course;
use crate::Error;
use crate::motion::{Steering, turned};
use crate::space::surface::{Barrier, SeenFrom, Surface};
use crate::steer::{Behaviour, Reason, View, Why};
use std::f32::consts::PI;
use std::sync::Arc;

/// Stays on one side of a surface: within a room, an aquarium, a cage of any shape. Nothing to correct while what it
/// looks at is free.
///
/// It sends probes as large as its body ahead and, half as far, to the sides. Where one leaves the container it turns
/// away, along the part of the normal that is at right angles to its way, the more the nearer that is; it brakes where
/// turning is not enough, and comes back from the wrong side.
///
/// ```
/// use glam::Vec3;
/// use throng::motion::Motion;
/// use throng::space::surface::Sphere;
/// use throng::steer::{Behaviour, Contain, View, Why};
///
/// let bowl = Contain::inside(Sphere::new(Vec3::ZERO, 3.0)?);
/// let steer = |x: f32| {
///     let motion = Motion::moving(Vec3::X * x, Vec3::new(1.0, 0.5, 0.0));
///     bowl.steer(&View { motion, ..View::default() }, &mut [], &mut Why::default())
/// };
/// assert_eq!(steer(0.0), None);
/// let turn = steer(2.0).expect("the rim is near").force;
/// assert!(turn.x < 0.0 || turn.y < 0.0);
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Contain {
    /// The surface, and the side to stay on.
    pub barrier: Barrier<Arc<dyn Surface>>,
    /// How far ahead it looks, seconds at its present speed; farther if it turns slowly. Limit: > 0.
    pub seconds: f32,
    /// How far to the sides its other probes point, radians. Limit: 0 to pi.
    pub angle: f32,
    /// How far from the surface its body stays, metres. Limit: >= 0.
    pub gap: f32,
}

impl Contain {
    /// Inside a solid.
    pub fn inside(surface: impl Surface + 'static) -> Self {
        Self::on_side(surface, SeenFrom::Inside)
    }

    /// On one side of a surface, or on the one where it is.
    pub fn on_side(surface: impl Surface + 'static, side: SeenFrom) -> Self {
        Self { barrier: Barrier::new(Arc::new(surface), side), seconds: 1.0, angle: 0.6, gap: 0.1 }
    }
}

impl Behaviour for Contain {
    fn steer(&self, view: &View<'_>, _: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let course = Course::new(view, self.gap, self.seconds);
        let basis = course.basis;
        let mut probe = |axis, angle, part: f32| {
            let (reach, direction) = (course.reach * part, turned(basis.forward, axis, angle));
            why.note(|| Reason::Feels(view.position() + direction * reach));
            let hit = self.barrier.ahead(view.position(), direction, course.radius, reach)?;
            Some((hit, 1.0 - hit.distance / reach.max(f32::MIN_POSITIVE)))
        };
        let axes = if view.is_on_ground() { &[basis.up][..] } else { &[basis.up, basis.side] };
        let beside = axes.iter().flat_map(|&axis| [self.angle, -self.angle].map(|angle| (axis, angle, 0.5)));
        let probes = beside.chain([(basis.side, 0.0, 1.0)]);
        let hits: Vec<_> = probes.filter_map(|(axis, angle, part)| probe(axis, angle, part)).collect();
        let &(hit, urgency) = hits.iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
        why.note(|| Reason::Expects(hit.point));
        if self.barrier.forbids(hit.vehicle_outside) {
            return view.go(view.passable(hit.steer_hint));
        }
        let force = course.aside(hit.free()) * (view.vehicle.max_force * urgency);
        let here = self.barrier.surface.query(view.position());
        let surfaces = hits.iter().map(|(hit, _)| (hit.point, hit.free()));
        Some(course.held_off(force, surfaces.chain([(here.point, here.free())])))
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless_positive("horizon", self.seconds)?;
        Error::unless((0.0..=PI).contains(&self.angle), "angle of the probes", self.angle, "from 0 to pi")?;
        Error::unless(self.gap >= 0.0, "gap", self.gap, "0 or more")
    }
}
