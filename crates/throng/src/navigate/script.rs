//! Scripts: prescribed motion of moving obstacles.

use crate::Error;
use glam::DVec2;
use serde::{Deserialize, Serialize};

/// A position and heading at a time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Keyframe {
    /// Time, seconds from the start of the world. Limit: >= 0, later than the keyframe before.
    pub time: f64,
    /// Position of the centre, world coordinates.
    pub at: DVec2,
    /// Heading of the body, radians counter-clockwise from +x. From 0 to 6.28 it makes one full turn.
    pub heading: f64,
}

/// The prescribed motion of a moving obstacle: a door, or a vehicle on its round. Between two keyframes, position and
/// heading are interpolated linearly; before the first and after the last keyframe they are constant.
///
/// An agent with a script moves to the script's position at the end of each sub-step, no faster than its motor moves and
/// turns. The guidance and the model of its group and its acceleration limit have no effect. The
/// [guard](crate::guard) applies as to every agent: a door with an agent in its way waits, then catches up.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Script {
    /// At least one, in order of time.
    pub keyframes: Vec<Keyframe>,
    /// Whether to start again with the first keyframe after the last.
    pub repeat: bool,
}

impl Script {
    /// Returns position and heading at a time.
    pub fn at(&self, time: f64) -> Keyframe {
        let (Some(first), Some(last)) = (self.keyframes.first(), self.keyframes.last()) else {
            return Keyframe { time, ..Keyframe::default() };
        };
        let period = last.time - first.time;
        let beyond = time - first.time;
        let within = if self.repeat && beyond > period { beyond - period * (beyond / period).floor() } else { beyond };
        let within = first.time + within;
        let next = self.keyframes.partition_point(|keyframe| keyframe.time <= within);
        match (self.keyframes[..next].last(), self.keyframes.get(next)) {
            (Some(a), Some(b)) => {
                let t = (within - a.time) / (b.time - a.time);
                Keyframe { time, at: a.at.lerp(b.at, t), heading: a.heading + (b.heading - a.heading) * t }
            }
            (Some(only), None) | (None, Some(only)) => Keyframe { time, ..*only },
            (None, None) => Keyframe { time, ..*first },
        }
    }

    pub(crate) fn check(&self) -> Result<(), Error> {
        let count = self.keyframes.len();
        let least = if self.repeat { 2 } else { 1 };
        let limit = "at least 1, at least 2 of a script that repeats";
        Error::unless(count >= least, "number of keyframes", count as f64, limit)?;
        let mut before = None;
        for keyframe in &self.keyframes {
            let later = before.is_none_or(|before| keyframe.time > before);
            let limit = "at least 0 s, finite, and later than the one before";
            let valid = keyframe.time >= 0.0 && keyframe.time.is_finite() && later;
            Error::unless(valid, "time of a keyframe", keyframe.time, limit)?;
            Error::unless(
                keyframe.heading.abs() <= 1e6,
                "heading of a keyframe",
                keyframe.heading,
                "from -1e6 to 1e6 rad",
            )?;
            before = Some(keyframe.time);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn between_keyframes_it_moves_evenly_and_begins_again() {
        let keyframe = |time, x, heading| Keyframe { time, at: DVec2::new(x, 1.0), heading };
        let keyframes = vec![keyframe(1.0, 0.0, 0.0), keyframe(3.0, 4.0, 1.0), keyframe(4.0, 0.0, 0.0)];
        let once = Script { keyframes, repeat: false };
        let again = Script { repeat: true, ..once.clone() };
        for (time, x) in [(0.0, 0.0), (1.0, 0.0), (2.0, 2.0), (3.0, 4.0), (3.5, 2.0), (4.0, 0.0), (9.0, 0.0)] {
            assert_eq!(once.at(time).at.x, x, "at {time} s");
        }
        for (time, x) in [(0.0, 0.0), (2.0, 2.0), (4.0, 0.0), (5.0, 2.0), (6.0, 4.0), (8.0, 2.0)] {
            assert_eq!(again.at(time).at.x, x, "at {time} s");
        }
        assert_eq!(once.at(2.0).heading, 0.5);
        assert_eq!(Script::default().at(2.0).at, DVec2::ZERO);
    }

    #[test]
    fn what_is_no_script_is_refused() {
        let at = |times: &[f64], repeat| {
            let keyframes = times.iter().map(|&time| Keyframe { time, ..Keyframe::default() }).collect();
            Script { keyframes, repeat }.check().is_ok()
        };
        assert!(at(&[0.0], false) && at(&[0.0, 1.0], true));
        for (times, repeat) in
            [(&[][..], false), (&[1.0], true), (&[-1.0], false), (&[1.0, 1.0], false), (&[f64::NAN], false)]
        {
            assert!(!at(times, repeat), "{times:?}");
        }
    }
}
