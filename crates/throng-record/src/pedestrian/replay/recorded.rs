//! The recorded pedestrians, with their assumed goals and preferred speeds.

use super::pause::{Pause, pauses};
use crate::pedestrian::{Border, People, Velocities, Walk};
use glam::DVec2;

/// Speed below which a pedestrian stands, m/s: about the noise of recordings.
const STANDS: f64 = 0.1;
/// Speed below which a pedestrian pauses, or has come to stay at its last position, m/s.
pub(super) const STAYS: f64 = 0.2;

/// The assumption on a pedestrian's preferred speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pace {
    /// The mean of the pedestrian's speeds while walking (faster than 0.1 m/s, and in no pause).
    Mean,
    /// A quantile, 0 to 1, of the pedestrian's speeds while walking: 0.5 for the median.
    Quantile(f64),
    /// The same speed for all, m/s.
    Constant(f64),
}

/// The assumed goal and preferred speed of a recorded pedestrian.
#[derive(Clone, Debug, PartialEq)]
pub struct Walker {
    /// Preferred speed, m/s.
    pub speed: f64,
    /// The goal: the last recorded position, metres.
    pub goal: DVec2,
    /// Whether the pedestrian stood at its last row, and therefore stays at the goal until then.
    pub stays: bool,
    /// The pauses on the way, in order.
    pub pauses: Vec<Pause>,
}

impl Walker {
    /// Returns the pauses that are not over at a time.
    pub fn pauses_after(&self, time: f64) -> &[Pause] {
        &self.pauses[self.pauses.partition_point(|pause| pause.until <= time)..]
    }

    /// Returns the position at `time` of a pedestrian that moves along straight lines from `place` at `start`: at
    /// preferred speed to each pause, where it stands until the pause is over, then to the goal. A pedestrian that has
    /// not reached a pause when it is over continues from its position.
    pub fn straight(&self, place: DVec2, start: f64, time: f64) -> DVec2 {
        let toward = |from: DVec2, to: DVec2, seconds: f64| from + (to - from).clamp_length_max(self.speed * seconds);
        let (mut place, mut now) = (place, start);
        for pause in self.pauses_after(start) {
            if now >= time {
                break;
            }
            let until = pause.until.min(time);
            place = toward(place, pause.place, until - now);
            now = until;
        }
        if now < time { toward(place, self.goal, time - now) } else { place }
    }
}

/// The recorded pedestrians.
#[derive(Clone, Debug)]
pub struct RecordedPeople {
    /// Pedestrians with at least two rows at different times.
    pub people: People,
    /// Goals and preferred speeds, by walk.
    pub walkers: Vec<Walker>,
    /// Number of pedestrians with a single row.
    pub seen_once: usize,
    /// Number of rows before and after over which a velocity is taken.
    pub rows: usize,
    /// Number of rows before over which the velocity is taken with which a pedestrian continues.
    back: usize,
}

impl Pace {
    /// Returns the preferred speed of a pedestrian with these speeds; 0 if it never walks.
    fn of(self, mut speeds: Vec<f64>) -> f64 {
        speeds.retain(|speed| *speed > STANDS);
        match self {
            Self::Constant(speed) => speed,
            _ if speeds.is_empty() => 0.0,
            Self::Mean => speeds.iter().sum::<f64>() / speeds.len() as f64,
            Self::Quantile(part) => {
                let rank = (part.clamp(0.0, 1.0) * (speeds.len() - 1) as f64).round() as usize;
                *speeds.select_nth_unstable_by(rank, f64::total_cmp).1
            }
        }
    }
}

impl RecordedPeople {
    /// Creates the pedestrians of a recording, with velocities over `interval` seconds, rounded to whole rows, at least
    /// one.
    ///
    /// ```
    /// use throng_record::pedestrian::{People, replay::{RecordedPeople, Pace}};
    /// let places = [0.0, 0.5, 1.0, 1.5].map(|x| glam::DVec2::X * x).to_vec();
    /// let walk = throng_record::pedestrian::Walk { number: 7, radius: 0.2, times: vec![0.0, 0.4, 0.8, 1.2], places };
    /// let cast = RecordedPeople::new(&People::new(vec![walk]), Pace::Quantile(0.5), 0.4);
    /// assert_eq!((cast.walkers[0].speed, cast.walkers[0].goal.x, cast.walkers[0].stays), (1.25, 1.5, false));
    /// ```
    pub fn new(people: &People, pace: Pace, interval: f64) -> Self {
        let moves = |walk: &&Walk| walk.times.last() > walk.times.first();
        let seen = People::new(people.walks.iter().filter(moves).cloned().collect());
        let whole = |rows: f64| if rows >= 1.0 { rows as usize } else { 1 };
        let rows = whole((0.5 * interval / seen.interval()).round());
        let mut cast = Self {
            seen_once: people.walks.len() - seen.walks.len(),
            walkers: Vec::new(),
            rows,
            back: whole((interval / seen.interval()).round()),
            people: seen,
        };
        let velocities = Velocities::of(&cast.people, rows, Border::OneSided);
        let speed = |velocity: &Option<DVec2>| velocity.map_or(0.0, DVec2::length);
        let speeds = velocities.walks().iter().map(|rows| rows.iter().map(speed).collect()).collect::<Vec<Vec<f64>>>();
        let pauses = pauses(&cast.people, &speeds);
        let walkers = pauses.into_iter().zip(speeds).enumerate().map(|(index, (pauses, speeds))| {
            let walk = &cast.people.walks[index];
            let paused = |time: f64| pauses.iter().any(|pause| (pause.from..=pause.until).contains(&time));
            let walking = speeds.into_iter().zip(&walk.times).filter(|(_, time)| !paused(**time));
            let last = walk.places.len() - 1;
            Walker {
                speed: pace.of(walking.map(|(speed, _)| speed).collect()),
                goal: walk.places[last],
                stays: cast.velocity(index, last).length() < STAYS,
                pauses,
            }
        });
        cast.walkers = walkers.collect();
        cast
    }

    /// Removes all pauses; goals and speeds remain.
    #[must_use]
    pub fn without_pauses(mut self) -> Self {
        self.walkers.iter_mut().for_each(|walker| walker.pauses.clear());
        self
    }

    /// Returns the velocity with which a pedestrian continues from a row, m/s: the velocity over the rows up to it; at
    /// the first rows, the velocity over the first rows.
    pub fn velocity(&self, walk: usize, row: usize) -> DVec2 {
        let Walk { times, places, .. } = &self.people.walks[walk];
        let (from, to) = if self.has_past(row) { (row - self.back, row) } else { (0, self.back.min(times.len() - 1)) };
        (places[to] - places[from]) / (times[to] - times[from])
    }

    /// Whether the velocity at this row is taken over the rows up to it.
    pub fn has_past(&self, row: usize) -> bool {
        row >= self.back
    }

    /// Returns the walk of an agent number.
    pub fn walk_of(&self, number: u32) -> Option<usize> {
        self.people.walks.binary_search_by_key(&number, |walk| walk.number).ok()
    }

    /// Returns all times, seconds.
    pub fn times(&self) -> Vec<f64> {
        self.people.moments.iter().map(|moment| moment.time).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a walk at these speeds, a second each, four rows per second.
    fn walk(speeds: &[f64]) -> Walk {
        let (mut times, mut places) = (vec![10.0], vec![DVec2::new(3.0, -2.0)]);
        for speed in speeds {
            for _ in 0..4 {
                times.push(times[times.len() - 1] + 0.25);
                places.push(places[places.len() - 1] + 0.25 * speed * DVec2::Y);
            }
        }
        Walk { number: 4, radius: 0.25, times, places }
    }

    #[test]
    fn speeds_are_those_of_walking() {
        let people = People::new(vec![walk(&[1.0, 1.0, 0.0, 0.0, 1.5])]);
        let speed = |pace| RecordedPeople::new(&people, pace, 0.25).walkers[0].speed;
        // of 21 rows, the first nine are at 1 m/s, two are transitions to 0 and to 1.5 m/s, seven at 0, four at 1.5 m/s
        assert_eq!(
            (speed(Pace::Quantile(0.5)), speed(Pace::Quantile(1.0)), speed(Pace::Quantile(0.0))),
            (1.0, 1.5, 0.5)
        );
        assert!((speed(Pace::Mean) - (8.0 + 0.5 + 0.75 + 6.0) / 14.0).abs() < 1e-9, "{}", speed(Pace::Mean));
        assert_eq!(speed(Pace::Constant(1.3)), 1.3);
        let stands = People::new(vec![walk(&[0.0, 0.05])]);
        let cast = RecordedPeople::new(&stands, Pace::Mean, 0.25);
        assert_eq!((cast.walkers[0].speed, cast.walkers[0].stays), (0.0, true));
    }

    #[test]
    fn a_pedestrian_continues_with_the_velocity_so_far() {
        let people = People::new(vec![walk(&[1.0, 2.0])]);
        let cast = RecordedPeople::new(&people, Pace::Mean, 0.5);
        let velocity = |row| cast.velocity(0, row).y;
        assert_eq!([0, 1, 2, 4, 5, 6, 8].map(velocity), [1.0, 1.0, 1.0, 1.0, 1.5, 2.0, 2.0]);
        assert!(!cast.has_past(1) && cast.has_past(2));
        let once = Walk { number: 9, times: vec![1.0], places: vec![DVec2::ZERO], radius: 0.2 };
        let cast = RecordedPeople::new(&People::new(vec![walk(&[1.0]), once]), Pace::Mean, 0.5);
        assert_eq!((cast.seen_once, cast.walk_of(4), cast.walk_of(9)), (1, Some(0), None));
    }
}
