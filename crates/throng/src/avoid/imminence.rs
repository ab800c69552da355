//! Imminence of a collision: the inverse of the time to collision, smooth where bodies graze, with its gradient
//! (Karamouzas, Sohre, Narain, Guy, Implicit crowds, ACM Transactions on Graphics 36(4), 2017, section 4).
//!
//! A body moves with a relative velocity `u` for a step and then keeps it until the collision. The inverse time is 0 if
//! there is no collision and grows without bound towards contact. Unlike the time itself it is a differentiable
//! function of `u`: it falls off linearly outside the relative velocities that touch within the fraction `grazing` of
//! the radii. The gradient is with respect to `u` and includes the effect of `u` on the position after the step.

use glam::Vec2;

/// A gap less than this fraction of the radii is treated as that fraction. It keeps values finite at contact.
pub(super) const LEAST_GAP: f32 = 0.025;

/// Inverse time, 1/s, and its gradient with respect to the relative velocity.
pub(super) type Imminence = (f32, Vec2);

/// Returns the imminence of the event that a point with the relative velocity comes within `radii` of `offset`, after a
/// step of `step` seconds.
pub(super) fn of_disc(offset: Vec2, velocity: Vec2, radii: f32, step: f32, grazing: f32) -> Imminence {
    let least = radii * (1.0 + LEAST_GAP);
    let there = offset - velocity * step;
    let distance = there.length();
    let outward = if distance > 0.0 { there / distance } else { offset.normalize_or(Vec2::X) };
    let apart = distance >= least;
    // in contact only the direction to the neighbour counts
    let (x, d) = if apart { (there, distance) } else { (outward * least, least) };
    let approach = x.dot(velocity);
    if approach <= 0.0 {
        return (0.0, Vec2::ZERO);
    }
    let q = d * d - radii * radii;
    let (closing, across) = (approach / d, x.perp_dot(velocity));
    let cosine = (1.0 - grazing * grazing).sqrt();
    // partial derivatives with respect to the velocity and to the place
    let (rate, by_velocity, by_place);
    if q.sqrt() * across.abs() / d <= cosine * radii * closing {
        let speed_squared = velocity.length_squared();
        let root = (approach * approach - speed_squared * q).max(0.0).sqrt().max(1e-9);
        rate = (approach + root) / q;
        by_velocity = (x + (x * approach - velocity * q) / root) / q;
        by_place = (velocity + (velocity * approach - x * speed_squared) / root - x * (2.0 * rate)) / q;
    } else {
        let (front, side) = (1.0 + radii / (grazing * d), cosine / grazing * q.sqrt() / d);
        rate = (approach * front - side * across.abs()) / q;
        if rate <= 0.0 {
            return (0.0, Vec2::ZERO);
        }
        let sign = across.signum();
        by_velocity = (x * front - x.perp() * (side * sign)) / q;
        let by_front = x * (-approach * radii / (grazing * d * d * d));
        let by_side = x * (side * across.abs() * (1.0 / q - 1.0 / (d * d))) - velocity.perp() * (side * sign);
        by_place = (velocity * front + by_front - by_side - x * (2.0 * rate)) / q;
    }
    let moved = if apart {
        by_place
    } else {
        (by_place - outward * outward.dot(by_place)) * (least / distance.max(radii * LEAST_GAP))
    };
    (rate, by_velocity - moved * step)
}

/// Returns the imminence of the event that a point with the velocity comes within `radius` of a segment, after a step
/// of `step` seconds.
pub(super) fn of_segment(start: Vec2, end: Vec2, velocity: Vec2, radius: f32, step: f32, grazing: f32) -> Imminence {
    let [a, b] = [start, end].map(|corner| of_disc(corner, velocity, radius, step, grazing));
    let corners = if b.0 > a.0 { b } else { a };
    let along = (end - start).normalize_or_zero();
    let towards = along.perp() * if along.perp_dot(start) >= 0.0 { 1.0 } else { -1.0 };
    let approach = towards.dot(velocity);
    if along == Vec2::ZERO || approach <= 0.0 {
        return corners;
    }
    let (least, gap) = (radius * LEAST_GAP, towards.dot(start) - radius - approach * step);
    let rate = approach / gap.max(least);
    let touched = along.dot(velocity * (step + 1.0 / rate) - start);
    if !(0.0..=end.distance(start)).contains(&touched) || corners.0 >= rate {
        return corners;
    }
    let by_place = if gap > least { rate * step } else { 0.0 };
    (rate, towards * ((1.0 + by_place) / gap.max(least)))
}
