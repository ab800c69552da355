//! Recorded people, one by one and moment by moment.

use crate::tracks::{Spot, Tracks};
use glam::DVec2;

/// Somebody's way: where one was at which times.
#[derive(Clone, Debug, PartialEq)]
pub struct Walk {
    /// The number.
    pub number: u32,
    /// Radius of the body, metres.
    pub radius: f64,
    /// When, ascending, seconds.
    pub times: Vec<f64>,
    /// Where at each of those, metres.
    pub places: Vec<DVec2>,
}

impl Walk {
    /// Where one was at a time: between two rows, on the straight way from one to the other; `None` before the first and after the last.
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

    /// The last row at a time or before it, and how much of the time to the next one has gone, 0 to 1.
    pub(crate) fn row_at(&self, time: f64) -> Option<(usize, f64)> {
        // rounding leaves out nothing
        let row = self.times.partition_point(|&row| row <= time + 1e-9).checked_sub(1)?;
        let Some(next) = self.times.get(row + 1) else {
            return (time <= self.times[row] + 1e-9).then_some((row, 0.0));
        };
        Some((row, ((time - self.times[row]) / (next - self.times[row])).max(0.0)))
    }
}

/// Somebody who is there: which walk, and which of its rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Here {
    /// Index into [`People::walks`].
    pub walk: usize,
    /// Index into its times and places.
    pub row: usize,
}

/// A moment and who is there.
#[derive(Clone, Debug, PartialEq)]
pub struct Moment {
    /// Seconds.
    pub time: f64,
    /// Who, by number.
    pub here: Vec<Here>,
}

/// Recorded people on the ground. What is above it does not count.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct People {
    /// Everybody, by number.
    pub walks: Vec<Walk>,
    /// Every moment, in order.
    pub moments: Vec<Moment>,
}

impl People {
    /// Those of trajectories whom `counts` lets pass; of two rows of one at the same time the first counts.
    ///
    /// ```
    /// use throng_record::pedestrian::People;
    /// # let folder = tempfile::tempdir()?;
    /// # let path = folder.path().join("walk.csv");
    /// std::fs::write(&path, "number,time,x,y\n7,0,0,0\n7,0.5,0.6,0\n7,1,1.2,0\n")?;
    /// let people = People::of(&throng_record::Tracks::read(path)?, |_| true);
    /// assert_eq!((people.walks.len(), people.moments.len(), people.interval()), (1, 3, 0.5));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn of(tracks: &Tracks, counts: impl Fn(&Spot) -> bool) -> Self {
        let mut spots: Vec<&Spot> = tracks.spots.iter().filter(|spot| counts(spot)).collect();
        spots.sort_by(|a, b| a.number.cmp(&b.number).then(a.time.total_cmp(&b.time)));
        spots.dedup_by(|b, a| a.number == b.number && a.time == b.time);
        let walk = |own: &[&Spot]| Walk {
            number: own[0].number,
            radius: own[0].radius.into(),
            times: own.iter().map(|spot| spot.time).collect(),
            places: own.iter().map(|spot| spot.place.truncate()).collect(),
        };
        Self::new(spots.chunk_by(|a, b| a.number == b.number).map(walk).collect())
    }

    /// Those who went these ways; `walks` are by number, and no two of one.
    pub fn new(walks: Vec<Walk>) -> Self {
        let rows = |(walk, own): (usize, &Walk)| (0..own.times.len()).map(move |row| Here { walk, row });
        let mut here: Vec<Here> = walks.iter().enumerate().flat_map(rows).collect();
        let time = |here: &Here| walks[here.walk].times[here.row];
        // stable: those of one moment stay by number
        here.sort_by(|a, b| time(a).total_cmp(&time(b)));
        let moments = here.chunk_by(|a, b| time(a) == time(b));
        let moments = moments.map(|here| Moment { time: time(&here[0]), here: here.to_vec() }).collect();
        Self { walks, moments }
    }

    /// Where somebody is.
    pub fn place(&self, here: Here) -> DVec2 {
        self.walks[here.walk].places[here.row]
    }

    /// The time from one row of somebody to the next: the median, seconds; not a number where nobody has two.
    pub fn interval(&self) -> f64 {
        let steps = self.walks.iter().flat_map(|walk| walk.times.windows(2).map(|pair| pair[1] - pair[0]));
        median(steps.collect())
    }
}

/// The value in the middle, of an even number the mean of the two there; not a number for none.
pub fn median(mut values: Vec<f64>) -> f64 {
    if values.is_empty() {
        return f64::NAN;
    }
    let (middle, even) = (values.len() / 2, values.len().is_multiple_of(2));
    let (below, &mut upper, _) = values.select_nth_unstable_by(middle, f64::total_cmp);
    let lower = below.iter().copied().max_by(f64::total_cmp).filter(|_| even);
    0.5 * (lower.unwrap_or(upper) + upper)
}
