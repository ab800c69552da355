//! Forbidden and permitted velocities as polygons.

use glam::Vec2;
use throng::avoid::{AvoidanceReason, Cause, Forbidden, HalfPlane};

/// The number of corners of a circle.
const ROUND: usize = 180;
/// The number of edges of a rounded tip.
const TIP: usize = 48;

/// Returns the velocities that a reason forbids, within coordinates of at most `reach`; `None` for pushes and
/// candidates, and if it forbids no velocity in this square.
pub(crate) fn forbidden(reason: &AvoidanceReason, reach: f32) -> Option<(Cause, Vec<Vec2>)> {
    let (cause, within) = match *reason {
        AvoidanceReason::Permits(cause, line) => (cause, vec![reversed(line)]),
        AvoidanceReason::Forbids(cause, region) => (cause, bounds(&region)),
        AvoidanceReason::Push(..) | AvoidanceReason::Candidate { .. } => return None,
    };
    let square = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|corner| Vec2::from(corner) * reach);
    let polygon = within.into_iter().fold(square.to_vec(), clip);
    (polygon.len() >= 3).then_some((cause, polygon))
}

/// Returns the velocities within `speed` that all reasons permit. Returns `None` if the reasons are not all
/// half-planes, because the region need not be convex then, or if there is no reason. Returns an empty polygon if no
/// velocity is permitted.
pub(super) fn permitted(reasons: &[AvoidanceReason], speed: f32) -> Option<Vec<Vec2>> {
    let lines: Option<Vec<HalfPlane>> = reasons
        .iter()
        .map(|reason| match *reason {
            AvoidanceReason::Permits(_, line) | AvoidanceReason::Forbids(_, Forbidden::RightOf(line)) => Some(line),
            _ => None,
        })
        .collect();
    let lines = lines.filter(|lines| !lines.is_empty())?;
    let angle = |i: usize| i as f32 * (std::f32::consts::TAU / ROUND as f32);
    let disc = (0..ROUND).map(|i| Vec2::from_angle(angle(i)) * speed).collect();
    Some(lines.into_iter().fold(disc, clip))
}

/// Returns lines that have the region as their common left side. All regions are convex.
fn bounds(region: &Forbidden) -> Vec<HalfPlane> {
    match *region {
        Forbidden::Cone { apex, right, left } => {
            vec![HalfPlane { point: apex, direction: right }, HalfPlane { point: apex, direction: -left }]
        }
        Forbidden::Truncated { apex, right, left, center, radius } => {
            // Around the tip from leg to leg.
            let (first, last) = (left.perp(), -right.perp());
            let sweep = first.angle_to(last);
            let normals = (0..=TIP).map(|k| Vec2::from_angle(sweep * k as f32 / TIP as f32).rotate(first));
            let tip = normals.map(|normal| HalfPlane { point: center + normal * radius, direction: normal.perp() });
            tip.chain(bounds(&Forbidden::Cone { apex, right, left })).collect()
        }
        Forbidden::RightOf(line) => vec![reversed(line)],
    }
}

fn reversed(line: HalfPlane) -> HalfPlane {
    HalfPlane { direction: -line.direction, ..line }
}

/// Returns the part of a convex polygon on a line or left of it (Sutherland, Hodgman, 1974).
pub(crate) fn clip(polygon: Vec<Vec2>, line: HalfPlane) -> Vec<Vec2> {
    let mut out = Vec::with_capacity(polygon.len() + 1);
    for (i, &to) in polygon.iter().enumerate() {
        let from = polygon[(i + polygon.len() - 1) % polygon.len()];
        let (a, b) = (line.violation(from), line.violation(to));
        if (a > 0.0) != (b > 0.0) {
            out.push(from + (to - from) * (a / (a - b)));
        }
        if b <= 0.0 {
            out.push(to);
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether `v` is inside a convex polygon in counter-clockwise order.
    fn holds(polygon: &[Vec2], v: Vec2) -> bool {
        let sides = polygon.iter().enumerate();
        let mut sides = sides.map(|(i, &a)| (polygon[(i + 1) % polygon.len()] - a).perp_dot(v - a));
        !polygon.is_empty() && sides.all(|side| side >= 0.0)
    }

    fn grid() -> impl Iterator<Item = Vec2> {
        (0..40 * 40).map(|k| Vec2::new((k % 40) as f32, (k / 40) as f32) * 0.1 - Vec2::splat(1.951))
    }

    #[test]
    fn polygons_hold_the_forbidden_velocities() {
        let (right, left) = (Vec2::from_angle(0.3), Vec2::from_angle(1.4));
        let line = HalfPlane { point: Vec2::new(0.2, -0.4), direction: Vec2::from_angle(2.0) };
        let apex = Vec2::new(-0.5, 0.1);
        // The disc touches both legs.
        let center = apex + (right + left).normalize() * 0.8;
        let radius = right.perp_dot(center - apex);
        let regions = [
            Forbidden::Cone { apex, right, left },
            Forbidden::RightOf(line),
            Forbidden::Truncated { apex, right, left, center, radius },
        ];
        for region in regions {
            let reason = AvoidanceReason::Forbids(Cause::Neighbour(0), region);
            let (_, polygon) = forbidden(&reason, 2.0).unwrap();
            // The rounded tip is approximated by a polygon.
            for v in grid().filter(|&v| region.depth(v).abs() > 1e-3) {
                assert_eq!(holds(&polygon, v), region.depth(v) >= 0.0, "{v} in {region:?}");
            }
        }
        let permits = AvoidanceReason::Permits(Cause::Edge(0), line);
        assert_eq!(forbidden(&permits, 2.0), forbidden(&AvoidanceReason::Forbids(Cause::Edge(0), regions[1]), 2.0));
    }

    #[test]
    fn half_planes_leave_a_polygon() {
        let lines = [0.4, 2.0, 3.5].map(|angle| {
            let direction = Vec2::from_angle(angle);
            HalfPlane { point: direction.perp() * -0.3, direction }
        });
        let reasons = lines.map(|line| AvoidanceReason::Permits(Cause::Neighbour(0), line));
        let polygon = permitted(&reasons, 1.5).unwrap();
        for v in grid().filter(|v| (v.length() - 1.5).abs() > 1e-3) {
            let free = v.length() < 1.5 && lines.iter().all(|line| line.violation(v) <= 0.0);
            assert_eq!(holds(&polygon, v), free, "{v}");
        }
        let away = HalfPlane { point: Vec2::new(0.0, 3.0), direction: Vec2::X };
        assert_eq!(
            permitted(&[AvoidanceReason::Permits(Cause::Body, away)], 1.5),
            Some(vec![]),
            "no velocity is permitted"
        );
        assert_eq!(permitted(&[], 1.5), None);
    }
}
