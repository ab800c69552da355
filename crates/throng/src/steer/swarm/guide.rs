//! What guides the insects of a swarm.

use crate::Error;
use crate::steer::View;
use glam::Vec3;
use std::fmt::Debug;

/// One thing that an insect of a [`Swarm`](super::Swarm) follows, or is subject to. Those of a list add up.
///
/// As a [behaviour](crate::steer::Behaviour) it keeps no state, but what it must remember is in the memory it is handed. What
/// differs from insect to insect but stays the same is drawn from `view.dice.at(0)`.
///
/// ```
/// use glam::Vec3;
/// use throng::steer::View;
/// use throng::steer::swarm::{Guide, Swarm, Wish};
///
/// /// Rises.
/// #[derive(Debug)]
/// struct Thermal {
///     speed: f32,
/// }
///
/// impl Guide for Thermal {
///     fn guide(&self, _: &View<'_>, _: &mut [f32], wish: &mut Wish) {
///         wish.drift += Vec3::Z * self.speed;
///     }
/// }
///
/// let swarm = Swarm::default().with(Thermal { speed: 0.2 });
/// ```
pub trait Guide: Debug + Send + Sync {
    /// How many words of memory it needs for each insect.
    fn memory(&self) -> usize {
        0
    }

    /// How far it must see others, metres; 0 if it sees nobody.
    fn reach(&self) -> f32 {
        0.0
    }

    /// Adds what it asks for. `memory` has [`memory`](Self::memory) words, at first zero.
    fn guide(&self, view: &View<'_>, memory: &mut [f32], wish: &mut Wish);

    /// What is wrong with the parameters, if anything is.
    ///
    /// # Errors
    /// [`Error::Limit`] names the parameter.
    fn check(&self) -> Result<(), Error> {
        Ok(())
    }
}

/// What guides ask of an insect together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wish {
    /// A velocity, m/s: the sum of what they ask for.
    pub velocity: Vec3,
    /// How strong its noise is: 1 as it was given.
    pub noise: f32,
    /// How fast it can be: a part of its top speed, 0 to 1.
    pub vigour: f32,
    /// A velocity that it is carried with, m/s, however weak it is.
    pub drift: Vec3,
    /// Whether it rests, whatever else is asked.
    pub rests: bool,
}

impl Default for Wish {
    fn default() -> Self {
        Self { velocity: Vec3::ZERO, noise: 1.0, vigour: 1.0, drift: Vec3::ZERO, rests: false }
    }
}

/// A number, 0 or more and finite.
pub(super) fn check_amount(what: &'static str, value: f32) -> Result<(), Error> {
    Error::unless(value >= 0.0 && value.is_finite(), what, value, "0 or more and finite")
}

/// A distance, which may be infinite.
pub(super) fn check_range(what: &'static str, value: f32) -> Result<(), Error> {
    Error::unless(value > 0.0, what, value, "greater than 0")
}
