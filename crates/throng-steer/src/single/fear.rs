//! Fear: fleeing from an event until it is forgotten (UnitySteer's SteerForFear).

use glam::Vec3;
use throng::Error;
use throng::motion::Steering;
use throng::parameters::{Value, parameters};
use throng::steer::{Behaviour, SteeringInput, SteeringReason, TraceRecorder};

/// Moves away from events until they are forgotten.
///
/// Less from events that are older or farther away.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::{Behaviour, SteeringInput, Stimulus, TraceRecorder};
/// use throng_steer::Fear;
/// let bang = [Stimulus { position: Vec3::X, time: 0.0 }];
/// let force = |time| {
///     let view = SteeringInput { stimuli: &bang, time, ..SteeringInput::default() };
///     Fear { range: 10.0, fades: 4.0 }.steer(&view, &mut [], &mut TraceRecorder::default()).map(|steering| steering.force.x)
/// };
/// assert!(force(0.0) < force(2.0) && force(5.0).is_none());
/// ```
#[parameters]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fear {
    /// Reach of events, metres.
    ///
    /// The effect decreases to 0 there.
    #[parameter(required, unit = "m", above = 0)]
    pub range: f32,
    /// Seconds until an event is forgotten.
    ///
    /// The effect decreases to 0 until then.
    #[parameter(required, unit = "s", above = 0, most = 600)]
    pub fades: f32,
}

impl Behaviour for Fear {
    fn steer(&self, view: &SteeringInput<'_>, _: &mut [f32], why: &mut TraceRecorder<'_>) -> Option<Steering> {
        let mut away = Vec3::ZERO;
        for event in view.stimuli {
            let offset = view.to(event.position);
            let fresh = 1.0 - (view.time - event.time) as f32 / self.fades;
            let fright = fresh * (1.0 - offset.length() / self.range);
            if (0.0..=1.0).contains(&fresh) && fright > 0.0 {
                why.note(|| SteeringReason::Shuns(event.position));
                away -= offset.normalize_or(-view.forward()) * fright;
            }
        }
        view.urge(away, 1.0)
    }

    fn check(&self) -> Result<(), Error> {
        self.check_limits()
    }
}
