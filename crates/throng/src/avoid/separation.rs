//! Distances and directions away from neighbours and walls, on which models of repulsion build.

use super::{AvoidanceInput, AvoidanceNeighbour, Cause, NearEdge};
use glam::Vec2;

/// A neighbour counts as exactly ahead if it is within this fraction of the radii beside the line of the preferred
/// velocity.
const TIE: f32 = 0.0025;
/// Offset to the left at which a neighbour exactly ahead is seen, as a fraction of the radii.
const BESIDE: f32 = 0.1;

impl AvoidanceNeighbour {
    /// Returns the distance between the cores of the two bodies (the centres of discs), and the unit vector from the
    /// neighbour to the agent.
    pub(super) fn separation(&self) -> (f32, Vec2) {
        if !self.outline.is_point() {
            let (distance, away) = self.outline.boundary(self.offset, Vec2::ZERO, 1.0, 0.0, None);
            return (distance, if away == Vec2::ZERO { self.aside } else { away });
        }
        let distance = self.offset.length();
        (distance, if distance > 0.0 { -self.offset / distance } else { self.aside })
    }

    /// Returns the neighbour as models of repulsion see it. A neighbour exactly ahead is seen a little to the left, so
    /// that the agent passes on the right. Without this, two agents that meet exactly head-on stop for ever: the forces
    /// between them have no component across. `ahead` is the direction of the preferred velocity, or zero.
    pub(super) fn untied(&self, ahead: Vec2) -> Self {
        let left = ahead.perp_dot(self.offset);
        if ahead.dot(self.offset) <= 0.0 || left.abs() > TIE * self.radii {
            return *self;
        }
        Self { offset: self.offset + ahead.perp() * (BESIDE * self.radii - left), ..*self }
    }
}

impl NearEdge {
    /// Returns the nearest point of the edge if the agent's distance from the wall has a minimum there. A corner
    /// belongs to the edge that starts at it, so that a wall counts the corner once. An edge seen from its solid side
    /// has no minimum.
    fn nearest(&self) -> Option<Vec2> {
        let along = self.end - self.start;
        let ahead = -self.start.dot(along);
        if ahead <= 0.0 {
            let beyond_previous = self.edge.previous.dot(-self.start) >= 0.0;
            return (self.edge.convex_start && beyond_previous).then_some(self.start);
        }
        let inside = ahead < along.length_squared() && along.perp_dot(-self.start) <= 0.0;
        inside.then(|| self.start + along * (ahead / along.length_squared()))
    }
}

impl AvoidanceInput<'_> {
    /// Returns the walls in view: the distance of the agent's core (the centre of a disc) from the surface, and the
    /// unit vector from the wall to the agent.
    pub(super) fn walls(&self) -> impl Iterator<Item = (Cause, f32, Vec2)> {
        let edges = self.edges.iter().enumerate().filter_map(|(index, near)| {
            let nearest = near.nearest()?;
            let distance = nearest.length();
            let away = if distance > 0.0 { -nearest / distance } else { -near.edge.direction.perp() };
            Some((Cause::Edge(index), distance, away))
        });
        let discs = self.discs.iter().enumerate().map(|(index, near)| {
            let body = AvoidanceNeighbour { outline: near.outline, ..AvoidanceNeighbour::resting(near.offset, 0.0) };
            let (distance, away) = body.separation();
            (Cause::Disc(index), distance - near.disc.radius as f32, away)
        });
        edges.chain(discs)
    }

    /// Returns the neighbours with ties resolved, see [`AvoidanceNeighbour::untied`].
    pub(super) fn others(&self) -> impl Iterator<Item = (Cause, AvoidanceNeighbour)> {
        let ahead = self.preferred.normalize_or_zero();
        let numbered = self.neighbours.iter().enumerate();
        numbered.map(move |(index, other)| (Cause::Neighbour(index), other.untied(ahead)))
    }

    /// Returns the neighbour that limits the speed of a body that walks along the unit vector `direction`, and the gap
    /// between the bodies, metres: the nearest neighbour ahead within the width of both bodies.
    pub(super) fn headway(&self, direction: Vec2) -> Option<(Cause, f32)> {
        let ahead = self.neighbours.iter().enumerate().filter_map(|(index, other)| {
            let (distance, away) = other.separation();
            let nearest = away * -distance;
            let in_the_way = direction.dot(nearest) >= 0.0 && direction.perp_dot(nearest).abs() <= other.radii;
            in_the_way.then_some((Cause::Neighbour(index), distance - other.radii))
        });
        ahead.reduce(|a, b| if b.1 < a.1 { b } else { a })
    }

    /// Returns the velocity after a step of a body that relaxes to the preferred velocity with the time constant
    /// `relaxation`, seconds, under the additional acceleration `force`, m/s^2. The relaxation is implicit, so it is
    /// stable for every step.
    pub(super) fn relaxed(&self, force: Vec2, relaxation: f32) -> Vec2 {
        let driven = self.velocity + (force + self.preferred / relaxation) * self.step;
        (driven / (1.0 + self.step / relaxation)).clamp_length_max(self.max_speed)
    }
}

/// Returns `strength * exp(-gap / range)`, limited where bodies overlap by more than ten ranges.
pub(super) fn exponential(strength: f32, gap: f32, range: f32) -> f32 {
    strength * libm::expf((-gap / range).min(10.0))
}
