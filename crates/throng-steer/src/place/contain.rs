//! Containment: Reynolds, Steering behaviors for autonomous characters, GDC 1999.

use super::course::Course;
use glam::Vec3;
use std::sync::Arc;
use throng::Error;
use throng::motion::{Basis, Steering, turned};
use throng::parameters::{Angle, Value, parameters};
use throng::space::surface::{Barrier, PathIntersection, SeenFrom, Surface};
use throng::steer::{Behaviour, SteeringInput, SteeringReason, TraceRecorder};

/// Stays on one side of a surface (Reynolds 1999).
///
/// Within a room, an aquarium, a cage of any shape: on the side from which the surface is seen. Nothing to correct while
/// all probes are free.
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
#[parameters]
#[derive(Clone, Debug)]
pub struct Contain {
    /// The name of the surface.
    #[parameter(required)]
    pub surface: Barrier<Arc<dyn Surface>>,
    /// How far ahead it looks, seconds; farther if it turns slowly.
    #[parameter(default = 1.0, unit = "s", above = 0)]
    pub horizon: f32,
    /// Angle of two further looks to the sides, half as far, degrees.
    #[parameter(default = Angle::from_radians(0.6), unit = "°", least = 0, most = 180)]
    pub angle: Angle,
    /// Gap between its body and the surface, metres.
    #[parameter(default = 0.1, unit = "m", least = 0)]
    pub gap: f32,
}

impl Contain {
    /// Returns the containment inside a solid.
    pub fn inside(surface: impl Surface + 'static) -> Self {
        Self::on_side(surface, SeenFrom::Inside)
    }

    /// Returns the containment on one side of a surface, or on the side where the agent is.
    pub fn on_side(surface: impl Surface + 'static, side: SeenFrom) -> Self {
        Self::new(Barrier::<Arc<dyn Surface>>::new(Arc::new(surface), side))
    }
}

impl Behaviour for Contain {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let course = Course::new(view, self.gap, self.horizon);
        let Basis { forward, side, up } = course.basis;
        let angle = self.angle.radians();
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
        why.note(|| SteeringReason::Hits { point: hit.point, normal: hit.free() });
        if self.surface.forbids(hit.vehicle_outside) {
            return view.go(view.passable(hit.steer_hint));
        }
        let force = course.aside(hit.free()) * (view.vehicle.max_force * urgency);
        let here = self.surface.surface.query(view.position());
        let ahead = touches.flat_map(|touch| [touch.hit, touch.beyond]).map(|hit| (hit.point, hit.free()));
        Some(course.held_off(force, ahead.chain([(here.point, here.free())])))
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
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
        let touch = |radius| self.surface.ahead(view.position(), direction, radius, reach);
        let hit = touch(course.radius)?;
        // within the gap of one wall of a corner the probe touches that wall, wherever it points, and not the other
        let beyond = touch(0.0).unwrap_or(hit);
        Some(Touch { hit, beyond, urgency: 1.0 - hit.distance / reach.max(f32::MIN_POSITIVE) })
    }
}
