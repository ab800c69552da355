//! What reasons forbid, and what they leave, as polygons of velocities.

use glam::Vec2;
use throng::avoid::{Cause, Forbidden, Line, Reason};

/// Corners of a circle.
const ROUND: usize = 180;
/// Edges of a rounded tip.
const TIP: usize = 48;

/// What a reason forbids of the velocities whose coordinates are at most `reach`; `None` for pushes, for candidates, and where it
/// forbids none of these.
pub(super) fn forbidden(reason: &Reason, reach: f32) -> Option<(Cause, Vec<Vec2>)> {
    let (cause, within) = match *reason {
        Reason::Permits(cause, line) => (cause, vec![reversed(line)]),
        Reason::Forbids(cause, region) => (cause, bounds(&region)),
        Reason::Push(..) | Reason::Candidate { .. } => return None,
    };
    let square = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|corner| Vec2::from(corner) * reach);
    let polygon = within.into_iter().fold(square.to_vec(), clip);
    (polygon.len() >= 3).then_some((cause, polygon))
}

/// What all reasons leave of the velocities within `speed`, where it is convex because each permits a half-plane; `None`
/// where it isn't, or where there is no reason. Empty where nothing is left.
pub(super) fn permitted(reasons: &[Reason], speed: f32) -> Option<Vec<Vec2>> {
    let lines: Option<Vec<Line>> = reasons
        .iter()
        .map(|reason| match *reason {
            Reason::Permits(_, line) | Reason::Forbids(_, Forbidden::RightOf(line)) => Some(line),
            _ => None,
        })
        .collect();
    let lines = lines.filter(|lines| !lines.is_empty())?;
    let angle = |i: usize| i as f32 * (std::f32::consts::TAU / ROUND as f32);
    let disc = (0..ROUND).map(|i| Vec2::from_angle(angle(i)) * speed).collect();
    Some(lines.into_iter().fold(disc, clip))
}

/// Lines that have a region on their left: all regions are convex.
fn bounds(region: &Forbidden) -> Vec<Line> {
    match *region {
        Forbidden::Cone { apex, right, left } => {
            vec![Line { point: apex, direction: right }, Line { point: apex, direction: -left }]
        }
        Forbidden::Truncated { apex, right, left, center, radius } => {
            // round the tip from leg to leg
            let (first, last) = (left.perp(), -right.perp());
            let sweep = first.angle_to(last);
            let normals = (0..=TIP).map(|k| Vec2::from_angle(sweep * k as f32 / TIP as f32).rotate(first));
            let tip = normals.map(|normal| Line { point: center + normal * radius, direction: normal.perp() });
            tip.chain(bounds(&Forbidden::Cone { apex, right, left })).collect()
        }
        Forbidden::RightOf(line) => vec![reversed(line)],
    }
}

fn reversed(line: Line) -> Line {
    Line { direction: -line.direction, ..line }
}

/// The part of a convex polygon on a line or left of it (Sutherland, Hodgman, 1974).
fn clip(polygon: Vec<Vec2>, line: Line) -> Vec<Vec2> {
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

    /// Whether `v` lies in a convex polygon that runs counter-clockwise.
    fn holds(polygon: &[Vec2], v: Vec2) -> bool {
        let sides = polygon.iter().enumerate();
        let mut sides = sides.map(|(i, &a)| (polygon[(i + 1) % polygon.len()] - a).perp_dot(v - a));
        !polygon.is_empty() && sides.all(|side| side >= 0.0)
    }

    fn grid() -> impl Iterator<Item = Vec2> {
        (0..40 * 40).map(|k| Vec2::new((k % 40) as f32, (k / 40) as f32) * 0.1 - Vec2::splat(1.951))
    }

    #[test]
    fn polygons_hold_what_reasons_forbid() {
        let (right, left) = (Vec2::from_angle(0.3), Vec2::from_angle(1.4));
        let line = Line { point: Vec2::new(0.2, -0.4), direction: Vec2::from_angle(2.0) };
        let apex = Vec2::new(-0.5, 0.1);
        // touches both legs
        let center = apex + (right + left).normalize() * 0.8;
        let radius = right.perp_dot(center - apex);
        let regions = [
            Forbidden::Cone { apex, right, left },
            Forbidden::RightOf(line),
            Forbidden::Truncated { apex, right, left, center, radius },
        ];
        for region in regions {
            let reason = Reason::Forbids(Cause::Neighbour(0), region);
            let (_, polygon) = forbidden(&reason, 2.0).unwrap();
            // a rounded tip has corners
            for v in grid().filter(|&v| region.depth(v).abs() > 1e-3) {
                assert_eq!(holds(&polygon, v), region.depth(v) >= 0.0, "{v} in {region:?}");
            }
        }
        let permits = Reason::Permits(Cause::Edge(0), line);
        assert_eq!(forbidden(&permits, 2.0), forbidden(&Reason::Forbids(Cause::Edge(0), regions[1]), 2.0));
    }

    #[test]
    fn half_planes_leave_a_polygon() {
        let lines = [0.4, 2.0, 3.5].map(|angle| {
            let direction = Vec2::from_angle(angle);
            Line { point: direction.perp() * -0.3, direction }
        });
        let reasons = lines.map(|line| Reason::Permits(Cause::Neighbour(0), line));
        let polygon = permitted(&reasons, 1.5).unwrap();
        for v in grid().filter(|v| (v.length() - 1.5).abs() > 1e-3) {
            let free = v.length() < 1.5 && lines.iter().all(|line| line.violation(v) <= 0.0);
            assert_eq!(holds(&polygon, v), free, "{v}");
        }
        let away = Line { point: Vec2::new(0.0, 3.0), direction: Vec2::X };
        assert_eq!(permitted(&[Reason::Permits(Cause::Body, away)], 1.5), Some(vec![]), "nothing is left");
        assert_eq!(permitted(&[], 1.5), None);
    }
}
