//! Time measurements.

use std::time::Instant;

/// Returns the seconds that this thread has run, where the system reports them (Linux). Unlike wall-clock time, they do
/// not depend on other load.
fn worked() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    Some(text.split(' ').next()?.parse::<f64>().ok()? * 1e-9)
}

/// Prints the time of each of `count` pictures.
pub fn report(what: &str, count: usize, start: (Instant, Option<f64>)) {
    let each = |seconds: f64| seconds * 1e3 / count as f64;
    let clock = start.0.elapsed().as_secs_f64();
    eprint!("{what}: {:.2} ms a picture, {:.0} a second", each(clock), count as f64 / clock);
    match (start.1, worked()) {
        (Some(from), Some(to)) => eprintln!("; at work {:.2} ms", each(to - from)),
        _ => eprintln!(),
    }
}

/// Returns the current time of both clocks.
pub fn now() -> (Instant, Option<f64>) {
    (Instant::now(), worked())
}
