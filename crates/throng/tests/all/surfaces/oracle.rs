//! The required answers of every surface, by samples of its boundary and a formula of its inside.

use glam::{Quat, Vec3};
use proptest::prelude::*;
use throng::space::surface::{Moved, Pose, Surface, Sweep};

/// A surface with independent knowledge about it.
pub struct Known {
    pub surface: Box<dyn Surface>,
    /// Points of the boundary.
    pub samples: Vec<Vec3>,
    /// Greatest distance of a boundary point from its nearest sample.
    pub cover: f32,
    /// Whether a point is inside; `None` for sheets.
    pub inside: Option<Box<dyn Fn(Vec3) -> bool>>,
}

impl std::fmt::Debug for Known {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.surface.fmt(f)
    }
}

impl Known {
    pub fn solid(
        surface: impl Surface + 'static,
        samples: Vec<Vec3>,
        cover: f32,
        inside: impl Fn(Vec3) -> bool + 'static,
    ) -> Self {
        Self { surface: Box::new(surface), samples, cover, inside: Some(Box::new(inside)) }
    }

    /// Rotates and moves the surface.
    pub fn moved(self, position: Vec3, rotation: Quat) -> Self {
        let pose = Pose::new(position, rotation).unwrap();
        let back = rotation.inverse();
        let inside = self
            .inside
            .map(|inside| Box::new(move |p: Vec3| inside(back * (p - position))) as Box<dyn Fn(Vec3) -> bool>);
        let samples = self.samples.into_iter().map(|p| rotation * p + position).collect();
        Self { surface: Box::new(Moved::new(self.surface, pose)), samples, cover: self.cover, inside }
    }

    /// Checks that the nearest point is on the boundary, that no sample is nearer, and that the sides differ.
    pub fn check_query(&self, p: Vec3) -> Result<(), TestCaseError> {
        let near = self.surface.query(p);
        let sampled = self.samples.iter().map(|s| s.distance(p)).fold(f32::INFINITY, f32::min);
        let distance = near.distance.abs();
        prop_assert!(distance <= sampled + 1e-4, "a sample is nearer: {sampled}, not {near:?}");
        prop_assert!(distance >= sampled - self.cover, "nothing is that near: {sampled}, not {near:?}");
        prop_assert!((near.point + near.normal * near.distance).distance(p) < 1e-4, "{near:?} does not lead to {p}");
        prop_assert!((near.normal.length() - 1.0).abs() < 1e-5);
        prop_assert!(self.surface.bounds().distance(near.point) < 1e-4);
        match &self.inside {
            None => prop_assert!(near.distance >= 0.0),
            Some(inside) => {
                prop_assert!(distance < 1e-4 || near.is_inside() == inside(p), "{near:?} on the wrong side");
                let around: Vec<bool> = ball(300).map(|v| inside(near.point + v * 1e-3)).collect();
                let across = around.contains(&true) && around.contains(&false);
                prop_assert!(across, "{near:?} is not on the boundary");
            }
        }
        Ok(())
    }

    /// Checks that the signed distance changes by no more than the distance between two points.
    pub fn check_slope(&self, p: Vec3, q: Vec3) -> Result<(), TestCaseError> {
        let change = self.surface.query(p).distance - self.surface.query(q).distance;
        prop_assert!(change.abs() <= p.distance(q) + 1e-4, "{change} on {}", p.distance(q));
        Ok(())
    }

    /// Checks a ball step by step: it stays off the surface until the hit, and is at its radius from the surface there.
    pub fn check_way(&self, sweep: &Sweep) -> Result<(), TestCaseError> {
        let start = self.surface.query(sweep.origin);
        let hit = self.surface.sweep(sweep);
        let gap = |t: f32| {
            let near = self.surface.query(sweep.at(t));
            let same_side = near.is_inside() == start.is_inside();
            if same_side { near.distance.abs() - sweep.radius } else { -near.distance.abs() - sweep.radius }
        };
        if gap(0.0) <= 1e-3 {
            // touching at the start: a later hit is no deeper than the start
            if let Some(hit) = hit {
                prop_assert!(hit.distance == 0.0 || gap(hit.distance) <= 1e-3, "{hit:?}");
            }
            return Ok(());
        }
        let end = hit.map_or(sweep.reach, |hit| hit.distance);
        let steps = (end / 0.02) as u32;
        for step in 0..steps {
            let t = step as f32 * 0.02;
            prop_assert!(gap(t) > -2e-3, "touched at {t} already, gap {}: {hit:?}", gap(t));
        }
        if let Some(hit) = hit {
            prop_assert!(gap(hit.distance).abs() < 1e-3, "does not touch: gap {} at {hit:?}", gap(hit.distance));
            prop_assert_eq!(hit.from_outside, !start.is_inside());
        }
        Ok(())
    }

    /// Checks the same, and that the hit point is on the surface and faces the ball.
    pub fn check_sweep(&self, sweep: &Sweep) -> Result<(), TestCaseError> {
        self.check_way(sweep)?;
        let apart = self.surface.query(sweep.origin).distance.abs() > sweep.radius + 1e-3;
        let Some(hit) = self.surface.sweep(sweep).filter(|_| apart) else { return Ok(()) };
        let at = sweep.at(hit.distance);
        prop_assert!(self.surface.query(hit.point).distance.abs() < 1e-3, "not on the surface: {hit:?}");
        prop_assert!((hit.point.distance(at) - sweep.radius).abs() < 1e-3, "not touched: {hit:?}");
        let facing = if hit.from_outside { hit.normal } else { -hit.normal };
        prop_assert!(facing.dot(sweep.direction) < 1e-3, "moves away from it: {hit:?}");
        if sweep.radius > 0.05 {
            prop_assert!(
                (at - hit.point).normalize().dot(facing) > 0.99,
                "the normal is not that of the ball: {hit:?}"
            );
        }
        Ok(())
    }
}

/// A point at most this far from the origin along each axis.
pub fn point(reach: f32) -> impl Strategy<Value = Vec3> {
    (-reach..reach, -reach..reach, -reach..reach).prop_map(|(x, y, z)| Vec3::new(x, y, z))
}

pub fn direction() -> impl Strategy<Value = Vec3> {
    let axis = prop_oneof![Just(Vec3::X), Just(-Vec3::Y), Just(Vec3::Z)];
    prop_oneof![4 => point(1.0).prop_map(|v| v.normalize_or(Vec3::X)), 1 => axis]
}

pub fn rotation() -> impl Strategy<Value = Quat> {
    let turned = (direction(), 0.0f32..6.0).prop_map(|(axis, angle)| Quat::from_axis_angle(axis, angle));
    prop_oneof![1 => Just(Quat::IDENTITY), 4 => turned]
}

pub fn sweep() -> impl Strategy<Value = Sweep> {
    (point(7.0), direction(), prop_oneof![Just(0.0f32), 0.01f32..1.5]).prop_map(|(origin, direction, radius)| Sweep {
        origin,
        direction,
        radius,
        reach: 15.0,
    })
}

/// Points evenly spread on a unit sphere, with no gap wider than about 2.5 / sqrt(count).
pub fn ball(count: usize) -> impl Iterator<Item = Vec3> {
    let golden = std::f32::consts::PI * (3.0 - 5.0f32.sqrt());
    (0..count).map(move |i| {
        let z = 1.0 - (2 * i + 1) as f32 / count as f32;
        let (sin, cos) = (golden * i as f32).sin_cos();
        let ring = (1.0 - z * z).sqrt();
        Vec3::new(cos * ring, sin * ring, z)
    })
}

/// Points of the parallelogram from `corner` along two sides, `n` by `n` cells.
pub fn sheet(corner: Vec3, along: Vec3, across: Vec3, n: u32) -> impl Iterator<Item = Vec3> {
    let part = move |k: u32| k as f32 / n as f32;
    (0..=n).flat_map(move |i| (0..=n).map(move |j| corner + along * part(i) + across * part(j)))
}
