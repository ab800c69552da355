//! Comparison of the distributions of recorded and replayed pedestrians.

use crate::pedestrian::{Line, People, Velocities, median};
use glam::DVec2;

/// Values of recorded and of replayed pedestrians.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pair {
    /// Values of the recording.
    pub recorded: Vec<f64>,
    /// Values of the replay.
    pub replayed: Vec<f64>,
}

/// The distributions of both: all pedestrians at all times count.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Compared {
    /// Speeds, m/s.
    pub speed: Pair,
    /// Distances to the nearest other pedestrian, metres.
    pub nearest: Pair,
    /// Times of the first crossings of a line, seconds.
    pub crossings: Option<Pair>,
}

impl Pair {
    /// Returns the Kolmogorov-Smirnov distance of the two ([`kolmogorov_smirnov`]).
    pub fn distance(&self) -> f64 {
        kolmogorov_smirnov(&self.recorded, &self.replayed)
    }

    /// Returns the medians.
    pub fn medians(&self) -> [f64; 2] {
        [median(self.recorded.clone()), median(self.replayed.clone())]
    }

    /// Returns the means; NaN for no values.
    pub fn means(&self) -> [f64; 2] {
        [&self.recorded, &self.replayed].map(|all| all.iter().sum::<f64>() / all.len() as f64)
    }
}

impl Compared {
    /// Compares recorded and replayed pedestrians, with their velocities.
    pub fn of(both: [(&People, &Velocities); 2], line: Option<Line>) -> Self {
        let pair = |of: &dyn Fn(&People, &Velocities) -> Vec<f64>| {
            let [recorded, replayed] = both.map(|(people, velocities)| of(people, velocities));
            Pair { recorded, replayed }
        };
        let crossings = |line: Line| pair(&|people, _| line.crossings(people).iter().map(|at| at.time).collect());
        Self {
            speed: pair(&|_, velocities| velocities.walks().iter().flatten().flatten().map(|v| v.length()).collect()),
            nearest: pair(&|people, _| nearest(people)),
            crossings: line.map(crossings),
        }
    }
}

/// Returns the distance of every pedestrian to the nearest other one at every time, if there is one, metres.
fn nearest(people: &People) -> Vec<f64> {
    let mut out = Vec::new();
    for moment in &people.moments {
        let mut places: Vec<DVec2> = moment.here.iter().map(|&here| people.place(here)).collect();
        places.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        for (k, place) in places.iter().enumerate() {
            // a pedestrian farther along x than the least distance so far is not nearer
            let mut least = f64::INFINITY;
            for other in &places[k + 1..] {
                if other.x - place.x >= least {
                    break;
                }
                least = least.min(place.distance(*other));
            }
            for other in places[..k].iter().rev() {
                if place.x - other.x >= least {
                    break;
                }
                least = least.min(place.distance(*other));
            }
            out.push(least);
        }
    }
    out.retain(|distance| distance.is_finite());
    out
}

/// Returns the two-sample Kolmogorov-Smirnov distance: the greatest difference of the two empirical distribution
/// functions. It is 0 for equal distributions, and 1 if all values of one sample are below all of the other. NaN if a
/// sample is empty. The values of a pedestrian over time are not independent: the distance measures the difference of
/// two distributions, not its significance.
///
/// ```
/// use throng_record::pedestrian::replay::kolmogorov_smirnov;
/// assert_eq!(kolmogorov_smirnov(&[1.0, 2.0, 3.0, 4.0], &[3.0, 4.0, 5.0, 6.0]), 0.5);
/// ```
pub fn kolmogorov_smirnov(a: &[f64], b: &[f64]) -> f64 {
    if a.is_empty() || b.is_empty() {
        return f64::NAN;
    }
    let sorted = |all: &[f64]| {
        let mut all = all.to_vec();
        all.sort_by(f64::total_cmp);
        all
    };
    let (a, b) = (sorted(a), sorted(b));
    let (mut i, mut j, mut most) = (0, 0, 0.0_f64);
    while i < a.len() && j < b.len() {
        let value = a[i].min(b[j]);
        i += a[i..].iter().take_while(|x| **x <= value).count();
        j += b[j..].iter().take_while(|x| **x <= value).count();
        most = most.max((i as f64 / a.len() as f64 - j as f64 / b.len() as f64).abs());
    }
    most
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draws::draws;
    use crate::pedestrian::{Border, Walk};

    #[test]
    fn the_distance_is_the_greatest_difference_of_shares() {
        let mut draw = draws(5);
        for (n, m) in [(1, 1), (1, 7), (20, 13), (200, 300)] {
            // includes repeated values
            let mut some =
                |n: usize, by: f64| -> Vec<f64> { (0..n).map(|_| (draw() * 20.0).floor() * 0.1 + by).collect() };
            let (a, b) = (some(n, 0.0), some(m, 0.3));
            let share = |all: &[f64], at: f64| all.iter().filter(|x| **x <= at).count() as f64 / all.len() as f64;
            let differences = a.iter().chain(&b).map(|&at| (share(&a, at) - share(&b, at)).abs());
            let most = differences.fold(0.0, f64::max);
            assert!((kolmogorov_smirnov(&a, &b) - most).abs() < 1e-12);
            assert_eq!(kolmogorov_smirnov(&a, &b), kolmogorov_smirnov(&b, &a));
            assert_eq!(kolmogorov_smirnov(&a, &a), 0.0);
        }
        assert_eq!(kolmogorov_smirnov(&[1.0], &[2.0, 3.0]), 1.0);
        assert!(kolmogorov_smirnov(&[], &[1.0]).is_nan());
    }

    #[test]
    fn the_nearest_is_that_of_all_pairs() {
        let mut draw = draws(5);
        let walk = |number: u32, place: DVec2| Walk { number, radius: 0.2, times: vec![0.0], places: vec![place] };
        for count in [0u32, 1, 2, 3, 40] {
            let places: Vec<DVec2> = (0..count).map(|_| DVec2::new(9.0 * draw(), 3.0 * draw())).collect();
            let people = People::new(places.iter().zip(0..).map(|(&place, number)| walk(number, place)).collect());
            let others = |k: usize| (0..places.len()).filter(move |&j| j != k);
            let least = |k: usize| others(k).map(|j| places[k].distance(places[j])).fold(f64::INFINITY, f64::min);
            let mut want: Vec<f64> = (0..places.len()).map(least).filter(|distance| distance.is_finite()).collect();
            let mut found = nearest(&people);
            want.sort_by(f64::total_cmp);
            found.sort_by(f64::total_cmp);
            assert_eq!(found, want, "{count}");
        }
    }

    #[test]
    fn equal_recordings_have_no_distance() {
        let places = (0..10).map(|k| DVec2::X * f64::from(k)).collect();
        let walk = Walk { number: 1, radius: 0.2, times: (0..10).map(f64::from).collect(), places };
        let people = People::new(vec![walk]);
        let velocities = Velocities::of(&people, 1, Border::OneSided);
        let line = Line { from: DVec2::new(3.5, -1.0), to: DVec2::new(3.5, 1.0) };
        let found = Compared::of([(&people, &velocities), (&people, &velocities)], Some(line));
        assert_eq!((found.speed.distance(), found.speed.medians(), found.speed.means()), (0.0, [1.0; 2], [1.0; 2]));
        assert!(found.nearest.distance().is_nan());
        assert_eq!(found.crossings.unwrap().recorded, [4.0]);
    }
}
