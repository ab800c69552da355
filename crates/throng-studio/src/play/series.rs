//! Figures of a run against its time.

use super::meter::{Gauge, Meter};
use super::observed::Observed;
use super::quantity::{Quantity, measure, turned};
use std::sync::Arc;

/// So many samples at most: enough for a plot as wide as a screen.
const MOST: usize = 1000;
/// Seconds between samples at first.
const PERIOD: f64 = 0.2;

/// The figures of one moment.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// Steps made.
    pub step: u64,
    /// Seconds since the start.
    pub time: f64,
    /// In the order of [`Quantity::ALL`]; not a number where there is nothing to tell.
    pub values: [f32; Quantity::ALL.len()],
}

/// Figures of a run by step, oldest first. When they grow too many, every second one is let go and the next ones are taken half
/// as often; when the run goes back, so do they.
#[derive(Clone, Debug)]
pub struct Series {
    samples: Vec<Sample>,
    /// Steps from one sample to the next.
    stride: u64,
    /// How far everybody had turned a step before the next sample, by number.
    turned: Vec<(u32, f64)>,
    gauges: Vec<Gauge>,
}

impl Series {
    /// Of a run at its start, with nothing but meters for now.
    pub fn new(now: &Observed, meters: &Arc<[Meter]>) -> Self {
        let stride = (PERIOD / now.period).round().max(1.0) as u64;
        let mut series = Self { samples: Vec::new(), stride, turned: Vec::new(), gauges: Vec::new() };
        series.meter(now, meters);
        series.see(now);
        series
    }

    /// What was measured, oldest first.
    pub fn samples(&self) -> &[Sample] {
        &self.samples
    }

    /// What the meters tell, in their order.
    pub fn gauges(&self) -> &[Gauge] {
        &self.gauges
    }

    /// Reads these meters from now on; one that is read already goes on.
    pub fn meter(&mut self, now: &Observed, meters: &Arc<[Meter]>) {
        let mut before = std::mem::take(&mut self.gauges);
        let mut gauge = |meter: &Meter| {
            let known = before.iter().position(|gauge| gauge.meter() == *meter);
            known.map_or_else(|| Gauge::new(*meter, now), |at| before.swap_remove(at))
        };
        self.gauges = meters.iter().map(&mut gauge).collect();
    }

    /// Whether there is something to see at this step.
    pub fn wants(&self, step: u64) -> bool {
        !self.gauges.is_empty() || step.is_multiple_of(self.stride) || (step + 1).is_multiple_of(self.stride)
    }

    /// Looks at everybody after a step.
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

    /// The run has gone back to where everybody is now.
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
