//! The autocorrelation of velocities.

use super::both;
use glam::DVec3;
use std::collections::VecDeque;

/// Autocorrelation of velocities: `C(tau) = <v(t) . v(t + tau)> / <v . v>`, over all times and all agents present at
/// both times. The denominator is the geometric mean of the squares at both times, so that the result is at most 1.
///
/// For a velocity that decorrelates at a rate `1/T` (a Langevin or Ornstein-Uhlenbeck process) it is `exp(-tau/T)`; if
/// the position is bound, it oscillates below 0 (Okubo, *Adv. Biophys.* 22, 1986).
#[derive(Clone, Debug)]
pub struct Correlation {
    /// Longest lag, seconds.
    longest: f64,
    /// Velocities by number, latest frame first.
    before: VecDeque<Vec<(u32, DVec3)>>,
    /// By lag: sums of products, of squares at the earlier time, and of squares at the later time.
    sums: Vec<[f64; 3]>,
    /// Interval of incoming frames, seconds; every `stride`-th frame is used, and `passed` counts the frames since the
    /// last one used.
    spacing: f64,
    stride: usize,
    passed: usize,
}

/// Greatest number of lags.
const LAGS: usize = 120;

impl Correlation {
    /// Creates a correlation for lags of up to `longest` seconds.
    pub fn new(longest: f64) -> Self {
        Self { longest, before: VecDeque::new(), sums: Vec::new(), spacing: 0.0, stride: 1, passed: 0 }
    }

    /// Adds the velocities of the next frame, by number. `spacing` is the time since the frame before, seconds. The
    /// first spacing counts for all frames; a different spacing restarts the lags.
    pub fn push(&mut self, spacing: f64, velocities: &[(u32, DVec3)]) {
        if self.spacing == 0.0 {
            self.stride = ((self.longest / spacing / LAGS as f64).ceil() as usize).max(1);
            self.spacing = spacing;
            let lags = (self.longest / (spacing * self.stride as f64)).round().clamp(1.0, LAGS as f64) as usize;
            self.sums = vec![[0.0; 3]; lags + 1];
        } else if (spacing - self.spacing).abs() > 0.01 * self.spacing {
            self.before.clear();
            self.passed = 0;
        }
        self.passed += 1;
        if !self.before.is_empty() && self.passed < self.stride {
            return;
        }
        self.passed = 0;
        let mut now =
            if self.before.len() == self.sums.len() { self.before.pop_back() } else { None }.unwrap_or_default();
        now.clear();
        now.extend_from_slice(velocities);
        self.before.push_front(now);
        for (sums, before) in self.sums.iter_mut().zip(&self.before) {
            for (then, later) in both(before, velocities) {
                let parts = [then.dot(later), then.length_squared(), later.length_squared()];
                sums.iter_mut().zip(parts).for_each(|(sum, part)| *sum += part);
            }
        }
    }

    /// Returns lags, seconds, and the correlation at each; only lags at which some agent was present at both times.
    pub fn points(&self) -> Vec<(f64, f64)> {
        let seconds = self.spacing * self.stride as f64;
        let value = |&[product, then, later]: &[f64; 3]| product / (then * later).sqrt();
        let all = self.sums.iter().map(value).enumerate().map(|(lag, value)| (lag as f64 * seconds, value));
        all.filter(|(_, value)| value.is_finite()).collect()
    }

    /// Returns the first lag at which the correlation falls to 1/e, seconds, interpolated linearly between lags; `None`
    /// if it does not.
    pub fn time(&self) -> Option<f64> {
        let limit = (-1.0f64).exp();
        let points = self.points();
        points.windows(2).find(|pair| pair[1].1 <= limit).map(|pair| {
            let [(t, c), (later, less)] = [pair[0], pair[1]];
            t + (later - t) * (c - limit) / (c - less)
        })
    }
}
