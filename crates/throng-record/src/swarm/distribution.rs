//! Distributions of values, computed incrementally.

/// The distribution of values: moments, and a histogram that grows with them. Values that are not finite are ignored.
///
/// Moments are computed in one pass (Pébay, *Formulas for robust, one-pass parallel computation of covariances and
/// arbitrary-order statistical moments*, Sandia 2008). The width of a bin is a power of two. If the values span more
/// than the greatest number of bins, pairs of bins are merged.
///
/// ```
/// use throng_record::swarm::Distribution;
/// let mut coin = Distribution::default();
/// (0..1000).for_each(|k| coin.add(if k % 2 == 0 { 1.0 } else { 3.0 }));
/// assert!((coin.mean() - 2.0).abs() < 1e-9 && (coin.deviation() - 1.0).abs() < 1e-9);
/// assert!((coin.kurtosis() - 1.0).abs() < 1e-9);
/// assert_eq!((coin.least(), coin.most()), (1.0, 3.0));
/// ```
#[derive(Clone, Debug)]
pub struct Distribution {
    count: u64,
    mean: f64,
    /// Sums of the powers 2 to 4 of differences from the mean.
    sums: [f64; 3],
    range: [f64; 2],
    /// Width of a bin, a power of two.
    width: f64,
    /// Index of the first bin; bin 0 begins at 0.
    first: i64,
    bins: Vec<u64>,
}

/// Greatest number of bins.
const BINS: usize = 1024;
/// Width of the bins of the first value: finer than any measurement.
const FINEST: f64 = 1.0 / (1u64 << 30) as f64;
/// Greatest absolute value with its own bin: beyond it, bin indices would not be exact.
const FARTHEST: f64 = 1e6;

impl Default for Distribution {
    fn default() -> Self {
        Self {
            count: 0,
            mean: 0.0,
            sums: [0.0; 3],
            range: [f64::INFINITY, f64::NEG_INFINITY],
            width: FINEST,
            first: 0,
            bins: Vec::new(),
        }
    }
}

impl Distribution {
    /// Adds a value.
    pub fn add(&mut self, value: f64) {
        if !value.is_finite() {
            return;
        }
        let before = self.count as f64;
        self.count += 1;
        let n = self.count as f64;
        let delta = value - self.mean;
        let part = delta / n;
        let term = delta * part * before;
        let [two, three, four] = self.sums;
        self.mean += part;
        self.sums = [
            two + term,
            three + term * part * (n - 2.0) - 3.0 * part * two,
            four + term * part * part * (n * n - 3.0 * n + 3.0) + 6.0 * part * part * two - 4.0 * part * three,
        ];
        self.range = [self.range[0].min(value), self.range[1].max(value)];
        self.put(value.clamp(-FARTHEST, FARTHEST));
    }

    fn put(&mut self, value: f64) {
        let bin = |width: f64| (value / width).floor() as i64;
        let mut at = bin(self.width);
        if self.bins.is_empty() {
            (self.first, self.bins) = (at, vec![0]);
        }
        while self.span(at) > BINS as i64 {
            self.widen();
            at = bin(self.width);
        }
        if at < self.first {
            let missing = (self.first - at) as usize;
            self.bins.splice(0..0, std::iter::repeat_n(0, missing));
            self.first = at;
        }
        let index = (at - self.first) as usize;
        if index >= self.bins.len() {
            self.bins.resize(index + 1, 0);
        }
        self.bins[index] += 1;
    }

    /// Returns the number of bins including bin `at`.
    fn span(&self, at: i64) -> i64 {
        (self.first + self.bins.len() as i64).max(at + 1) - self.first.min(at)
    }

    /// Merges pairs of bins.
    fn widen(&mut self) {
        self.width *= 2.0;
        self.bins = merged(&self.bins, self.first, 2).1;
        self.first = self.first.div_euclid(2);
    }

    /// Returns the number of values.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// Returns the mean; NaN for no values.
    pub fn mean(&self) -> f64 {
        if self.count > 0 { self.mean } else { f64::NAN }
    }

    /// Returns the standard deviation of the values themselves, not an estimate for a larger population.
    pub fn deviation(&self) -> f64 {
        (self.sums[0] / self.count as f64).sqrt()
    }

    /// Returns the root mean square.
    pub fn rms(&self) -> f64 {
        (self.sums[0] / self.count as f64 + self.mean * self.mean).sqrt()
    }

    /// Returns the skewness, the third moment over the cube of the deviation: 0 for a symmetric distribution.
    pub fn skewness(&self) -> f64 {
        (self.count as f64).sqrt() * self.sums[1] / self.sums[0].powi(3).sqrt()
    }

    /// Returns the kurtosis, the fourth moment over the fourth power of the deviation: 3 for a normal distribution,
    /// more with heavy tails.
    pub fn kurtosis(&self) -> f64 {
        self.count as f64 * self.sums[2] / (self.sums[0] * self.sums[0])
    }

    /// Returns the least value; infinity for no values.
    pub fn least(&self) -> f64 {
        self.range[0]
    }

    /// Returns the greatest value; minus infinity for no values.
    pub fn most(&self) -> f64 {
        self.range[1]
    }

    /// Returns the probability density: centres of bins and densities, in order. Bins are about `part` of a deviation
    /// wide, and at least as wide as the bins of the histogram.
    pub fn density(&self, part: f64) -> Vec<(f64, f64)> {
        if self.bins.is_empty() {
            return Vec::new();
        }
        let most = self.bins.len() as f64;
        let many = (self.deviation() * part / self.width).round().clamp(1.0, most) as i64;
        let (first, bins) = merged(&self.bins, self.first, many);
        let width = self.width * many as f64;
        let share = 1.0 / (self.count as f64 * width);
        let at = |k: usize| (first + k as i64) as f64 * width + 0.5 * width;
        bins.iter().enumerate().map(|(k, &count)| (at(k), count as f64 * share)).collect()
    }

    /// Returns the density of the standardised values: less their mean, over their deviation.
    pub fn standardised(&self, part: f64) -> Vec<(f64, f64)> {
        let (mean, deviation) = (self.mean(), self.deviation());
        self.density(part).into_iter().map(|(x, density)| ((x - mean) / deviation, density * deviation)).collect()
    }
}

/// Merges `many` bins into one; returns the index of the first merged bin, and the bins.
fn merged(bins: &[u64], first: i64, many: i64) -> (i64, Vec<u64>) {
    let start = first.div_euclid(many);
    let end = (first + bins.len() as i64 - 1).div_euclid(many);
    let mut all = vec![0; (end - start + 1) as usize];
    for (at, &count) in (first..).zip(bins) {
        all[(at.div_euclid(many) - start) as usize] += count;
    }
    (start, all)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn moments_and_bins_are_those_of_all_values(all in prop::collection::vec(-1e3f64..1e3, 2..400), shift in -1e3f64..1e3) {
            let mut found = Distribution::default();
            let all: Vec<f64> = all.into_iter().map(|x| x + shift).collect();
            all.iter().for_each(|&x| found.add(x));
            let n = all.len() as f64;
            let mean = all.iter().sum::<f64>() / n;
            let moment = |power: i32| all.iter().map(|x| (x - mean).powi(power)).sum::<f64>() / n;
            let near = |a: f64, b: f64| (a - b).abs() <= 1e-7 * (1.0 + b.abs());
            prop_assert!(near(found.mean(), mean) && near(found.deviation(), moment(2).sqrt()));
            prop_assert!(near(found.skewness(), moment(3) / moment(2).powf(1.5)), "{} {}", found.skewness(), moment(3) / moment(2).powf(1.5));
            prop_assert!(near(found.kurtosis(), moment(4) / moment(2).powi(2)));
            prop_assert!(near(found.rms(), (all.iter().map(|x| x * x).sum::<f64>() / n).sqrt()));
            prop_assert!(found.bins.len() <= BINS);
            prop_assert_eq!(found.bins.iter().sum::<u64>(), all.len() as u64);
            for part in [0.01, 0.25, 3.0] {
                let density = found.density(part);
                let width = if density.len() > 1 { density[1].0 - density[0].0 } else { found.width * found.bins.len() as f64 };
                let inside = |x: f64, middle: f64| (middle - 0.5 * width..middle + 0.5 * width).contains(&x);
                for &(middle, density) in density.iter().filter(|_| density.len() > 1) {
                    let count = all.iter().filter(|&&x| inside(x, middle)).count() as f64;
                    prop_assert!(near(density, count / n / width), "{middle}: {density}");
                }
            }
        }
    }

    #[test]
    fn no_values_and_extreme_values_are_handled() {
        let mut none = Distribution::default();
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            none.add(value);
        }
        assert!(none.count() == 0 && none.mean().is_nan() && none.deviation().is_nan() && none.density(0.1).is_empty());
        let mut far = Distribution::default();
        for value in [1e-12, -1e300, 1e300, 0.0] {
            far.add(value);
        }
        assert!(far.count() == 4 && far.bins.len() <= BINS && far.most() == 1e300);
        let mut same = Distribution::default();
        (0..5).for_each(|_| same.add(0.7));
        assert_eq!((same.mean(), same.deviation(), same.density(0.25).len()), (0.7, 0.0, 1));
    }
}
