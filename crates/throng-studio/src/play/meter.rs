//! Meters that people put on the ground: flow through a line, density in a rectangle.

use super::observed::Observed;
use glam::{DVec2, Vec2};

/// Seconds over which a flow is taken.
const WINDOW: f64 = 5.0;
/// So many crossings are kept one by one at most.
const MOST: usize = 1 << 15;
/// Who goes farther than this in a step, metres, was put there, and crosses nothing.
const FARTHEST: f32 = 10.0;

/// Something that measures a part of the ground, in world coordinates, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Meter {
    /// Counts who goes through a line, either way.
    Line([DVec2; 2]),
    /// Counts who is in the rectangle that has these corners.
    Area([DVec2; 2]),
}

impl Meter {
    /// Metres of a line, square metres of a rectangle.
    pub fn extent(&self) -> f64 {
        match self {
            Self::Line([a, b]) => a.distance(*b),
            Self::Area([a, b]) => (*b - *a).abs().element_product(),
        }
    }
}

/// What a meter has told so far.
#[derive(Clone, Debug)]
pub struct Gauge {
    meter: Meter,
    /// Where those near the line were a step ago, relative to [`Observed::origin`], by number.
    before: Vec<(u32, Vec2)>,
    /// How many had crossed in all after each step at which somebody did: step, time, count.
    crossings: Vec<(u64, f64, u32)>,
    /// Step, time, and persons a square metre.
    densities: Vec<(u64, f64, f64)>,
}

impl Gauge {
    /// A meter that is put up now.
    pub(super) fn new(meter: Meter, now: &Observed) -> Self {
        let mut gauge = Self { meter, before: Vec::new(), crossings: Vec::new(), densities: Vec::new() };
        gauge.crossings.push((now.step, now.time, 0));
        gauge.remember(now);
        gauge
    }

    /// What measures.
    pub fn meter(&self) -> Meter {
        self.meter
    }

    /// How many have crossed the line in all.
    pub fn count(&self) -> u32 {
        self.crossings.last().map_or(0, |&(.., count)| count)
    }

    /// How many had crossed the line, against time.
    pub fn counts(&self) -> impl Iterator<Item = [f64; 2]> {
        self.crossings.iter().map(|&(_, time, count)| [time, f64::from(count)])
    }

    /// How many a second cross the line around a time, over the last five seconds or what there is of them.
    pub fn flow(&self, time: f64) -> f64 {
        let at = |time: f64| {
            let after = self.crossings.partition_point(|&(_, then, _)| then <= time);
            after.checked_sub(1).map_or(0, |k| self.crossings[k].2)
        };
        let begin = self.crossings.first().map_or(0.0, |&(_, time, _)| time).max(time - WINDOW);
        let seconds = time - begin;
        if seconds > 0.0 { f64::from(at(time).saturating_sub(at(begin))) / seconds } else { 0.0 }
    }

    /// Persons a square metre, against time.
    pub fn densities(&self) -> impl Iterator<Item = [f64; 2]> {
        self.densities.iter().map(|&(_, time, density)| [time, density])
    }

    /// Looks at everybody after a step.
    pub(super) fn see(&mut self, now: &Observed) {
        let Meter::Line(ends) = self.meter else { return };
        let [a, b] = ends.map(|end| (end - now.origin).as_vec2());
        let near = near(now, [a, b]);
        let crosses = |&&(number, at): &&(u32, Vec2)| {
            let known = self.before.binary_search_by_key(&number, |(number, _)| *number);
            known.is_ok_and(|before| cross([self.before[before].1, at], [a, b]))
        };
        let crossed = near.iter().filter(crosses).count() as u32;
        if crossed > 0 {
            self.crossings.push((now.step, now.time, self.count() + crossed));
        }
        if self.crossings.len() > MOST {
            // the first and the last stay: counts in between become coarser
            let mut odd = true;
            self.crossings.retain(|_| {
                odd = !odd;
                !odd
            });
        }
        self.before = near;
    }

    /// Takes a sample of what is not counted at every step.
    pub(super) fn sample(&mut self, now: &Observed) {
        let Meter::Area(corners) = self.meter else { return };
        let [a, b] = corners.map(|corner| (corner - now.origin).as_vec2());
        let (low, high) = (a.min(b), a.max(b));
        let inside = |at: &&Vec2| at.cmpge(low).all() && at.cmple(high).all();
        let count = now.beings.iter().map(|being| &being.position).filter(inside).count();
        self.densities.push((now.step, now.time, count as f64 / self.meter.extent()));
    }

    /// The run has gone back to where everybody is now.
    pub(super) fn back(&mut self, now: &Observed) {
        let step = now.step;
        self.crossings.truncate(self.crossings.partition_point(|&(at, ..)| at <= step));
        self.densities.truncate(self.densities.partition_point(|&(at, ..)| at <= step));
        if self.crossings.is_empty() {
            self.crossings.push((step, now.time, 0));
        }
        self.remember(now);
    }

    /// Keeps the samples of every so many steps.
    pub(super) fn thin(&mut self, stride: u64) {
        self.densities.retain(|(step, ..)| step.is_multiple_of(stride));
    }

    fn remember(&mut self, now: &Observed) {
        if let Meter::Line(ends) = self.meter {
            self.before = near(now, ends.map(|end| (end - now.origin).as_vec2()));
        }
    }
}

/// Who is so near to a line that a step may lead across it, by number.
fn near(now: &Observed, [a, b]: [Vec2; 2]) -> Vec<(u32, Vec2)> {
    let (low, high) = (a.min(b) - FARTHEST, a.max(b) + FARTHEST);
    let beings = now.beings.iter().map(|being| (being.number, being.position));
    let mut near: Vec<(u32, Vec2)> = beings.filter(|(_, at)| at.cmpge(low).all() && at.cmple(high).all()).collect();
    near.sort_unstable_by_key(|(number, _)| *number);
    near
}

/// Whether a way crosses a line; one that ends on it crosses when it goes on.
fn cross([from, to]: [Vec2; 2], [a, b]: [Vec2; 2]) -> bool {
    let side = |point: Vec2, a: Vec2, b: Vec2| (b - a).perp_dot(point - a) > 0.0;
    side(from, a, b) != side(to, a, b) && side(a, from, to) != side(b, from, to)
}

#[cfg(test)]
mod tests {
    use super::*;
    use throng_scene::gallery;

    #[test]
    fn everybody_who_comes_through_is_counted_once() {
        let (mut world, _) = gallery::scene("headon").unwrap().build().unwrap();
        let x = DVec2::new(0.0, 50.0);
        let mut gauge = Gauge::new(Meter::Line([-x, x]), &(&world).into());
        let mut area = Gauge::new(Meter::Area([-DVec2::splat(50.0), DVec2::splat(50.0)]), &(&world).into());
        area.sample(&(&world).into());
        assert_eq!(area.densities().next().map(|[_, density]| density), Some(world.agents().len() as f64 / 1e4));
        let mut saved = None;
        while !world.finished() && world.steps() < 1000 {
            world.step();
            gauge.see(&(&world).into());
            if gauge.count() == 0 {
                saved = Some(world.save());
            }
        }
        assert_eq!(gauge.count() as usize, world.agents().len());
        assert_eq!(gauge.flow(world.time() + 60.0), 0.0);
        world.load(&saved.unwrap()).unwrap();
        gauge.back(&(&world).into());
        assert_eq!(gauge.count(), 0);
    }

    #[test]
    fn only_who_is_near_is_remembered() {
        let (world, _) = gallery::scene("ring-1000").unwrap().build().unwrap();
        let gauge = Gauge::new(Meter::Line([DVec2::new(100.0, -1.0), DVec2::new(110.0, 1.0)]), &Observed::from(&world));
        // a ring of 103.5 m, 0.65 m for each
        assert!((20..60).contains(&gauge.before.len()), "{}", gauge.before.len());
        assert!(gauge.before.is_sorted_by_key(|(number, _)| *number));
    }

    #[test]
    fn who_passes_beside_the_line_does_not_cross_it() {
        let line = [Vec2::ZERO, Vec2::Y];
        assert!(cross([Vec2::new(-1.0, 0.5), Vec2::new(1.0, 0.5)], line));
        assert!(!cross([Vec2::new(-1.0, 1.5), Vec2::new(1.0, 1.5)], line));
        assert!(!cross([Vec2::new(1.0, 0.5), Vec2::new(2.0, 0.5)], line));
    }
}
