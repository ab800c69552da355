//! Trajectories read from a file, grouped by time, to be shown or written again.

use crate::trajectories::{Sample, Trajectories};
use crate::{Body, Frame, Setting};
use glam::DVec2;
use std::collections::HashSet;
use std::ops::Range;
use throng::Status;

/// Trajectories grouped by time: one moment for each time.
#[derive(Clone, Debug, Default)]
pub struct Moments {
    /// The place, as far as it is known, and the names of the groups.
    pub setting: Setting,
    spots: Vec<Sample>,
    moments: Vec<Moment>,
    /// Number of agents in all moments.
    total: usize,
    fastest: f32,
}

/// The samples of one time.
#[derive(Clone, Debug)]
struct Moment {
    spots: Range<usize>,
    /// Number of agents that have left or arrived by this time.
    arrived: usize,
}

impl Moments {
    /// Groups the samples of trajectories by time. An agent without further samples counts as arrived.
    ///
    /// ```
    /// # let folder = tempfile::tempdir()?;
    /// # let path = folder.path().join("run.csv");
    /// use throng_record::{Frame, Moments, Trajectories};
    /// std::fs::write(&path, "time,number,x,y\n0,7,1.5,2\n0.1,7,1.6,2\n0.1,8,3,3\n")?;
    /// let moments = Moments::of(Trajectories::read(&path)?);
    /// assert_eq!((moments.count(), moments.time(1), moments.period()), (2, 0.1, 0.1));
    /// let mut frame = Frame::default();
    /// moments.capture(1, &mut frame);
    /// assert_eq!(frame.bodies.len(), 2);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn of(tracks: Trajectories) -> Self {
        let Trajectories { mut setting, spots, .. } = tracks;
        setting.in_space |= spots.iter().any(|spot| spot.place.z != 0.0);
        if setting.origin == DVec2::ZERO {
            setting.origin = spots.first().map_or(DVec2::ZERO, |spot| spot.place.truncate().round());
        }
        let (mut come, mut moments, mut start) = (HashSet::new(), Vec::new(), 0);
        for at in spots.chunk_by(|a, b| a.time == b.time) {
            come.extend(at.iter().map(|spot| spot.number));
            // an agent without a sample at this time has left through an exit
            let there = at.iter().filter(|spot| spot.status != Status::Arrived).count();
            moments.push(Moment { spots: start..start + at.len(), arrived: come.len().saturating_sub(there) });
            start += at.len();
        }
        let speeds = spots.iter().map(|spot| spot.velocity.length());
        let fastest = speeds.filter(|speed| speed.is_finite()).fold(0.0, f32::max);
        Self { setting, moments, total: come.len(), fastest, spots }
    }

    /// Returns the number of moments.
    pub fn count(&self) -> usize {
        self.moments.len()
    }

    /// Returns the number of agents in all moments.
    pub fn total(&self) -> usize {
        self.total
    }

    /// Returns the number of agents that have left or arrived by a moment. After the last moment, the last moment
    /// counts.
    pub fn arrived(&self, moment: usize) -> usize {
        self.at(moment).map_or(0, |moment| moment.arrived)
    }

    /// Returns the samples of all moments, by time, then by agent number.
    pub fn spots(&self) -> &[Sample] {
        &self.spots
    }

    /// Returns the range of a moment in [`spots`](Self::spots). After the last moment, returns the range of the last
    /// moment.
    pub fn range(&self, moment: usize) -> Range<usize> {
        self.at(moment).map_or(0..0, |moment| moment.spots.clone())
    }

    /// Returns the time of a moment, seconds. After the last moment, returns the time of the last moment.
    pub fn time(&self, moment: usize) -> f64 {
        self.at(moment).map_or(0.0, |moment| self.spots[moment.spots.start].time)
    }

    /// Returns the median interval between moments, seconds: the lower median of an even number of intervals. Returns
    /// 0.04 for fewer than two moments.
    pub fn period(&self) -> f64 {
        let mut periods: Vec<f64> = (1..self.count()).map(|k| self.time(k) - self.time(k - 1)).collect();
        periods.sort_by(f64::total_cmp);
        periods.get(periods.len().saturating_sub(1) / 2).copied().filter(|period| *period > 0.0).unwrap_or(0.04)
    }

    /// Writes a moment into `frame`. After the last moment, writes the last moment.
    pub fn capture(&self, moment: usize, frame: &mut Frame) {
        self.show(self.range(moment), frame);
        (frame.time, frame.arrived) = (self.time(moment), self.arrived(moment));
    }

    /// Returns a frame with the samples of all moments. Its extent is the space that the trajectories take.
    pub fn all_bodies(&self) -> Frame {
        let mut frame = Frame::default();
        self.show(0..self.spots.len(), &mut frame);
        frame
    }

    fn show(&self, spots: Range<usize>, frame: &mut Frame) {
        frame.total = self.total;
        frame.accounts.clear();
        frame.explanations.clear();
        frame.fields.clear();
        frame.bodies.clear();
        frame.bodies.extend(self.spots[spots].iter().map(|spot| self.body(spot)));
    }

    fn at(&self, moment: usize) -> Option<&Moment> {
        self.moments.get(moment).or(self.moments.last())
    }

    fn body(&self, spot: &Sample) -> Body {
        Body {
            number: spot.number,
            group: spot.group,
            goal: None,
            position: spot.place.truncate(),
            altitude: spot.place.z as f32,
            velocity: spot.velocity.truncate(),
            vertical_velocity: spot.velocity.z,
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

    fn tracks(rows: &[(f64, u32, u32)], groups: &[&str]) -> Trajectories {
        let spot = |&(time, number, group): &(f64, u32, u32)| Sample {
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
        Trajectories {
            setting: Setting { groups, ..Setting::default() },
            spots: rows.iter().map(spot).collect(),
            ..Trajectories::default()
        }
    }

    #[test]
    fn agents_come_and_go() {
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
        assert_eq!(seen(9), (1.0, vec![2, 3]), "the last moment stands for later ones");
        assert_eq!(moments.all_bodies().bodies.len(), 5);
        assert_eq!(moments.setting.origin, DVec2::new(1000.0, 1.0));
    }

    #[test]
    fn no_samples_give_no_moments() {
        let moments = Moments::of(Trajectories::default());
        let mut frame = Frame::default();
        moments.capture(0, &mut frame);
        assert_eq!((moments.count(), moments.period(), frame), (0, 0.04, Frame::default()));
    }

    #[test]
    fn a_place_is_accepted_only_if_it_has_the_groups() {
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
