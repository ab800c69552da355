//! Shapes with a direction: tapering blades and arrow heads.

use crate::Color;
use crate::primitive::Primitive;
use glam::Vec2;

/// Returns a line through points as one shape; each point has half the line's width there.
pub(super) fn blade(points: &[(Vec2, f32)], fill: Color) -> Option<Primitive> {
    if points.len() < 2 {
        return None;
    }
    let along = |index: usize| {
        let (before, after) = (points[index.saturating_sub(1)].0, points[(index + 1).min(points.len() - 1)].0);
        (after - before).normalize_or_zero()
    };
    let side = |index: usize| along(index).perp() * points[index].1;
    let left = (0..points.len()).map(|index| points[index].0 + side(index));
    let right = (0..points.len()).rev().map(|index| points[index].0 - side(index));
    let ring: Vec<Vec2> = left.chain(right).collect();
    ring.iter().all(|corner| corner.is_finite()).then_some(Primitive::Area { rings: vec![ring], fill })
}

/// Returns a slim arrow head with its tip at `tip` and a notch at its back.
pub(super) fn head(tip: Vec2, along: Vec2, length: f32) -> Vec<Vec2> {
    let (back, side) = (tip - along * length, along.perp() * (0.36 * length));
    vec![tip, back + side, back + along * (0.25 * length), back - side]
}

/// Returns an arrow as one shape: a shaft that begins thin, and a head. The tip is at `to`.
pub(super) fn arrow(from: Vec2, to: Vec2, half: f32, fill: Color) -> Option<Primitive> {
    let length = from.distance(to);
    let along = (to - from).try_normalize().filter(|_| from.is_finite() && length.is_finite())?;
    let size = (6.5 * half).min(0.6 * length);
    let half = half.min(0.15 * size);
    let (side, neck) = (along.perp(), to - along * (0.75 * size));
    let [tip, left, _, right] = head(to, along, size)[..] else { return None };
    let shaft = [neck + side * half, from + side * (0.45 * half), from - side * (0.45 * half), neck - side * half];
    let [a, b, c, d] = shaft;
    Some(Primitive::Area { rings: vec![vec![tip, left, a, b, c, d, right]], fill })
}
