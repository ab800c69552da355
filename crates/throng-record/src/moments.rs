//! Trajectories that were read, moment by moment, to be shown or written again.

use crate::tracks::{Spot, Tracks};
use crate::{Body, Frame, Setting};
use glam::DVec2;
use std::collections::HashSet;
use std::ops::Range;
use throng::Status;

/// Tracks, moment by moment.
#[derive(Clone, Debug, Default)]
pub struct Moments {
    /// The place, as far as it is known, and the names of the groups.
    pub setting: Setting,
    spots: Vec<Spot>,
    moments: Vec<Moment>,
    /// How many there are in all.
    total: usize,
    fastest: f32,
}

/// One moment.
#[derive(Clone, Debug)]
struct Moment {
    spots: Range<usize>,
    /// How many had come and gone, or had arrived.
    arrived: usize,
}

impl Moments {
    /// The moments of tracks. Who is not there any more counts as arrived.
    ///
    /// ```
    /// # let folder = tempfile::tempdir()?;
    /// # let path = folder.path().join("run.csv");
    /// use throng_record::{Frame, Moments, Tracks};
    /// std::fs::write(&path, "time,number,x,y\n0,7,1.5,2\n0.1,7,1.6,2\n0.1,8,3,3\n")?;
    /// let moments = Moments::of(Tracks::read(&path)?);
    /// assert_eq!((moments.count(), moments.time(1), moments.period()), (2, 0.1, 0.1));
    /// let mut frame = Frame::default();
    /// moments.capture(1, &mut frame);
    /// assert_eq!(frame.bodies.len(), 2);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn of(tracks: Tracks) -> Self {
        let Tracks { mut setting, spots, .. } = tracks;
        setting.in_space |= spots.iter().any(|spot| spot.place.z != 0.0);
        if setting.origin == DVec2::ZERO {
            setting.origin = spots.first().map_or(DVec2::ZERO, |spot| spot.place.truncate().round());
        }
        let (mut come, mut moments, mut start) = (HashSet::new(), Vec::new(), 0);
        for at in spots.chunk_by(|a, b| a.time == b.time) {
            come.extend(at.iter().map(|spot| spot.number));
            // who is not in the file any more has gone through an exit
            let there = at.iter().filter(|spot| spot.status != Status::Arrived).count();
            moments.push(Moment { spots: start..start + at.len(), arrived: come.len().saturating_sub(there) });
            start += at.len();
        }
        let speeds = spots.iter().map(|spot| spot.velocity.length());
        let fastest = speeds.filter(|speed| speed.is_finite()).fold(0.0, f32::max);
        Self { setting, moments, total: come.len(), fastest, spots }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.moments.len()
    }

    /// How many people there are in all.
    pub fn total(&self) -> usize {
        self.total
    }

    /// How many had come and gone, or had arrived, by a moment.
    pub fn arrived(&self, moment: usize) -> usize {
        self.at(moment).map_or(0, |moment| moment.arrived)
    }

    /// Everybody of all moments, by time, then by number.
    pub fn spots(&self) -> &[Spot] {
        &self.spots
    }

    /// Which of [`spots`](Self::spots) are of a moment; of those after the last, the last.
    pub fn range(&self, moment: usize) -> Range<usize> {
        self.at(moment).map_or(0..0, |moment| moment.spots.clone())
    }

    /// When a moment was, seconds; of those after the last, when that was.
    pub fn time(&self, moment: usize) -> f64 {
        self.at(moment).map_or(0.0, |moment| self.spots[moment.spots.start].time)
    }

    /// Median of the seconds between moments, of an even number the lower one; 0.04 where there are not two.
    pub fn period(&self) -> f64 {
        let mut periods: Vec<f64> = (1..self.count()).map(|k| self.time(k) - self.time(k - 1)).collect();
        periods.sort_by(f64::total_cmp);
        periods.get(periods.len().saturating_sub(1) / 2).copied().filter(|period| *period > 0.0).unwrap_or(0.04)
    }

    /// Makes `frame` show a moment; of those after the last, the last.
    pub fn capture(&self, moment: usize, frame: &mut Frame) {
        self.show(self.range(moment), frame);
        (frame.time, frame.arrived) = (self.time(moment), self.arrived(moment));
    }

    /// A frame with everybody at every moment, of which one sees how much room all that takes.
    pub fn everybody(&self) -> Frame {
        let mut frame = Frame::default();
        self.show(0..self.spots.len(), &mut frame);
        frame
    }

    fn show(&self, spots: Range<usize>, frame: &mut Frame) {
        frame.total = self.total;
        frame.accounts.clear();
        frame.bodies.clear();
        frame.bodies.extend(self.spots[spots].iter().map(|spot| self.body(spot)));
    }

    fn at(&self, moment: usize) -> Option<&Moment> {
        self.moments.get(moment).or(self.moments.last())
    }

    fn body(&self, spot: &Spot) -> Body {
        Body {
            number: spot.number,
            group: spot.group,
            goal: None,
            position: spot.place.truncate(),
            altitude: spot.place.z as f32,
            velocity: spot.velocity.truncate(),
            climb: spot.velocity.z,
            heading: spot.heading,
            basis: None,
            radius: spot.radius,
            core: glam::Vec2::ZERO,
            preferred_speed: self.fastest,
            status: spot.status,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec3, Vec3};

    fn tracks(rows: &[(f64, u32, u32)], groups: &[&str]) -> Tracks {
        let spot = |&(time, number, group): &(f64, u32, u32)| Spot {
            number,
            group,
            time,
            place: DVec3::new(1000.0 + time, f64::from(number), 0.0),
            velocity: Vec3::new(number as f32, 0.0, 0.0),
            heading: 0.5,
            radius: 0.25,
            status: Status::Walking,
        };
        let groups = groups.iter().map(|&name| name.to_owned()).collect();
        Tracks {
            setting: Setting { groups, ..Setting::default() },
            spots: rows.iter().map(spot).collect(),
            ..Tracks::default()
        }
    }

    #[test]
    fn people_come_and_go() {
        let moments = Moments::of(tracks(&[(0.0, 1, 0), (0.0, 2, 0), (0.5, 2, 0), (1.0, 2, 0), (1.0, 3, 0)], &["all"]));
        assert_eq!((moments.count(), moments.total(), moments.period()), (3, 3, 0.5));
        assert_eq!((0..3).map(|k| moments.arrived(k)).collect::<Vec<_>>(), [0, 1, 1]);
        let mut frame = Frame::default();
        let mut seen = |moment| {
            moments.capture(moment, &mut frame);
            (frame.time, frame.bodies.iter().map(|body| body.number).collect::<Vec<_>>())
        };
        assert_eq!(seen(0), (0.0, vec![1, 2]));
        assert_eq!(seen(2), (1.0, vec![2, 3]));
        assert_eq!(seen(9), (1.0, vec![2, 3]), "after the last, the last");
        assert_eq!(moments.everybody().bodies.len(), 5);
        assert_eq!(moments.setting.origin, DVec2::new(1000.0, 1.0));
    }

    #[test]
    fn nobody_has_no_moments() {
        let moments = Moments::of(Tracks::default());
        let mut frame = Frame::default();
        moments.capture(0, &mut frame);
        assert_eq!((moments.count(), moments.period(), frame), (0, 0.04, Frame::default()));
    }

    #[test]
    fn a_place_has_the_groups_or_is_not_theirs() {
        let place = Setting { groups: vec!["left".into(), String::new(), "right".into()], ..Setting::default() };
        let mut found = tracks(&[(0.0, 1, 0), (0.0, 2, 1)], &["right", "1"]);
        assert!(found.put_into(&place));
        let groups: Vec<u32> = found.spots.iter().map(|spot| spot.group).collect();
        assert_eq!((groups, &found.setting), (vec![2, 1], &place));
        let mut others = tracks(&[(0.0, 1, 0)], &["up"]);
        assert!(!others.put_into(&place));
        assert_eq!(others, tracks(&[(0.0, 1, 0)], &["up"]));
    }
}
