//! Amplitudes of noise.

use super::ramp;
use glam::Vec3;
use throng::Error;
use throng::space::surface::Surface;

/// An amplitude at every place and time: a factor and its gradient, per metre. Functions of a place and a time are
/// amplitudes.
///
/// ```
/// use glam::Vec3;
/// use throng_field::Amplitude;
/// // in proportion to the height above the ground
/// let shear = |place: Vec3, _: f64| (0.5 * place.z, Vec3::Z * 0.5);
/// assert_eq!(shear.at(Vec3::Z * 3.0, 0.0).0, 1.5);
/// ```
pub trait Amplitude: Send + Sync {
    /// Returns the factor and its gradient at a place, metres from the origin, and a time, seconds since the
    /// start. If the gradient is not that of the factor, the resulting field is not free of divergence.
    fn at(&self, place: Vec3, time: f64) -> (f32, Vec3);
}

impl<F: Fn(Vec3, f64) -> (f32, Vec3) + Send + Sync> Amplitude for F {
    fn at(&self, place: Vec3, time: f64) -> (f32, Vec3) {
        self(place, time)
    }
}

/// The factor 1 inside a surface and 0 beyond a distance from it, with a smooth transition.
///
/// ```
/// use glam::Vec3;
/// use throng_field::{Amplitude, FadeOut};
/// use throng::space::surface::Sphere;
/// let cloud = FadeOut::new(Sphere::new(Vec3::ZERO, 2.0)?, 1.0)?;
/// let factor = |x: f32| cloud.at(Vec3::X * x, 0.0).0;
/// assert_eq!([factor(1.9), factor(2.5), factor(3.1)], [1.0, 0.5, 0.0]);
/// # Ok::<(), throng::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct FadeOut<S> {
    surface: S,
    width: f32,
}

impl<S: Surface> FadeOut<S> {
    /// Creates an amplitude that falls to 0 within a width, metres, outside a surface.
    ///
    /// # Errors
    /// A width that is not greater than 0 and finite.
    pub fn new(surface: S, width: f32) -> Result<Self, Error> {
        Error::unless_positive("the width of a fading", width)?;
        Ok(Self { surface, width })
    }
}

impl<S: Surface> Amplitude for FadeOut<S> {
    fn at(&self, place: Vec3, _: f64) -> (f32, Vec3) {
        let near = self.surface.query(place);
        // the ramp goes from -1 at the surface to 1 at the width
        let (ramp, slope) = ramp(2.0 * near.distance / self.width - 1.0);
        (0.5 - 0.5 * ramp, near.normal * (-slope / self.width))
    }
}
