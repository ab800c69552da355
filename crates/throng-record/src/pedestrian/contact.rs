//! Distances and times to collision of pedestrians.

use super::people::{People, PersonRow};
use super::speed::Velocities;
use glam::DVec2;
use std::collections::BTreeSet;

/// Time to collision below which a pair is a near miss, seconds.
pub const NEAR_MISS: f64 = 0.5;

/// Contacts of all pairs at all times.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contacts {
    /// Least distance of two centres, metres; infinite if no two pedestrians are ever present together.
    pub least: f64,
    /// Least distance of two centres over the sum of their radii; 1: the discs touch.
    pub separation: f64,
    /// Number of times that two bodies started to overlap.
    pub collisions: usize,
    /// Number of times that the time to collision of two bodies without overlap fell below [`NEAR_MISS`].
    pub near_misses: usize,
    /// Least time to collision of all near misses, seconds; infinite if there are none.
    pub least_time: f64,
}

impl Contacts {
    /// Computes the contacts of all pedestrians with these velocities.
    pub fn of(people: &People, velocities: &Velocities) -> Self {
        let mut out = Self {
            least: f64::INFINITY,
            separation: f64::INFINITY,
            collisions: 0,
            near_misses: 0,
            least_time: f64::INFINITY,
        };
        let radius = |here: &PersonRow| people.walks[here.walk].radius;
        let (mut overlapped, mut missed) = (BTreeSet::new(), BTreeSet::new());
        for moment in &people.moments {
            let (mut overlap, mut miss) = (BTreeSet::new(), BTreeSet::new());
            let mut order: Vec<(DVec2, PersonRow)> =
                moment.here.iter().map(|&here| (people.place(here), here)).collect();
            order.sort_by(|a, b| a.0.x.total_cmp(&b.0.x).then(a.1.walk.cmp(&b.1.walk)));
            let speed = |here: PersonRow| velocities.at(here).unwrap_or_default();
            let fastest = order.iter().map(|(_, here)| speed(*here).length()).fold(0.0, f64::max);
            let widest = order.iter().map(|(_, here)| radius(here)).fold(0.0, f64::max);
            for (k, &(place, here)) in order.iter().enumerate() {
                // pairs farther apart than this cannot be near misses or overlaps
                let reach = 2.0 * (widest + fastest * NEAR_MISS);
                for &(other, there) in &order[k + 1..] {
                    let aside = other.x - place.x;
                    if aside > reach && aside > out.least && aside > out.separation * 2.0 * widest {
                        break;
                    }
                    let (radii, apart) = (radius(&here) + radius(&there), other - place);
                    out.least = out.least.min(apart.length());
                    out.separation = out.separation.min(apart.length() / radii);
                    let pair = (here.walk.min(there.walk), here.walk.max(there.walk));
                    if apart.length() < radii {
                        overlap.insert(pair);
                    } else if let Some(time) = time_to_collision(apart, speed(there) - speed(here), radii)
                        && time < NEAR_MISS
                    {
                        out.least_time = out.least_time.min(time);
                        miss.insert(pair);
                    }
                }
            }
            out.collisions += overlap.difference(&overlapped).count();
            out.near_misses += miss.difference(&missed).count();
            (overlapped, missed) = (overlap, miss);
        }
        out
    }
}

/// Returns the time to collision, seconds: the time until two discs touch at constant velocities (J. C. Hayward,
/// *Near-miss determination through use of a scale of danger*, Highway Research Record 384, 1972). `apart` and
/// `velocity` are the position and the velocity of one disc relative to the other; `radii` is the sum of their radii.
/// Returns `None` if the discs never touch, and 0 if they overlap.
///
/// ```
/// use glam::DVec2;
/// use throng_record::pedestrian::time_to_collision;
/// assert_eq!(time_to_collision(DVec2::X * 5.0, -DVec2::X * 2.0, 1.0), Some(2.0));
/// assert_eq!(time_to_collision(DVec2::X * 5.0, DVec2::Y, 1.0), None);
/// ```
pub fn time_to_collision(apart: DVec2, velocity: DVec2, radii: f64) -> Option<f64> {
    let (a, b, c) = (velocity.length_squared(), apart.dot(velocity), apart.length_squared() - radii * radii);
    if c < 0.0 {
        return Some(0.0);
    }
    let root = b * b - a * c;
    (b < 0.0 && root >= 0.0).then(|| c / (root.sqrt() - b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draws::draws;
    use crate::pedestrian::{Border, PeopleMoment, Walk};

    #[test]
    fn contacts_are_those_of_all_pairs() {
        let mut next = draws(3);
        for count in [0, 1, 2, 5, 40] {
            let walks: Vec<Walk> = (0..count)
                .map(|number| {
                    let (start, way) = (DVec2::new(9.0 * next(), 9.0 * next()), DVec2::new(next() - 0.5, next() - 0.5));
                    let places = (0..20).map(|k| start + f64::from(k) * 0.3 * way).collect();
                    let times = (0..20).map(|k| f64::from(k) * 0.1).collect();
                    Walk { number, radius: 0.1 + 0.3 * next(), times, places }
                })
                .collect();
            let here = |row: usize| (0..walks.len()).map(move |walk| PersonRow { walk, row }).collect();
            let moments = (0..20).map(|row| PeopleMoment { time: row as f64 * 0.1, here: here(row) }).collect();
            let people = People { walks, moments };
            let velocities = Velocities::of(&people, 1, Border::OneSided);
            let found = Contacts::of(&people, &velocities);
            let (mut collisions, mut misses) = (0, 0);
            let (mut least, mut separation) = (f64::INFINITY, f64::INFINITY);
            for (k, a) in people.walks.iter().enumerate() {
                for (l, b) in people.walks[..k].iter().enumerate() {
                    let (mut overlapped, mut missed) = (false, false);
                    for row in 0..20 {
                        let (apart, radii) = (b.places[row] - a.places[row], a.radius + b.radius);
                        let speed = |walk| velocities.at(PersonRow { walk, row }).unwrap();
                        let time = time_to_collision(apart, speed(l) - speed(k), radii);
                        let overlap = apart.length() < radii;
                        let miss = !overlap && time.is_some_and(|time| time < NEAR_MISS);
                        collisions += usize::from(overlap && !overlapped);
                        misses += usize::from(miss && !missed);
                        (overlapped, missed) = (overlap, miss);
                        (least, separation) = (least.min(apart.length()), separation.min(apart.length() / radii));
                    }
                }
            }
            assert_eq!((found.collisions, found.near_misses), (collisions, misses));
            assert_eq!((found.least, found.separation), (least, separation));
        }
    }

    #[test]
    fn a_time_to_collision_is_when_they_touch() {
        let (apart, velocity) = (DVec2::new(3.0, 0.4), DVec2::new(-1.5, -0.1));
        let time = time_to_collision(apart, velocity, 0.5).unwrap();
        assert!(((apart + time * velocity).length() - 0.5).abs() < 1e-12);
        assert_eq!(time_to_collision(apart, DVec2::ZERO, 0.5), None);
        assert_eq!(time_to_collision(apart, -velocity, 0.5), None);
        assert_eq!(time_to_collision(DVec2::ZERO, velocity, 0.5), Some(0.0));
    }
}
