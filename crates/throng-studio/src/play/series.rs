//! Time series of a run.

use super::meter::{Gauge, Meter};
use super::observed::Observed;
use super::quantity::{Quantity, measure, turned};
use std::sync::Arc;

/// The most samples, enough for a plot of the width of a screen.
const MOST: usize = 1000;
/// The first interval between samples, seconds.
const PERIOD: f64 = 0.2;

/// The quantities at one moment.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// Number of steps.
    pub step: u64,
    /// Simulation time, seconds.
    pub time: f64,
    /// The values in the order of [`Quantity::ALL`]. NaN if undefined.
    pub values: [f32; Quantity::ALL.len()],
}

/// Samples of a run by step, oldest first. Beyond `MOST`, every second sample is dropped and the interval doubles.
/// When the run goes back, later samples are dropped.
#[derive(Clone, Debug)]
pub struct Series {
    samples: Vec<Sample>,
    /// Steps between samples.
    stride: u64,
    /// Total turning of the agents one step before the next sample, by number.
    turned: Vec<(u32, f64)>,
    gauges: Vec<Gauge>,
}

impl Series {
    /// Creates the series of a run at its start.
    pub fn new(now: &Observed, meters: &Arc<[Meter]>) -> Self {
        let stride = (PERIOD / now.period).round().max(1.0) as u64;
        let mut series = Self { samples: Vec::new(), stride, turned: Vec::new(), gauges: Vec::new() };
        series.meter(now, meters);
        series.see(now);
        series
    }

    /// Returns the samples, oldest first.
    pub fn samples(&self) -> &[Sample] {
        &self.samples
    }

    /// Returns the measurements of the meters, in their order.
    pub fn gauges(&self) -> &[Gauge] {
        &self.gauges
    }

    /// Sets the meters. A meter that exists already keeps its measurements.
    pub fn meter(&mut self, now: &Observed, meters: &Arc<[Meter]>) {
        let mut before = std::mem::take(&mut self.gauges);
        let mut gauge = |meter: &Meter| {
            let known = before.iter().position(|gauge| gauge.meter() == *meter);
            known.map_or_else(|| Gauge::new(*meter, now), |at| before.swap_remove(at))
        };
        self.gauges = meters.iter().map(&mut gauge).collect();
    }

    /// Whether this step is to be observed.
    pub fn wants(&self, step: u64) -> bool {
        !self.gauges.is_empty() || step.is_multiple_of(self.stride) || (step + 1).is_multiple_of(self.stride)
    }

    /// Updates the series after a step.
    pub fn see(&mut self, now: &Observed) {
        let step = now.step;
        self.gauges.iter_mut().for_each(|gauge| gauge.see(now));
        if step.is_multiple_of(self.stride) && self.samples.last().is_none_or(|last| last.step < step) {
            self.samples.push(Sample { step, time: now.time, values: measure(now, &self.turned) });
            self.gauges.iter_mut().for_each(|gauge| gauge.sample(now));
            self.thin();
        }
        if (step + 1).is_multiple_of(self.stride) {
            self.turned = turned(now).collect();
        }
    }

    /// Drops the samples after `now`, because the run has gone back.
    pub fn back(&mut self, now: &Observed) {
        let step = now.step;
        self.samples.truncate(self.samples.partition_point(|sample| sample.step <= step));
        self.gauges.iter_mut().for_each(|gauge| gauge.back(now));
        self.turned = turned(now).collect();
    }

    fn thin(&mut self) {
        if self.samples.len() > MOST {
            self.stride *= 2;
            let stride = self.stride;
            self.samples.retain(|sample| sample.step.is_multiple_of(stride));
            self.gauges.iter_mut().for_each(|gauge| gauge.thin(stride));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use throng_scene::gallery;

    #[test]
    fn a_run_of_any_length_stays_small() {
        let (mut world, _) = gallery::scene("headon").unwrap().build().unwrap();
        let mut series = Series::new(&(&world).into(), &Arc::from([]));
        for _ in 0..6 * MOST {
            world.step();
            series.see(&(&world).into());
        }
        assert!((MOST / 2..=MOST).contains(&series.samples().len()), "{}", series.samples().len());
        assert!(series.samples().is_sorted_by(|a, b| b.step - a.step == series.stride));
    }

    #[test]
    fn back_and_on_again_gives_the_same_figures() {
        let (mut world, _) = gallery::scene("circle").unwrap().build().unwrap();
        let mut series = Series::new(&(&world).into(), &Arc::from([]));
        let mut saved = Vec::new();
        for step in 1..=200 {
            world.step();
            series.see(&(&world).into());
            if step == 104 {
                saved = world.save();
            }
        }
        let all = series.samples().to_vec();
        world.load(&saved).unwrap();
        series.back(&(&world).into());
        assert_eq!(series.samples().last().map(|sample| sample.step), Some(100));
        while world.steps() < 200 {
            world.step();
            series.see(&(&world).into());
        }
        let bits = |samples: &[Sample]| format!("{samples:?}");
        assert_eq!(bits(series.samples()), bits(&all));
    }
}
