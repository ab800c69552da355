//! The motion of pedestrians: turning, acceleration and effort.

use super::people::People;
use super::speed::{Velocities, accelerations};
use crate::swarm::Distribution;

/// Speed below which a pedestrian stands and has no direction of motion, m/s.
const STANDS: f64 = 0.1;
/// Power of standing, W/kg, and of walking, J s/(kg m²): S. J. Guy and others, *PLEdestrians: a least-effort approach
/// to crowd simulation*, SCA 2010, after measurements of metabolism.
const POWER: [f64; 2] = [2.23, 1.26];

/// The motion of all pedestrians, over all rows.
#[derive(Clone, Debug, Default)]
pub struct PeopleMotion {
    /// Speeds, m/s.
    pub speed: Distribution,
    /// Absolute change of the direction of motion from row to row while walking, degrees per second.
    pub turning: Distribution,
    /// Magnitudes of accelerations, m/s².
    pub acceleration: Distribution,
    /// Effort: the power of walking at a speed, W/kg: 2.23 + 1.26 v².
    pub effort: Distribution,
}

impl PeopleMotion {
    /// Computes the motion of all pedestrians; velocities and accelerations are over `n` rows before and after.
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
    fn turning_and_acceleration_are_constant_on_a_circle() {
        let (radius, rate, step) = (3.0, 0.4, 0.02);
        let times: Vec<f64> = (0..500).map(|k| f64::from(k) * step).collect();
        let places = times.iter().map(|time| radius * DVec2::from_angle(rate * time)).collect();
        let people = People { walks: vec![Walk { number: 1, radius: 0.2, times, places }], moments: vec![] };
        let found = PeopleMotion::of(&people, &Velocities::of(&people, 5, Border::Exclude), 5);
        assert!((found.turning.mean() - f64::to_degrees(rate)).abs() < 1e-9 && found.turning.deviation() < 1e-6);
        assert!((found.speed.mean() - radius * rate).abs() < 1e-3);
        assert!((found.acceleration.mean() - radius * rate * rate).abs() < 1e-3);
        assert!((found.effort.mean() - (2.23 + 1.26 * 1.44)).abs() < 1e-2);
        assert_eq!((found.speed.count(), found.acceleration.count()), (490, 490));
    }
}
