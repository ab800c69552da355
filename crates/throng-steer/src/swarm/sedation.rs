//! Sedation: smoke calms insects, and they sink to the ground.

use super::guide::{Guide, GuideOutput, check_amount};
use glam::Vec3;
use std::fmt;
use std::sync::Arc;
use throng::Error;
use throng::parameters::parameters;
use throng::space::surface::{Barrier, Surface};
use throng::steer::SteeringInput;
use throng_field::{Amplitude, FadeOut};

/// Vigour below which an insect near the ground settles.
const ASLEEP: f32 = 0.5;

/// Is sedated by smoke, as by that of a beekeeper.
///
/// An insect takes up a dose while it is in the smoke. Noise and top speed fall exponentially
/// with the dose, and the insect sinks. Where it lands it rests until, out of the smoke, the dose has worn off.
///
/// An insect cannot rest if its vehicle has a least speed.
#[derive(Clone)]
pub struct Sedation {
    /// Density of the smoke; 0 for none.
    pub smoke: Arc<dyn Amplitude>,
    /// The dose that smoke of density 1 gives, 1/s: a dose of 1 leaves a vigour of `1 / e`. Limit: >= 0.
    pub uptake: f32,
    /// Rate at which the dose wears off where there is no smoke, 1/s; 0: never. Limit: >= 0.
    pub recovery: f32,
    /// Speed of sinking at vigour 0, m/s. Limit: >= 0.
    pub sink: f32,
    /// Distance between the body and the ground, or a floor, at which an insect settles, metres. Limit: >= 0.
    pub landing: f32,
    /// Surfaces other than the ground on which insects settle.
    pub floors: Vec<Arc<dyn Surface>>,
}

/// Is sedated by smoke.
#[parameters]
pub(super) struct InSmoke {
    /// A surface with an inside, which is full of smoke.
    #[parameter(required)]
    smoke: Barrier<Arc<dyn Surface>>,
    /// Depth inside the surface at which the smoke has its full density, metres.
    #[parameter(default = 0.3, unit = "m", above = 0)]
    rim: f32,
    /// The dose of full smoke, 1/s: a dose of 1 leaves a vigour of 1/e.
    #[parameter(default = 0.5, unit = "1/s", least = 0)]
    uptake: f32,
    /// Rate at which the dose wears off outside, 1/s.
    #[parameter(default = 0.1, unit = "1/s", least = 0)]
    recovery: f32,
    /// Sinking speed without any vigour, m/s.
    #[parameter(default = 0.5, unit = "m/s", least = 0)]
    sink: f32,
    /// Height above the ground at which it settles, metres.
    #[parameter(default = 0.02, unit = "m", least = 0)]
    landing: f32,
}

impl TryFrom<InSmoke> for Sedation {
    type Error = Error;

    fn try_from(InSmoke { smoke, rim, uptake, recovery, sink, landing }: InSmoke) -> Result<Self, Error> {
        let smoke = Arc::new(FadeOut::new(smoke.surface, rim)?);
        Ok(Self { smoke, uptake, recovery, sink, landing, floors: Vec::new() })
    }
}

impl Sedation {
    /// Returns the sedation by this smoke.
    pub fn new(smoke: impl Amplitude + 'static) -> Self {
        let smoke = Arc::new(smoke);
        Self { smoke, uptake: 0.5, recovery: 0.0, sink: 0.5, landing: 0.02, floors: Vec::new() }
    }

    fn is_down(&self, view: &SteeringInput<'_>) -> bool {
        let near = self.landing + view.radius;
        let place = view.position();
        place.z <= near || self.floors.iter().any(|floor| floor.query(place).distance <= near)
    }
}

impl Guide for Sedation {
    /// The dose, and whether the insect rests.
    fn memory(&self) -> usize {
        2
    }

    fn guide(&self, view: &SteeringInput<'_>, memory: &mut [f32], chosen: &mut GuideOutput) {
        let [dose, rests] = memory else { return };
        let density = self.smoke.at(view.position(), view.time).0.max(0.0);
        if density > 0.0 {
            *dose += self.uptake * density * view.seconds;
        } else if self.recovery > 0.0 {
            *dose *= libm::expf(-self.recovery * view.seconds);
        }
        let vigour = libm::expf(-*dose);
        let stays = vigour < ASLEEP && (*rests > 0.0 || self.is_down(view));
        *rests = if stays { 1.0 } else { 0.0 };
        chosen.rests |= stays;
        chosen.noise *= vigour;
        chosen.vigour *= vigour;
        chosen.drift -= Vec3::Z * (self.sink * (1.0 - vigour));
    }

    fn check(&self) -> Result<(), Error> {
        check_amount("uptake of smoke", self.uptake)?;
        check_amount("recovery from smoke", self.recovery)?;
        check_amount("speed of sinking", self.sink)?;
        check_amount("distance of landing", self.landing)
    }
}

impl fmt::Debug for Sedation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { uptake, recovery, sink, landing, floors, .. } = self;
        let mut all = f.debug_struct("Sedation");
        all.field("uptake", uptake).field("recovery", recovery).field("sink", sink).field("landing", landing);
        all.field("floors", floors).finish_non_exhaustive()
    }
}
