//! Resamples frames to an even rate.

use crate::formats::Writer;
use crate::{Frame, OutputError};

/// Greatest difference, seconds, between a frame's time and a due time at which the frame is used unchanged.
pub(crate) const SLACK: f64 = 1e-6;

/// Due times at a constant rate, from the first to the last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Beat {
    /// The first due time, seconds; if it is not finite, every multiple of the interval is due.
    pub from: f64,
    /// The last due time, seconds.
    pub to: f64,
    /// Due times per second.
    pub rate: f64,
}

impl Beat {
    /// Returns the first due time at or after a time, seconds.
    pub fn at_or_after(&self, time: f64) -> Option<f64> {
        let (start, least) = if self.from.is_finite() { (self.from, 0.0) } else { (0.0, f64::NEG_INFINITY) };
        let index = ((time - SLACK - start) * self.rate).ceil().max(least);
        let due = start + index / self.rate;
        (due <= self.to + SLACK).then_some(due)
    }

    /// Whether a frame between the times `before` and `after` is needed for a due time.
    pub fn needs(&self, before: f64, after: f64) -> bool {
        self.at_or_after(before + 2.0 * SLACK).is_some_and(|due| due < after - SLACK)
    }
}

/// Writes frames at due times. Between two incoming frames, agents in both are interpolated linearly.
pub(crate) struct Resampled {
    writer: Box<dyn Writer>,
    beat: Beat,
    /// Whether to skip the rest of the due times between two incoming frames.
    stop: fn() -> bool,
    /// The previous incoming frame.
    last: Option<Frame>,
    /// Memory for an interpolated frame.
    between: Frame,
}

impl Resampled {
    pub fn new(writer: Box<dyn Writer>, beat: Beat, stop: fn() -> bool) -> Self {
        Self { writer, beat, stop, last: None, between: Frame::default() }
    }
}

impl Writer for Resampled {
    fn push(&mut self, frame: &Frame) -> Result<(), OutputError> {
        let after = self.last.as_ref().map_or(frame.time, |last| last.time + 2.0 * SLACK);
        let mut next = self.beat.at_or_after(after);
        while let Some(due) = next.filter(|due| *due <= frame.time + SLACK && !(self.stop)()) {
            match &self.last {
                Some(last) if due < frame.time - SLACK => {
                    between(last, frame, due, &mut self.between);
                    self.writer.push(&self.between)?;
                }
                _ => self.writer.push(frame)?,
            }
            next = self.beat.at_or_after(due + 2.0 * SLACK);
        }
        match &mut self.last {
            Some(last) => last.clone_from(frame),
            None => self.last = Some(frame.clone()),
        }
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<(), OutputError> {
        self.writer.finish()
    }
}

/// Sets `to` to the interpolation of two frames at a time.
fn between(before: &Frame, after: &Frame, time: f64, to: &mut Frame) {
    let share = (time - before.time) / (after.time - before.time);
    to.time = time;
    to.bodies.clear();
    let mut rest = after.bodies.as_slice();
    to.bodies.extend(before.bodies.iter().filter_map(|body| {
        // both are sorted by number
        let next = rest.iter().position(|other| other.number >= body.number).unwrap_or(rest.len());
        rest = &rest[next..];
        let other = rest.first().filter(|other| other.number == body.number)?;
        Some(body.between(other, share))
    }));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Body;
    use glam::{DVec2, Vec2};
    use proptest::prelude::*;
    use std::sync::{Arc, Mutex};

    /// Keeps the frames that are pushed.
    struct Kept(Arc<Mutex<Vec<Frame>>>);

    impl Writer for Kept {
        fn push(&mut self, frame: &Frame) -> Result<(), OutputError> {
            self.0.lock().unwrap().push(frame.clone());
            Ok(())
        }

        fn finish(self: Box<Self>) -> Result<(), OutputError> {
            Ok(())
        }
    }

    fn resampled(frames: &[Frame], beat: Beat) -> Vec<Frame> {
        let kept = Arc::new(Mutex::new(Vec::new()));
        let mut writer = Resampled::new(Box::new(Kept(kept.clone())), beat, || false);
        frames.iter().for_each(|frame| writer.push(frame).unwrap());
        drop(writer);
        Arc::into_inner(kept).unwrap().into_inner().unwrap()
    }

    /// An agent that walks straight on from the origin at this velocity, and an agent that is present from 1 s on.
    fn walk(times: impl IntoIterator<Item = f64>, velocity: DVec2) -> Vec<Frame> {
        let frame = |time: f64| {
            let one = Body { velocity: velocity.as_vec2(), ..Body::walking(3, velocity * time) };
            let late = (time >= 1.0).then(|| Body::walking(5, DVec2::new(7.0, 8.0)));
            Frame { time, bodies: [one].into_iter().chain(late).collect(), ..Frame::default() }
        };
        times.into_iter().map(frame).collect()
    }

    const ALL: Beat = Beat { from: f64::NEG_INFINITY, to: f64::INFINITY, rate: 10.0 };

    #[test]
    fn steps_that_are_due_are_taken_as_they_are() {
        let frames = walk((0..40).map(|k| f64::from(k) * 0.05), DVec2::new(1.0, 0.5));
        let expected: Vec<Frame> = frames.iter().step_by(2).cloned().collect();
        assert_eq!(resampled(&frames, ALL), expected);
        let window = resampled(&frames, Beat { from: 0.5, to: 1.0, ..ALL });
        assert_eq!(window, expected[5..=10]);
    }

    #[test]
    fn an_agent_is_present_between_two_frames_that_hold_it() {
        let found = resampled(&walk([0.04, 0.98, 1.02, 1.5], DVec2::X), ALL);
        let count: Vec<usize> = found.iter().map(|frame| frame.bodies.len()).collect();
        assert_eq!(count, [1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2], "{found:?}");
        assert!((found[0].time - 0.1).abs() < 1e-12, "the first multiple of the interval within the frames");
    }

    #[test]
    fn headings_turn_the_short_way() {
        let facing = |time: f64, heading: f32| Frame {
            time,
            bodies: vec![Body { heading, ..Body::walking(1, DVec2::ZERO) }],
            ..Frame::default()
        };
        let found = resampled(&[facing(0.0, 3.0), facing(0.2, -3.0)], ALL);
        assert!((found[1].bodies[0].heading.abs() - std::f32::consts::PI).abs() < 1e-6, "{found:?}");
    }

    proptest! {
        /// At every due time, and at no other, an agent that walks straight on is where its velocity leads.
        #[test]
        fn straight_ways_stay_straight(
            steps in proptest::collection::vec(0.01..0.7f64, 1..40),
            start in -5.0..5.0f64,
            rate in 0.5..40.0f64,
            velocity in (-2.0..2.0f64, -2.0..2.0f64),
            from in prop::option::of(-3.0..8.0f64),
        ) {
            let velocity = DVec2::from(velocity);
            let times = steps.iter().scan(start, |time, step| { *time += step; Some(*time) });
            let frames = walk(times, velocity);
            let beat = Beat { from: from.unwrap_or(f64::NEG_INFINITY), to: f64::INFINITY, rate };
            let found = resampled(&frames, beat);
            let (first, last) = (frames[0].time, frames[frames.len() - 1].time);
            for (k, frame) in found.iter().enumerate() {
                prop_assert!((frame.bodies[0].position - velocity * frame.time).length() < 1e-9);
                prop_assert!((frame.bodies[0].velocity - velocity.as_vec2()).length() < 1e-5);
                let since = (frame.time - from.unwrap_or(0.0)) * rate;
                prop_assert!((since - since.round()).abs() < 1e-4 * rate.max(1.0), "{since}");
                prop_assert!(k == 0 || (frame.time - found[k - 1].time - 1.0 / rate).abs() < 3e-6);
            }
            // the definition gives the number of due times
            let start = from.unwrap_or(0.0);
            let due = (-1000..2000).map(|k| start + f64::from(k) / rate);
            let due = due.filter(|due| *due >= first && *due <= last && (from.is_none() || *due >= start)).count();
            prop_assert!(found.len().abs_diff(due) <= 1, "{} of {due}", found.len());
            prop_assert!(found.iter().all(|frame| frame.bodies[0].velocity != Vec2::NAN));
        }

        /// Leaving out frames that are not needed changes nothing.
        #[test]
        fn what_is_not_needed_is_not_missed(step in 0.01..0.2f64, rate in 0.5..40.0f64, count in 2..200i32) {
            let frames = walk((0..count).map(|k| f64::from(k) * step), DVec2::new(1.0, -0.5));
            let beat = Beat { rate, ..ALL };
            let needed: Vec<Frame> =
                frames.iter().filter(|frame| beat.needs(frame.time - step, frame.time + step)).cloned().collect();
            let (all, few) = (resampled(&frames, beat), resampled(&needed, beat));
            prop_assert_eq!(all.len(), few.len());
            for (all, few) in all.iter().zip(&few) {
                prop_assert!((all.time - few.time).abs() < 1e-9);
                prop_assert!((all.bodies[0].position - few.bodies[0].position).length() < 1e-9);
            }
        }
    }
}
