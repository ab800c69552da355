//! Reciprocal velocity obstacles as students implemented them: the algorithm of two lab reports (Zhejiang University,
//! 2020 and 2021), with its faults, to reproduce the reports and for comparison.
//!
//! A velocity is forbidden if it points into the cone of any neighbour, with the apex at the mean of the two
//! velocities, however far away the collision is. Candidates are the preferred velocity and 63 directions by 5 speeds.
//! The model takes the candidate nearest to the preferred velocity that is not forbidden. If all are forbidden the
//! agent stops, though its neighbours do not expect that. Obstacles are treated like neighbours that stand still, as if
//! they did half of the avoidance. That is why agents overlap by a few per cent, block each other, and tremble
//! ([`Rvo`](super::Rvo) does not).

use super::{
    AvoidanceInput, AvoidanceNeighbour, AvoidanceReason, Cause, Forbidden, LocalModel, Workspace, time_to_segment,
};
use crate::parameters::parameters;
use glam::Vec2;

/// Number of directions tried, and the angle between two of them, radians.
const DIRECTIONS: usize = 63;
const BETWEEN: f32 = 0.1;
/// Number of speeds tried, up to the preferred one.
const SPEEDS: usize = 5;
/// Range within which walls are considered, metres.
const WALL_RANGE: f32 = 5.0;

/// Reciprocal velocity obstacles as in two students' lab reports, with their faults, for comparison.
///
/// ```
/// use throng::{Group, avoid::RvoLab};
/// let group = Group { model: std::sync::Arc::new(RvoLab), look_ahead: false, keep_right: 0.0, ..Group::default() };
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RvoLab;

impl LocalModel for RvoLab {
    fn velocity(&self, view: &AvoidanceInput<'_>, workspace: &mut Workspace) -> Vec2 {
        choose(view, &mut workspace.forbidden, |_, _| ())
    }

    /// Returns false: the faults of the reports are to be seen.
    fn wants_guard(&self) -> bool {
        false
    }

    fn explain(&self, view: &AvoidanceInput<'_>, workspace: &mut Workspace) -> Vec<AvoidanceReason> {
        let neighbours = view.neighbours.iter().enumerate();
        let mut reasons: Vec<AvoidanceReason> = neighbours
            .map(|(index, other)| AvoidanceReason::Forbids(Cause::Neighbour(index), cone(view, other)))
            .chain(
                discs(view)
                    .enumerate()
                    .map(|(index, disc)| AvoidanceReason::Forbids(Cause::Disc(index), cone(view, &disc))),
            )
            .collect();
        choose(view, &mut workspace.forbidden, |velocity, cost| {
            reasons.push(AvoidanceReason::Candidate { velocity, cost })
        });
        reasons
    }

    fn wall_range(&self, radius: f32, _: f32) -> f32 {
        WALL_RANGE + radius
    }
}

/// Returns the sum of radii without the margin, which the reports do not have.
fn radii(view: &AvoidanceInput<'_>, other: &AvoidanceNeighbour) -> f32 {
    other.radii / view.margin
}

fn discs<'a>(view: &'a AvoidanceInput<'_>) -> impl Iterator<Item = AvoidanceNeighbour> + 'a {
    view.discs.iter().map(|near| AvoidanceNeighbour {
        outline: near.outline,
        ..AvoidanceNeighbour::resting(near.offset, (near.disc.radius as f32 + view.radius) * view.margin)
    })
}

/// Returns the forbidden cone of one neighbour. A neighbour that overlaps forbids all velocities that lead nearer.
fn cone(view: &AvoidanceInput<'_>, other: &AvoidanceNeighbour) -> Forbidden {
    let apex = (view.velocity + other.velocity) * 0.5;
    let bare = AvoidanceNeighbour { radii: radii(view, other), ..*other };
    if !bare.outline.is_point() && !bare.touches() {
        let (left, right) = bare.legs();
        return Forbidden::Cone { apex, right, left };
    }
    let distance = other.offset.length();
    let sine = (bare.radii / distance).min(1.0);
    let (axis, cosine) = (other.offset / distance, (1.0 - sine * sine).sqrt());
    Forbidden::Cone { apex, right: axis.rotate(Vec2::new(cosine, -sine)), left: axis.rotate(Vec2::new(cosine, sine)) }
}

fn choose(view: &AvoidanceInput<'_>, cones: &mut Vec<Forbidden>, mut tried: impl FnMut(Vec2, f32)) -> Vec2 {
    cones.clear();
    cones.extend(view.neighbours.iter().copied().chain(discs(view)).map(|other| cone(view, &other)));
    let is_free = |v: Vec2| {
        let walls = || view.edges.iter().map(|e| time_to_segment(e.start, e.end, v * 2.0 - view.velocity, view.radius));
        cones.iter().all(|cone| cone.depth(v) <= 0.0) && walls().all(f32::is_infinite)
    };
    let speed = view.preferred.length().min(view.max_speed);
    let pattern = (0..DIRECTIONS).flat_map(|i| {
        let (sin, cos) = libm::sincosf(i as f32 * BETWEEN);
        (1..=SPEEDS).map(move |k| Vec2::new(cos, sin) * (speed * k as f32 / SPEEDS as f32))
    });
    let mut best = (Vec2::ZERO, f32::INFINITY);
    for v in std::iter::once(view.preferred.clamp_length_max(view.max_speed)).chain(pattern) {
        let cost = if is_free(v) { v.distance(view.preferred) } else { f32::INFINITY };
        tried(v, cost);
        if cost < best.1 {
            best = (v, cost);
        }
    }
    best.0
}
