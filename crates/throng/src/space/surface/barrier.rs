//! Surfaces as obstacles and containers: from which side they are seen, and what a vehicle sees ahead of it.

use super::{Surface, SurfaceHit, Sweep};
use glam::Vec3;

/// From where a surface is seen. Sheets have an outside only.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SeenFrom {
    /// An obstacle: who is outside stays outside, who is inside wants out.
    #[default]
    Outside,
    /// A container: who is inside stays inside, who is outside wants in.
    Inside,
    /// Hollow: everybody stays on the side they are on.
    Both,
}

/// A surface that steering keeps to one side of: what OpenSteer calls an obstacle.
#[derive(Clone, Debug, PartialEq)]
pub struct Barrier<S> {
    /// The surface.
    pub surface: S,
    /// From where it is seen.
    pub seen_from: SeenFrom,
}

/// How much room there is at a point on the free side of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Room {
    /// Distance from the surface, metres: negative on the wrong side. From one point to another it changes by no more
    /// than they are apart.
    pub distance: f32,
    /// Unit vector along which that grows fastest.
    pub out: Vec3,
}

/// What a vehicle meets on its forward axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathIntersection {
    /// How far the vehicle can go until it touches, metres: 0 if it is on the wrong side.
    pub distance: f32,
    /// The point of the surface that it touches, or the nearest if it is on the wrong side.
    pub point: Vec3,
    /// Unit normal there, out of the solid; of a sheet, to the vehicle's side.
    pub normal: Vec3,
    /// Unit vector to steer along: across the forward axis to where there is room; at distance 0, away from the surface
    /// to the side where it should be.
    pub steer_hint: Vec3,
    /// Whether the vehicle's centre is outside the solid now.
    pub vehicle_outside: bool,
}

impl PathIntersection {
    /// The normal on the vehicle's side of the surface.
    pub fn free(&self) -> Vec3 {
        if self.vehicle_outside { self.normal } else { -self.normal }
    }
}

/// Sine of the angle to the normal below which a vehicle heads straight at a surface: the normal says no side then.
const HEAD_ON: f32 = 0.05;

impl<S: Surface> Barrier<S> {
    /// A surface seen from one side, or both.
    pub fn new(surface: S, seen_from: SeenFrom) -> Self {
        Self { surface, seen_from }
    }

    /// Whether who is outside, or inside, is on the wrong side.
    pub fn forbids(&self, outside: bool) -> bool {
        match self.seen_from {
            SeenFrom::Outside => !outside,
            SeenFrom::Inside => outside,
            SeenFrom::Both => false,
        }
    }

    /// How much room there is at a point: its distance from the surface, and where that grows.
    pub fn room(&self, point: Vec3) -> Room {
        let near = self.surface.query(point);
        match self.seen_from {
            SeenFrom::Outside => Room { distance: near.distance, out: near.normal },
            SeenFrom::Inside => Room { distance: -near.distance, out: -near.normal },
            SeenFrom::Both => Room { distance: near.distance.abs(), out: near.free() },
        }
    }

    /// What a vehicle meets first within `reach` metres: a ball of this radius, metres, at `position`, that goes along
    /// `forward`, of any length. Without a direction it meets only what it touches already.
    ///
    /// Reynolds' obstacle avoidance (1999), with the answer of OpenSteer's `PathIntersection`, and these differences:
    /// the radius counts for every shape, in all directions; who starts on the wrong side gets the way back as a hint;
    /// who heads straight at a surface is sent round its nearer side, straight at its middle to the right.
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
        let hit = self.surface.sweep(&Sweep { origin: position, direction, radius, reach })?;
        let SurfaceHit { distance, point, normal, .. } = hit;
        let free = away(normal, vehicle_outside);
        let steer_hint = if distance > 0.0 { self.round(point, free, direction, vehicle_outside) } else { free };
        Some(PathIntersection { distance, point, normal, steer_hint, vehicle_outside })
    }

    /// To which side of the forward axis there is room: that of the normal; else away from the middle of an obstacle,
    /// or to the middle of a container; else to the right.
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
        // a middle within rounding of the axis says nothing
        if from_middle.length() <= 1e-4 * (bounds.high - bounds.low).max_element() {
            return right;
        }
        if outside { from_middle.normalize() } else { -from_middle.normalize() }
    }
}
