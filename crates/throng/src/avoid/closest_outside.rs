//! The velocity closest to the preferred one outside all forbidden regions, found among all candidate optima: Guy et
//! al., ClearPath: highly parallel collision avoidance for multi-agent simulation, SCA 2009, section 4.
//!
//! The boundary of the free velocities consists of pieces of lines and circles: legs of cones, their rounded tips,
//! lines, and the circle of greatest speed. The closest free velocity is the preferred velocity itself, the nearest
//! point of a piece, or a crossing of two pieces. [VO](super::Vo), [ClearPath](super::ClearPath) and [HRVO](super::Hrvo)
//! share this search.

use super::{AvoidanceInput, AvoidanceNeighbour, AvoidanceReason, BoundaryPiece, Cause, Forbidden, Workspace};
use glam::Vec2;

impl Workspace {
    /// Collects the velocities that walls, the body itself and neighbours forbid, the most important first, and the
    /// cause of each. `region` returns what a neighbour forbids. Walls forbid what leads to a collision within
    /// `wall_horizon` seconds.
    pub fn forbid(
        &mut self,
        view: &AvoidanceInput<'_>,
        wall_horizon: f32,
        region: impl Fn(&AvoidanceNeighbour) -> Forbidden,
    ) {
        self.permit(view, view.radius, wall_horizon);
        self.forbidden.clear();
        self.forbidden.extend(self.lines.iter().map(|&line| Forbidden::RightOf(line)));
        for (index, neighbour) in view.neighbours.iter().enumerate() {
            self.forbidden.push(region(neighbour));
            self.causes.push(Cause::Neighbour(index));
        }
    }

    /// Returns the collected regions as reasons.
    pub fn reasons(&self) -> impl Iterator<Item = AvoidanceReason> + '_ {
        self.causes.iter().zip(&self.forbidden).map(|(&cause, &region)| match region {
            Forbidden::RightOf(line) => AvoidanceReason::Permits(cause, line),
            region => AvoidanceReason::Forbids(cause, region),
        })
    }
}

/// Depth within a region that still counts as outside, m/s.
const TOUCH: f32 = 1e-4;

/// Returns the velocity within `max_speed` closest to `preferred` that is in none of the regions. If there is none,
/// returns a velocity for which the first region in the list that contains it comes as late as possible. So the most
/// important regions must come first.
pub fn closest_outside(regions: &[Forbidden], max_speed: f32, preferred: Vec2) -> Vec2 {
    let preferred = preferred.clamp_length_max(max_speed);
    let mut best = Best { regions, max_speed, preferred, clear: 0, distance: f32::INFINITY, velocity: Vec2::ZERO };
    best.consider(preferred);
    if best.is_free() {
        return preferred;
    }
    best.consider(Vec2::ZERO);
    let pieces = || regions.iter().flat_map(Forbidden::pieces);
    pieces().for_each(|piece| best.consider(piece.nearest(preferred)));
    let fastest = BoundaryPiece::Circle { center: Vec2::ZERO, radius: max_speed };
    for (i, piece) in pieces().enumerate() {
        // no crossing of a piece is nearer than its nearest point
        if best.is_beaten_by(piece.nearest(preferred)) {
            piece.crossings(&fastest).for_each(|v| best.consider(v));
            for other in pieces().take(i) {
                piece.crossings(&other).for_each(|v| best.consider(v));
            }
        }
    }
    best.velocity
}

/// The best velocity considered so far.
struct Best<'a> {
    regions: &'a [Forbidden],
    max_speed: f32,
    preferred: Vec2,
    /// Number of regions, from the front of the list, that the velocity is out of.
    clear: usize,
    /// Squared distance from the preferred velocity.
    distance: f32,
    velocity: Vec2,
}

impl Best<'_> {
    fn is_free(&self) -> bool {
        self.clear == self.regions.len()
    }

    /// Whether `v` is better, given that it is out of all regions.
    fn is_beaten_by(&self, v: Vec2) -> bool {
        !self.is_free() || v.distance_squared(self.preferred) < self.distance
    }

    fn consider(&mut self, v: Vec2) {
        if !self.is_beaten_by(v) || v.length_squared() > self.max_speed * self.max_speed * 1.0001 {
            return;
        }
        let distance = v.distance_squared(self.preferred);
        let clear = self.regions.iter().position(|region| region.depth(v) > TOUCH).unwrap_or(self.regions.len());
        if clear > self.clear || clear == self.clear && distance < self.distance {
            (self.clear, self.distance, self.velocity) = (clear, distance, v);
        }
    }
}
