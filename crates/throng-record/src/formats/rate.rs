//! The rate of frames.

/// Measures the rate of frames.
#[derive(Clone, Debug, Default)]
pub(super) struct Rate {
    first: f64,
    last: f64,
    count: u64,
    shortest: f64,
    longest: f64,
}

impl Rate {
    /// Adds the next frame, at a time in seconds.
    pub(super) fn push(&mut self, time: f64) {
        let since = time - self.last;
        match self.count {
            0 => self.first = time,
            1 => (self.shortest, self.longest) = (since, since),
            _ => (self.shortest, self.longest) = (self.shortest.min(since), self.longest.max(since)),
        }
        self.last = time;
        self.count += 1;
    }

    /// Returns the mean rate, frames per second, rounded to a whole number if it is within a millionth of it; `None`
    /// for fewer than two frames.
    pub(super) fn mean(&self) -> Option<f64> {
        let rate = (self.count.max(1) - 1) as f64 / (self.last - self.first);
        let whole = rate.round();
        let rate = if (rate - whole).abs() < 1e-6 * rate { whole } else { rate };
        (self.count > 1 && rate.is_finite() && rate > 0.0).then_some(rate)
    }

    /// Returns the mean rate if frames come at even times, to a thousandth of the interval.
    pub(super) fn even(&self) -> Option<f64> {
        self.mean().filter(|rate| (self.longest - self.shortest) * rate < 1e-3)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn even_moments_have_a_rate() {
        let rate = |times: &[f64]| {
            let mut rate = Rate::default();
            times.iter().for_each(|&time| rate.push(time));
            (rate.mean(), rate.even())
        };
        assert_eq!((rate(&[]), rate(&[3.0])), ((None, None), (None, None)));
        assert_eq!(rate(&[3.0, 3.0]), (None, None));
        let tenths: Vec<f64> = (0..100).map(|k| 5.0 + 0.1 * f64::from(k)).collect();
        assert_eq!(rate(&tenths), (Some(10.0), Some(10.0)));
        assert_eq!(rate(&[0.0, 0.4, 0.8]), (Some(2.5), Some(2.5)));
        assert_eq!(rate(&[0.0, 1.0, 3.0, 4.0]), (Some(0.75), None));
    }
}
