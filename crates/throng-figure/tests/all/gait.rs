//! Steps are as long, as frequent and as long on the ground as those of people.

use crate::paths::driven;
use throng_figure::gait::{cycle_duration, duty};
use throng_figure::{Person, Side, Walk};

/// Mean length of steps (m), their number a minute and the share of the cycle on the ground of a person of 1.75 m at a
/// speed (m/s).
fn steps(speed: f64) -> (f64, f64, f64) {
    let person = Person { stride: 1.0, ..Person::new(2, 3) }.with_height(1.75);
    let walk = Walk::recorded(&person, &driven(25.0, 40.0, |_| (speed, 0.0, 0.0))).unwrap();
    let plants: Vec<_> = walk.plants(Side::Left).filter(|plant| plant.strike > 5.0 && plant.lift < 35.0).collect();
    let (first, last) = (plants[0], plants[plants.len() - 1]);
    let cycles = (plants.len() - 1) as f64;
    let cycle = (last.strike - first.strike) / cycles;
    let ground: f64 = plants[..plants.len() - 1].iter().map(|plant| plant.lift - plant.strike).sum::<f64>() / cycles;
    (first.ankle.distance(last.ankle) / cycles / 2.0, 120.0 / cycle, ground / cycle)
}

/// Grieve & Gear 1966 and Inman 1981 for a height of 1.75 m; both differ by up to 5 % from Boulic 1990.
#[test]
fn length_of_steps_and_cadence_agree_with_published_curves() {
    for tenths in [5, 8, 10, 13, 16, 18] {
        let v = f64::from(tenths) / 10.0;
        let (length, cadence, share) = steps(v);
        let grieve = 0.463 * 1.75 * (v / 1.75_f64).powf(0.43);
        let inman = (0.24 * 1.75 * v).sqrt();
        let (low, high) = (grieve.min(inman), grieve.max(inman));
        assert!(length > 0.93 * low && length < 1.07 * high, "{v} m/s: steps of {length} m, {grieve} m or {inman} m");
        assert!((length * cadence / 60.0 / v - 1.0).abs() < 0.02, "{v} m/s: {length} m at {cadence} a minute");
        // Kirtley 1985: 0.642 - 0.035 v; Hansen 2017: swing 37.1 % + 3.4 % v
        let kirtley = 0.642 - 0.035 * v;
        let hansen = 0.629 - 0.034 * v;
        assert!(
            share > hansen.min(kirtley) - 0.03 && share < hansen.max(kirtley) + 0.05,
            "{v} m/s: {share} on the ground"
        );
    }
}

#[test]
fn runners_fly() {
    for v in [2.4, 3.0, 4.0] {
        let (length, cadence, share) = steps(v);
        assert!(share < 0.45, "{v} m/s: {share} on the ground");
        assert!(length > 0.8 && (145.0..190.0).contains(&cadence), "{v} m/s: {length} m at {cadence} a minute");
    }
}

#[test]
fn laws_are_monotonic() {
    let mut last = f64::INFINITY;
    for hundredths in 5..260 {
        let v = f64::from(hundredths) / 100.0;
        let cycle = cycle_duration(v, 0.86);
        assert!((0.7..=2.0).contains(&cycle) && (0.5..0.72).contains(&duty(cycle)));
        if v > 0.4 {
            assert!(cycle <= last);
            last = cycle;
        }
    }
}

#[test]
fn people_walk_in_their_own_time() {
    let samples = driven(25.0, 10.0, |_| (1.3, 0.0, 0.0));
    let mut phases: Vec<f64> = (0..200)
        .map(|number| {
            let walk = Walk::recorded(&Person::new(1, number), &samples).unwrap();
            let strike = walk.plants(Side::Left).find(|plant| plant.strike > 5.0).unwrap().strike;
            (strike - 5.0) / 1.1
        })
        .collect();
    phases.sort_by(f64::total_cmp);
    // no tenth of the cycle has less than a third or more than the triple of its share
    for tenth in 0..9 {
        let from = f64::from(tenth) / 10.0;
        let count = phases.iter().filter(|&&phase| phase >= from && phase < from + 0.1).count();
        assert!((6..60).contains(&count), "{count} people in tenth {tenth}");
    }
}
