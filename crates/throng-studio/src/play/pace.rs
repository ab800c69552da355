//! The playback speed: simulation time against real time.

use std::time::Duration;
use web_time::Instant;

/// The speed of playback.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub enum Speed {
    /// Seconds of simulation per second of real time. Limit: > 0.
    Times(f64),
    /// As many steps as possible.
    Fastest,
}

impl Speed {
    /// The selectable speeds, in ascending order.
    pub const ALL: [Self; 8] = [
        Self::Times(0.1),
        Self::Times(0.25),
        Self::Times(0.5),
        Self::Times(1.0),
        Self::Times(2.0),
        Self::Times(4.0),
        Self::Times(10.0),
        Self::Fastest,
    ];

    /// Returns the label.
    pub fn label(self) -> String {
        match self {
            Self::Times(times) => format!("{times}×"),
            Self::Fastest => "fastest".into(),
        }
    }

    /// Returns the next speed of [`Speed::ALL`], the first after the last.
    pub fn next(self) -> Self {
        let now = Self::ALL.iter().position(|&speed| speed == self);
        Self::ALL[now.map_or(3, |now| (now + 1) % Self::ALL.len())]
    }
}

/// The real time that a slow world may fall behind, seconds. Further delay is dropped, so that the world does not rush
/// later.
const PATIENCE: f64 = 0.1;

/// Decides when a step is due.
#[derive(Clone, Copy, Debug)]
pub struct Pace {
    /// The playback speed.
    pub speed: Speed,
    /// Seconds of simulation that are due.
    owed: f64,
    last: Instant,
}

impl Pace {
    /// Creates a pace with no step due at `now`.
    pub fn new(speed: Speed, now: Instant) -> Self {
        Self { speed, owed: 0.0, last: now }
    }

    /// Adds the real time until `now`, if the run is playing.
    pub fn pass(&mut self, now: Instant, playing: bool) {
        let real = now.saturating_duration_since(self.last).as_secs_f64().min(PATIENCE);
        self.last = now;
        match self.speed {
            Speed::Times(times) if playing => self.owed += real * times,
            _ => self.owed = 0.0,
        }
    }

    /// Takes a step of this length, seconds, if it is due. Returns whether it was due.
    pub fn take(&mut self, seconds: f64) -> bool {
        match self.speed {
            Speed::Fastest => true,
            Speed::Times(_) if self.owed >= seconds => {
                self.owed -= seconds;
                true
            }
            Speed::Times(_) => false,
        }
    }

    /// Drops overdue steps, except for less than one.
    pub fn let_go(&mut self, seconds: f64) {
        self.owed = self.owed.min(seconds);
    }

    /// Returns the real time until the next step of this length is due.
    pub fn wait(&self, seconds: f64) -> Duration {
        match self.speed {
            Speed::Fastest => Duration::ZERO,
            Speed::Times(times) => Duration::from_secs_f64(((seconds - self.owed) / times).clamp(0.0, PATIENCE)),
        }
    }

    /// Returns the share of the next step that has passed at `now`, 0 to 1.
    pub fn share(&self, seconds: f64, now: Instant) -> f64 {
        match self.speed {
            Speed::Fastest => 1.0,
            Speed::Times(times) => {
                let since = now.saturating_duration_since(self.last).as_secs_f64();
                ((self.owed + since * times) / seconds).clamp(0.0, 1.0)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_due_as_the_speed_says() {
        let begin = Instant::now();
        let steps = |speed: Speed, real: u64| {
            let mut pace = Pace::new(speed, begin);
            let ticks = (1..=real / 10).map(|k| begin + Duration::from_millis(10 * k));
            ticks
                .map(|now| {
                    pace.pass(now, true);
                    (0..9).take_while(|_| pace.take(0.04)).count()
                })
                .sum::<usize>()
        };
        assert_eq!(steps(Speed::Times(1.0), 1010), 25);
        assert_eq!(steps(Speed::Times(4.0), 1010), 101);
        assert_eq!(steps(Speed::Times(0.1), 1010), 2);
    }

    #[test]
    fn a_long_pause_is_not_caught_up() {
        let begin = Instant::now();
        let mut pace = Pace::new(Speed::Times(1.0), begin);
        pace.pass(begin + Duration::from_secs(60), true);
        assert_eq!((0..100).take_while(|_| pace.take(0.04)).count(), 2);
    }

    #[test]
    fn every_speed_has_a_next() {
        assert_eq!(Speed::Times(1.0).next(), Speed::Times(2.0));
        assert_eq!(Speed::Fastest.next(), Speed::Times(0.1));
    }
}
