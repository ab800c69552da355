//! The guidance of the insects of a swarm.

use glam::Vec3;
use std::fmt::Debug;
use throng::Error;
use throng::steer::{SteeringInput, TraceRecorder};

/// A guide or an influence that an insect of a [`Swarm`](super::Swarm) follows. The guides of a list add up.
///
/// Like a [behaviour](throng::steer::Behaviour) a guide keeps no state; what it must remember is in the memory that the
/// caller passes. Constant differences between insects are drawn from `view.rng.at(0)`.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::SteeringInput;
/// use throng_steer::swarm::{Guide, GuideOutput, Swarm};
///
/// /// Rises.
/// #[derive(Debug)]
/// struct Thermal {
///     speed: f32,
/// }
///
/// impl Guide for Thermal {
///     fn guide(&self, _: &SteeringInput<'_>, _: &mut [f32], chosen: &mut GuideOutput) {
///         chosen.drift += Vec3::Z * self.speed;
///     }
/// }
///
/// let swarm = Swarm::default().with(Thermal { speed: 0.2 });
/// ```
pub trait Guide: Debug + Send + Sync {
    /// Returns the number of words of memory that the guide needs for each insect.
    fn memory(&self) -> usize {
        0
    }

    /// Returns the distance up to which the guide needs neighbours, metres; 0 if it needs none.
    fn reach(&self) -> f32 {
        0.0
    }

    /// Adds its velocity and effects to the output. `memory` has [`memory`](Self::memory) words, which are zero at
    /// first.
    fn guide(&self, view: &SteeringInput<'_>, memory: &mut [f32], chosen: &mut GuideOutput);

    /// Records what it constructs, for pictures. It is called only if a trace is requested.
    fn tell(&self, _view: &SteeringInput<'_>, _why: &mut TraceRecorder<'_>) {}

    /// Checks the parameters.
    ///
    /// # Errors
    /// [`Error::Limit`] names the parameter.
    fn check(&self) -> Result<(), Error> {
        Ok(())
    }
}

/// The joint output of the guides of an insect.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GuideOutput {
    /// The sum of the guides' velocities, m/s.
    pub velocity: Vec3,
    /// Factor on the noise.
    pub noise: f32,
    /// Factor on the top speed, 0 to 1.
    pub vigour: f32,
    /// A velocity that is added regardless of the vigour, m/s.
    pub drift: Vec3,
    /// Whether the insect stands still, regardless of the rest of the output.
    pub rests: bool,
}

impl Default for GuideOutput {
    fn default() -> Self {
        Self { velocity: Vec3::ZERO, noise: 1.0, vigour: 1.0, drift: Vec3::ZERO, rests: false }
    }
}

/// Checks that a number is 0 or more and finite.
pub(super) fn check_amount(what: &'static str, value: f32) -> Result<(), Error> {
    Error::unless(value >= 0.0 && value.is_finite(), what, value, "0 or more and finite")
}
