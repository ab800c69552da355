//! Containment: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use super::course::Course;
use glam::Vec3;
use std::f32::consts::PI;
use std::sync::Arc;
use throng::Error;
use throng::motion::{Basis, Steering, turned};
use throng::space::surface::{Barrier, PathIntersection, SeenFrom, Surface};
use throng::steer::{Behaviour, SteeringInput, SteeringReason, TraceRecorder};

/// Stays on one side of a surface: within a room, an aquarium, a cage of any shape. Nothing to correct while all probes
/// are free.
///
/// The behaviour sends probes as large as the body ahead and, half as far, to the sides. Where a probe leaves the
/// container, the agent turns away along the component of the normal at right angles to its course, the more the nearer
/// the surface is. The agent brakes where turning is not enough, and comes back from the wrong side.
///
/// ```
/// use glam::Vec3;
/// use throng::motion::Motion;
/// use throng::space::surface::Sphere;
/// use throng::steer::{Behaviour, SteeringInput, TraceRecorder};
/// use throng_steer::Contain;
///
/// let bowl = Contain::inside(Sphere::new(Vec3::ZERO, 3.0)?);
/// let steer = |x: f32| {
///     let motion = Motion::moving(Vec3::X * x, Vec3::new(1.0, 0.5, 0.0));
///     bowl.steer(&SteeringInput { motion, ..SteeringInput::default() }, &mut [], &mut TraceRecorder::default())
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
    /// How far ahead it looks, seconds at the present speed; farther if the agent turns slowly. Limit: > 0.
    pub seconds: f32,
    /// Angle of the other probes to the sides, radians. Limit: 0 to pi.
    pub angle: f32,
    /// Distance between the body and the surface, metres. Limit: >= 0.
    pub gap: f32,
}

impl Contain {
    /// Returns the containment inside a solid.
    pub fn inside(surface: impl Surface + 'static) -> Self {
        Self::on_side(surface, SeenFrom::Inside)
    }

    /// Returns the containment on one side of a surface, or on the side where the agent is.
    pub fn on_side(surface: impl Surface + 'static, side: SeenFrom) -> Self {
        Self { barrier: Barrier::new(Arc::new(surface), side), seconds: 1.0, angle: 0.6, gap: 0.1 }
    }
}

impl Behaviour for Contain {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let course = Course::new(view, self.gap, self.seconds);
        let Basis { forward, side, up } = course.basis;
        let angle = self.angle;
        let probes = [(side, angle, 0.5), (side, -angle, 0.5), (up, angle, 0.5), (up, -angle, 0.5), (up, 0.0, 1.0)];
        let probes = if view.is_on_ground() { &probes[2..] } else { &probes };
        let mut touches = [None; 5];
        for (touch, &(axis, angle, part)) in touches.iter_mut().zip(probes) {
            let (direction, reach) = (turned(forward, axis, angle), course.reach * part);
            why.note(|| SteeringReason::Feels(view.position() + direction * reach));
            *touch = self.feel(&course, view, direction, reach);
        }
        let touches = touches.iter().flatten();
        let Touch { hit, urgency, .. } = touches.clone().max_by(|a, b| a.urgency.total_cmp(&b.urgency))?;
        why.note(|| SteeringReason::Expects(hit.point));
        if self.barrier.forbids(hit.vehicle_outside) {
            return view.go(view.passable(hit.steer_hint));
        }
        let force = course.aside(hit.free()) * (view.vehicle.max_force * urgency);
        let here = self.barrier.surface.query(view.position());
        let ahead = touches.flat_map(|touch| [touch.hit, touch.beyond]).map(|hit| (hit.point, hit.free()));
        Some(course.held_off(force, ahead.chain([(here.point, here.free())])))
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless_positive("horizon", self.seconds)?;
        Error::unless((0.0..=PI).contains(&self.angle), "angle of the probes", self.angle, "from 0 to pi")?;
        Error::unless(self.gap >= 0.0, "gap", self.gap, "0 or more")
    }
}

/// The contact of a probe.
#[derive(Clone, Copy)]
struct Touch {
    hit: PathIntersection,
    /// The intersection of the probe's axis, or `hit` if there is none.
    beyond: PathIntersection,
    /// 0 to 1, greater for a nearer contact.
    urgency: f32,
}

impl Contain {
    /// Returns the contact of a probe in a direction.
    fn feel(&self, course: &Course<'_>, view: &SteeringInput<'_>, direction: Vec3, reach: f32) -> Option<Touch> {
        let touch = |radius| self.barrier.ahead(view.position(), direction, radius, reach);
        let hit = touch(course.radius)?;
        // within the gap of one wall of a corner the probe touches that wall, wherever it points, and not the other
        let beyond = touch(0.0).unwrap_or(hit);
        Some(Touch { hit, beyond, urgency: 1.0 - hit.distance / reach.max(f32::MIN_POSITIVE) })
    }
}
