//! Timing of functions.

use std::time::Instant;

/// Returns the median time of five runs, seconds.
pub fn median(mut work: impl FnMut()) -> f64 {
    let mut all = [(); 5].map(|()| {
        let start = Instant::now();
        work();
        start.elapsed().as_secs_f64()
    });
    all.sort_by(f64::total_cmp);
    all[2]
}
