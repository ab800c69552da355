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

    /// Counts the pictures of times before `end` (less 1e-9 s) as taken, and returns how many of them are new.
    pub fn due(&mut self, end: f64) -> u64 {
        let before = self.taken;
        let due = ((end - 1e-9 - self.from) / self.interval).ceil();
        // a float converts to the nearest number of the type, NaN to 0
        self.taken = before.max(due as u64);
        self.taken - before
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_of_a_long_gap_are_not_counted_one_by_one() {
        let mut pace = Pace::new(0.0, 0.04);
        assert_eq!([0.02, 0.06, 1e9, 1.0].map(|end| pace.due(end)), [1, 1, 24_999_999_998, 0]);
        assert_eq!(pace.due(f64::INFINITY), u64::MAX - 25_000_000_000);
        assert_eq!(Pace::new(0.0, 0.04).due(f64::NAN), 0);
    }

    #[test]
    fn as_many_pictures_come_as_counting_them_gives() {
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
