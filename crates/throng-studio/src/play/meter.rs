//! Meters on the ground: flow through a line, density in a rectangle.

use super::observed::Observed;
use glam::{DVec2, Vec2};
use throng::space::crosses_line;

/// The averaging window of a flow, seconds.
const WINDOW: f64 = 5.0;
/// The most crossings stored individually.
const MOST: usize = 1 << 15;
/// A longer displacement in one step, metres, is a relocation and counts as no crossing.
const FARTHEST: f32 = 10.0;

/// A meter on the ground, in world coordinates, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Meter {
    /// Counts the agents that cross a line in either direction.
    Line([DVec2; 2]),
    /// Counts the agents in the rectangle with these corners.
    Area([DVec2; 2]),
}

impl Meter {
    /// Returns the length of a line in metres or the area of a rectangle in square metres.
    pub fn extent(&self) -> f64 {
        match self {
            Self::Line([a, b]) => a.distance(*b),
            Self::Area([a, b]) => (*b - *a).abs().element_product(),
        }
    }
}

/// The measurements of a meter so far.
#[derive(Clone, Debug)]
pub struct Gauge {
    meter: Meter,
    /// The positions of the agents near the line one step ago, relative to [`Observed::origin`], by number.
    before: Vec<(u32, Vec2)>,
    /// The total number of crossings after each step with a crossing: step, time, count.
    crossings: Vec<(u64, f64, u32)>,
    /// Step, time, and agents per square metre.
    densities: Vec<(u64, f64, f64)>,
}

impl Gauge {
    /// Creates a meter that starts now.
    pub(super) fn new(meter: Meter, now: &Observed) -> Self {
        let mut gauge = Self { meter, before: Vec::new(), crossings: Vec::new(), densities: Vec::new() };
        gauge.crossings.push((now.step, now.time, 0));
        gauge.remember(now);
        gauge
    }

    /// Returns the meter.
    pub fn meter(&self) -> Meter {
        self.meter
    }

    /// Returns the number of crossings so far.
    pub fn count(&self) -> u32 {
        self.crossings.last().map_or(0, |&(.., count)| count)
    }

    /// Returns the number of crossings against time.
    pub fn counts(&self) -> impl Iterator<Item = [f64; 2]> {
        self.crossings.iter().map(|&(_, time, count)| [time, f64::from(count)])
    }

    /// Returns the crossings per second at a time, averaged over the last five seconds or the shorter time since the
    /// meter started.
    pub fn flow(&self, time: f64) -> f64 {
        let at = |time: f64| {
            let after = self.crossings.partition_point(|&(_, then, _)| then <= time);
            after.checked_sub(1).map_or(0, |k| self.crossings[k].2)
        };
        let begin = self.crossings.first().map_or(0.0, |&(_, time, _)| time).max(time - WINDOW);
        let seconds = time - begin;
        if seconds > 0.0 { f64::from(at(time).saturating_sub(at(begin))) / seconds } else { 0.0 }
    }

    /// Returns the agents per square metre against time.
    pub fn densities(&self) -> impl Iterator<Item = [f64; 2]> {
        self.densities.iter().map(|&(_, time, density)| [time, density])
    }

    /// Updates the crossings after a step.
    pub(super) fn see(&mut self, now: &Observed) {
        let Meter::Line(ends) = self.meter else { return };
        let [a, b] = ends.map(|end| (end - now.origin).as_vec2());
        let near = near(now, [a, b]);
        let crosses = |&&(number, at): &&(u32, Vec2)| {
            let known = self.before.binary_search_by_key(&number, |(number, _)| *number);
            known.is_ok_and(|before| {
                crosses_line(self.before[before].1.as_dvec2(), at.as_dvec2(), [a.as_dvec2(), b.as_dvec2()])
            })
        };
        let crossed = near.iter().filter(crosses).count() as u32;
        if crossed > 0 {
            self.crossings.push((now.step, now.time, self.count() + crossed));
        }
        if self.crossings.len() > MOST {
            // keeps the first and the last count and drops every second count in between
            let mut odd = true;
            self.crossings.retain(|_| {
                odd = !odd;
                !odd
            });
        }
        self.before = near;
    }

    /// Samples the density, which is not measured at every step.
    pub(super) fn sample(&mut self, now: &Observed) {
        let Meter::Area(corners) = self.meter else { return };
        let [a, b] = corners.map(|corner| (corner - now.origin).as_vec2());
        let (low, high) = (a.min(b), a.max(b));
        let inside = |at: &&Vec2| at.cmpge(low).all() && at.cmple(high).all();
        let count = now.beings.iter().map(|being| &being.position).filter(inside).count();
        self.densities.push((now.step, now.time, count as f64 / self.meter.extent()));
    }

    /// Drops the measurements after `now`, because the run has gone back.
    pub(super) fn back(&mut self, now: &Observed) {
        let step = now.step;
        self.crossings.truncate(self.crossings.partition_point(|&(at, ..)| at <= step));
        self.densities.truncate(self.densities.partition_point(|&(at, ..)| at <= step));
        if self.crossings.is_empty() {
            self.crossings.push((step, now.time, 0));
        }
        self.remember(now);
    }

    /// Keeps the samples at multiples of `stride` steps.
    pub(super) fn thin(&mut self, stride: u64) {
        self.densities.retain(|(step, ..)| step.is_multiple_of(stride));
    }

    fn remember(&mut self, now: &Observed) {
        if let Meter::Line(ends) = self.meter {
            self.before = near(now, ends.map(|end| (end - now.origin).as_vec2()));
        }
    }
}

/// Returns the agents that may cross the line in the next step, sorted by number.
fn near(now: &Observed, [a, b]: [Vec2; 2]) -> Vec<(u32, Vec2)> {
    let (low, high) = (a.min(b) - FARTHEST, a.max(b) + FARTHEST);
    let beings = now.beings.iter().map(|being| (being.number, being.position));
    let mut near: Vec<(u32, Vec2)> = beings.filter(|(_, at)| at.cmpge(low).all() && at.cmple(high).all()).collect();
    near.sort_unstable_by_key(|(number, _)| *number);
    near
}

#[cfg(test)]
mod tests {
    use super::*;
    use throng_scene::gallery;

    #[test]
    fn each_agent_that_crosses_is_counted_once() {
        let (mut world, _) = gallery::scene("headon").unwrap().build().unwrap();
        let x = DVec2::new(0.0, 50.0);
        let mut gauge = Gauge::new(Meter::Line([-x, x]), &(&world).into());
        let mut area = Gauge::new(Meter::Area([-DVec2::splat(50.0), DVec2::splat(50.0)]), &(&world).into());
        area.sample(&(&world).into());
        assert_eq!(
            area.densities().next().map(|[_, density]| density),
            Some(world.relative_columns().len() as f64 / 1e4)
        );
        let mut saved = None;
        while !world.finished() && world.steps() < 1000 {
            world.step();
            gauge.see(&(&world).into());
            if gauge.count() == 0 {
                saved = Some(world.save());
            }
        }
        assert_eq!(gauge.count() as usize, world.relative_columns().len());
        assert_eq!(gauge.flow(world.time() + 60.0), 0.0);
        world.load(&saved.unwrap()).unwrap();
        gauge.back(&(&world).into());
        assert_eq!(gauge.count(), 0);
    }

    #[test]
    fn only_agents_near_the_line_are_remembered() {
        let (world, _) = gallery::scene("ring-1000").unwrap().build().unwrap();
        let gauge = Gauge::new(Meter::Line([DVec2::new(100.0, -1.0), DVec2::new(110.0, 1.0)]), &Observed::from(&world));
        // a ring of 103.5 m radius with 0.65 m per agent
        assert!((20..60).contains(&gauge.before.len()), "{}", gauge.before.len());
        assert!(gauge.before.is_sorted_by_key(|(number, _)| *number));
    }
}
