//! Travel times, path lengths and evacuation times of pedestrians.

use super::people::{People, Walk};
use crate::swarm::Distribution;
use glam::DVec2;

/// Ways of pedestrians from their first to their last positions.
#[derive(Clone, Debug, Default)]
pub struct Ways {
    /// Travel times, seconds.
    pub time: Distribution,
    /// Path lengths, metres.
    pub length: Distribution,
    /// Path ratios: path length over straight distance, of ways with a straight distance above 1 m; swaying counts.
    pub ratio: Distribution,
    /// Last times of all pedestrians, ascending, seconds after the first time of the recording.
    left: Vec<f64>,
}

impl Ways {
    /// Computes the ways of all pedestrians.
    pub fn of(people: &People) -> Self {
        let mut out = Self::default();
        let start = people.moments.first().map_or(0.0, |moment| moment.time);
        for walk in &people.walks {
            let ([first, .., last], [from, .., to]) = (&walk.times[..], &walk.places[..]) else { continue };
            let (length, straight) = (length(walk), from.distance(*to));
            out.time.add(last - first);
            out.length.add(length);
            if straight > 1.0 {
                out.ratio.add(length / straight);
            }
        }
        out.left.extend(people.walks.iter().filter_map(|walk| walk.times.last()).map(|last| last - start));
        out.left.sort_by(f64::total_cmp);
        out
    }

    /// Returns the evacuation time: the time after which a fraction `part` of all pedestrians, 0 to 1, is no longer
    /// present, seconds after the first time; `None` for no pedestrians.
    pub fn left(&self, part: f64) -> Option<f64> {
        let count = (part.clamp(0.0, 1.0) * self.left.len() as f64).ceil() as usize;
        self.left.get(count.max(1) - 1).copied()
    }
}

fn length(walk: &Walk) -> f64 {
    walk.places.windows(2).map(|pair: &[DVec2]| pair[0].distance(pair[1])).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pedestrian::PeopleMoment;

    #[test]
    fn ways_and_leaving_are_counted_from_first_to_last() {
        let walk = |number: u32, times: &[f64], places: &[(f64, f64)]| {
            let places = places.iter().map(|&place| place.into()).collect();
            Walk { number, radius: 0.2, times: times.to_vec(), places }
        };
        let walks = vec![
            walk(1, &[10.0, 12.0, 14.0], &[(0.0, 0.0), (3.0, 0.0), (3.0, 4.0)]),
            walk(2, &[11.0, 13.0], &[(0.0, 0.0), (0.5, 0.0)]),
            walk(3, &[20.0], &[(0.0, 0.0)]),
        ];
        let found = Ways::of(&People { walks, moments: vec![PeopleMoment { time: 10.0, here: vec![] }] });
        assert_eq!((found.time.mean(), found.length.mean(), found.ratio.mean()), (3.0, 3.75, 1.4));
        assert_eq!([0.0, 0.3, 0.5, 0.95, 1.0].map(|part| found.left(part).unwrap()), [3.0, 3.0, 4.0, 10.0, 10.0]);
        assert_eq!(Ways::default().left(0.5), None);
    }
}
