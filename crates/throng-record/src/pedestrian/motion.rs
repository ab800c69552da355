//! How people move: how they turn, speed up, and what it costs them.

use super::people::People;
use super::speed::{Velocities, accelerations};
use crate::swarm::Distribution;

/// Who is slower stands: directions of motion say nothing, m/s.
const STANDS: f64 = 0.1;
/// Power of standing, W/kg, and of walking, J s/(kg m²): S. J. Guy and others, *PLEdestrians: a least-effort approach to crowd
/// simulation*, SCA 2010, after measurements of metabolism.
const POWER: [f64; 2] = [2.23, 1.26];

/// How everybody moves, over all rows.
#[derive(Clone, Debug, Default)]
pub struct Motion {
    /// Speeds, m/s.
    pub speed: Distribution,
    /// Turning of directions of motion from row to row, either way, of those who do not stand, degrees a second.
    pub turning: Distribution,
    /// Magnitudes of accelerations, m/s².
    pub acceleration: Distribution,
    /// Effort: the power that walking so fast takes, W/kg: 2.23 + 1.26 v².
    pub effort: Distribution,
}

impl Motion {
    /// Of everybody; velocities and accelerations over `n` rows to each side.
    pub fn of(people: &People, velocities: &Velocities, n: usize) -> Self {
        let mut out = Self::default();
        for (walk, own) in people.walks.iter().zip(velocities.walks()) {
            for velocity in own.iter().flatten() {
                out.speed.add(velocity.length());
                out.effort.add(POWER[0] + POWER[1] * velocity.length_squared());
            }
            for (pair, times) in own.windows(2).zip(walk.times.windows(2)) {
                if let [Some(a), Some(b)] = pair
                    && a.length().min(b.length()) > STANDS
                {
                    out.turning.add(a.angle_to(*b).abs().to_degrees() / (times[1] - times[0]));
                }
            }
            accelerations(walk, n).iter().flatten().for_each(|change| out.acceleration.add(change.length()));
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pedestrian::{Border, Walk};
    use glam::DVec2;

    #[test]
    fn round_a_circle_one_turns_and_accelerates_evenly() {
        let (radius, rate, step) = (3.0, 0.4, 0.02);
        let times: Vec<f64> = (0..500).map(|k| f64::from(k) * step).collect();
        let places = times.iter().map(|time| radius * DVec2::from_angle(rate * time)).collect();
        let people = People { walks: vec![Walk { number: 1, radius: 0.2, times, places }], moments: vec![] };
        let found = Motion::of(&people, &Velocities::of(&people, 5, Border::Exclude), 5);
        assert!((found.turning.mean() - f64::to_degrees(rate)).abs() < 1e-9 && found.turning.deviation() < 1e-6);
        assert!((found.speed.mean() - radius * rate).abs() < 1e-3);
        assert!((found.acceleration.mean() - radius * rate * rate).abs() < 1e-3);
        assert!((found.effort.mean() - (2.23 + 1.26 * 1.44)).abs() < 1e-2);
        assert_eq!((found.speed.count(), found.acceleration.count()), (490, 490));
    }
}
