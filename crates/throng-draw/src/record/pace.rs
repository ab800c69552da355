//! When pictures of a run are due.

/// Pictures at even intervals of the scene's time, each at the step nearest to its time.
#[derive(Clone, Copy, Debug)]
pub struct Pace {
    from: f64,
    interval: f64,
    taken: u64,
}

impl Pace {
    /// A picture at the time `from` and one every `interval` seconds after it.
    pub fn new(from: f64, interval: f64) -> Self {
        Self { from, interval, taken: 0 }
    }

    /// How many pictures are due at `time`, after a step of `step` seconds (or before the first), and counts them as
    /// taken.
    pub fn due(&mut self, time: f64, step: f64) -> u64 {
        let before = self.taken;
        while self.from + self.taken as f64 * self.interval < time + step * 0.5 - 1e-9 {
            self.taken += 1;
        }
        self.taken - before
    }
}
