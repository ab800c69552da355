//! The labs' algorithm, compared with the description in the reports: angles and their differences, in f64.

use crate::avoid::common::{choose, other, vector};
use glam::Vec2;
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};
use throng::avoid::RvoLab;

/// By angles: the velocity obstacle of each neighbour is the angles from `left` to `right` about the mean velocity.
fn as_reported(velocity: Vec2, preferred: Vec2, all: &[(Vec2, Vec2)]) -> (Vec2, f64) {
    let forbidden = |v: Vec2| {
        // least distance from the border of a cone at which the result is certain
        let mut sharp = f64::INFINITY;
        let inside = all.iter().any(|&(offset, theirs)| {
            let relative = v - (velocity + theirs) / 2.0;
            let axis = f64::from(offset.y).atan2(f64::from(offset.x));
            let towards = f64::from(relative.y).atan2(f64::from(relative.x));
            let half = (0.4 / f64::from(offset.length())).min(1.0).asin();
            let away = (towards - axis + 3.0 * PI).rem_euclid(TAU) - PI;
            sharp = sharp.min((away.abs() - half).abs()).min(f64::from(relative.length()));
            away.abs() < half
        });
        (inside, sharp)
    };
    let mut all = vec![preferred];
    for i in 0..63 {
        for k in 1..=5 {
            all.push(Vec2::from_angle(i as f32 * 0.1) * (preferred.length() * k as f32 / 5.0));
        }
    }
    let sharp = all.iter().map(|&v| forbidden(v).1).fold(f64::INFINITY, f64::min);
    let free = all.into_iter().filter(|&v| !forbidden(v).0);
    let best = free.min_by(|a, b| a.distance(preferred).total_cmp(&b.distance(preferred)));
    (best.unwrap_or(Vec2::ZERO), sharp)
}

proptest! {
    #[test]
    fn it_chooses_as_the_reports_say(
        all in prop::collection::vec((vector(3.0), vector(1.5)), 0..8), velocity in vector(1.5), preferred in vector(1.05),
    ) {
        let neighbours: Vec<_> = all.iter().map(|&(offset, theirs)| other(offset, theirs, 0.4, 0.8)).collect();
        let (expected, sharp) = as_reported(velocity, preferred, &all);
        prop_assume!(sharp > 1e-5);
        let chosen = choose(&RvoLab, velocity, preferred, &neighbours);
        prop_assert!((chosen.distance(preferred) - expected.distance(preferred)).abs() < 1e-5, "{chosen} {expected}");
    }
}

/// A surrounded agent stops: the fault that blocks the labs' crowds.
#[test]
fn surrounded_agents_stop() {
    let ring: Vec<_> = (0..8).map(|i| other(Vec2::from_angle(i as f32 * 0.785) * 0.9, Vec2::ZERO, 0.4, 0.5)).collect();
    assert_eq!(choose(&RvoLab, Vec2::ZERO, Vec2::X, &ring), Vec2::ZERO);
}
