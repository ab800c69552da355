//! The due times of pictures.

/// Pictures at regular intervals of the scene's time, each at the step nearest to its due time.
#[derive(Clone, Copy, Debug)]
pub struct Pace {
    from: f64,
    interval: f64,
    taken: u64,
}

impl Pace {
    /// Creates a pace with a picture at the time `from` and every `interval` seconds after it.
    pub fn new(from: f64, interval: f64) -> Self {
        Self { from, interval, taken: 0 }
    }

    /// Counts the pictures due before `end` (minus 1e-9 s) as taken. Returns how many of them are new.
    pub fn due(&mut self, end: f64) -> u64 {
        let before = self.taken;
        let due = ((end - 1e-9 - self.from) / self.interval).ceil();
        // The cast saturates, and maps NaN to 0.
        self.taken = before.max(due as u64);
        self.taken - before
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_gap_takes_constant_time() {
        let mut pace = Pace::new(0.0, 0.04);
        assert_eq!([0.02, 0.06, 1e9, 1.0].map(|end| pace.due(end)), [1, 1, 24_999_999_998, 0]);
        assert_eq!(pace.due(f64::INFINITY), u64::MAX - 25_000_000_000);
        assert_eq!(Pace::new(0.0, 0.04).due(f64::NAN), 0);
    }

    #[test]
    fn the_number_of_pictures_equals_a_count() {
        for (from, rate) in [(0.0, 25.0), (0.0, 24.0), (3.7, 60.0), (-2.0, 0.3), (12.0, 1000.0)] {
            for step in [0.04, 0.1, 1.0 / 60.0, 0.25, 3.0] {
                let (mut pace, mut sum, mut counted) = (Pace::new(from, 1.0 / rate), 0, 0u64);
                for k in 0..2000 {
                    let end = (f64::from(k) + 0.5) * step;
                    while from + counted as f64 / rate < end - 1e-9 {
                        counted += 1;
                    }
                    sum += pace.due(end);
                    assert_eq!(sum, counted, "{from} {rate} {step} {k}");
                }
            }
        }
    }
}
