//! Velocities limited by walls.

use glam::DVec2;

/// Maximum number of walls considered together; walls farther apart than a cell are never more.
const MOST: usize = 8;
/// Squared difference of directions below which they count as the same.
const SAME: f64 = 1e-9;

/// The limits of speed towards nearby walls.
#[derive(Default)]
pub(super) struct WallSpeedLimits {
    /// Unit vectors away from walls, and the maximum speed against each, at least 0.
    all: [(DVec2, f64); MOST],
    count: usize,
}

impl WallSpeedLimits {
    /// Limits the speed against a unit vector to `most`.
    pub fn add(&mut self, away: DVec2, most: f64) {
        match self.all[..self.count].iter_mut().find(|limit| limit.0.distance_squared(away) < SAME) {
            Some(limit) => limit.1 = limit.1.min(most),
            None if self.count < MOST => {
                self.all[self.count] = (away, most);
                self.count += 1;
            }
            // the tightest limits are kept
            None => {
                if let Some(widest) = self.all.iter_mut().max_by(|a, b| a.1.total_cmp(&b.1))
                    && widest.1 > most
                {
                    *widest = (away, most);
                }
            }
        }
    }

    /// Returns the velocity nearest to `velocity` that keeps all limits: `velocity` itself, or its projection on the
    /// line of a limit, or the intersection of two such lines. Zero always keeps the limits.
    pub fn nearest(&self, velocity: DVec2) -> DVec2 {
        let limits = &self.all[..self.count];
        let slack = 1e-9 * velocity.length();
        let keeps = |v: DVec2| limits.iter().all(|&(away, most)| -v.dot(away) <= most + slack);
        if keeps(velocity) {
            return velocity;
        }
        let mut best = DVec2::ZERO;
        let mut offer = |v: DVec2| {
            if v.distance_squared(velocity) < best.distance_squared(velocity) && keeps(v) {
                best = v;
            }
        };
        for (index, &(away, most)) in limits.iter().enumerate() {
            offer(velocity - away * (velocity.dot(away) + most));
            for &(other, other_most) in &limits[..index] {
                let sine = away.perp_dot(other);
                if sine.abs() > SAME {
                    // v . away = -most, v . other = -other_most
                    offer((other.perp() * most - away.perp() * other_most) / sine);
                }
            }
        }
        best
    }
}
