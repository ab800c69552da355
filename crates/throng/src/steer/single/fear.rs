//! Fear: running from what happened, until it is forgotten (UnitySteer's SteerForFear).

use crate::Error;
use crate::motion::Steering;
use crate::steer::{Behaviour, Reason, View, Why};
use glam::Vec3;

/// Goes away from events near it; the less the longer ago and the farther off they are.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::{Behaviour, Event, Fear, View, Why};
/// let bang = [Event { position: Vec3::X, time: 0.0 }];
/// let force = |time| {
///     let view = View { events: &bang, time, ..View::default() };
///     Fear { range: 10.0, fades: 4.0 }.steer(&view, &mut [], &mut Why::default()).map(|steering| steering.force.x)
/// };
/// assert!(force(0.0) < force(2.0) && force(5.0).is_none());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fear {
    /// How far off events frighten, metres; ever less up to there. Limit: > 0.
    pub range: f32,
    /// Seconds until an event is forgotten; it frightens ever less up to then. Limit: > 0.
    pub fades: f32,
}

impl Behaviour for Fear {
    fn steer(&self, view: &View<'_>, _: &mut [f32], why: &mut Why<'_>) -> Option<Steering> {
        let mut away = Vec3::ZERO;
        for event in view.events {
            let offset = view.to(event.position);
            let fresh = 1.0 - (view.time - event.time) as f32 / self.fades;
            let fright = fresh * (1.0 - offset.length() / self.range);
            if (0.0..=1.0).contains(&fresh) && fright > 0.0 {
                why.note(|| Reason::Expects(event.position));
                away -= offset.normalize_or(-view.forward()) * fright;
            }
        }
        view.urge(away, 1.0)
    }

    fn check(&self) -> Result<(), Error> {
        Error::unless_positive("range of fear", self.range)?;
        Error::unless_positive("time that fear fades in", self.fades)
    }
}
