//! Recorded pedestrians, by walk and by time.

use crate::trajectories::{Sample, Trajectories};
use glam::DVec2;

/// The trajectory of a pedestrian: its positions at times.
#[derive(Clone, Debug, PartialEq)]
pub struct Walk {
    /// The agent number.
    pub number: u32,
    /// Radius of the body, metres.
    pub radius: f64,
    /// Times, ascending, seconds.
    pub times: Vec<f64>,
    /// The position at each time, metres.
    pub places: Vec<DVec2>,
}

impl Walk {
    /// Returns the position at a time, interpolated linearly between rows; `None` before the first and after the last
    /// row.
    ///
    /// ```
    /// use glam::DVec2;
    /// let walk = throng_record::pedestrian::Walk { number: 1, radius: 0.2, times: vec![1.0, 3.0], places: vec![DVec2::ZERO, DVec2::X] };
    /// assert_eq!([0.5, 1.0, 2.5, 3.0].map(|time| walk.at(time).map(|at| at.x)), [None, Some(0.0), Some(0.75), Some(1.0)]);
    /// ```
    pub fn at(&self, time: f64) -> Option<DVec2> {
        let (row, share) = self.row_at(time)?;
        Some(if share > 0.0 { self.places[row].lerp(self.places[row + 1], share) } else { self.places[row] })
    }

    /// Returns the last row at or before a time, and the fraction of the interval to the next row that has passed, 0 to
    /// 1.
    pub(crate) fn row_at(&self, time: f64) -> Option<(usize, f64)> {
        // the tolerance keeps rows that rounding would skip
        let row = self.times.partition_point(|&row| row <= time + 1e-9).checked_sub(1)?;
        let Some(next) = self.times.get(row + 1) else {
            return (time <= self.times[row] + 1e-9).then_some((row, 0.0));
        };
        Some((row, ((time - self.times[row]) / (next - self.times[row])).max(0.0)))
    }
}

/// A row of a walk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PersonRow {
    /// Index into [`People::walks`].
    pub walk: usize,
    /// Index into the times and places of the walk.
    pub row: usize,
}

/// The pedestrians that are present at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct PeopleMoment {
    /// Seconds.
    pub time: f64,
    /// Their rows, by number.
    pub here: Vec<PersonRow>,
}

/// Recorded pedestrians on the ground. Altitudes are ignored.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct People {
    /// All walks, by number.
    pub walks: Vec<Walk>,
    /// All times, in order.
    pub moments: Vec<PeopleMoment>,
}

impl People {
    /// Returns the pedestrians of trajectories, from the samples that `counts` accepts. If an agent has two samples at
    /// a time, the first one counts.
    ///
    /// ```
    /// use throng_record::pedestrian::People;
    /// # let folder = tempfile::tempdir()?;
    /// # let path = folder.path().join("walk.csv");
    /// std::fs::write(&path, "number,time,x,y\n7,0,0,0\n7,0.5,0.6,0\n7,1,1.2,0\n")?;
    /// let people = People::of(&throng_record::Trajectories::read(path)?, |_| true);
    /// assert_eq!((people.walks.len(), people.moments.len(), people.interval()), (1, 3, 0.5));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn of(tracks: &Trajectories, counts: impl Fn(&Sample) -> bool) -> Self {
        let mut spots: Vec<&Sample> = tracks.spots.iter().filter(|spot| counts(spot)).collect();
        spots.sort_by(|a, b| a.number.cmp(&b.number).then(a.time.total_cmp(&b.time)));
        spots.dedup_by(|b, a| a.number == b.number && a.time == b.time);
        let walk = |own: &[&Sample]| Walk {
            number: own[0].number,
            radius: own[0].radius.into(),
            times: own.iter().map(|spot| spot.time).collect(),
            places: own.iter().map(|spot| spot.place.truncate()).collect(),
        };
        Self::new(spots.chunk_by(|a, b| a.number == b.number).map(walk).collect())
    }

    /// Creates pedestrians from walks, which are sorted by number and unique.
    pub fn new(walks: Vec<Walk>) -> Self {
        let rows = |(walk, own): (usize, &Walk)| (0..own.times.len()).map(move |row| PersonRow { walk, row });
        let mut here: Vec<PersonRow> = walks.iter().enumerate().flat_map(rows).collect();
        let time = |here: &PersonRow| walks[here.walk].times[here.row];
        // a stable sort keeps the order by number at each time
        here.sort_by(|a, b| time(a).total_cmp(&time(b)));
        let moments = here.chunk_by(|a, b| time(a) == time(b));
        let moments = moments.map(|here| PeopleMoment { time: time(&here[0]), here: here.to_vec() }).collect();
        Self { walks, moments }
    }

    /// Returns the position of a row.
    pub fn place(&self, here: PersonRow) -> DVec2 {
        self.walks[here.walk].places[here.row]
    }

    /// Returns the median interval of rows, seconds; NaN if no walk has two rows.
    pub fn interval(&self) -> f64 {
        let steps = self.walks.iter().flat_map(|walk| walk.times.windows(2).map(|pair| pair[1] - pair[0]));
        median(steps.collect())
    }
}

/// Returns the median, the mean of the two middle values for an even number of values; NaN for no values.
pub fn median(mut values: Vec<f64>) -> f64 {
    if values.is_empty() {
        return f64::NAN;
    }
    let (middle, even) = (values.len() / 2, values.len().is_multiple_of(2));
    let (below, &mut upper, _) = values.select_nth_unstable_by(middle, f64::total_cmp);
    let lower = below.iter().copied().max_by(f64::total_cmp).filter(|_| even);
    0.5 * (lower.unwrap_or(upper) + upper)
}
