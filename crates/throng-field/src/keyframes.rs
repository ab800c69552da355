//! Fields that change with time.

use glam::{DVec2, Vec2, Vec3};
use std::fmt;
use std::sync::Arc;
use throng::Error;
use throng::field::Field;
use throng::parameters::parameters;

/// Fields at some times, interpolated linearly in between. Before the first time and after the last, the first and the
/// last field apply.
///
/// A field through anchors is linear in their velocities (Jin et al. 2008). So between two keyframes with anchors in
/// the same places, the result is the field through the interpolated velocities. Other fields cross-fade.
///
/// ```
/// use glam::Vec3;
/// use std::sync::Arc;
/// use throng::field::Field;
/// use throng_field::{Keyframes, Uniform};
/// let tide = Keyframes::new(vec![(0.0, Arc::new(Uniform(Vec3::ZERO))), (10.0, Arc::new(Uniform(Vec3::X)))], None)?;
/// assert_eq!(tide.velocity(Vec3::ZERO, 2.5), Vec3::X * 0.25);
/// assert_eq!(tide.velocity(Vec3::ZERO, 99.0), Vec3::X);
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone)]
pub struct Keyframes {
    frames: Vec<(f64, Arc<dyn Field>)>,
    period: Option<f64>,
}

impl Keyframes {
    /// Creates a field from pairs of time, seconds, and field. With a period, seconds, the sequence repeats: the first
    /// field follows the last.
    ///
    /// # Errors
    /// No fields; times that do not increase or are not finite; a period that is not longer than the time from the
    /// first field to the last.
    pub fn new(frames: Vec<(f64, Arc<dyn Field>)>, period: Option<f64>) -> Result<Self, Error> {
        let fail = |why: String| Err(Error::Shape { what: "the keyframes of a field".into(), why });
        let (Some(first), Some(last)) = (frames.first(), frames.last()) else {
            return fail("there are none: give at least one".into());
        };
        if let Some(pair) =
            frames.windows(2).find(|pair| pair[0].0.partial_cmp(&pair[1].0) != Some(std::cmp::Ordering::Less))
        {
            return fail(format!("after {} s comes {} s: put them in order", pair[0].0, pair[1].0));
        }
        if !(first.0.is_finite() && last.0.is_finite()) {
            return fail("their times are not finite".into());
        }
        if let Some(period) = period {
            let length = last.0 - first.0;
            Error::unless(
                period > length && period.is_finite(),
                "period of a field",
                period,
                "more than the time from the first keyframe to the last",
            )?;
        }
        Ok(Self { frames, period })
    }

    /// Returns the two fields around a time, and the part (0 to 1) of the second.
    fn around(&self, time: f64) -> (&dyn Field, &dyn Field, f32) {
        let (first, last) = (&self.frames[0], &self.frames[self.frames.len() - 1]);
        let time = self.period.map_or(time, |period| first.0 + (time - first.0).rem_euclid(period));
        let after = self.frames.partition_point(|&(at, _)| at <= time);
        let (before, next) = match (after.checked_sub(1), self.frames.get(after), self.period) {
            (Some(before), Some(next), _) => (&self.frames[before], (next.0, &next.1)),
            (Some(_), None, Some(period)) => (last, (first.0 + period, &first.1)),
            (Some(_), None, None) => return (&*last.1, &*last.1, 0.0),
            (None, _, _) => return (&*first.1, &*first.1, 0.0),
        };
        (&*before.1, &**next.1, ((time - before.0) / (next.0 - before.0)) as f32)
    }
}

/// Different fields at different times.
///
/// Keyframes as files write them.
#[parameters(name = "keyframes")]
pub(super) struct KeyframeSequence {
    /// The fields and their times.
    #[parameter(required)]
    frames: Vec<TimedField>,
    /// Seconds after which the sequence repeats. Without it, the last field stays.
    #[parameter(unit = "s")]
    period: Option<f64>,
}

/// A field at a time.
#[parameters]
pub(super) struct TimedField {
    /// The time, seconds.
    #[parameter(required, unit = "s")]
    at: f64,
    /// The field.
    #[parameter(required)]
    of: Arc<dyn Field>,
}

impl TryFrom<KeyframeSequence> for Keyframes {
    type Error = Error;

    fn try_from(KeyframeSequence { frames, period }: KeyframeSequence) -> Result<Self, Error> {
        Self::new(frames.into_iter().map(|TimedField { at, of }| (at, of)).collect(), period)
    }
}

impl Field for Keyframes {
    fn velocity(&self, place: Vec3, time: f64) -> Vec3 {
        let (before, next, part) = self.around(time);
        let from = before.velocity(place, time);
        if part == 0.0 { from } else { from.lerp(next.velocity(place, time), part) }
    }

    fn row(&self, row: (DVec2, f64), from: usize, time: f64, out: &mut [Vec2]) {
        let (before, next, part) = self.around(time);
        before.row(row, from, time, out);
        if part > 0.0 {
            let mut others = vec![Vec2::ZERO; out.len()];
            next.row(row, from, time, &mut others);
            out.iter_mut().zip(others).for_each(|(one, other)| *one = one.lerp(other, part));
        }
    }
}

impl fmt::Debug for Keyframes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let times: Vec<f64> = self.frames.iter().map(|frame| frame.0).collect();
        f.debug_struct("Keyframes").field("times", &times).field("period", &self.period).finish_non_exhaustive()
    }
}
