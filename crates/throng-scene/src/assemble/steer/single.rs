//! What several behaviours share.

use super::or;
use crate::scene::steer::Noise;

/// Default distance at which behaviours start to slow down, if the library has none, metres.
pub(super) const SLOWING_DISTANCE: f32 = 1.0;

pub(super) fn noise(said: &Option<Noise>) -> throng_steer::Noise {
    let standard = throng_steer::Noise::default();
    let Some(said) = said else { return standard };
    throng_steer::Noise {
        period: or(said.period, standard.period),
        octaves: said.octaves.unwrap_or(standard.octaves),
        gain: or(said.gain, standard.gain),
        turbulent: said.turbulent.unwrap_or(standard.turbulent),
    }
}
