//! Selects the samples of a trajectory from which linear interpolation restores the others.

use glam::DVec3;

/// Returns the samples to keep: linear interpolation between two kept samples restores the samples between them to
/// within `error` along each axis. `way` returns the displacement from a sample to a later one. A displacement longer
/// than `reach` skips no samples. The first and the last sample are kept.
///
/// From each kept sample, the function extends the interval as long as a cone of directions passes all samples within
/// `error`.
pub fn kept(times: &[f64], error: f64, reach: f64, way: impl Fn(usize, usize) -> DVec3) -> Vec<usize> {
    const ALL: [DVec3; 2] = [DVec3::NEG_INFINITY, DVec3::INFINITY];
    let mut kept = Vec::new();
    let (mut from, mut cone) = (0, ALL);
    for to in 0..times.len() {
        if to > 0 {
            let speed = |from: usize| way(from, to) / (times[to] - times[from]);
            let mut heads = speed(from);
            let hits = heads.cmpge(cone[0]).all() && heads.cmple(cone[1]).all();
            if to > from + 1 && !(hits && way(from, to).length() <= reach) {
                (from, cone) = (to - 1, ALL);
                kept.push(from);
                heads = speed(from);
            }
            let wide = DVec3::splat(error / (times[to] - times[from]));
            cone = [cone[0].max(heads - wide), cone[1].min(heads + wide)];
        } else {
            kept.push(0);
        }
    }
    if times.len() > 1 {
        kept.push(times.len() - 1);
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn every_sample_is_restored(
            steps in proptest::collection::vec((0.01..0.5f64, (-1.0..1.0f64, -1.0..1.0f64, -1.0..1.0f64)), 1..80),
            error in 0.01..2.0f64,
            reach in 1.0..100.0f64,
        ) {
            let mut at = (0.0, DVec3::ZERO);
            let samples: Vec<(f64, DVec3)> = steps.into_iter().map(|(time, step)| {
                at = (at.0 + time, at.1 + DVec3::from(step));
                at
            }).collect();
            let times: Vec<f64> = samples.iter().map(|&(time, _)| time).collect();
            let kept = kept(&times, error, reach, |from, to| samples[to].1 - samples[from].1);
            prop_assert_eq!((kept[0], *kept.last().unwrap()), (0, times.len() - 1));
            for ends in kept.windows(2) {
                let [(start, from), (end, to)] = [samples[ends[0]], samples[ends[1]]];
                prop_assert!(ends[1] == ends[0] + 1 || to.distance(from) <= reach);
                for &(time, place) in &samples[ends[0]..=ends[1]] {
                    let found = from.lerp(to, (time - start) / (end - start));
                    prop_assert!((found - place).abs().max_element() <= error + 1e-9);
                }
            }
        }
    }

    #[test]
    fn a_straight_way_is_its_ends() {
        let times: Vec<f64> = (0..1000).map(|k| 0.04 * f64::from(k)).collect();
        let straight = |from: usize, to: usize| DVec3::new(times[to] - times[from], 0.0, 0.0);
        assert_eq!(kept(&times, 1e-9, f64::INFINITY, straight), [0, 999]);
        assert_eq!(kept(&times[..1], 1.0, 1.0, straight), [0]);
        assert!(kept(&[], 1.0, 1.0, straight).is_empty());
    }
}
