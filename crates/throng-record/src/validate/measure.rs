//! Measures that several experiments share.

use super::Run;
use crate::pedestrian::{Area, Border, Crossing, Ground, Line, PeopleMoment, Velocities, voronoi};
use glam::DVec2;
use std::ops::RangeInclusive;

/// Half the interval of velocities, seconds.
const HALF_INTERVAL: f64 = 0.4;
/// Fraction of the crossings at either end that is left out.
const TAIL: f64 = 0.05;

/// Returns velocities over ±0.4 s.
pub fn velocities(run: &Run) -> Velocities {
    let rows = (HALF_INTERVAL / run.people.interval()).round();
    Velocities::of(&run.people, if rows >= 1.0 { rows as usize } else { 1 }, Border::OneSided)
}

/// A line across a corridor that runs along x, from `low` to `high`.
pub fn across(x: f64, low: f64, high: f64) -> Line {
    Line { from: DVec2::new(x, low), to: DVec2::new(x, high) }
}

/// Returns the time over which a flow is measured: from the crossing of the first 5 % to that of the last 5 %, seconds.
pub fn steady(crossings: &[Crossing]) -> RangeInclusive<f64> {
    let n = crossings.len();
    let at =
        |share: f64| crossings.get(((share * n as f64) as usize).min(n.saturating_sub(1))).map_or(0.0, |at| at.time);
    at(TAIL)..=at(1.0 - TAIL)
}

/// Returns the frames within a time.
pub fn moments<'r>(run: &'r Run, time: &RangeInclusive<f64>) -> impl Iterator<Item = &'r PeopleMoment> {
    let time = time.clone();
    run.people.moments.iter().filter(move |moment| time.contains(&moment.time))
}

/// Returns the mean number of agents in an area over its size, 1/m², and their mean speed, m/s, within a time.
pub fn density_and_speed(run: &Run, area: &Area, time: &RangeInclusive<f64>) -> (f64, f64) {
    let velocities = velocities(run);
    let (mut sum, mut agents, mut count) = (0.0, 0u32, 0u32);
    for moment in moments(run, time) {
        count += 1;
        for &here in moment.here.iter().filter(|&&here| area.contains(run.people.place(here))) {
            if let Some(velocity) = velocities.at(here) {
                sum += velocity.length();
                agents += 1;
            }
        }
    }
    (f64::from(agents) / f64::from(count) / area.size(), sum / f64::from(agents))
}

/// Returns the mean Voronoi density of an area within a time, 1/m², from every 6th frame.
pub fn voronoi_density(run: &Run, area: &Area, time: &RangeInclusive<f64>) -> f64 {
    /// Densities change slowly.
    const EVERY: usize = 6;
    let ground = Ground { walkable: run.walkable.clone(), cut_off: None };
    let at = |moment: &PeopleMoment| voronoi::density(&voronoi::cells(&run.people, moment, &ground, area), area);
    mean(moments(run, time).step_by(EVERY).map(at))
}

/// Returns the mean speed along a circle about the origin within a time, positive counter-clockwise, m/s. Each agent's
/// path length is measured at its own distance from the centre.
pub fn speed_round(run: &Run, time: &RangeInclusive<f64>) -> f64 {
    let (mut way, mut seconds) = (0.0, 0.0);
    for walk in &run.people.walks {
        let rows = walk.times.windows(2).zip(walk.places.windows(2));
        for (times, places) in rows.filter(|(times, _)| time.contains(&times[0]) && time.contains(&times[1])) {
            let angle = places[0].perp_dot(places[1]).atan2(places[0].dot(places[1]));
            way += angle * 0.5 * (places[0].length() + places[1].length());
            seconds += times[1] - times[0];
        }
    }
    way / seconds
}

/// Returns the mean; NaN for no values.
pub fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0u32), |(sum, count), value| (sum + value, count + 1));
    sum / f64::from(count)
}

/// Returns the value below which a share of all values lies; NaN for no values.
pub fn quantile(mut values: Vec<f64>, share: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    let at = (share * values.len().saturating_sub(1) as f64).round() as usize;
    values.get(at).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pedestrian::{People, Walk};
    use throng::Summary;

    fn run(walks: Vec<Walk>) -> Run {
        let summary = Summary { agents: walks.len(), ..Summary::default() };
        Run { people: People::new(walks), groups: std::iter::once(0..1).collect(), walkable: vec![], summary, left: 0 }
    }

    /// Returns an agent that moves along a path for 10 s.
    fn walk(number: u32, at: impl Fn(f64) -> DVec2) -> Walk {
        let times: Vec<f64> = (0..=100).map(|k| 0.1 * f64::from(k)).collect();
        let places = times.iter().map(|&time| at(time)).collect();
        Walk { number, radius: 0.2, times, places }
    }

    #[test]
    fn the_speed_round_a_ring_is_that_along_it() {
        let circle = |radius: f64, speed: f64| move |time: f64| radius * DVec2::from_angle(speed * time / radius);
        let run = run(vec![walk(0, circle(4.0, 1.2)), walk(1, circle(5.0, 0.8)), walk(2, circle(6.0, -0.5))]);
        assert!((speed_round(&run, &(2.0..=9.0)) - 0.5).abs() < 1e-9);
        // an agent that sways across the ring makes no progress
        let sways = walk(0, |time| DVec2::X * (5.0 + 0.3 * (3.0 * time).sin()));
        assert!(speed_round(&self::run(vec![sways]), &(0.0..=10.0)).abs() < 1e-12);
    }

    #[test]
    fn density_and_speed_are_those_of_the_agents_in_the_area() {
        // an agent enters the square metre at 3 s and leaves it at 5 s
        let run = run(vec![walk(0, |time| DVec2::new(0.5 * time - 1.5, 0.5)), walk(1, |time| DVec2::new(time, 9.0))]);
        let area = Area::rectangle([0.0, 0.0, 1.0, 1.0]).unwrap();
        let (rho, v) = density_and_speed(&run, &area, &(0.0..=10.0));
        assert!((rho - 0.2).abs() < 0.02 && (v - 0.5).abs() < 1e-9, "{rho} {v}");
    }

    #[test]
    fn a_quantile_lies_among_the_values() {
        let values: Vec<f64> = (0..101).map(|k| f64::from(100 - k)).collect();
        assert_eq!(
            [0.0, 0.25, 0.5, 0.99, 1.0].map(|share| quantile(values.clone(), share)),
            [0.0, 25.0, 50.0, 99.0, 100.0]
        );
        assert!(quantile(vec![], 0.5).is_nan());
    }
}
