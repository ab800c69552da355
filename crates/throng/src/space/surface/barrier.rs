//! Surfaces as obstacles and containers: the side on which agents are, and the first obstacle ahead of a vehicle.

use super::sweep::rounding;
use super::{Surface, SurfaceHit, Sweep};
use glam::Vec3;

/// The side from which a surface is seen. Sheets have an outside only.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SeenFrom {
    /// An obstacle: agents outside stay outside, agents inside move out.
    #[default]
    Outside,
    /// A container: agents inside stay inside, agents outside move in.
    Inside,
    /// Hollow: agents stay on the side on which they are.
    Both,
}

/// A surface with the side on which agents must be: an obstacle in OpenSteer.
#[derive(Clone, Debug, PartialEq)]
pub struct Barrier<S> {
    /// The surface.
    pub surface: S,
    /// The side from which it is seen.
    pub seen_from: SeenFrom,
}

/// The clearance at a point on the free side of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BarrierClearance {
    /// Distance from the surface, metres; negative on the wrong side. Between two points it changes by at most their
    /// distance.
    pub distance: f32,
    /// Unit vector along which the distance grows fastest.
    pub out: Vec3,
}

/// The first contact of a vehicle along its forward axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathIntersection {
    /// Distance that the vehicle can move before the contact, metres; 0 if it is on the wrong side.
    pub distance: f32,
    /// The point of contact, or the nearest point of the surface if the vehicle is on the wrong side.
    pub point: Vec3,
    /// Unit normal there, out of the solid; for a sheet, to the vehicle's side.
    pub normal: Vec3,
    /// Unit vector to steer along: across the forward axis towards free space. At distance 0 it leads away from the
    /// surface to the side on which the vehicle should be.
    pub steer_hint: Vec3,
    /// Whether the vehicle's centre is outside the solid now.
    pub vehicle_outside: bool,
}

impl PathIntersection {
    /// Returns the normal on the vehicle's side of the surface.
    pub fn free(&self) -> Vec3 {
        if self.vehicle_outside { self.normal } else { -self.normal }
    }
}

/// Sine of the angle between heading and normal below which a vehicle heads straight at a surface: then the normal does
/// not determine a side.
const HEAD_ON: f32 = 0.05;

impl<S: Surface> Barrier<S> {
    /// Returns a barrier of a surface seen from one side, or both.
    pub fn new(surface: S, seen_from: SeenFrom) -> Self {
        Self { surface, seen_from }
    }

    /// Whether an agent outside (or inside) is on the wrong side.
    pub fn forbids(&self, outside: bool) -> bool {
        match self.seen_from {
            SeenFrom::Outside => !outside,
            SeenFrom::Inside => outside,
            SeenFrom::Both => false,
        }
    }

    /// Returns the clearance at a point: the distance from the surface, and the direction in which it grows.
    pub fn room(&self, point: Vec3) -> BarrierClearance {
        let near = self.surface.query(point);
        match self.seen_from {
            SeenFrom::Outside => BarrierClearance { distance: near.distance, out: near.normal },
            SeenFrom::Inside => BarrierClearance { distance: -near.distance, out: -near.normal },
            SeenFrom::Both => BarrierClearance { distance: near.distance.abs(), out: near.free() },
        }
    }

    /// Returns the first contact within `reach` metres of a vehicle, a ball of this radius, metres, at `position`, that
    /// moves along `forward`, of any length. If `forward` has length zero, only a contact at the start counts.
    ///
    /// Reynolds' obstacle avoidance (1999), with the result of OpenSteer's `PathIntersection`, and these differences.
    /// The radius counts for every shape, in all directions. A vehicle that starts on the wrong side gets the way back
    /// as a hint. A vehicle that heads straight at a surface is directed round its nearer side, or to the right if it
    /// heads straight at the centre.
    pub fn ahead(&self, position: Vec3, forward: Vec3, radius: f32, reach: f32) -> Option<PathIntersection> {
        let here = self.surface.query(position);
        let vehicle_outside = !here.is_inside();
        let away = |normal: Vec3, outside: bool| if outside { normal } else { -normal };
        let wrong_side = self.forbids(vehicle_outside);
        let back = PathIntersection {
            distance: 0.0,
            point: here.point,
            normal: here.normal,
            steer_hint: away(here.normal, vehicle_outside != wrong_side),
            vehicle_outside,
        };
        if wrong_side {
            return Some(back);
        }
        let Some(direction) = forward.try_normalize() else {
            return (here.distance.abs() <= radius).then_some(back);
        };
        // the distance changes by at most the length of the motion
        if here.distance.abs() > (radius + reach) * (1.0 + 1e-5) + 16.0 * rounding(position) {
            return None;
        }
        let sweep = Sweep { origin: position, direction, radius, reach };
        let SurfaceHit { distance, point, normal, .. } = self.surface.sweep(&sweep)?;
        let free = away(normal, vehicle_outside);
        let steer_hint = if distance > 0.0 { self.round(point, free, direction, vehicle_outside) } else { free };
        Some(PathIntersection { distance, point, normal, steer_hint, vehicle_outside })
    }

    /// Returns the direction across the forward axis towards free space: that of the normal; else away from the centre
    /// of an obstacle, or to the centre of a container; else to the right.
    fn round(&self, point: Vec3, free: Vec3, forward: Vec3, outside: bool) -> Vec3 {
        let across = |v: Vec3| v - forward * v.dot(forward);
        let right = Vec3::new(forward.y, -forward.x, 0.0).normalize_or(Vec3::X);
        let side = across(free);
        if side.length() >= HEAD_ON {
            return side.normalize();
        }
        let bounds = self.surface.bounds();
        if !bounds.is_finite() {
            return right;
        }
        let from_middle = across(point - bounds.center());
        // if the centre is within rounding of the axis it does not determine a side
        if from_middle.length() <= 1e-4 * (bounds.high - bounds.low).max_element() {
            return right;
        }
        if outside { from_middle.normalize() } else { -from_middle.normalize() }
    }
}
